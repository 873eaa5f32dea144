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
    select,
)
from elastogeo.identification.influences import Effect
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array

SCATTER = "scatter of the readings"

MOST_TRIALS = 300_000
"""After which draws that have not settled will not."""

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
    moments = _moments(systems, solution)
    sizes = [effect.influence.standard_uncertainty for effect in effects]
    moved = [size * _sensitivity(systems, solution, e, moments) for size, e in zip(sizes, effects, strict=True)]
    systematic = np.array(moved).reshape(len(effects), len(solution.labels))
    freedoms = np.array([effect.influence.degrees_of_freedom for effect in effects])
    scatter = solution.standard_uncertainty
    contributions = np.column_stack([scatter, np.abs(systematic).T])
    degrees = np.column_stack([solution.degrees_of_freedom, np.tile(freedoms, (len(scatter), 1))])
    covariance = solution.covariance + systematic.T @ systematic
    effective = effective_degrees_of_freedom(contributions, degrees)
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


def agreement(systems: Systems, solution: Solution, effects: Sequence[Effect], budget: Budget, seed: int = 0) -> Agreement:
    """The budget again by random draws, and whether both agree.

    Raises
    ------
    UnsupportedError
        If there is no influence to draw, or the draws do not settle.
    """
    if not effects:
        raise UnsupportedError("the test states no systematic influence; add [[influences]] to its file to draw from them")
    draw = _sampler(systems, solution, effects)
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


@dataclass(frozen=True, slots=True)
class _Moments:
    """The normal equations of every run, columns scaled to unit length over all runs.

    The design is well conditioned on scaled columns (the verdict says when it is not), so that they lose nothing here.
    """

    norms: Array
    gram: Array
    moment: Array
    powers: Array


@dataclass(frozen=True, slots=True)
class _Loads:
    """What q of all k effects, those on single loads, change in the normal equations of p parameters.

    With the sizes s of all effects and D_i the change of the design, the information gains `sum s_i (D_i^T A + A^T D_i) +
    sum s_i s_j D_i^T D_j`, the moment `sum s_i (D_i^T y - sum s_l D_i^T shift_l)`.
    """

    which: np.ndarray[tuple[int], np.dtype[np.int_]]
    cross: Array
    square: Array
    moment: Array
    shifted: Array

    def information(self, sizes: Array) -> Array:
        """What draws of the sizes, shape (c, k), add to the information, shape (c, p, p)."""
        own = sizes[:, self.which]
        return np.asarray(
            np.einsum("ci,ipq->cpq", own, self.cross) + np.einsum("ci,cj,ijpq->cpq", own, own, self.square, optimize=True)
        )

    def moved(self, sizes: Array) -> Array:
        """What they add to the moment, shape (c, p)."""
        own = sizes[:, self.which]
        return np.asarray(own @ self.moment - np.einsum("ci,cl,ilp->cp", own, sizes, self.shifted, optimize=True))


def _moments(systems: Systems, solution: Solution) -> _Moments:
    runs = [select(run.factor, solution.labels) for run in systems.runs]
    norms = np.sqrt(sum(np.sum(run.R**2, axis=0) for run in runs))
    by_name = {source.name: source.force_degree for source in systems.sources}
    return _Moments(
        norms=norms,
        gram=np.array([(run.R / norms).T @ (run.R / norms) for run in runs]),
        moment=np.array([(run.R / norms).T @ run.z for run in runs]),
        powers=np.array([by_name[label] for label in solution.labels]),
    )


def _shifted(systems: Systems, solution: Solution, effect: Effect, norms: Array) -> Array:
    """`A^T s` of every run for the change s of its readings, shape (runs, p)."""
    if effect.shift is None:
        return np.zeros((len(systems.runs), len(norms)))
    pairs = zip(systems.runs, effect.shift, strict=True)
    return np.array([(run.design_of(solution.labels) / norms).T @ (run.counted * shift) for run, shift in pairs])


def _columns(systems: Systems, solution: Solution, effect: Effect, norms: Array) -> list[Array]:
    """Change of the design of every run, scaled like its columns."""
    columns = systems.runs[0].factor.labels
    chosen = [columns.index(label) for label in solution.labels]
    return [change[:, chosen] / norms for change in effect.columns or ()]


def _counted(systems: Systems, columns: Sequence[Array]) -> list[Array]:
    """Columns of every run, each reading with what it counts."""
    return [c * np.reshape(run.counted, (-1, 1)) for run, c in zip(systems.runs, columns, strict=False)]


def _loads(systems: Systems, solution: Solution, effects: Sequence[Effect], norms: Array) -> _Loads:
    """What effects on single loads change in the normal equations."""
    plain = [(k, _columns(systems, solution, effect, norms)) for k, effect in enumerate(effects) if effect.columns]
    changed = [(k, _counted(systems, columns)) for k, columns in plain]
    designs = [run.design_of(solution.labels) / norms for run in systems.runs]
    p, readings = len(norms), [run.reading for run in systems.runs]
    half = np.array([sum(d.T @ a for d, a in zip(D, designs, strict=True)) for _, D in changed]).reshape(-1, p, p)
    return _Loads(
        which=np.array([k for k, _ in changed], dtype=int),
        cross=half + half.swapaxes(1, 2),
        square=np.array([[sum(d.T @ e for d, e in zip(D, E, strict=True)) for _, E in plain] for _, D in changed]),
        moment=np.array([sum(d.T @ y for d, y in zip(D, readings, strict=True)) for _, D in changed]).reshape(-1, p),
        shifted=np.array([[_across(D, effect) for effect in effects] for _, D in changed]).reshape(-1, len(effects), p),
    )


def _across(columns: Sequence[Array], effect: Effect) -> Array:
    """`D^T s` over all runs for a change D of the design and a shift s of the readings."""
    if effect.shift is None:
        return np.zeros(columns[0].shape[1])
    return np.asarray(sum(d.T @ s for d, s in zip(columns, effect.shift, strict=True)))


def _sensitivity(systems: Systems, solution: Solution, effect: Effect, runs: _Moments) -> Array:
    """Change of the estimate per unit of the influence quantity, shape (p,)."""
    moved = _moved(systems, solution, effect, runs).sum(axis=0)
    return np.asarray(np.linalg.solve(runs.gram.sum(axis=0), moved) / runs.norms)


def _moved(systems: Systems, solution: Solution, effect: Effect, runs: _Moments) -> Array:
    """By how much the normal equations of each run are off per unit of the influence quantity, shape (runs, p)."""
    values = solution.values * runs.norms
    rest = runs.moment - runs.gram @ values
    moved = effect.stretch[:, np.newaxis] * (runs.powers * rest - runs.gram @ (runs.powers * values))
    moved -= _shifted(systems, solution, effect, runs.norms)
    changes = _counted(systems, _columns(systems, solution, effect, runs.norms))
    for k, (run, change) in enumerate(zip(systems.runs, changes, strict=False)):
        design = run.design_of(solution.labels) / runs.norms
        moved[k] += change.T @ (run.reading - design @ values) - design.T @ (change @ values)
    return np.asarray(moved)


def moments_moved(systems: Systems, solution: Solution, effects: Sequence[Effect]) -> Array:
    """By how much the normal equations of each run are off for one standard uncertainty of each effect.

    Shape (effects, runs, p), of columns scaled to unit length over all runs.
    """
    runs = _moments(systems, solution)
    sizes = (effect.influence.standard_uncertainty for effect in effects)
    found = [size * _moved(systems, solution, effect, runs) for size, effect in zip(sizes, effects, strict=True)]
    return np.array(found).reshape(len(effects), len(systems.runs), len(runs.norms))


def _sampler(systems: Systems, solution: Solution, effects: Sequence[Effect]) -> Callable[[np.random.Generator, int], Array]:
    """Draws of the parameters, shape (count, p): each trial solves the test anew, with forces and readings of its own.

    Every standard uncertainty counts as known.
    """
    known = [replace(effect.influence, degrees_of_freedom=inf) for effect in effects]
    runs = _moments(systems, solution)
    stretch, kin = np.unique(np.array([effect.stretch for effect in effects]), axis=1, return_inverse=True)
    # Runs whose force every influence stretches alike are one run to the draws.
    together = (kin.ravel() == np.arange(stretch.shape[1])[:, np.newaxis]).astype(float)
    gram = np.einsum("gr,rpq->gpq", together, runs.gram)
    moment = together @ runs.moment
    shifted = np.array([together @ _shifted(systems, solution, effect, runs.norms) for effect in effects])
    loads = _loads(systems, solution, effects, runs.norms)
    deviation = solution.standard_uncertainty * runs.norms
    # By run the covariance has no higher rank than there are runs: no Cholesky factor, but a root all the same.
    correlation = solution.covariance / np.outer(solution.standard_uncertainty, solution.standard_uncertainty)
    spreads, vectors = np.linalg.eigh(correlation)
    root = vectors * np.sqrt(np.maximum(spreads, 0.0))

    def draw(random: np.random.Generator, count: int) -> Array:
        sizes = np.column_stack([np.zeros((count, 0)), *(influence.draws(random, count) for influence in known)])
        factors = (1.0 + sizes @ stretch)[:, :, np.newaxis] ** runs.powers
        moved = moment - np.einsum("ck,kgp->cgp", sizes, shifted)
        information = np.einsum("cgp,gpq,cgq->cpq", factors, gram, factors, optimize=True)
        summed = np.sum(factors * moved, axis=1)
        if len(loads.which):
            information, summed = information + loads.information(sizes), summed + loads.moved(sizes)
        values = np.linalg.solve(information, summed[..., np.newaxis])[..., 0]
        scatter = random.standard_normal((count, len(root))) @ root.T * deviation
        return np.asarray((values + scatter) / runs.norms)

    return draw
