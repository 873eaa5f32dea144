"""Live acquisition from a control into files that `formats` can read. Stands on `formats` and `errors`."""

from elastogeo.recording.recorder import record
from elastogeo.recording.settings import RecordedNode, RecordingPlan, named_nodes, planned, read_plan
from elastogeo.recording.summary import Recording, recording_json, recording_lines
from elastogeo.recording.writing import Watcher

__all__ = [
    "RecordedNode",
    "Recording",
    "RecordingPlan",
    "Watcher",
    "named_nodes",
    "planned",
    "read_plan",
    "record",
    "recording_json",
    "recording_lines",
]
