"""How a fault of each component moves the indicators of a test: from the columns of its own design, and of what it left out.

A fault is a change of parameters, asked for or not: a guideway that wears gives way across its axis and to moments, and its
path bends; a nut gives way along its axis and has backlash. What such a change does to the readings is a column (Eq. 4.13);
what the readings make of it, the estimate decides: so a fault that the question does not hold shows where it would be taken
for another.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from elastogeo.changes.causes import Signatures
from elastogeo.changes.indicators.identified import around_of, asked_of, has_value
from elastogeo.identification import Diagnosis, Identification, systems_of
from elastogeo.machine import SPINDLE, Array, Joint, Machine
from elastogeo.observe import Observations
from elastogeo.prediction import Knowledge, knowledge_of, parameter_scales
from elastogeo.result import Result
from elastogeo.sources import Source, design_rows, select_sources

GAUGE = 0.02
"""Share by which a force gauge, or what it is read with, may be off after a knock or a calibration."""

_NOTHING = 1e-6
"""Of its scale: an indicator that a typical fault moves by less is not moved by it."""

Fault = tuple[str, bool, tuple[tuple[Source, float], ...]]
"""A component, whether its fault has one sign only, and the parameters that change together, by how much."""


def signatures_of(result: Result) -> Signatures | None:
    """The signatures of the components of the machine in this test; None for a result that is no identification of joints.

    They depend on the machine and the recipe, hardly on the readings: one test of a series serves for all.
    """
    found = result.identification if isinstance(result, Diagnosis) else result
    if not isinstance(found, Identification):
        return None
    knowledge = knowledge_of(found)
    asked = [one for one in asked_of(found, knowledge) if one.row.any()]
    values = knowledge.predict(np.array([one.row for one in asked])).value if asked else np.zeros(0)
    kept = [k for k, one in enumerate(asked) if has_value(one, float(values[k]))]
    if not kept:
        return None
    asked, values = [asked[k] for k in kept], values[kept]
    faults = tuple(faults_of(knowledge.machine, around_of(found).half))
    taken_for = _taken_for(found, faults)
    moved = np.array([one.row for one in asked]) @ _onto(knowledge) @ taken_for
    inverse = np.array([one.inverse for one in asked])
    moved = moved * np.where(inverse, -1 / values**2, 1.0)[:, np.newaxis]
    scale = np.array([abs(v) if one.inverse else one.kind.reproducibility for v, one in zip(values, asked, strict=True)])
    moved[np.abs(moved) < _NOTHING * scale[:, np.newaxis]] = 0.0
    return Signatures(
        components=(*(component for component, _, _ in faults), "spindle side", "workpiece side", "instrument"),
        indicators=tuple(one.name for one in asked),
        matrix=np.asarray(moved.T),
        one_sided=(*(one_sided for _, one_sided, _ in faults), True, True, False),
    )


def faults_of(machine: Machine, moving: Collection[str] = ()) -> Iterator[Fault]:
    """Every way in which a component of the machine may change; axes that the test moves come first."""
    linear = [joint for joint in machine.joints if not joint.is_rotary]
    linear.sort(key=lambda joint: joint.name not in moving)
    for joint in linear:
        yield from _of_drive(machine, joint)
    for source in select_sources(machine, ("E_?(0*)?|",)) if len(linear) > 1 else ():
        if source.sign is not None and source.sign.kind == "squareness":
            yield f"squareness {''.join(sorted((source.sign.axis, source.sign.other)))}", False, _typical([source])
    for joint in linear:
        yield from _of_guideway(machine, joint)
    for joint in machine.joints:
        if joint.is_rotary and joint.name != SPINDLE:
            yield from _of_rotary(machine, joint)


def _of_drive(machine: Machine, joint: Joint) -> Iterator[Fault]:
    """Nut and screw act along the axis: they give way, have play, change their pitch."""
    along, name = "XYZ"[joint.direction], joint.name
    yield f"drive {name}", True, _named(machine, f"C_{along}{along}{name}")
    yield f"drive {name}", True, _named(machine, f"B_{along}{name}")
    yield f"drive {name}", False, _named(machine, f"E_{along}{name}1")


def _of_guideway(machine: Machine, joint: Joint) -> Iterator[Fault]:
    """A guideway gives way across the axis and to moments, and its path bends."""
    for letter in "XYZ":
        if letter != "XYZ"[joint.direction]:
            yield f"guideway {joint.name}", True, _named(machine, f"C_{letter}{letter}{joint.name}")
            yield f"guideway {joint.name}", False, _named(machine, f"E_{letter}{joint.name}2")
    for letter in "ABC":
        yield f"guideway {joint.name}", True, _named(machine, f"C_{letter}{letter}{joint.name}")


def _of_rotary(machine: Machine, joint: Joint) -> Iterator[Fault]:
    for letter in "XYZABC":
        yield f"rotary axis {joint.name}", True, _named(machine, f"C_{letter}{letter}{joint.name}")


def _named(machine: Machine, name: str) -> tuple[tuple[Source, float], ...]:
    return _typical(select_sources(machine, (name,)))


def _typical(sources: Sequence[Source]) -> tuple[tuple[Source, float], ...]:
    """Each by the size that a parameter of its kind is expected to have."""
    return tuple((source, float(size)) for source, size in zip(sources, parameter_scales(sources), strict=True))


def _taken_for(result: Identification, faults: Sequence[Fault]) -> Array:
    """What each fault is taken for by the retained parameters, shape (r, faults + 3), by least squares."""
    systems = systems_of(result.campaign)
    labels = result.solution.labels
    elastic = [source.elastic for source in systems.sources if source.name in labels]
    order = [source.name for source in systems.sources if source.name in labels]
    loaded = [order[k] for k in range(len(order)) if elastic[k]]
    columns, seen = [], []
    for run in systems.runs:
        root = np.sqrt(np.broadcast_to(run.counted, (run.readings,)))[:, np.newaxis]
        values = [result.solution.values[labels.index(label)] for label in loaded]
        gauge = GAUGE * run.design_of(loaded) @ np.array(values)[:, np.newaxis] if loaded else np.zeros((run.readings, 1))
        other = run.without_own(_columns(result.campaign.machine, faults, run.observations))
        columns.append(root * run.design_of(labels))
        seen.append(root * np.hstack([other, gauge]))
    design = np.vstack(columns)
    norms = np.linalg.norm(design, axis=0)
    return np.asarray(np.linalg.lstsq(design / norms, np.vstack(seen), rcond=None)[0] / norms[:, np.newaxis])


def _columns(machine: Machine, faults: Sequence[Fault], observations: Observations) -> Array:
    """What each fault does to the readings of a run, then a tool or a workpiece that gives way alike in all directions."""
    sources = [source for _, _, changes in faults for source, _ in changes]
    sizes = np.array([size for _, _, changes in faults for _, size in changes])
    made = design_rows(sources, machine, observations)[:, :-1] * sizes
    at_the_tool = 5e-6 * np.einsum("mi,mi->m", observations.direction[:, :3], observations.wrench[:, :3])
    return np.column_stack([made, at_the_tool, at_the_tool])


def _onto(knowledge: Knowledge) -> Array:
    """What a unit of each retained parameter says of all parameters, shape (p, r)."""
    seen, scales = knowledge.seen, knowledge.scales[:, np.newaxis]
    chosen = [knowledge.confounding.labels.index(label) for label in knowledge.solution.labels]
    return np.asarray(scales * (seen @ (seen / scales).T[:, chosen]))
