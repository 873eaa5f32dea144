"""Of identified compliance and geometry: how stiff, how square, how straight the machine is where the test moved it.

Each is what an ideal sensor would read, so that what the test does not tell by itself (one of a sum) is no indicator,
whatever the parameters are called.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations
from math import inf, isfinite

import numpy as np

from elastogeo.changes.indicators.register import indicates
from elastogeo.changes.kinds import KINDS, Kind
from elastogeo.changes.series import Indicator
from elastogeo.errors import UnsupportedError
from elastogeo.identification import Identification
from elastogeo.machine import Array
from elastogeo.prediction import Knowledge, Span, entry_rows, knowledge_of, virtual_observations

DIRECTIONS = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}

_STILL = 1e-6
"""Travel [mm] of an axis that stands."""

_OTHER = 0.01
"""Share, in scaled parameters, by which the compliance at the ends of a travel must be another sum than at its middle."""


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
    """An indicator as a linear functional of all parameters, shape (p,): itself, or its inverse."""

    name: str
    kind: Kind
    row: Array
    inverse: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Around:
    """Where a test moved the machine: its middle, and half the travel of each linear axis that moved [mm]."""

    commands: Array
    tool: Array
    half: Mapping[str, float]


@indicates(Identification)
def of_an_identification(result: Identification) -> tuple[Indicator, ...]:
    """Stiffness at the middle, squareness, backlash, scale, straightness, stiffness at the ends of the travel."""
    knowledge = knowledge_of(result)
    asked = [one for one in asked_of(result, knowledge) if one.row.any()]
    if not asked:
        return ()
    found = _by_scatter(knowledge).predict(np.array([one.row for one in asked]))
    every = zip(asked, found.value, found.standard_uncertainty, strict=True)
    return tuple(_indicator(one, float(value), float(u)) for one, value, u in every if has_value(one, value))


def asked_of(result: Identification, knowledge: Knowledge) -> tuple[Asked, ...]:
    """Every indicator that a test may determine, the most important first."""
    around = around_of(result)
    axes = tuple(around.half)
    return (
        *_stiffness(knowledge, around),
        *(_squareness(knowledge, around, *pair) for pair in combinations(axes, 2)),
        *_backlash(knowledge),
        *(_scale_difference(knowledge, around, *pair) for pair in combinations(axes, 2)),
        *(_straightness(knowledge, around, axis, across) for axis in axes for across in axes if across != axis),
        *_stiffness_at_ends(knowledge, around),
    )


def _by_scatter(knowledge: Knowledge) -> Span:
    """What is known of the parameters, with the scatter of the runs as its only uncertainty."""
    span = knowledge.span
    return replace(span, systematic=np.zeros((len(span.value), 0)), freedoms=np.zeros(0))


def has_value(asked: Asked, value: float) -> bool:
    """Whether the test determines it; a compliance that noise makes negative has no stiffness."""
    return isfinite(value) and (value > 0 or not asked.inverse)


def _indicator(asked: Asked, value: float, u: float) -> Indicator:
    u = u if isfinite(u) else inf
    return (
        Indicator(asked.name, asked.kind, 1 / value, u / value**2)
        if asked.inverse
        else Indicator(asked.name, asked.kind, value, u)
    )


def around_of(result: Identification) -> Around:
    """Where the (first) test of a result moved the machine."""
    observations = next(iter(result.campaign.tests.values())).observations()
    machine = result.campaign.machine
    every = np.concatenate([run.commands for run in observations])
    low, high = every.min(axis=0), every.max(axis=0)
    travel = {axis: float(high[k] - low[k]) for k, axis in enumerate(machine.axes)}
    half = {axis: travel[axis] / 2 for axis in DIRECTIONS if travel.get(axis, 0.0) > _STILL}
    return Around(observations[0].centre, observations[0].tool, half)


def _moved(knowledge: Knowledge, around: Around, travel: Mapping[str, float]) -> Array:
    """Commands with some axes moved from the middle."""
    commands = np.array(around.commands, dtype=float)
    for axis, by in travel.items():
        commands[knowledge.machine.index(axis)] += by
    return commands


def _compliance(knowledge: Knowledge, around: Around, commands: Array, direction: str) -> Array:
    k = "XYZ".index(direction)
    return np.asarray(entry_rows(knowledge, commands, around.tool, [(k, k)])[0, 0])


def _stiffness(knowledge: Knowledge, around: Around) -> Iterator[Asked]:
    try:
        for axis in DIRECTIONS:
            row = _compliance(knowledge, around, around.commands, axis)
            yield Asked(f"stiffness {axis}", KINDS["stiffness"], row, inverse=True)
    except UnsupportedError:  # no compliance was asked for, or none that is constant
        return


def _stiffness_at_ends(knowledge: Knowledge, around: Around) -> Iterator[Asked]:
    """Across each travel: what a guideway gives way to moments shows at its ends."""
    try:
        for axis, half in around.half.items():
            for across in around.half:
                if across == axis:
                    continue
                middle = _compliance(knowledge, around, around.commands, across)
                ends = [_compliance(knowledge, around, _moved(knowledge, around, {axis: s * half}), across) for s in (-1, 1)]
                row = np.mean(ends, axis=0)
                if np.linalg.norm((row - middle) * knowledge.scales) > _OTHER * np.linalg.norm(row * knowledge.scales):
                    yield Asked(f"stiffness {across} at the ends of {axis}", KINDS["stiffness"], row, inverse=True)
    except UnsupportedError:
        return


def _displacement(knowledge: Knowledge, around: Around, travel: Mapping[str, float], direction: str) -> Array:
    """What geometry displaces the tool by in a direction, shape (p,), without any load."""
    twist = np.array([*DIRECTIONS[direction], 0.0, 0.0, 0.0])
    at = virtual_observations(knowledge.machine, _moved(knowledge, around, travel), twist, np.zeros(6), around.tool)
    row = knowledge.rows(at)[0]
    row[[k for k, source in enumerate(knowledge.sources) if source.elastic]] = 0.0
    return np.asarray(row)


def _slope(knowledge: Knowledge, around: Around, axis: str, direction: str) -> Array:
    half = around.half[axis]
    ends = [_displacement(knowledge, around, {axis: s * half}, direction) for s in (-1, 1)]
    return (ends[1] - ends[0]) / (2 * half)


def _squareness(knowledge: Knowledge, around: Around, one: str, other: str) -> Asked:
    """By how much the angle between the positive directions is too small [rad]."""
    row = _slope(knowledge, around, one, other) + _slope(knowledge, around, other, one)
    return Asked(f"squareness {one}{other}", KINDS["squareness"], row)


def _scale_difference(knowledge: Knowledge, around: Around, one: str, other: str) -> Asked:
    """By how much `one` travels too far against `other`: the length of the bar, and the temperature, are in both."""
    row = _slope(knowledge, around, one, one) - _slope(knowledge, around, other, other)
    return Asked(f"scale difference {one}{other}", KINDS["scale"], row)


def _straightness(knowledge: Knowledge, around: Around, axis: str, across: str) -> Asked:
    """How far both ends of the travel are off the line through its middle [mm]: positive towards + of `across`."""
    half = around.half[axis]
    ends, middle = ({axis: -half}, {axis: half}), _displacement(knowledge, around, {}, across)
    row = np.mean([_displacement(knowledge, around, end, across) for end in ends], axis=0) - middle
    return Asked(f"straightness {axis} in {across}", KINDS["straightness"], row)


def _backlash(knowledge: Knowledge) -> Iterator[Asked]:
    for k, source in enumerate(knowledge.sources):
        if source.sign is not None and source.sign.kind == "backlash" and source.unit == "mm":
            row = np.zeros(len(knowledge.sources))
            row[k] = source.sign.factor
            yield Asked(f"backlash {source.sign.axis}", KINDS["backlash"], row)
