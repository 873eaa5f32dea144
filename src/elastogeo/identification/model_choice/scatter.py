"""What the runs of a test scatter by, beside a model: order by order, with the force of each, and as influences say.

Each run sets its force anew, and a force that is off moves the trace by a part of all that the force moves: little at a low
force, much at a high one. The scatter of an order, one for all runs, does not hold that. By how much a force may be off is
known, from what is stated or from what is usual; if the runs show more, it is more.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import gammaincc

from elastogeo.identification.model_choice.shapes import Integers
from elastogeo.machine import Array

SHOWN = 0.05
"""P-value below which runs show that their forces scatter by more than is known. Nominally: the variances of the orders are
estimated together with it and favour it, so that forces which scatter as is known show more in about a fifth of tests."""

_STEPS = 8
_FEWEST = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Scatter:
    """The variances that runs show.

    Attributes
    ----------
    orders : array of int, shape (k,)
    variances : array, shape (k,) [mm² or rad²]
        Of one coefficient of each order.
    force : float
        Variance of the forces, over what they are known to scatter by: 1 or more.
    uncertainty : array, shape (k + 1, k + 1)
        Covariance of these, the force's last.
    """

    orders: Integers
    variances: Array
    force: float
    uncertainty: Array

    def of(self, across: Array, order: Integers, force: Array, known: Array) -> tuple[Array, float]:
        """Covariance of combinations of the readings, shape (m, m), and the degrees of freedom of its trace.

        Parameters
        ----------
        across : array, shape (m, n)
            The combinations.
        order : array of int, shape (n,)
            Of the readings.
        force : array, shape (n, runs)
            What one standard uncertainty of the force of each run moves.
        known : array, shape (n, e)
            What one standard uncertainty of each influence moves.
        """
        each = np.searchsorted(self.orders, order)
        by_force, by_influence = across @ force, across @ known
        covariance = (across * self.variances[each]) @ across.T
        covariance += self.force * by_force @ by_force.T + by_influence @ by_influence.T
        parts = np.bincount(each, np.sum(across**2, axis=0), len(self.orders))
        gain = np.append(parts, np.sum(by_force**2))
        variance = float(gain @ self.uncertainty @ gain)
        return covariance, 2 * float(np.trace(covariance)) ** 2 / variance if variance > 0 else np.inf


def scatter_of(reading: Array, base: Array, order: Integers, run: Integers, force: Array, known: Array) -> Scatter:
    """What runs scatter by beside a model.

    Parameters
    ----------
    reading : array, shape (n,) [mm or rad]
    base : array, shape (n, p)
        Columns of the model, of full rank.
    order, run : array of int, shape (n,)
        Of which order a reading is, and of which run.
    force : array, shape (n, runs)
        What one standard uncertainty of the force of each run moves, as it is known.
    known : array, shape (n, e)
        What one standard uncertainty of each influence moves.

    Notes
    -----
    The variance of an order is the mean square of its residuals, with what forces and influences put into them:
    taking that off would leave a small difference of two uncertain numbers. That of the forces comes from the
    residuals along what the force of each run moves, beside what orders and influences put there. An order in which
    the model leaves none counts as noisy as the noisiest. What is of one order and one run counts as one number,
    though it be a cosine and a sine: their amplitude may be drawn once a run.
    """
    seen = _Residuals.of(reading, base, order, run, force, known)
    excess = seen.excess()
    return seen.scatter(excess if excess > 1.0 and seen.shows(excess) else 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class _Residuals:
    """What a model leaves of n readings of r runs, of k orders.

    `each` (n,) is the order of a reading by its place in `orders`, `left` (n,) what `M` (n, n) leaves of the readings;
    `along` (n, r) has unit columns along `force`.
    """

    orders: Integers
    each: Integers
    run: Integers
    M: Array
    left: Array
    force: Array
    along: Array
    known: Array

    @classmethod
    def of(cls, reading: Array, base: Array, order: Integers, run: Integers, force: Array, known: Array) -> _Residuals:
        orders, each = np.unique(order, return_inverse=True)
        Q = np.linalg.qr(base)[0]
        M = np.eye(len(base)) - Q @ Q.T
        size = np.linalg.norm(force, axis=0)
        along = np.divide(force, size, out=np.zeros_like(force), where=size > 0)
        return cls(orders, each, run, M, M @ reading, force, along, known)

    def by_order(self, squares: Array) -> Array:
        """Sums of rows, shape (k, ..)."""
        return np.asarray((self.each == np.arange(len(self.orders))[:, np.newaxis]).astype(float) @ squares)

    @property
    def freedom(self) -> Array:
        """Degrees of freedom of each order, shape (k,)."""
        return self.by_order(np.diag(self.M))

    def variances(self, excess: float, influences: bool = True) -> Array:
        """Of each order, shape (k,), beside forces whose variance is so many times what is known of it, and influences."""
        taken = excess * self.by_order(np.sum((self.M @ self.force) ** 2, axis=1))
        if influences:
            taken += self.by_order(np.sum((self.M @ self.known) ** 2, axis=1))
        shows = self.freedom > _FEWEST
        found = np.where(shows, (self.by_order(self.left**2) - taken) / np.where(shows, self.freedom, 1.0), 0.0).clip(0.0)
        return np.where(shows, found, found.max())

    def weights(self, excess: float) -> Array:
        """Of each run where its force is looked at, shape (r,): the surer it shows its force, the more."""
        size = np.sum(self.force**2, axis=0)
        total = (self.variances(excess)[self.each] @ self.along**2 + excess * size) ** 2
        return np.asarray(np.divide(size, total, out=np.zeros_like(total), where=total > 0))

    def excess(self) -> float:
        """Variance of the forces over what is known of it, at least 1."""
        shown = (self.along.T @ self.left) ** 2
        own = np.sum((self.along.T @ self.M @ self.force) ** 2, axis=1)
        influenced = np.sum((self.along.T @ self.M @ self.known) ** 2, axis=1)
        reads = (self.M @ self.along) ** 2
        excess = 1.0
        for _ in range(_STEPS):
            weights, variances = self.weights(excess), self.variances(excess)
            expected = float(weights @ own)
            rest = shown - influenced - variances[self.each] @ reads
            excess = max(1.0, float(weights @ rest) / expected) if expected > 0 else 1.0
        return excess

    def shows(self, excess: float) -> bool:
        """Whether the runs show that their forces scatter by more than is known, and not something else by chance."""
        root = self.along * np.sqrt(self.weights(excess))
        known = root.T @ self.covariance(self.variances(excess), 1.0) @ root
        freedom = float(np.trace(known)) ** 2 / float(np.sum(known**2))
        ratio = float(np.sum((root.T @ self.left) ** 2) / np.trace(known))
        return bool(gammaincc(freedom / 2, freedom / 2 * ratio) <= SHOWN)

    def covariance(self, variances: Array, excess: float) -> Array:
        """Of the residuals, shape (n, n)."""
        readings = np.diag(variances[self.each]) + excess * self.force @ self.force.T + self.known @ self.known.T
        return np.asarray(self.M @ readings @ self.M)

    def scatter(self, excess: float) -> Scatter:
        """The variances with their covariance: that of the sums of squares that they come from."""
        k, shows = len(self.orders), self.freedom > _FEWEST
        variances = self.variances(0.0, influences=False)
        N = self.M @ (variances[self.each][:, np.newaxis] * self.M)
        runs = [len(np.unique(self.run[self.each == n])) for n in range(k)]
        at_once = np.bincount(self.each, minlength=k) / runs
        divisor = np.where(shows, self.freedom, 1.0) / np.sqrt(at_once)
        spread = np.zeros((k + 1, k + 1))
        spread[:k, :k] = 2 * self.by_order(self.by_order(N**2).T) / np.outer(divisor, divisor)
        if excess > 1.0:
            weights = self.weights(excess)
            root = self.along * np.sqrt(weights)
            seen = root.T @ self.covariance(self.variances(excess), excess) @ root
            expected = float(weights @ np.sum((self.along.T @ self.M @ self.force) ** 2, axis=1))
            spread[k, k] = 2 * np.sum(seen**2) / expected**2
        return Scatter(self.orders, variances, excess, spread)
