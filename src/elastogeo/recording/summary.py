"""What a recording came to, as numbers and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from elastogeo.formats import SCHEMA, Gap, said_gap, said_time

SHOWN = 20
"""Gaps that are told one by one."""


@dataclass(frozen=True, slots=True)
class Recording:
    """What one run of the recorder came to.

    Attributes
    ----------
    server : str
    folder : Path
    samples : mapping of str to int
        Samples of each channel that this run put on disk, those from the server's history among them.
    filled : mapping of str to int
        Samples of each channel from the server's history.
    in_folder : mapping of str to int
        Samples of each channel in the folder, of earlier runs too.
    gaps : tuple of Gap
        Those that remain marked in the folder.
    parts : int
        Parts in the folder.
    reconnects : int
        Connections made after the first one of this run.
    notes : tuple of str
        What else must be known.
    """

    server: str
    folder: Path
    samples: Mapping[str, int]
    filled: Mapping[str, int]
    in_folder: Mapping[str, int]
    gaps: tuple[Gap, ...]
    parts: int
    reconnects: int
    notes: tuple[str, ...] = ()


def recording_lines(recording: Recording) -> list[str]:
    """The recording in sentences."""
    total, filled = sum(recording.samples.values()), sum(recording.filled.values())
    held = sum(recording.in_folder.values())
    lines = [f"{total} samples kept in {recording.folder}, which now holds {held} in {recording.parts} parts"]
    if filled:
        lines.append(f"{filled} of them are from the server's history")
    if recording.reconnects:
        lines.append(f"Connected again {recording.reconnects} times")
    if not total:
        lines.append("Nothing arrived: check that the nodes change, and that the server may be read")
    lines += [f"Samples may be missing: {said_gap(gap)}" for gap in recording.gaps[:SHOWN]]
    if len(recording.gaps) > SHOWN:
        lines.append(f"... and in {len(recording.gaps) - SHOWN} more gaps")
    return lines


def recording_json(recording: Recording) -> dict[str, Any]:
    """The recording as one JSON object."""
    return {
        "schema": SCHEMA,
        "server": recording.server,
        "folder": str(recording.folder),
        "parts": recording.parts,
        "channels": [
            {
                "name": name,
                "samples": recording.samples.get(name, 0),
                "filled": recording.filled.get(name, 0),
                "samples_in_folder": in_folder,
            }
            for name, in_folder in recording.in_folder.items()
        ],
        "gaps": [
            {
                "channel": gap.channel,
                "start": said_time(gap.start),
                "end": None if gap.end is None else said_time(gap.end),
                "cause": gap.cause,
            }
            for gap in recording.gaps
        ],
        "reconnects": recording.reconnects,
        "notes": list(recording.notes),
    }
