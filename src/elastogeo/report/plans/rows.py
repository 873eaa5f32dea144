"""The tests of a plan in words and figures."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees
from typing import Any

import numpy as np

from elastogeo.machine import Machine
from elastogeo.observe import MachineTest
from elastogeo.planning import Candidate, Plan
from elastogeo.report.numbers import display_unit, pretty, significant, whole_percent
from elastogeo.report.view import Table

PER_NEWTON = "mm/N"
_ROUND = 0.5
"""Of a turn's angle [deg]: less is rounding."""


def test_table(plan: Plan) -> Table:
    """The tests in the order of doing."""
    unit = display_unit(PER_NEWTON, plan.tests[-1].worst_so_far)
    rows = tuple(
        (
            str(k),
            one.candidate.name,
            one.candidate.test.instrument.replace("-", " "),
            what_of(one.candidate),
            where_of(one.candidate),
            f"{one.candidate.minutes:.0f}",
            str(one.rank_so_far),
            whole_percent(one.supported_so_far),
            significant(one.worst_so_far * unit.factor),
        )
        for k, one in enumerate(plan.tests, start=1)
    )
    headings = ("", "test", "instrument", "what", "where", "min", "rank", "supported [%]", f"worst u [{unit.name}]")
    return Table(
        headings,
        rows,
        words=(1, 2, 3, 4),
        title="Tests, in the order of doing",
        note="Rank, share of the workspace supported and worst standard uncertainty (with the stated prior) are those after "
        "the test, with all before it.",
    )


def what_of(candidate: Candidate) -> str:
    """What a test does: plane, radius and what turns; or directions."""
    facts: dict[str, Any] = {fact.name: fact.value for fact in candidate.setup.facts()}
    parts = []
    if "plane" in facts:
        plane = facts["plane"]
        angle = candidate.test.observations()[0].pose
        turn, full = np.ptp(angle), 2 * np.pi * (1 - 1.5 / len(angle))
        arc = "circle" if turn > full else f"arc of {degrees(float(turn)):.0f}°"
        parts.append(f"{plane if isinstance(plane, str) else 'tilted'} {arc}, R {facts['radius']:g} mm")
    if "across" in facts:
        parts.append(f"probe across {facts['across']}, {_beside(facts)}")
    if "sensors" in facts:
        parts.append(f"{len(candidate.test.runs)} forces, {facts['sensors']} sensors")
    if "probes" in facts:
        parts.append(f"{len(candidate.test.runs)} forces, {len(candidate.setup.quantities) - 1} probes")
    if "direction of the sensor" in facts and "across" not in facts:
        parts.append("force and sensor")
    turns = facts.get("rotary turn")
    if isinstance(turns, dict) and turns:
        parts.append(f"{' and '.join(turns)} turning")
    tool = _tool(candidate.test)
    return ", ".join([*parts, *([tool] if tool else [])])


def where_of(candidate: Candidate) -> str:
    """Where a test stands: axis commands at its centre."""
    machine = candidate.test.machine
    centre = np.asarray(candidate.test.observations()[0].commands)
    middle = (centre.min(axis=0) + centre.max(axis=0)) / 2
    said = [_said(machine, k, float(value), float(np.ptp(centre[:, k]))) for k, value in enumerate(middle)]
    return pretty(" ".join(filter(None, said)))


def _said(machine: Machine, k: int, value: float, span: float) -> str:
    joint = machine.joints[k]
    if not joint.is_rotary:
        return f"{joint.name} {round(value)}"
    if degrees(span) > _ROUND:
        low, high = degrees(value - span / 2), degrees(value + span / 2)
        return f"{joint.name} {round(low)} to {round(high)}°"
    return f"{joint.name} {round(degrees(value))}°" if joint.compliant else ""


def _beside(facts: Mapping[str, Any]) -> str:
    """Along what a probe across a joint reads, and where it touches, in the frame of the carriage."""
    (sensor,), (point,) = facts["direction of the sensor"], facts["point of the sensor"]
    along = "".join(axis for axis, part in zip("xyz", sensor, strict=True) if part)
    at = "at the origin" if not any(point) else f"at {', '.join(f'{part:.0f}' for part in point)} mm"
    return f"along {along} {at}"


def _tool(test: MachineTest) -> str:
    """The tool, where it is not the machine's own."""
    tool = getattr(test.setup, "tool", None)
    if tool is None or tuple(tool) == test.machine.tool:
        return ""
    return f"tool at {', '.join(f'{part:g}' for part in tool)} mm"
