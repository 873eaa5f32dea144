"""Covariance when readings of one run belong together: residuals along a trace are not independent, runs are.

The sandwich by clusters, with the bias-reduced residuals and the effective degrees of freedom of Bell and McCaffrey (Survey
Methodology 28, 2002; Pustejovsky and Tipton, doi:10.1080/07350015.2016.1247004). All of it follows from one small triangle
per run.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.linalg import solve_triangular

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate.factor import Array, Factor, merge, select
from elastogeo.estimate.run_scatter import RunScatter
from elastogeo.estimate.solution import Solution, solve

_NOTHING = 1e-12
"""Share of a run in a direction of the estimate below which it has none: rounding error."""

_MOST_TIMES = 4
"""How often a test is repeated, at most, to see whether its runs would be enough."""


def solve_by_run(runs: Sequence[Factor], labels: Sequence[str]) -> Solution:
    """Least-squares solution whose covariance assumes independent runs, not independent readings.

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
    plain = solve(merge(*chosen))
    scatter = _scatter(chosen, plain.values)
    parameters = np.eye(len(plain.values))
    degrees, covariance = scatter.degrees_of_freedom(parameters), scatter.covariance(parameters)
    weak = degrees <= 1
    covariance[weak], covariance[:, weak] = 0.0, 0.0
    covariance[weak, weak] = np.diag(plain.covariance)[weak]
    found = Solution(plain.labels, plain.values, covariance, np.where(weak, 1.0, degrees), plain.residual_std, scatter)
    return found, tuple(label for label, is_weak in zip(labels, weak, strict=True) if is_weak)


def runs_needed(runs: Sequence[Factor], labels: Sequence[str]) -> int | None:
    """How many runs give every parameter an uncertainty by run, if the test is repeated as it is; None if no number does."""
    chosen = [select(run, labels) for run in runs]
    for times in range(1, _MOST_TIMES + 1):
        scatter = _scatter(chosen * times, np.zeros(len(labels)))
        if (scatter.degrees_of_freedom(np.eye(len(labels))) > 1).all():
            return times * len(runs)
    return None


def _scatter(runs: Sequence[Factor], values: Array) -> RunScatter:
    """How the runs scatter about an estimate."""
    every = merge(*runs)
    size, norms = (len(runs), *every.R.shape), every.column_norms
    whole = every.R / norms
    scaled = np.vstack([run.R / norms for run in runs])
    roots = solve_triangular(whole, scaled.T, trans="T").T.reshape(size)
    left, shares, right = np.linalg.svd(roots)
    most = max(1, int(np.max(np.sum(shares > _NOTHING, axis=1))))
    residuals = np.array([run.z - run.R @ values for run in runs])
    seen = np.einsum("gik,gi->gk", left[:, :, :most], residuals)
    return RunScatter(norms, whole, right[:, :most].swapaxes(1, 2), shares[:, :most], seen)
