"""In which order to make the tests of a plan: one tool after the other, the ball moved as little as may be."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.machine import Array
from elastogeo.planning.offers.candidate import Candidate


def in_order_of_doing(tests: Sequence[Candidate]) -> list[Candidate]:
    """The tests, those of one instrument and tool together, each nearest to the one before it.

    Parameters
    ----------
    tests : sequence of Candidate
    """
    groups: dict[object, list[Candidate]] = {}
    for one in tests:
        observed = one.test.observations()[0]
        groups.setdefault((one.test.instrument, tuple(observed.tool)), []).append(one)
    return [one for group in groups.values() for one in _nearest_next(group)]


def _nearest_next(group: Sequence[Candidate]) -> list[Candidate]:
    """From the first one on, each time the nearest that is left."""
    places = np.array([_place(one) for one in group])
    left, order = list(range(1, len(group))), [0]
    while left:
        apart = np.linalg.norm(places[left] - places[order[-1]], axis=1)
        order.append(left.pop(int(np.argmin(apart))))
    return [group[k] for k in order]


def _place(one: Candidate) -> Array:
    """Where a test stands, shape (3,) [mm]: the point that it is measured against, on the workpiece."""
    return np.asarray(np.atleast_2d(one.test.observations()[0].workpiece)[0])
