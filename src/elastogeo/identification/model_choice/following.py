"""Which force level does not follow the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from elastogeo.identification.model_choice.scatter import Scatter, scatter_of
from elastogeo.identification.model_choice.shapes import Integers, Mask, Shapes
from elastogeo.machine import Array

FALSE_ALARM = 0.02
"""Probability that any level is named where all follow."""

CERTAIN = 1e9
"""Degrees of freedom of a variance that is known."""


@dataclass(frozen=True, slots=True)
class OffLevel:
    """A force level that the model of all others does not predict.

    Attributes
    ----------
    force : float [N]
    size : float [mm or rad]
        Root mean square, over a trace, of how far the mean of its runs lies from the prediction.
    p_value : float
        Probability of such a level among so many, or of a worse one, if all follow.
    """

    force: float
    size: float
    p_value: float


def off_level(
    shapes: Shapes,
    model: Sequence[str],
    levels: Sequence[tuple[float, Sequence[int]]],
    force: Array,
    known: Array,
    limit: float = FALSE_ALARM,
) -> OffLevel | None:
    """The level that follows the others least, if it does not.

    Parameters
    ----------
    shapes : Shapes
    model : sequence of str
        Labels of its columns.
    levels : sequence of (float [N], sequence of int)
        Each level with its runs.
    force : array, shape (n, runs)
        What one standard uncertainty of the force of each run moves: it is set anew in each.
    known : array, shape (n, e)
        What one standard uncertainty of each influence moves.
    limit : float
        Probability below which a level counts as off.

    Notes
    -----
    The mean trace of a level less its prediction, squared, over what the scatter of the other runs, the force that is set
    anew, the influences and the prediction make of it: F, with the degrees of freedom of a sum of unequal variances
    (Satterthwaite, Box). It is held against all orders together, which have many degrees of freedom, and against each by
    itself, so that an order that scatters does not hide what is wrong in a quiet one; each look has half of the
    probability. Cosine and sine of an order may be one amplitude, drawn once a run, and count as one.
    """
    found = [seen for level, runs in levels if (seen := _judged(shapes, shapes.of(model), level, runs, force, known))]
    if not found:
        return None
    worst = min(found, key=lambda level: level.p_value)
    joint = min(1.0, worst.p_value * len(found))
    return OffLevel(worst.force, worst.size, joint) if joint < limit else None


@dataclass(frozen=True, slots=True, eq=False)
class _Apart:
    """How far a level lies from its prediction.

    `apart` (m,) in the shapes of `order` (m,); `across` (m, n) makes it of all readings, whose orders are `orders` (n,).
    """

    apart: Array
    order: Integers
    across: Array
    orders: Integers
    scatter: Scatter
    force: Array
    known: Array

    @property
    def together(self) -> float:
        """P-value of all its shapes."""
        return self._p_value(np.ones(len(self.order), dtype=bool))

    @property
    def single(self) -> float:
        """P-value of the order that is furthest off, of so many."""
        orders = np.unique(self.order)
        return min(self._p_value(self.order == order, 1.0) for order in orders) * len(orders)

    def _p_value(self, rows: Mask, most: float = np.inf) -> float:
        covariance, freedom = self.scatter.of(self.across[rows], self.orders, self.force, self.known)
        total = float(np.trace(covariance))
        if not total > 0:
            return 1.0
        own = min(total**2 / float(np.sum(covariance**2)), most)
        return float(fdtrc(own, min(freedom, CERTAIN), float(np.sum(self.apart[rows] ** 2)) / total))


def _judged(shapes: Shapes, base: Array, level: float, runs: Sequence[int], force: Array, known: Array) -> OffLevel | None:
    """A level against its prediction by all others; None where they do not predict it."""
    inside = np.isin(shapes.run, runs)
    others, order = base[~inside], shapes.order
    rows = [np.flatnonzero(shapes.run == k) for k in runs]
    if np.linalg.matrix_rank(others) < others.shape[1] or len({len(row) for row in rows}) != 1:
        return None
    if not np.isin(order[rows[0]], order[~inside]).all():
        return None
    across = np.zeros((len(rows[0]), len(base)))
    for row in rows:
        across[np.arange(len(row)), row] = 1.0 / len(rows)
    across[:, ~inside] = -np.mean([base[row] for row in rows], axis=0) @ np.linalg.pinv(others)
    scatter = scatter_of(
        shapes.reading[~inside], others, order[~inside], shapes.run[~inside], force[~inside], known[~inside]
    )
    seen = _Apart(across @ shapes.reading, order[rows[0]], across, order, scatter, force, known)
    size = float(np.sqrt(np.sum(seen.apart**2) / shapes.readings[runs[0]]))
    return OffLevel(level, size, 2 * min(seen.together, seen.single))
