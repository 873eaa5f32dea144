"""Has something changed? Between local estimates of one test, and between two tests of one machine.

A difference is judged against the covariance of the difference: two estimates from overlapping force levels share runs, and
estimates from close levels are strongly coupled. What looks like a geometry that changes with the force can be just that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from elastogeo.errors import DegreesOfFreedomError, UnsupportedError
from elastogeo.estimate import Factor, Solution, effective_degrees_of_freedom, merge, select, solve
from elastogeo.machine import Array

SIGNIFICANT = 0.05
"""Probability, without any change, below which a difference counts as a change."""

_WITHIN = 1e-8
"""Least singular value of a run's scaled columns that counts as a direction of its traces."""

_KNOWN = 1e9
"""Degrees of freedom of a covariance that is known: the F-distribution wants a number."""

_ROUNDING = 1e-12
"""Share of the readings that is their rounding error at most: less scatter than that is none."""

_DEPENDENT = 1e-10
"""Share of the greatest eigenvalue of a correlation up to which estimates depend on one another."""

_ALIKE = 1e-6
"""Relative difference of the products of columns up to which one run repeats another."""


@dataclass(frozen=True, slots=True)
class Change:
    """A joint test of differences.

    Attributes
    ----------
    labels : tuple of str
        Parameters whose differences are tested.
    statistic : float
        F-distributed with `q` and `degrees_of_freedom` if nothing changed. Of two tests, Hotelling's, with V from both. **Of
        local estimates, and of two tests whose degrees of freedom are not twice the differences**, it is that of the surest
        parameter, and the p-value allows for their number (Bonferroni).
    q : int
        How many differences.
    degrees_of_freedom : float
    p_value : float
        Probability of such differences, or greater ones, if nothing changed.
    each : dict of str to float
        The same for each parameter by itself.
    """

    labels: tuple[str, ...]
    statistic: float
    q: int
    degrees_of_freedom: float
    p_value: float
    each: dict[str, float]

    @property
    def significant(self) -> bool:
        """Whether something changed by more than its uncertainty."""
        return self.p_value < SIGNIFICANT


def run_dispersion(runs: Sequence[Factor], labels: Sequence[str]) -> tuple[float, float]:
    """Variance of one reading as the scatter *between* runs shows it, and its degrees of freedom.

    Within the space of traces that the parameters can make, each run gives as many numbers as its design has rank; what the
    common fit leaves of them scatters by the noise of the readings if runs are alike, and by more if they are not.

    Raises
    ------
    DegreesOfFreedomError
        If the runs leave nothing over.
    """
    left, freedom = _between([select(run, labels) for run in runs])
    return left / freedom, freedom


def _between(runs: Sequence[Factor]) -> tuple[float, float]:
    """Sum of squares that the common fit leaves between the runs, within what the parameters can make; its freedom."""
    values = solve(merge(*runs)).values
    left, freedom = 0.0, -float(len(values))
    for run in runs:
        norms = run.column_norms
        U, singular_values, _ = np.linalg.svd(run.R / np.where(norms > 0, norms, 1.0))
        within = U[:, singular_values > _WITHIN]  # what is left beyond it is the scatter of readings about any trace
        left += float(np.sum((within.T @ (run.z - run.R @ values)) ** 2))
        freedom += within.shape[1]
    if freedom <= 0:
        raise DegreesOfFreedomError(f"{len(runs)} runs leave no degree of freedom for {len(values)} parameters")
    return max(left, freedom * _rounding(runs)), freedom


def _rounding(runs: Sequence[Factor]) -> float:
    """Variance that is the rounding error of the readings."""
    return (_ROUNDING * float(np.linalg.norm([run.z for run in runs]))) ** 2


def local_change(
    runs: Sequence[Factor], labels: Sequence[str], choices: Sequence[Sequence[int]], loads: Sequence[float]
) -> Change:
    """Whether estimates from choices of runs differ by more than their uncertainty.

    Parameters
    ----------
    runs : sequence of Factor
    labels : sequence of str, length p
    choices : sequence of sequence of int
        For each local estimate the runs it uses; they may overlap.
    loads : sequence of float
        For each, how much load it was made under: what it goes with if it changes with the load.

    Returns
    -------
    Change
        Each parameter by itself, by the scatter of runs in just the shape of the trace that it reads, whatever shape the
        scatter has. If runs are repeated, any difference counts, against the scatter between repeats. **If none is, only a
        change in proportion to `loads` does**, against what is left of the differences beside it: any other change looks
        just like runs that scatter.

    Raises
    ------
    UnsupportedError
        If there are fewer than two local estimates.
    DegreesOfFreedomError
        If no run is repeated and there are fewer than three local estimates that do not depend on one another.
    """
    if len(choices) < 2:
        raise UnsupportedError(
            "to say whether local estimates differ takes two of them; measure at three force levels or more"
        )
    chosen = [select(run, labels) for run in runs]
    norms = merge(*chosen).column_norms
    grams = [(run.R / norms).T @ (run.R / norms) for run in chosen]
    inverses: list[Array] = [np.asarray(np.linalg.inv(sum(grams[r] for r in choice))) for choice in choices]
    values = np.array([solve(merge(*(chosen[r] for r in choice))).values * norms for choice in choices])
    covariance = np.block(
        [[inverses[i] @ _shared(grams, a, b) @ inverses[j] for j, b in enumerate(choices)] for i, a in enumerate(choices)]
    )
    floor = _rounding(chosen)
    contrasts = _contrasts(values, covariance)
    scores = [(run.R / norms).T @ run.z for run in chosen]
    variances, repeats = _own_scatter(scores, grams, inverses, choices)
    if repeats >= contrasts.rank(range(0, contrasts.size, len(labels))):
        return _tested_by_repeats(contrasts, np.maximum(variances, floor), repeats, labels)
    return _tested_by_trend(values, covariance, np.asarray(loads, dtype=float), floor, labels)


def difference(one: Solution, other: Solution, shared: Array | None = None) -> Change:
    """Whether two estimates of the same parameters differ by more than their uncertainty.

    Parameters
    ----------
    one, other : Solution
        Of two tests of one machine, with the same labels.
    shared : array, shape (p, p), optional
        Covariance that both have in common (the same gauge, the same bar); it cancels.

    Raises
    ------
    UnsupportedError
        If the parameters are not the same.
    """
    if one.labels != other.labels:
        raise UnsupportedError(
            f"the tests determine different parameters, {', '.join(one.labels)} and {', '.join(other.labels)}; "
            f"ask both for the same ones"
        )
    covariance = one.covariance + other.covariance - (0.0 if shared is None else 2 * shared)
    scale = np.sqrt(np.diag(covariance))
    delta = (other.values - one.values) / scale
    freedom = difference_freedom(one, other)
    each = fdtrc(1, freedom, delta**2)
    p_values = dict(zip(one.labels, map(float, each), strict=True))
    value, q = _quadratic(delta, covariance / np.outer(scale, scale))
    least = float(freedom.min())
    rest = least - q + 1
    if rest < q:
        surest = int(np.argmin(each))
        p_value = min(1.0, len(each) * float(each[surest]))
        return Change(one.labels, float(delta[surest] ** 2), len(each), float(freedom[surest]), p_value, p_values)
    statistic = value / q * rest / least
    return Change(one.labels, statistic, q, rest, float(fdtrc(q, rest, statistic)), p_values)


def difference_freedom(one: Solution, other: Solution) -> Array:
    """Effective degrees of freedom of each difference of two independent estimates, shape (p,) (JCGM 100, G.2b)."""
    contributions = np.column_stack([one.standard_uncertainty, other.standard_uncertainty])
    degrees = np.column_stack([one.degrees_of_freedom, other.degrees_of_freedom])
    return np.minimum(effective_degrees_of_freedom(contributions, degrees), _KNOWN)


def _shared(grams: Sequence[Array], one: Sequence[int], other: Sequence[int]) -> Array:
    common = [grams[r] for r in one if r in other]
    return np.asarray(sum(common, np.zeros_like(grams[0])))


@dataclass(frozen=True, slots=True)
class _Contrasts:
    """Every estimate against the first: differences, in units of what unit readings give, and their correlation."""

    delta: Array
    correlation: Array

    @property
    def size(self) -> int:
        return len(self.delta)

    def value(self, rows: Sequence[int]) -> tuple[float, int]:
        """`d^T V^+ d` of some differences, and its rank."""
        return _quadratic(self.delta[rows], self.correlation[np.ix_(rows, rows)])

    def rank(self, rows: Sequence[int]) -> int:
        return self.value(rows)[1]


def _contrasts(values: Array, covariance: Array) -> _Contrasts:
    """Of estimates, shape (count, p), whose joint covariance is that of readings of unit variance."""
    count, p = values.shape
    contrast = np.kron(np.column_stack([-np.ones(count - 1), np.eye(count - 1)]), np.eye(p))
    spread = contrast @ covariance @ contrast.T
    scale = np.sqrt(np.diag(spread))
    return _Contrasts(contrast @ values.ravel() / scale, spread / np.outer(scale, scale))


def _own_scatter(
    scores: Sequence[Array], grams: Sequence[Array], inverses: Sequence[Array], choices: Sequence[Sequence[int]]
) -> tuple[Array, int]:
    """Variance of a reading as repeated runs show it in each parameter, shape (p,), and the degrees of freedom.

    What a run adds to a local estimate is linear in its readings and scatters, between runs of the same design, by its own
    variance in just the shape of the trace that the parameter reads: no other shape comes in.
    """
    left, freedom = np.zeros(len(scores[0])), 0
    for group in _repeats(grams, sorted({run for choice in choices for run in choice})):
        mean = np.mean([scores[run] for run in group], axis=0)
        shares = []
        for inverse, choice in zip(inverses, choices, strict=True):
            members = [run for run in group if run in choice]
            unit = np.diag(inverse @ grams[group[0]] @ inverse)  # variance that unit readings give to what a run adds
            square = sum(((inverse @ (scores[run] - mean)) ** 2 for run in members), np.zeros_like(left))
            if len(members) == len(group):
                shares.append(np.divide(square, unit, out=np.zeros_like(left), where=unit > 0))
        if shares:
            left += np.mean(shares, axis=0)
            freedom += len(group) - 1
    return left / max(freedom, 1), freedom


def _repeats(grams: Sequence[Array], runs: Sequence[int]) -> list[list[int]]:
    """Groups of runs whose designs are alike."""
    groups: list[list[int]] = []
    for run in runs:
        for group in groups:
            if np.allclose(grams[run], grams[group[0]], rtol=0, atol=_ALIKE * np.abs(grams[run]).max()):
                group.append(run)
                break
        else:
            groups.append([run])
    return groups


def _tested_by_repeats(contrasts: _Contrasts, variances: Array, freedom: int, labels: Sequence[str]) -> Change:
    """Each parameter by its own scatter; all together by the surest of them, for their number."""
    found = [contrasts.value(range(k, contrasts.size, len(labels))) for k in range(len(labels))]
    statistics = [value / size / variance for (value, size), variance in zip(found, variances, strict=True)]
    each = [float(fdtrc(size, freedom, F)) for (_, size), F in zip(found, statistics, strict=True)]
    surest = int(np.argmin(each))
    p_value = min(1.0, len(each) * each[surest])
    p_values = dict(zip(labels, each, strict=True))
    return Change(tuple(labels), float(statistics[surest]), found[surest][1], float(freedom), p_value, p_values)


def _tested_by_trend(values: Array, covariance: Array, loads: Array, floor: float, labels: Sequence[str]) -> Change:
    """Each parameter by its trend with the load, among its own local estimates; all together by the surest of them.

    Generalised least squares of a constant and the load: the local estimates share runs, so that they are whitened first.
    """
    p, statistics, freedoms = len(labels), [], []
    for k in range(p):
        spreads, vectors = np.linalg.eigh(covariance[k::p, k::p])
        free = spreads > _DEPENDENT * spreads[-1]
        white = vectors[:, free].T / np.sqrt(spreads[free])[:, np.newaxis]
        y, flat, trend = white @ values[:, k], white.sum(axis=1), white @ (loads / np.abs(loads).max())
        freedom = int(free.sum()) - 2
        if freedom < 1:
            raise DegreesOfFreedomError(f"{len(values)} local estimates leave no degree of freedom to judge a trend by")
        y, trend = (v - flat * (flat @ v) / (flat @ flat) for v in (y, trend))
        along = float(trend @ y) ** 2 / float(trend @ trend)
        statistics.append(along / max((float(y @ y) - along) / freedom, floor))
        freedoms.append(freedom)
    each = [float(fdtrc(1, freedom, F)) for freedom, F in zip(freedoms, statistics, strict=True)]
    surest = int(np.argmin(each))
    p_value = min(1.0, p * each[surest])
    p_values = dict(zip(labels, each, strict=True))
    return Change(tuple(labels), float(statistics[surest]), 1, float(freedoms[surest]), p_value, p_values)


def _quadratic(delta: Array, correlation: Array) -> tuple[float, int]:
    """`d^T V^+ d` and the rank of V: differences that depend on one another count once."""
    values, vectors = np.linalg.eigh(correlation)
    free = values > _DEPENDENT * values[-1]
    along = vectors[:, free].T @ delta
    return float(np.sum(along**2 / values[free])), int(free.sum())
