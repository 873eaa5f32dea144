"""The head of every page about a test: what was tested, how, with what."""

from __future__ import annotations

from elastogeo.observe import MachineTest
from elastogeo.report.document import instrument_name
from elastogeo.report.text import in_micrometres


def head(test: MachineTest) -> tuple[tuple[str, str], ...]:
    """What was tested and how, as labelled lines."""
    topology = test.machine.topology
    readings = sum(len(next(iter(run.columns.values()))) for run in test.runs)
    reference = test.question.reference_force
    lines = [
        ("Machine", f"{test.machine.name}, {topology.compact} {topology.iso}"),
        ("Instrument", instrument_name(test).replace("-", " ")),
        ("Runs", f"{len(test.runs)}, with {readings} readings"),
        ("Asked for", ", ".join(test.asked)),
    ]
    if reference is not None:
        lines.append(("Reference", f"the readings at {reference:g} N are subtracted"))
    resolution = "not stated" if test.resolution is None else f"{in_micrometres(test.resolution)} µm"
    return (*lines, ("Resolution", resolution))
