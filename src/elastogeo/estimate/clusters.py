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
    chosen = [select(run, labels) for run in runs]
    plain, split = solve(merge(*chosen)), _split(chosen)
    residuals = [run.z - run.R @ plain.values for run in chosen]
    scores = np.array([share @ residual for share, residual in zip(split.shares, residuals, strict=True)])
    degrees, norms = split.degrees_of_freedom(), split.norms
    if (degrees <= 1).any():
        weak = ", ".join(label for label, degree in zip(labels, degrees, strict=True) if degree <= 1)
        raise DegreesOfFreedomError(
            f"{len(runs)} runs are too few for an uncertainty of {weak} by run: it rests on hardly more than one of them; "
            f"repeat the runs"
        )
    covariance = scores.T @ scores / np.outer(norms, norms)
    return Solution(plain.labels, plain.values, covariance, degrees, plain.residual_std)


def runs_needed(runs: Sequence[Factor], labels: Sequence[str]) -> int | None:
    """How many runs give every parameter an uncertainty by run, if the test is repeated as it is; None if no number does."""
    chosen = [select(run, labels) for run in runs]
    for times in range(1, _MOST_TIMES + 1):
        if (_split(chosen * times).degrees_of_freedom() > 1).all():
            return times * len(runs)
    return None


@dataclass(frozen=True, slots=True)
class _Split:
    """How runs share in an estimate.

    `roots[g]` is the triangle of run g over that of all, `shares[g]` the bread times the adjusted design of run g: what it
    adds to the estimate, per residual.
    """

    norms: Array
    whole: Array
    roots: Sequence[Array]
    shares: Sequence[Array]

    def degrees_of_freedom(self) -> Array:
        """Of the variance of each parameter, shape (p,); 0 where it rests on one run alone."""
        alone = np.any([_resting_on(root, self.whole) for root in self.roots], axis=0)
        each = [_degrees_of_freedom(self.roots, [share[k] for share in self.shares]) for k in range(len(self.norms))]
        return np.where(alone, 0.0, each)


def _split(runs: Sequence[Factor]) -> _Split:
    every = merge(*runs)
    whole = every.R / every.column_norms
    roots = [solve_triangular(whole, (run.R / every.column_norms).T, trans="T").T for run in runs]
    shares = [solve_triangular(whole, (_lifted(root) @ root).T) for root in roots]
    return _Split(every.column_norms, whole, roots, shares)


def _lifted(root: Array) -> Array:
    """`(I - H)^(-1/2)` of one run in the space of its triangle; a combination that rests on it alone is left out."""
    values, vectors, free = _apart(root)
    inverse = np.where(free, 1.0 / np.sqrt(np.where(free, values, 1.0)), 0.0)
    return np.asarray((vectors * inverse) @ vectors.T)


def _apart(root: Array) -> tuple[Array, Array, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """Eigenvalues and vectors of `I - H` of one run, and which of them other runs share in."""
    values, vectors = np.linalg.eigh(np.eye(len(root)) - root @ root.T)
    return values, vectors, values > _SINGULAR


def _resting_on(root: Array, whole: Array) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which parameters hang on combinations that one run alone determines: no other run shows how they scatter."""
    _, vectors, free = _apart(root)
    part = solve_triangular(whole, root.T @ vectors[:, ~free])
    size = np.linalg.norm(solve_triangular(whole, np.eye(len(whole))), axis=1)
    return np.asarray(np.linalg.norm(part, axis=1) > _HANGING * size)


def _degrees_of_freedom(roots: Sequence[Array], shares: Sequence[Array]) -> float:
    """Satterthwaite's degrees of freedom of the variance of one parameter, for independent readings of equal variance."""
    across = np.array([root.T @ share for root, share in zip(roots, shares, strict=True)])
    gram = np.diag([float(share @ share) for share in shares]) - across @ across.T
    square = float(np.sum(gram**2))
    return float(np.trace(gram) ** 2 / square) if square > 0 else 0.0
