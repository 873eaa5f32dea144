"""Type A uncertainty from repeated runs (thesis 4.7), as it is commonly done and as it is sound.

When n1 runs at one level and n2 at another are combined in all n1 n2 pairs, the pairs share runs and are not independent:
their standard deviation is that of *one* pair (but for a factor), and dividing it by the root of their number claims far
too much. What is independent is the runs. The estimate is linear in the readings, so each run adds its own part to it; the
scatter of the parts within each level gives the variance, and Welch-Satterthwaite its degrees of freedom.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate.factor import Array, Factor, merge, select
from elastogeo.estimate.solution import Solution, solve


@dataclass(frozen=True, slots=True)
class Repeatability:
    """What repeated runs say of the parameters.

    Attributes
    ----------
    solution : Solution
        Estimate from all runs together, its covariance and degrees of freedom by run.
    combinations : array, shape (k, p)
        The estimates from every combination of one run per level.
    runs : mapping of str to int
        How many runs each level has.
    """

    solution: Solution
    combinations: Array
    runs: Mapping[str, int]

    @property
    def combination_mean(self) -> Array:
        """Mean over all combinations, shape (p,)."""
        return np.asarray(self.combinations.mean(axis=0))

    @property
    def combination_std(self) -> Array:
        """Standard deviation over all combinations, shape (p,). **Not** the uncertainty of their mean."""
        return np.asarray(self.combinations.std(axis=0, ddof=1))


@dataclass(frozen=True, slots=True)
class Common:
    """What an error that all runs share adds to the uncertainty.

    Attributes
    ----------
    covariance : array, shape (p, p)
    degrees_of_freedom : float
    """

    covariance: Array
    degrees_of_freedom: float


def repeatability(
    levels: Mapping[str, Sequence[Factor]], labels: Sequence[str], common: Common | None = None
) -> Repeatability:
    """Estimate from repeated runs with a run-level (type A) uncertainty.

    Parameters
    ----------
    levels : mapping of str to sequence of Factor
        One factor per run, by level.
    labels : sequence of str
        Parameters to solve for (a retained set).
    common : Common, optional
        Of an error that all runs share: that of a reference which was subtracted from each.

    Returns
    -------
    Repeatability

    Raises
    ------
    DegreesOfFreedomError
        If a level has a single run: its scatter is unknown, and no number would be honest.
    """
    single = [name for name, runs in levels.items() if len(runs) < 2]
    if single or not levels:
        raise DegreesOfFreedomError(
            f"a run-level uncertainty needs at least two runs at every level; {', '.join(single) or 'no level'} has fewer"
        )
    chosen = {name: [select(run, labels) for run in runs] for name, runs in levels.items()}
    every = merge(*(run for runs in chosen.values() for run in runs))
    solution = solve(every)
    parts = {name: np.array([_part(run, every, solution.values) for run in runs]) for name, runs in chosen.items()}
    # The sum of n independent parts has n times the variance of one.
    by_level = [len(part) * np.cov(part, rowvar=False, ddof=1).reshape(len(labels), -1) for part in parts.values()]
    freedoms = np.array([[len(part) - 1.0] for part in parts.values()])
    if common is not None:
        by_level.append(common.covariance)
        freedoms = np.vstack([freedoms, [[common.degrees_of_freedom]]])
    variances = np.array([np.diag(covariance) for covariance in by_level])
    total = variances.sum(axis=0)
    degrees = np.divide(total**2, (variances**2 / freedoms).sum(axis=0), out=np.full(len(labels), np.inf), where=total > 0)
    return Repeatability(
        solution=Solution(solution.labels, solution.values, np.sum(by_level, axis=0), degrees, solution.residual_std),
        combinations=np.array([solve(merge(*runs)).values for runs in product(*chosen.values())]),
        runs={name: len(runs) for name, runs in levels.items()},
    )


def _part(run: Factor, every: Factor, values: Array) -> Array:
    """What one run adds to the estimate beyond the common fit: `(R^T R)^-1 R_run^T (z_run - R_run p)`, shape (p,)."""
    norms = every.column_norms
    R = every.R / norms
    score = (run.R / norms).T @ (run.z - run.R @ values)
    return np.asarray(np.linalg.solve(R, np.linalg.solve(R.T, score)) / norms)
