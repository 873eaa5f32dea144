"""How sure a model lacks a column: a test of one parameter that takes runs, not readings, for independent.

The noise of a run is as large as it is in each order of its harmonics, so orders are weighed by the scatter that the runs
show in them; an order that is quiet decides more. The weights are estimates themselves and may mislead where few runs show
them, so every column is tested with and without them. A parameter's variance is that of its scores by run (Bell and
McCaffrey, Survey Methodology 28, 2002), with their degrees of freedom. The p-values, which depend on one another, are
combined by Cauchy's distribution (Liu and Xie, doi:10.1080/01621459.2018.1554485).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtr

from elastogeo.identification.model_choice.shapes import Integers, Mask, Shapes
from elastogeo.machine import Array

SEEN = 0.02
"""Share of a column that the model must leave of it for the test to see it."""

FEWEST = 2.5
"""Degrees of freedom of a test that is worth making."""

QUIETEST = 1e-3
"""Standard deviation of an order at least, as a share of the noisiest one's."""

COUNTS = 0.05
"""Share of a variance from which an order counts."""

MOST = 0.95
"""P-value at most: one column that fits too badly to be chance must not outvote others."""

NEUTRAL = 0.5
"""P-value at least of a column that is not worth having."""

_STEPS = 3
_RUN_ALONE = 1e-9
_CERTAIN = 1e-15


@dataclass(frozen=True, slots=True)
class Evidence:
    """What says that a model lacks columns.

    Attributes
    ----------
    labels : tuple of str
        The columns that could be tested.
    p_values : array, shape (len(labels),)
        Of each by itself.
    removed : array, shape (len(labels),) [mm or rad]
        Length of what each would remove from the traces.
    p_value : float
        Of all together; 1 if none could be tested.
    """

    labels: tuple[str, ...]
    p_values: Array
    removed: Array
    p_value: float


def evidence(shapes: Shapes, model: Sequence[str], offers: Mapping[str, float], least: float = 0.0) -> Evidence:
    """Which columns a model lacks.

    Parameters
    ----------
    shapes : Shapes
    model : sequence of str
        Labels of its columns.
    offers : mapping of str to float
        Columns that it could have besides, and the weight of each in the combined p-value.
    least : float [mm or rad]
        Length that a column must remove from the traces to count.
    """
    labels = tuple(label for label in offers if label not in model)
    base, added = shapes.of(model), shapes.of(labels)
    left = np.linalg.norm(_beyond(base, added), axis=0)
    weights = weights_by_order(shapes, model)
    weighed = _Fit.of(shapes, base, added, weights)
    plain = _Fit.of(shapes, base, added, np.ones_like(weights))
    scatter = weighed.scatter(shapes, weights)
    p_values = np.array([*(fit.by_run() for fit in (weighed, plain)), *(fit.by_order(*scatter) for fit in (weighed, plain))])
    removed = np.maximum(np.abs(weighed.values), np.abs(plain.values)) * left
    p_values = np.where(np.isnan(p_values) | (removed > least), p_values, np.maximum(p_values, NEUTRAL))
    seen = (left > SEEN) & ~np.isnan(p_values).all(axis=0)
    p_values = p_values[:, seen]
    shares = np.array([offers[label] for label in labels])[seen]
    return Evidence(
        tuple(label for label, is_seen in zip(labels, seen, strict=True) if is_seen),
        np.array([cauchy(p_values[:, k], np.ones(len(p_values))) for k in range(len(shares))]),
        removed[seen],
        cauchy(p_values, np.broadcast_to(shares, p_values.shape)) if seen.any() else 1.0,
    )


def weights_by_order(shapes: Shapes, model: Sequence[str]) -> Array:
    """Weights of the rows, shape (n,): one over the standard deviation of their order, of the residuals of a model."""
    base, orders = shapes.of(model), np.unique(shapes.order)
    groups = [shapes.order == order for order in orders]
    weights = np.ones(len(base))
    for _ in range(_STEPS):
        variances, _ = variances_by_order(shapes.reading, base, weights, groups)
        sizes = np.sqrt(np.maximum(variances, QUIETEST**2 * variances.max()))
        if not sizes.max() > 0:
            return weights
        for group, size in zip(groups, sizes, strict=True):
            weights[group] = sizes.min() / size
    return weights


def variances_by_order(reading: Array, base: Array, weights: Array, groups: Sequence[Array]) -> tuple[Array, Array]:
    """Variance of one coefficient of each order, and how many degrees of freedom it has.

    An order in which the model leaves none counts as noisy as the noisiest.
    """
    Q = np.linalg.qr(base * weights[:, np.newaxis])[0]
    left = reading * weights
    left = (left - Q @ (Q.T @ left)) / weights
    leverage = np.sum(Q**2, axis=1)
    freedom = np.array([np.sum(1 - leverage[group]) for group in groups])
    squares = np.array([np.sum(left[group] ** 2) for group in groups])
    known = freedom > 0.5
    variances = np.divide(squares, freedom, out=np.zeros_like(squares), where=known)
    return np.where(known, variances, variances.max()), freedom


def cauchy(p_values: Array, shares: Array) -> float:
    """One p-value of several that depend on one another; those that are not numbers do not count."""
    known = ~np.isnan(p_values)
    p, w = np.clip(p_values[known], _CERTAIN, MOST), shares[known]
    return float(0.5 - np.arctan(np.sum(w * np.tan((0.5 - p) * np.pi)) / w.sum()) / np.pi)


def _beyond(base: Array, added: Array) -> Array:
    """What a model leaves of columns."""
    Q = np.linalg.qr(base)[0]
    once = added - Q @ (Q.T @ added)
    return np.asarray(once - Q @ (Q.T @ once))


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
    """Every added column by itself beside a model, with one set of weights.

    `Q` spans the weighted model, `q` what it leaves of each weighted column, of unit length; `left` are the weighted
    readings beyond the model, `along` the component of these along each `q`.
    """

    count: int
    run: Integers
    weights: Array
    Q: Array
    q: Array
    size: Array
    seen: Mask
    left: Array
    along: Array

    @classmethod
    def of(cls, shapes: Shapes, base: Array, added: Array, weights: Array) -> _Fit:
        root = weights[:, np.newaxis]
        Q = np.linalg.qr(base * root)[0]
        left = shapes.reading * weights
        left = left - Q @ (Q.T @ left)
        columns = _beyond(base * root, added * root)
        size = np.linalg.norm(columns, axis=0)
        seen = size > SEEN * np.linalg.norm(added * root, axis=0).clip(np.finfo(float).tiny)
        q = columns / np.where(size > 0, size, 1.0)
        return cls(len(shapes.rest), shapes.run, weights, Q, q, size, seen, left, q.T @ left)

    @property
    def values(self) -> Array:
        """Estimates, in units of the columns."""
        return np.divide(self.along, self.size, out=np.zeros_like(self.along), where=self.seen)

    def scatter(self, shapes: Shapes, weights: Array) -> tuple[Integers, Array, Array]:
        """Order of each row; of each order variance and degrees of freedom once a column is added, shape (orders, q)."""
        orders, each = np.unique(shapes.order, return_inverse=True)
        rest = ((self.left[:, np.newaxis] - self.q * self.along) / weights[:, np.newaxis]) ** 2
        free = 1.0 - np.sum(self.Q**2, axis=1)[:, np.newaxis] - self.q**2
        squares = np.array([rest[each == k].sum(axis=0) for k in range(len(orders))])
        freedom = np.array([free[each == k].sum(axis=0) for k in range(len(orders))])
        known = freedom > 0.5
        variances = np.divide(squares, freedom, out=np.zeros_like(squares), where=known)
        return each, np.where(known, variances, variances.max(axis=0)), np.where(known, freedom, 1.0)

    def by_order(self, each: Integers, variances: Array, freedom: Array) -> Array:
        """P-values if the noise of an order is alike in all runs.

        The degrees of freedom are those of the order of which least is known, of all that count: a sum of variances that
        are hardly known looks better known than it is.
        """
        pull = (self.q * self.weights[:, np.newaxis]) ** 2
        parts = np.array([pull[each == k].sum(axis=0) for k in range(len(variances))]) * variances
        total = parts.sum(axis=0)
        least = np.where(parts > COUNTS * total, freedom, np.inf).min(axis=0)
        return self._p_values(total, np.where(np.isfinite(least), least, 0.0))

    def by_run(self) -> Array:
        """P-values from the scatter of the scores by run.

        A score is lifted to the variance that it would have if nothing had been fitted: what a column reads of a run is one
        number. A column that rests on one run cannot be tested.
        """
        own, scores = np.zeros((self.count, len(self.size))), np.zeros((self.count, len(self.size)))
        across = np.zeros((self.count, self.Q.shape[1], len(self.size)))
        for k in range(self.count):
            rows = self.run == k
            own[k] = np.sum(self.q[rows] ** 2, axis=0)
            across[k] = self.Q[rows].T @ self.q[rows]
            scores[k] = self.q[rows].T @ self.left[rows] - own[k] * self.along
        free = own - np.sum(across**2, axis=1) - own**2
        alone = free <= _RUN_ALONE * own
        lift = np.sqrt(np.divide(own, free, out=np.zeros_like(own), where=~alone))
        rests = np.where(alone, own, 0.0).max(axis=0) > 0.5
        freedom = np.where(rests, 0.0, _degrees_of_freedom(lift, own, across))
        return self._p_values(np.sum((lift * scores) ** 2, axis=0), freedom)

    def _p_values(self, variance: Array, freedom: Array) -> Array:
        tested = self.seen & (freedom >= FEWEST) & (variance > 0)
        p = np.full(len(variance), np.nan)
        p[tested] = 2 * stdtr(freedom[tested], -np.abs(self.along[tested]) / np.sqrt(variance[tested]))
        return p


def _degrees_of_freedom(lift: Array, own: Array, across: Array) -> Array:
    """Satterthwaite's, of the sum of squared scores, for independent shapes of equal variance, shape (labels,)."""
    lifted = lift[:, np.newaxis, :] * across
    diagonal = lift**2 * own
    pairs = np.einsum("apl,bpl->lab", lifted, lifted) + np.einsum("al,bl->lab", lift * own, lift * own)
    gram = np.einsum("al,ab->lab", diagonal, np.eye(len(own))) - pairs
    square = np.sum(gram**2, axis=(1, 2))
    trace = np.trace(gram, axis1=1, axis2=2)
    return np.asarray(np.divide(trace**2, square, out=np.zeros_like(trace), where=square > 0))
