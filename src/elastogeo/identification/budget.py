"""The uncertainty budget of identified parameters: the scatter of the runs, and every systematic influence.

To first order in closed form, also where the force stands in the design matrix: if the force of run r is off by the relative
amount w_r, each of its columns is off by h w_r, with h the column's power of the force, and the estimate by

    (sum_r A_r^T A_r)^-1 sum_r w_r [ H A_r^T (y_r - A_r p) - A_r^T A_r H p ].

If single loads are off, so that the design changes by D_r, it is off by

    (sum_r A_r^T A_r)^-1 sum_r [ D_r^T (y_r - A_r p) - A_r^T D_r p ].

And by random draws (JCGM 101) through the triangles of the runs, where nothing is linearised.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import (
    MonteCarlo,
    Solution,
    coverage_factor,
    effective_degrees_of_freedom,
    monte_carlo,
)
from elastogeo.identification.influences import Effect
from elastogeo.identification.moments import Moments, moments_of
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array

SCATTER = "scatter of the readings"

MOST_TRIALS = 300_000
"""After which draws that have not settled will not."""

_AT_ONCE = 500
"""Draws that are solved at once: each has a matrix of its own."""

COVERAGE = 0.95
TAIL = 0.0125
"""By how much the share of draws beyond an end of an interval may differ from 2.5 %: half of it."""

_NORMAL = 1.959963984540054
"""Quantile of the normal distribution for this coverage."""


@dataclass(frozen=True, slots=True)
class BudgetLine:
    """What one influence contributes to one parameter.

    Attributes
    ----------
    label : str
    type_b : bool
    distribution : str
    degrees_of_freedom : float
    contribution : float
        Standard uncertainty that it brings, in the unit of the parameter.
    """

    label: str
    type_b: bool
    distribution: str
    degrees_of_freedom: float
    contribution: float


@dataclass(frozen=True, slots=True)
class Budget:
    """Combined uncertainty of p parameters.

    Attributes
    ----------
    labels : tuple of str
    lines : tuple of tuple of BudgetLine
        For each parameter, greatest contribution first.
    covariance : array, shape (p, p)
        Of scatter and influences together (JCGM 102, 6.2).
    degrees_of_freedom : array, shape (p,)
        Effective (JCGM 100, G.4).
    interval : array, shape (p, 2)
        95 % coverage interval about the values (JCGM 100, G.6.4).
    systematic : array, shape (q, p)
        By how much one standard uncertainty of each influence moves the parameters.
    freedoms : array, shape (q,)
        Degrees of freedom of each.
    """

    labels: tuple[str, ...]
    lines: tuple[tuple[BudgetLine, ...], ...]
    covariance: Array
    degrees_of_freedom: Array
    interval: Array
    systematic: Array
    freedoms: Array

    @property
    def standard_uncertainty(self) -> Array:
        """Combined standard uncertainty of each parameter, shape (p,)."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))


@dataclass(frozen=True, slots=True)
class Agreement:
    """First order against random draws (JCGM 101, 8).

    Both count every standard uncertainty as known: what is compared is the shape of the distributions and what the force in
    the design matrix bends, not what few degrees of freedom are worth. These widen both intervals alike, by Student's
    factor.

    Attributes
    ----------
    draws : MonteCarlo
        With every standard uncertainty known.
    interval : array, shape (p, 2)
        95 % coverage interval of the draws, widened for the effective degrees of freedom.
    agrees : array of bool, shape (p,)
        Whether both shares are 2.5 % to within `TAIL`: else the model is not linear, or a distribution not normal, where it
        counts.
    beyond : array, shape (p, 2)
        Share of the draws below and above the interval to first order.
    """

    draws: MonteCarlo
    interval: Array
    agrees: np.ndarray[tuple[int], np.dtype[np.bool_]]
    beyond: Array


def uncertainty_budget(systems: Systems, solution: Solution, effects: Sequence[Effect]) -> Budget:
    """The budget of a solution to first order.

    Parameters
    ----------
    systems : Systems
    solution : Solution
        With the covariance of the scatter.
    effects : sequence of Effect
    """
    return budget_of(solution, moments_of(systems, solution, effects))


def budget_of(solution: Solution, moments: Moments) -> Budget:
    """The budget of a solution to first order, from the moments about it."""
    effects = moments.effects
    sizes = np.array([effect.influence.standard_uncertainty for effect in effects]).reshape(-1, 1)
    systematic = sizes * np.linalg.solve(moments.gram.sum(axis=0), moments.moved.sum(axis=1).T).T / moments.norms
    freedoms = np.array([effect.influence.degrees_of_freedom for effect in effects])
    scatter = solution.standard_uncertainty
    contributions = np.column_stack([scatter, np.abs(systematic).T])
    degrees = np.column_stack([solution.degrees_of_freedom, np.tile(freedoms, (len(scatter), 1))])
    covariance = solution.covariance + systematic.T @ systematic
    effective = effective_degrees_of_freedom(contributions, degrees, [SCATTER, *(e.influence.label for e in effects)])
    half = coverage_factor(effective) * np.sqrt(np.diag(covariance))
    return Budget(
        labels=solution.labels,
        lines=tuple(_lines(contributions[k], degrees[k], effects) for k in range(len(solution.labels))),
        covariance=covariance,
        degrees_of_freedom=effective,
        interval=np.column_stack([solution.values - half, solution.values + half]),
        systematic=systematic,
        freedoms=freedoms,
    )


def agreement(solution: Solution, moments: Moments, budget: Budget, seed: int = 0) -> Agreement:
    """The budget again by random draws, and whether both agree.

    Parameters
    ----------
    solution : Solution
    moments : Moments
        About it, with what the influences change.
    budget : Budget
    seed : int

    Raises
    ------
    UnsupportedError
        If there is no influence to draw, or the draws do not settle.
    """
    if not moments.effects:
        raise UnsupportedError("the test states no systematic influence; add [[influences]] to its file to draw from them")
    draw = _sampler(solution, moments)
    half = _NORMAL * budget.standard_uncertainty
    beyond, trials = np.zeros((len(half), 2)), 0

    def outputs(random: np.random.Generator, count: int) -> Array:
        nonlocal beyond, trials
        values = draw(random, count)
        off = values - solution.values
        beyond = beyond + np.column_stack([np.sum(off < -half, axis=0), np.sum(off > half, axis=0)])
        trials += count
        return values

    draws = monte_carlo(outputs, digits=1, seed=seed, most=MOST_TRIALS)
    shares, values = beyond / trials, solution.values[:, np.newaxis]
    few = coverage_factor(budget.degrees_of_freedom) / _NORMAL
    widened = values + (draws.interval - values) * few[:, np.newaxis]
    return Agreement(draws, widened, np.all(np.abs(shares - (1 - COVERAGE) / 2) <= TAIL, axis=1), shares)


def _lines(contributions: Array, degrees: Array, effects: Sequence[Effect]) -> tuple[BudgetLine, ...]:
    lines = {SCATTER: BudgetLine(SCATTER, False, "normal", float(degrees[0]), float(contributions[0]))}
    for size, freedom, effect in zip(contributions[1:], degrees[1:], effects, strict=True):
        influence = effect.influence
        before = lines[influence.label].contribution if influence.label in lines else 0.0
        lines[influence.label] = BudgetLine(
            influence.label, influence.type_b, influence.distribution, float(freedom), float(np.hypot(before, size))
        )
    return tuple(sorted(lines.values(), key=lambda line: -line.contribution))


def _sampler(solution: Solution, runs: Moments) -> Callable[[np.random.Generator, int], Array]:
    """Draws of the parameters, shape (count, p): each trial solves the test anew, with forces and readings of its own.

    Every standard uncertainty counts as known.
    """
    known = [replace(effect.influence, degrees_of_freedom=inf) for effect in runs.effects]
    stretch, kin = np.unique(np.array([effect.stretch for effect in runs.effects]), axis=1, return_inverse=True)
    # Runs whose force every influence stretches alike are one run to the draws.
    together = (kin.ravel() == np.arange(stretch.shape[1])[:, np.newaxis]).astype(float)
    gram = np.einsum("gr,rpq->gpq", together, runs.gram)
    moment = together @ runs.moment
    shifted, loads = together @ runs.shifted, runs.loads
    deviation = solution.standard_uncertainty * runs.norms
    # By run the covariance has no higher rank than there are runs: no Cholesky factor, but a root all the same.
    correlation = solution.covariance / np.outer(solution.standard_uncertainty, solution.standard_uncertainty)
    spreads, vectors = np.linalg.eigh(correlation)
    root = vectors * np.sqrt(np.maximum(spreads, 0.0))

    def solved(sizes: Array) -> Array:
        factors = (1.0 + sizes @ stretch)[:, :, np.newaxis] ** runs.powers
        moved = moment - np.einsum("ck,kgp->cgp", sizes, shifted)
        information = np.einsum("cgp,gpq,cgq->cpq", factors, gram, factors, optimize=True)
        summed = np.sum(factors * moved, axis=1)
        if len(loads.which):
            information, summed = information + loads.information(sizes), summed + loads.moved(sizes)
        return np.asarray(np.linalg.solve(information, summed[..., np.newaxis])[..., 0])

    def draw(random: np.random.Generator, count: int) -> Array:
        sizes = np.column_stack([np.zeros((count, 0)), *(influence.draws(random, count) for influence in known)])
        values = np.vstack([solved(sizes[first : first + _AT_ONCE]) for first in range(0, count, _AT_ONCE)])
        scatter = random.standard_normal((count, len(root))) @ root.T * deviation
        return np.asarray((values + scatter) / runs.norms)

    return draw
