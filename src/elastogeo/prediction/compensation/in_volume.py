"""What the tables of all axes leave within the travel of the tests: what two axes cause together is in none of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from elastogeo.identification import Identification
from elastogeo.machine import Array, ErrorTable, Joint, motion_of
from elastogeo.prediction.compensation.by_parameters import deviation_rows, tested_spans
from elastogeo.prediction.knowledge import Knowledge, knowledge_of

PLACES = 5
"""Positions of each linear axis that the tests moved: the poses are all combinations, come to from either side."""


@dataclass(frozen=True, slots=True)
class InVolume:
    """The deviation along the linear axes, over poses within the travel of the tests.

    Attributes
    ----------
    components : tuple of str
        Of `X`, `Y`, `Z`: those that the tests determine at every pose; the others are not counted.
    axes : tuple of str
        Axes that were moved.
    poses : int
    before, after : float [mm]
        Greatest deviation of one component from that at the zero.
    bound : float [mm]
        Farthest end of the intervals after.
    """

    components: tuple[str, ...]
    axes: tuple[str, ...]
    poses: int
    before: float
    after: float
    bound: float


def in_volume(result: Identification, written: Mapping[str, ErrorTable], zero: Mapping[str, float]) -> InVolume | None:
    """What is left over the travel of the tests.

    Parameters
    ----------
    result : Identification
    written : mapping of str to ErrorTable
        By name, what the control compensates.
    zero : mapping of str to float [mm]
        By axis, where its errors count as zero.

    Returns
    -------
    InVolume or None
        None where the tests moved one linear axis only, or determine no component everywhere.
    """
    knowledge = knowledge_of(result)
    machine = knowledge.machine
    linear = [joint for joint in machine.joints if not joint.is_rotary]
    spans = {name: span for name, span in tested_spans(result).items() if span[1] > span[0]}
    axes = [joint.name for joint in linear if joint.name in spans]
    if len(axes) < 2:
        return None
    commands, sense, at_zero = _poses(knowledge, axes, spans, zero)
    before, after, doubt, seen = [], [], [], []
    for joint in linear:
        rows = deviation_rows(knowledge, commands, sense, joint)
        rows = rows - deviation_rows(knowledge, at_zero, np.zeros_like(at_zero), joint)
        found = knowledge.predict(rows)
        if rows.any() and found.supported.all():
            good = _made_good(joint, axes, written, commands, sense, machine.axes)
            seen.append(motion_of(joint.name))
            before.append(np.abs(found.value).max())
            after.append(np.abs(found.value - good).max())
            doubt.append((np.abs(found.value - good) + found.expanded).max())
    if not seen:
        return None
    return InVolume(tuple(seen), tuple(axes), len(commands), float(max(before)), float(max(after)), float(max(doubt)))


def _poses(
    knowledge: Knowledge, axes: list[str], spans: Mapping[str, tuple[float, float]], zero: Mapping[str, float]
) -> tuple[Array, Array, Array]:
    places = np.array(list(product(*(np.linspace(*spans[axis], PLACES) for axis in axes))))
    columns = [knowledge.machine.index(axis) for axis in axes]
    commands = np.tile(knowledge.centre, (2 * len(places), 1))
    commands[:, columns] = np.vstack([places, places])
    sense = np.zeros_like(commands)
    sense[:, columns] = np.repeat([1.0, -1.0], len(places))[:, np.newaxis]
    at_zero = knowledge.centre[np.newaxis].copy()
    at_zero[0, columns] = [zero.get(axis, knowledge.centre[k]) for axis, k in zip(axes, columns, strict=True)]
    return commands, sense, at_zero


def _made_good(
    joint: Joint, axes: list[str], written: Mapping[str, ErrorTable], commands: Array, sense: Array, order: tuple[str, ...]
) -> Array:
    """What all tables of one component add up to, shape (k,)."""
    total = np.zeros(len(commands))
    for axis in axes:
        table = written.get(f"E_{motion_of(joint.name)}{axis}")
        if table is not None:
            k = order.index(axis)
            total += table.deviation(commands[:, k], sense[:, k])
    return total
