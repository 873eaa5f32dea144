"""Which way, and for which time, an axis came to each target: as the run says, or as its order shows."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array
from elastogeo.observe.run import Run

SAME_TARGET = 1e-7
"""Share of the span of the targets by which two may differ and still be one: rounding in the file."""


@dataclass(frozen=True, slots=True)
class Approaches:
    """How each reading was approached.

    Attributes
    ----------
    sense : array, shape (m,)
        +1 where the axis came in its positive direction, -1 in its negative one.
    cycle : array of int, shape (m,)
        For which time, from 1, it came so to this target: the j of ISO 230-2.
    """

    sense: Array
    cycle: Array


def approaches(run: Run, target: Array) -> Approaches:
    """How each reading of a run was approached.

    The columns `direction` (+1, -1) and `cycle` say it. Without the first, an axis that goes on to another target comes from
    the last one, and an axis that is read twice in succession at one target has passed it and come back. Without the second,
    the approaches of each target from each side are counted.

    Parameters
    ----------
    run : Run
    target : array, shape (m,) [mm or rad]
        In the order in which it was read.

    Raises
    ------
    InputError
        If the direction is neither +1 nor -1 or cannot be seen, or a cycle comes to one target twice from one side.
    """
    target = distinct(target)
    sense = _senses(run, target)
    if "cycle" not in run.columns:
        return Approaches(sense, _counted(target, sense))
    cycle = np.asarray(run.columns["cycle"])
    if not np.array_equal(cycle, np.round(cycle)):
        raise InputError(f"run {run.name!r}: the column cycle must hold whole numbers; number the cycles 1, 2, 3, ...")
    (most, times), *_ = Counter(zip(cycle.tolist(), target.tolist(), sense.tolist(), strict=True)).most_common(1)
    if times > 1:
        raise InputError(
            f"run {run.name!r}: cycle {most[0]:g} comes {times} times to the target {most[1]:.6g} in the direction "
            f"{'+' if most[2] > 0 else '-'}; number the cycles anew, or leave the column cycle out"
        )
    return Approaches(sense, cycle.astype(int))


def distinct(target: Array) -> Array:
    """The same targets, shape (m,), where those that differ by rounding are one number."""
    values, place = np.unique(target, return_inverse=True)
    first = np.flatnonzero(np.diff(values, prepend=-np.inf) > SAME_TARGET * np.ptp(values))
    return np.asarray(values[first[np.searchsorted(first, place, side="right") - 1]])


def _senses(run: Run, target: Array) -> Array:
    if "direction" in run.columns:
        given = np.asarray(run.columns["direction"], dtype=float)
        wrong = np.flatnonzero(np.abs(given) != 1)
        if len(wrong):
            raise InputError(
                f"run {run.name!r}: the direction of reading {wrong[0] + 1} is {given[wrong[0]]:g}; write + or - (1 or -1)"
            )
        return given
    step = np.sign(np.diff(target))
    moves = np.flatnonzero(step)
    if not len(moves):
        raise InputError(
            f"run {run.name!r} stays at one target, so that its order does not show from which side it came; add a column "
            f"direction of + and -"
        )
    sense = np.empty(len(target))
    sense[0] = step[moves[0]]
    for k, one in enumerate(step, 1):
        sense[k] = one or -sense[k - 1]
    return sense


def _counted(target: Array, sense: Array) -> Array:
    seen: Counter[tuple[float, float]] = Counter()
    cycle = np.empty(len(target), dtype=int)
    for k, place in enumerate(zip(target.tolist(), sense.tolist(), strict=True)):
        seen[place] += 1
        cycle[k] = seen[place]
    return cycle
