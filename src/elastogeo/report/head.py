"""The head of every page about a test: who, when, which machine and instrument, how, with which files."""

from __future__ import annotations

from typing import Any

from elastogeo.observe import MachineTest
from elastogeo.report.text import in_micrometres
from elastogeo.report.view import Section, Table

_MINUTE = 60.0


def head(test: MachineTest) -> tuple[tuple[str, str], ...]:
    """What was tested and how, as labelled lines; nothing is said of what is not known."""
    topology, about = test.machine.topology, test.about
    readings = sum(len(next(iter(run.columns.values()))) for run in test.runs)
    reference = test.question.reference_force
    files = {run.file for run in test.runs if run.sha256}
    lines = [
        ("Machine", f"{test.machine.name}, {topology.compact} {topology.iso}"),
        ("Machine serial number", about.machine_serial),
        ("Instrument", ", ".join(filter(None, (test.instrument.replace("-", " "), about.instrument)))),
        ("Instrument serial number", about.instrument_serial),
        ("Calibrated", about.instrument_calibrated),
        ("Date", about.date),
        ("Operator", about.operator),
        ("Place", about.place),
        ("Path", _path(test)),
        ("Runs", f"{len(test.runs)}, with {readings} readings"),
        ("Asked for", ", ".join(test.asked)),
        ("Reference", "" if reference is None else f"the readings at {reference:g} N are subtracted"),
        ("Resolution", "not stated" if test.resolution is None else f"{in_micrometres(test.resolution)} µm"),
        ("Remarks", about.remarks),
        ("Files", f"{len(files)}, their SHA-256 below" if files else ""),
    ]
    return tuple((label, text) for label, text in lines if text)


def files_section(test: MachineTest) -> tuple[Section, ...]:
    """The files that the runs were read from, with their hashes; none where there are none."""
    rows = tuple((run.name, run.file, run.sha256) for run in test.runs if run.sha256)
    return (Section("Files", tables=(Table(("run", "file", "SHA-256"), rows, words=(0, 1, 2)),)),) if rows else ()


def origin(test: MachineTest) -> str:
    """Whether the readings, or which of them, are simulated, and from what; empty if all were measured."""
    if not test.simulated:
        return ""
    marked = sum(bool(run.simulated) for run in test.runs)
    some = f" ({marked} of {len(test.runs)} runs)" if 0 < marked < len(test.runs) else ""
    return f"Simulated{some}: {test.simulated}"


def _path(test: MachineTest) -> str:
    known: dict[str, Any] = {fact.name: fact.value for fact in test.setup.facts()}
    if "plane" not in known:
        return ""
    plane = f"plane {known['plane']}" if isinstance(known["plane"], str) else "a tilted plane"
    return f"circle, {plane}, radius {known['radius']:g} mm, {known['feed'] * _MINUTE:g} mm/min"
