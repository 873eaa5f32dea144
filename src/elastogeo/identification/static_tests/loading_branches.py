"""Loading branches: between which readings a force rises and falls, and which of them make cycles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array

DEAD_BAND = 0.05
"""Share of the force's range by which it must come back for a turning point to count: less is noise of the load cell."""

FULL = 0.9
"""Share of the force's range that a branch must cover to count: the first one up to a load from zero may not."""


@dataclass(frozen=True, slots=True)
class Branch:
    """Readings between two turning points of the force.

    Attributes
    ----------
    first, last : int
        Its readings, as `[first:last]`; a turning point belongs to both branches that meet there.
    rising : bool
        Whether the force goes up.
    least, greatest : float [N]
        Force.
    """

    first: int
    last: int
    rising: bool
    least: float
    greatest: float


def turning_points(force: Array, dead_band: float) -> tuple[int, ...]:
    """Readings at which the force turns back by more than a dead band, the first and the last reading among them.

    Parameters
    ----------
    force : array, shape (m,) [N]
    dead_band : float [N]
        Less is noise; dwells do not turn.
    """
    points = [0]
    low = high = sense = 0
    for k, value in enumerate(force):
        if sense >= 0 and value >= force[high]:
            high = k
        if sense <= 0 and value <= force[low]:
            low = k
        if sense >= 0 and force[high] - value > dead_band:
            points.append(high)
            sense, low = -1, k
        elif sense <= 0 and value - force[low] > dead_band:
            points.append(low)
            sense, high = 1, k
    return tuple(dict.fromkeys([*points, len(force) - 1]))


def branches_of(force: Array, dead_band: float = DEAD_BAND) -> tuple[Branch, ...]:
    """The branches of a force that goes up and down, in order.

    Parameters
    ----------
    force : array, shape (m,) [N]
    dead_band : float
        Share of its range by which it must come back for a turning point to count.
    """
    points = turning_points(force, dead_band * float(np.ptp(force)))
    found = []
    for first, last in pairwise(points):
        part = force[first : last + 1]
        if np.ptp(part) > dead_band * np.ptp(force):
            found.append(Branch(first, last + 1, bool(part[-1] > part[0]), float(part.min()), float(part.max())))
    return tuple(found)


def loading_cycles(branches: Sequence[Branch], force: Array) -> tuple[tuple[Branch, Branch], ...]:
    """Rising and falling branches that cover the range, paired with their neighbours in time.

    Raises
    ------
    UnsupportedError
        If there is no such pair.
    """
    whole = float(np.ptp(force))
    full = [branch for branch in branches if branch.greatest - branch.least >= FULL * whole]
    cycles = []
    k = 0
    while k + 1 < len(full):
        one, other = full[k : k + 2]
        if one.rising != other.rising:
            cycles.append((one, other) if one.rising else (other, one))
            k += 1
        k += 1
    if not cycles:
        senses = {branch.rising for branch in full}
        only = "no" if not full else "only a rising" if senses == {True} else "only a falling"
        raise UnsupportedError(
            f"of {len(branches)} branches of the force {only} branch covers its range of {whole:g} N; hysteresis takes "
            f"loading and unloading over the same forces. For loads that do not come back use static_line"
        )
    return tuple(cycles)
