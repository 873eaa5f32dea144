"""How the runs scatter about an estimate, and so what any combination of its parameters is worth.

A covariance by runs is not linear in the parameters: the degrees of freedom of a sum do not follow from those of its parts.
Kept is therefore, thin, what all of them follow from: for each run the directions of the estimate that it has a share in.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from elastogeo.equality import ByValue
from elastogeo.estimate.factor import Array

SINGULAR = 1e-10
"""A run whose share in a direction is closer to all of it than this is alone in it: no other shows how it scatters."""

HANGING = 1e-4
"""Share of the standard uncertainty of a combination, counted by reading, from which on such a direction matters to it."""

FEWEST_RUNS = 3
"""Runs without which there is hardly more than one degree of freedom, however they are made."""

_BLOCK = 2_000_000
"""Numbers that combinations take at once."""


@dataclass(frozen=True, slots=True, eq=False)
class RunScatter(ByValue):
    """The scatter of g runs about an estimate of p parameters (Bell and McCaffrey's, for combinations of them).

    Attributes
    ----------
    norms : array, shape (p,)
        Of the columns over all runs.
    whole : array, shape (p, p)
        Triangle of all runs, of columns scaled to unit length.
    directions : array, shape (g, p, k)
        For each run the orthonormal directions, in the space of the triangle, that it has a share in.
    shares : array, shape (g, k)
        Singular values of its triangle over that of all: 1 where no other run has a share.
    residuals : array, shape (g, k)
        What the estimate leaves of the run along them.
    """

    norms: Array
    whole: Array
    directions: Array
    shares: Array
    residuals: Array

    def covariance(self, weights: Array) -> Array:
        """Covariance of combinations of the parameters, shape (m, m), for weights of shape (m, p)."""
        moved = self.moved(self.over(weights))
        return np.asarray(moved @ moved.T)

    def variance(self, weights: Array) -> Array:
        """Variance of combinations of the parameters, shape (m,), for weights of shape (m, p)."""
        return np.asarray(np.sum(self.moved(self.over(weights)) ** 2, axis=1))

    def degrees_of_freedom(self, weights: Array) -> Array:
        """Satterthwaite's of the variance of each combination, shape (m,), for independent readings of equal variance.

        0 where it rests on one run alone, or the runs are two.
        """
        return self.freedom(self.over(weights))

    def over(self, weights: Array) -> Array:
        """Weights, shape (m, p), in the space of the triangle, where `moved` and `freedom` take them: linear in them."""
        return np.asarray(solve_triangular(self.whole, (weights / self.norms).T, trans="T").T)

    def moved(self, over: Array) -> Array:
        """What each run moves each combination by, shape (m, g); their squares add up to the variance."""
        lifted = self.residuals * self.shares * self._lift()
        return np.asarray(over @ np.einsum("gpk,gk->pg", self.directions, lifted))

    def freedom(self, over: Array) -> Array:
        """`degrees_of_freedom` of weights in the space of the triangle, shape (m,)."""
        block = max(1, _BLOCK // max(1, len(self.shares) * len(self.norms)))
        found = [self._freedom(over[first : first + block]) for first in range(0, len(over), block)]
        return np.concatenate([np.zeros(0), *found])

    def along(self, over: Array) -> ScatterAlong:
        """The same for combinations of a few, shape (b, p), of which very many are asked."""
        along = np.einsum("bp,gpk->gbk", over, self.directions, optimize=True)
        left, lift = 1 - self.shares**2, self._lift()
        own = along * (self.shares * lift)[:, np.newaxis]
        across = (along * (self.shares**2 * lift)[:, np.newaxis]) @ self.directions.swapaxes(1, 2)
        gram = -np.einsum("gbp,hcp->ghbc", across, across, optimize=True)
        runs = np.arange(len(self.shares))
        gram[runs, runs] += own @ own.swapaxes(1, 2)
        first, second = np.triu_indices(len(over))
        twice = np.where(first == second, 1.0, 2.0)
        halves = (gram + gram.swapaxes(2, 3))[:, :, first, second].reshape(-1, len(first)) * (twice / 2)
        return ScatterAlong(
            enough=len(self.shares) >= FEWEST_RUNS,
            trace=gram[runs, runs].sum(axis=0),
            square=halves.T @ halves,
            whole=over,
            hanging=(along * (left <= SINGULAR)[:, np.newaxis]).swapaxes(0, 1).reshape(len(over), -1),
        )

    def _freedom(self, over: Array) -> Array:
        runs, size, kept = self.directions.shape
        if runs < FEWEST_RUNS:
            return np.zeros(len(over))
        along = (over @ self.directions.transpose(1, 0, 2).reshape(size, -1)).reshape(-1, runs, kept)
        hanging = np.linalg.norm(along * (1 - self.shares**2 <= SINGULAR), axis=(1, 2))
        own = np.sum((along * (self.shares * self._lift())) ** 2, axis=2)
        part = (along * (self.shares**2 * self._lift())).swapaxes(0, 1)
        across = np.ascontiguousarray((part @ self.directions.swapaxes(1, 2)).swapaxes(0, 1))
        gram = across.swapaxes(1, 2) @ across
        taken = np.einsum("mgp,mgp->mg", across, across)
        # of the matrix `diag(own) - across across^T`, without making it
        square = np.sum(own * (own - 2 * taken), axis=1) + np.einsum("mpq,mpq->m", gram, gram)
        return _ratio(np.sum(own - taken, axis=1), square, hanging, np.linalg.norm(over, axis=1))

    def _lift(self) -> Array:
        """What the residuals of each run are lifted by for the share that the fit took, shape (g, k)."""
        left = 1.0 - self.shares**2
        return np.where(left > SINGULAR, 1.0 / np.sqrt(np.where(left > SINGULAR, left, 1.0)), 0.0)


@dataclass(frozen=True, slots=True)
class ScatterAlong:
    """Degrees of freedom of combinations of b given ones, as forms of their coefficients.

    Attributes
    ----------
    enough : bool
        Whether there are runs enough for any.
    trace : array, shape (b, b)
        Of second degree: the expected variance.
    square : array, shape (b (b + 1) / 2,) * 2
        Of fourth degree, in the products of two coefficients: half its variance.
    whole : array, shape (b, p)
    hanging : array, shape (b, k)
        What rests on one run alone.
    """

    enough: bool
    trace: Array
    square: Array
    whole: Array
    hanging: Array

    def freedom(self, coefficients: Array) -> Array:
        """Degrees of freedom of each combination, shape (m,), of coefficients of shape (m, b)."""
        if not self.enough:
            return np.zeros(len(coefficients))
        first, second = np.triu_indices(len(self.trace))
        products = coefficients[:, first] * coefficients[:, second]
        trace = np.einsum("mb,mb->m", coefficients @ self.trace, coefficients)
        square = np.einsum("mb,mb->m", products @ self.square, products)
        size = np.linalg.norm(coefficients @ self.whole, axis=1)
        return _ratio(trace, square, np.linalg.norm(coefficients @ self.hanging, axis=1), size)


def _ratio(trace: Array, square: Array, hanging: Array, size: Array) -> Array:
    some = (square > 0) & (hanging <= HANGING * size)
    return np.where(some, trace**2 / np.where(some, square, 1.0), 0.0)
