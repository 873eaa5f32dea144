"""How the runs scatter about an estimate, and so what any combination of its parameters is worth.

What counts on runs is not linear in the parameters: the degrees of freedom of a sum do not follow from those of its parts.
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
        moved = self._moved(weights)
        return np.asarray(moved @ moved.T)

    def variance(self, weights: Array) -> Array:
        """Variance of combinations of the parameters, shape (m,), for weights of shape (m, p)."""
        return np.asarray(np.sum(self._moved(weights) ** 2, axis=1))

    def degrees_of_freedom(self, weights: Array) -> Array:
        """Satterthwaite's of the variance of each combination, shape (m,), for independent readings of equal variance.

        0 where it rests on one run alone, or the runs are two.
        """
        block = max(1, _BLOCK // max(1, len(self.shares) * len(self.norms)))
        found = [self._degrees(weights[first : first + block]) for first in range(0, len(weights), block)]
        return np.concatenate([np.zeros(0), *found])

    def _moved(self, weights: Array) -> Array:
        """What each run moves each combination by, shape (m, g)."""
        lifted = self.residuals * self.shares * self._lift()
        return np.asarray(self._over(weights) @ np.einsum("gpk,gk->pg", self.directions, lifted))

    def _degrees(self, weights: Array) -> Array:
        if len(self.shares) < FEWEST_RUNS:
            return np.zeros(len(weights))
        over = self._over(weights)
        along = np.einsum("mp,gpk->mgk", over, self.directions, optimize=True)
        hanging = np.linalg.norm(along * ((1 - self.shares**2) <= SINGULAR), axis=2)
        own = np.sum((along * self.shares * self._lift()) ** 2, axis=2)
        across = np.einsum("mgk,gpk->mgp", along * (self.shares**2 * self._lift()), self.directions, optimize=True)
        gram = own[:, :, np.newaxis] * np.eye(len(self.shares)) - across @ across.swapaxes(1, 2)
        trace, square = np.trace(gram, axis1=1, axis2=2), np.sum(gram**2, axis=(1, 2))
        alone = np.any(hanging > HANGING * np.linalg.norm(over, axis=1)[:, np.newaxis], axis=1)
        return np.where(alone | (square == 0), 0.0, trace**2 / np.where(square > 0, square, 1.0))

    def _over(self, weights: Array) -> Array:
        """Weights in the space of the triangle, shape (m, p)."""
        return np.asarray(solve_triangular(self.whole, (weights / self.norms).T, trans="T").T)

    def _lift(self) -> Array:
        """What the residuals of each run are lifted by for the share that the fit took, shape (g, k)."""
        left = 1.0 - self.shares**2
        return np.where(left > SINGULAR, 1.0 / np.sqrt(np.where(left > SINGULAR, left, 1.0)), 0.0)
