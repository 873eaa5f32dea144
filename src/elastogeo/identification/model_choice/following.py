"""Which force level does not follow the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from elastogeo.identification.model_choice.evidence import variances_by_order
from elastogeo.identification.model_choice.shapes import Shapes

FALSE_ALARM = 0.02
"""Probability that any level is named where all follow."""


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
    shapes: Shapes, model: Sequence[str], levels: Sequence[tuple[float, Sequence[int]]], limit: float = FALSE_ALARM
) -> OffLevel | None:
    """The level that follows the others least, if it does not.

    Parameters
    ----------
    shapes : Shapes
    model : sequence of str
        Labels of its columns.
    levels : sequence of (float [N], sequence of int)
        Each level with its runs.
    limit : float
        Probability below which a level counts as off.

    Notes
    -----
    The mean trace of a level less its prediction, squared, over what the scatter of the other runs, order by order, and the
    prediction make of it: F, with the degrees of freedom of a sum of unequal variances (Satterthwaite).
    """
    found = [level for force, runs in levels if (level := _judged(shapes, model, force, runs)) is not None]
    if not found:
        return None
    worst = min(found, key=lambda level: level.p_value)
    joint = min(1.0, worst.p_value * len(found))
    return OffLevel(worst.force, worst.size, joint) if joint < limit else None


def _judged(shapes: Shapes, model: Sequence[str], force: float, runs: Sequence[int]) -> OffLevel | None:
    others, base = shapes.without(runs), shapes.of(model)
    known = others.of(model)
    if np.linalg.matrix_rank(known) < known.shape[1]:
        return None
    orders = np.unique(others.order)
    groups = [others.order == order for order in orders]
    variances, freedom = variances_by_order(others.reading, known, np.ones(len(known)), groups)
    inverse = np.linalg.pinv(known)
    values = inverse @ others.reading
    noise = variances[np.searchsorted(orders, others.order)]
    rows = [shapes.run == k for k in runs]
    if len({int(row.sum()) for row in rows}) != 1:
        return None
    first = shapes.order[rows[0]]
    if not np.isin(first, orders).all():
        return None
    design = np.mean([base[row] for row in rows], axis=0)
    apart = np.mean([shapes.reading[row] for row in rows], axis=0) - design @ values
    spread = (design @ inverse) ** 2 @ noise
    each = np.searchsorted(orders, first)
    expected = variances[each] / len(runs) + spread
    total = float(expected.sum())
    if not total > 0:
        return None
    by_order = np.array([expected[each == k].sum() for k in range(len(orders))])
    counts = np.bincount(each, minlength=len(orders))
    own = total**2 / np.sum(np.divide(by_order**2, counts, out=np.zeros_like(by_order), where=counts > 0))
    rest = total**2 / np.sum(np.divide(by_order**2, freedom, out=np.zeros_like(by_order), where=freedom > 0.5))
    statistic = float(np.sum(apart**2)) / total
    size = float(np.sqrt(np.sum(apart**2) / shapes.readings[runs[0]]))
    return OffLevel(force, size, float(fdtrc(own, rest, statistic)))
