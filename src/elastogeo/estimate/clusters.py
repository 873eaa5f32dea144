"""Covariance when readings of one run belong together: residuals along a trace are not independent, runs are.

The sandwich by clusters, with the bias-reduced residuals and the effective degrees of freedom of Bell and McCaffrey (Survey
Methodology 28, 2002; Pustejovsky and Tipton, doi:10.1080/07350015.2016.1247004). All of it follows from one small triangle
per run.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate.factor import Array, Factor, merge, select
from elastogeo.estimate.solution import Solution, solve

_SINGULAR = 1e-10
"""Eigenvalues of `I - H` below this belong to combinations that one run alone determines."""

FEWEST_RUNS = 3
"""Runs without which there is hardly more than one degree of freedom, however they are made."""

_MOST_TIMES = 4
"""How often a test is repeated, at most, to see whether its runs would be enough."""

_HANGING = 1e-4
"""Share of the standard uncertainty of a parameter, counted by reading, from which on such a combination matters to it."""


def solve_by_run(runs: Sequence[Factor], labels: Sequence[str]) -> Solution:
    """Least-squares solution whose covariance counts on independent runs, not on independent readings.

    Parameters
    ----------
    runs : sequence of Factor
        One per run.
    labels : sequence of str, length p
        Parameters to solve for.

    Returns
    -------
    Solution
        The values are those of `solve`; covariance and degrees of freedom are by run.

    Raises
    ------
    RankError
        If the parameters are dependent.
    DegreesOfFreedomError
        If there are too few runs for a parameter: some combination rests on one run alone.
    """
    solution, weak = solve_as_runs_show(runs, labels)
    if weak:
        raise DegreesOfFreedomError(
            f"{len(runs)} runs are too few for an uncertainty of {', '.join(weak)} by run: it rests on hardly more than one "
            f"of them; repeat the runs"
        )
    return solution


def solve_as_runs_show(runs: Sequence[Factor], labels: Sequence[str]) -> tuple[Solution, tuple[str, ...]]:
    """As `solve_by_run`, for the parameters of which the runs show the scatter; and the labels of the others.

    **Of the others the solution has no uncertainty**: their variance is that of independent readings, without covariance
    and with one degree of freedom, so that the numbers stay finite, and is not to be stated.

    Raises
    ------
    RankError
        If the parameters are dependent.
    """
    chosen = [select(run, labels) for run in runs]
    plain, split = solve(merge(*chosen)), _split(chosen)
    residuals = [run.z - run.R @ plain.values for run in chosen]
    scores = np.einsum("gki,gi->gk", split.shares, residuals)
    degrees, norms = split.degrees_of_freedom(), split.norms
    covariance = scores.T @ scores / np.outer(norms, norms)
    weak = degrees <= 1
    covariance[weak], covariance[:, weak] = 0.0, 0.0
    covariance[weak, weak] = np.diag(plain.covariance)[weak]
    solution = Solution(plain.labels, plain.values, covariance, np.where(weak, 1.0, degrees), plain.residual_std)
    return solution, tuple(label for label, is_weak in zip(labels, weak, strict=True) if is_weak)


def runs_needed(runs: Sequence[Factor], labels: Sequence[str]) -> int | None:
    """How many runs give every parameter an uncertainty by run, if the test is repeated as it is; None if no number does."""
    chosen = [select(run, labels) for run in runs]
    for times in range(1, _MOST_TIMES + 1):
        if (_split(chosen * times).degrees_of_freedom() > 1).all():
            return times * len(runs)
    return None


@dataclass(frozen=True, slots=True)
class _Split:
    """How the g runs share in an estimate of p parameters.

    Attributes
    ----------
    norms : array, shape (p,)
        Of the columns over all runs.
    roots : array, shape (g, p, p)
        The triangle of each run over that of all.
    shares : array, shape (g, p, p)
        The bread times the adjusted design of each run: what it adds to the estimate, per residual.
    alone : array of bool, shape (p,)
        Which parameters hang on combinations that one run alone determines: no other run shows how they scatter.
    """

    norms: Array
    roots: Array
    shares: Array
    alone: np.ndarray[tuple[int], np.dtype[np.bool_]]

    def degrees_of_freedom(self) -> Array:
        """Satterthwaite's of the variance of each parameter, shape (p,), for independent readings of equal variance.

        0 where it rests on one run alone, or the runs are two.
        """
        if len(self.roots) < FEWEST_RUNS:
            return np.zeros(len(self.norms))
        across = (self.shares @ self.roots).swapaxes(0, 1)
        own = np.sum(self.shares**2, axis=2).T
        gram = own[:, :, np.newaxis] * np.eye(len(self.roots)) - across @ across.swapaxes(1, 2)
        trace, square = np.trace(gram, axis1=1, axis2=2), np.sum(gram**2, axis=(1, 2))
        return np.where(self.alone | (square == 0), 0.0, trace**2 / np.where(square > 0, square, 1.0))


def _split(runs: Sequence[Factor]) -> _Split:
    every = merge(*runs)
    size, norms = (len(runs), *every.R.shape), every.column_norms
    whole = every.R / norms
    scaled = np.vstack([run.R / norms for run in runs])
    roots = solve_triangular(whole, scaled.T, trans="T").T.reshape(size)
    # I - H of each run in the space of its triangle; what is zero in it rests on that run alone, and is left out
    values, vectors = np.linalg.eigh(np.eye(len(whole)) - roots @ roots.swapaxes(1, 2))
    free = values > _SINGULAR
    inverse = np.where(free, 1.0 / np.sqrt(np.where(free, values, 1.0)), 0.0)
    lifted = (vectors * inverse[:, np.newaxis]) @ vectors.swapaxes(1, 2)
    shares = _over(whole, lifted @ roots)
    hanging = _over(whole, (vectors * ~free[:, np.newaxis]).swapaxes(1, 2) @ roots)
    scatter = np.linalg.norm(solve_triangular(whole, np.eye(len(whole))), axis=1)
    alone = np.any(np.linalg.norm(hanging, axis=2) > _HANGING * scatter, axis=0)
    return _Split(norms, roots, shares, alone)


def _over(whole: Array, parts: Array) -> Array:
    """`whole^-1 part^T` of each part, shape (g, p, p)."""
    solved = solve_triangular(whole, parts.reshape(-1, len(whole)).T)
    return np.asarray(solved.T.reshape(parts.shape).swapaxes(1, 2))
