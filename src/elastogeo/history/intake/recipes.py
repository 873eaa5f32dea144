"""Recipes: how a test was made, without by whom, when, with which of two like instruments: tests of one recipe compare.

In it are the kind of instrument, its set-up, the levels of the runs with their repeats and senses, the question, the
topology of the machine, what lay on the table, and whether it was measured at all. Not in it are names, dates, serial
numbers, calibrations, temperatures, files: they differ from test to test and must not make a series of its own.
"""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from math import degrees, isfinite, isinf
from typing import Any

import numpy as np

from elastogeo.drive import DriveTest
from elastogeo.history.store.columns import canonical
from elastogeo.observe import MachineTest, Run

SCHEMA = "elastogeo.recipe/1"

DIGITS = 6
"""Significant digits of a setting: the same in another unit is the same."""

SAME_LEVEL = 0.03
"""Share by which levels that count as the same may differ: a force that was read off is never quite the commanded one."""

ARC = 15.0
"""To so many degrees an arc of readings is told."""


@dataclass(frozen=True, slots=True)
class Recipe:
    """What makes tests comparable.

    Attributes
    ----------
    name : str
        For people, short: instrument, plane, levels.
    document : mapping
        All of it, as JSON has it.
    sha256 : str
        Of the document in its canonical form.
    """

    name: str
    document: Mapping[str, Any]
    sha256: str


def recipe_of(test: MachineTest | DriveTest) -> Recipe:
    """How a test was made.

    Returns
    -------
    Recipe
        Equal for tests that compare; a set-up in other units, other names, dates, serial numbers, calibrations,
        temperatures and files change nothing.
    """
    if isinstance(test, DriveTest):
        document, name = _of_drives(test), f"feed drives {' '.join(test.axes)}"
    else:
        document, name = _of_machine(test), _name(test)
    document = {"schema": SCHEMA, "origin": origin_of(test), **document}
    if document["origin"] != "measured":
        name = f"{name}, {document['origin']}"
    return Recipe(name, document, hashlib.sha256(canonical(document).encode()).hexdigest())


def origin_of(test: MachineTest | DriveTest) -> str:
    """`measured`, `simulated` or `reconstructed`: tests of two origins never stand in one series."""
    if test.simulated:
        return "simulated"
    return "reconstructed" if isinstance(test, MachineTest) and test.reconstructed else "measured"


def alike(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether two recipes are one but for levels that differ by less than `SAME_LEVEL`."""
    return not differing(one, other)


def differing(one: Any, other: Any, at: str = "") -> tuple[str, ...]:
    """Where two recipes differ: names of the settings, as in `setup.circle.radius`, `runs.level`."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        keys = sorted({*one, *other})
        found = [part for key in keys for part in differing(one.get(key), other.get(key), f"{at}.{key}".lstrip("."))]
        return tuple(dict.fromkeys(found))
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return tuple(dict.fromkeys(part for a, b in zip(one, other, strict=True) for part in differing(a, b, at)))
    if at.endswith(".level") and isinstance(one, float) and isinstance(other, float):
        return () if abs(one - other) <= SAME_LEVEL * max(abs(one), abs(other)) else (at,)
    return () if one == other else (at,)


def _of_machine(test: MachineTest) -> dict[str, Any]:
    setup = test.setup
    usual = {field.name: field.default for field in fields(setup)}  # type: ignore[arg-type]
    settings = {
        field.name: _plain(getattr(setup, field.name))
        for field in fields(setup)  # type: ignore[arg-type]
        if field.name not in setup.knowledge
    }
    return {
        "instrument": test.instrument,
        "topology": test.machine.topology.compact,
        "setup": settings,
        "corrections": [name for name in setup.corrections if getattr(setup, name) != usual[name]],
        "workpiece": _plain(test.workpiece),
        "question": _plain(test.question),
        "runs": list(_runs(test.runs, test.setup.pose_quantity)),
    }


def _of_drives(test: DriveTest) -> dict[str, Any]:
    return {
        "instrument": "feed-drives",
        "axes": sorted(test.axes),
        "efforts": sorted({f"{record.axis} {record.effort_unit}" for record in test.records}),
        "model": _plain(test.model),
        "searched": sorted(test.searched),
        "known": sorted(f"{axis} {name}" for axis, values in test.known.items() for name in values),
    }


def _runs(runs: Sequence[Run], pose: str) -> Iterator[dict[str, Any]]:
    """What was done in the runs: each setting once, with how often it was repeated; in the order of their levels."""
    done = [_run(run, pose) for run in runs]
    levels = _grouped([run["level"] for run in done])
    counted = Counter(canonical({**run, "level": levels[run["level"]]}) for run in done)
    for settings in sorted(map(json.loads, counted), key=lambda run: (run["of"], run["level"], canonical(run))):
        yield {**settings, "runs": counted[canonical(settings)]}


def _grouped(levels: Sequence[float]) -> dict[float, float]:
    """The level that each counts as: those that differ by less than `SAME_LEVEL` are one, the first of them."""
    found: dict[float, float] = {}
    first = None
    for level in sorted(set(levels)):
        first = level if first is None or abs(level - first) > SAME_LEVEL * abs(level) else first
        found[level] = first
    return found


def _run(run: Run, pose: str) -> dict[str, Any]:
    of = next((name for name in ("pressure", "force", "engagement") if getattr(run, name) is not None), "")
    found = {
        "of": of,
        "level": _plain(float(getattr(run, of))) if of else 0.0,
        "sense": run.sense,
        "feed": _plain(run.feed),
    }
    along = run.columns.get(pose)
    if pose == "angle" and along is not None and len(along):
        found["arc_deg"] = round(degrees(float(np.ptp(along))) * len(along) / max(len(along) - 1, 1) / ARC) * ARC
    if pose == "target" and along is not None:
        found["targets"] = [_plain(float(target)) for target in np.unique(np.round(along, DIGITS))]
    return found


def _plain(value: Any) -> Any:
    """A setting as JSON has it, numbers to `DIGITS`."""
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, tuple | list | np.ndarray):
        return [_plain(entry) for entry in value]
    if isinstance(value, bool | str) or value is None:
        return value
    number = float(value)
    if isfinite(number):
        return float(f"{number:.{DIGITS}g}") + 0.0
    return ("inf" if number > 0 else "-inf") if isinf(number) else "nan"


def _name(test: MachineTest) -> str:
    """What people call it: instrument, plane or axis, radius, levels."""
    facts = {fact.name: fact.value for fact in test.setup.facts()}
    parts = [test.instrument.replace("-", " ")]
    if "plane" in facts:
        parts.append(facts["plane"] if isinstance(facts["plane"], str) else "tilted")
    if "radius" in facts:
        parts.append(f"R{facts['radius']:g}")
    if isinstance(facts.get("axis"), str):
        parts.append(str(facts["axis"]))
    parts += _levels(test.runs)
    return " ".join(parts)


def _levels(runs: Sequence[Run]) -> list[str]:
    for of, unit in (("pressure", "bar"), ("force", "N"), ("engagement", "mm")):
        levels = sorted({getattr(run, of) for run in runs if getattr(run, of) is not None})
        if levels:
            return [f"{levels[0]:.3g} {unit}" if len(levels) == 1 else f"{levels[0]:.3g} to {levels[-1]:.3g} {unit}"]
    return []
