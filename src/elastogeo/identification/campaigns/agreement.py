"""Whether the tests of a campaign agree; if not, which test, level or run does not.

What a test says and what all others say are two estimates. Where both determine a combination of the parameters they can
differ, and the sum of squares that the joint fit leaves over beyond that of the two fits is the square of the difference in
its own covariance (Chow, doi:10.2307/1910133). It is held against what runs scatter within tests, so that a test that
contradicts the others is not thought to be noise, and against the stated influences that the tests do not share. Runs do not
scatter alike in all directions: the sum of squares is compared with the trace of its covariance by run, and has as many
degrees of freedom as that covariance has (Box, doi:10.1214/aoms/1177728786).

A test that is wrong makes others disagree too. So the one is named whose removal makes the rest agree, not every test that
disagrees because of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import nan
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc

from elastogeo.estimate import RANK_TOLERANCE, Array, Factor, Solution, merge, select
from elastogeo.identification.check import Check
from elastogeo.identification.moments import Moments
from elastogeo.identification.systems import Systems, merged

TESTS_AGREE = "tests agree"

LEVEL = 0.05
"""Probability, where all tests agree, with which one is said not to: for all tests together (Holm)."""

_KNOWN = 1e9
"""Degrees of freedom of what is known: the F-distribution wants a number."""

_CANDIDATES = 3
"""How many tests are held against what is without them: each takes as long as the first look."""

_ALONE = 1e-6
"""Share of its variance that the fit leaves of a run in a direction, up to which the run alone determines it."""

_FLOOR = 1e-9
"""Share of the pooled variance that is added in every direction, so that no covariance is zero."""

_SHAPES = 0.5
"""Share of the directions in which runs scatter, as far as no other run of the test shows in which: noise that is one of a
run has an offset and a few orders, and is the same everywhere only if readings are independent."""

_ROUNDING = 1e-12
"""Share of the readings that is their rounding error at most: less scatter than that is none."""


@dataclass(frozen=True, slots=True)
class AgainstOthers:
    """One test against all others.

    Attributes
    ----------
    directions : int
        How many combinations of the parameters it determines that the others determine too.
    square : float
        Sum of squares that a fit of all leaves over beyond those of the test and of the others by themselves, over the
        variance of a reading.
    statistic : float or None
        Square of the differences over the trace of its covariance: F-distributed with `effective_directions` and
        `degrees_of_freedom` if the tests agree. None where they share nothing, or no runs show how runs scatter.
    effective_directions : float
        As many as `directions` if runs scatter alike in all of them, else fewer.
    degrees_of_freedom : float
        Of the variance: of the scatter of runs, more where influences that are known add to it.
    p_value : float or None
        Of so great a difference or a greater one if the tests agree, of the test or of a level of it, adjusted for the
        number of tests and levels (Holm) and for both looks.
    rmse : float [mm or rad]
        Of the readings against the prediction from all others. What the others do not determine is fitted to the test.
    fitted : int
        How many combinations that is.
    """

    directions: int
    square: float
    statistic: float | None
    effective_directions: float
    degrees_of_freedom: float
    p_value: float | None
    rmse: float
    fitted: int


@dataclass(frozen=True, slots=True)
class TestsAgreement:
    """Whether the tests of a campaign agree.

    Attributes
    ----------
    against : dict of str to AgainstOthers
        By test.
    disagreeing : tuple of str
        Tests that differ from all others by more than scatter and influences explain, whatever the cause.
    named : tuple of str
        Those without which the others agree, each alone; where none is such, the one whose removal reduces most of the
        disagreement. One, as a rule; several where the tests cannot tell which of them is wrong.
    rest_agrees : bool
        Whether the others agree without it.
    level : float or None [N]
        Of the test that is named, the force level without which all agree, if there is one.
    run : str
        The run of it without which all agree, if there is one; else empty.
    scatter : float
        Standard deviation between runs of a test over that of readings about its best fit.
    scatter_freedom : float
    """

    against: dict[str, AgainstOthers]
    disagreeing: tuple[str, ...]
    named: tuple[str, ...]
    rest_agrees: bool
    level: float | None
    run: str
    scatter: float
    scatter_freedom: float


Rows = NDArray[np.int_]


@dataclass(frozen=True, slots=True)
class _Seen:
    """What some runs see: as many independent numbers of unit variance as their columns have rank.

    `design` (k, r), `seen` (k,) and `moved` (effects, k): what one standard uncertainty of each effect adds to them. `basis`
    (m, k): how they come from the m numbers that these runs see, each by itself; `rows` (m,) says which of all runs' numbers
    these are.
    """

    design: Array
    seen: Array
    moved: Array
    basis: Array
    rows: Rows


@dataclass(frozen=True, slots=True)
class _Run:
    """What one run sees."""

    level: float
    name: str
    seen: _Seen


_Tests = Mapping[str, Sequence[_Run]]


@dataclass(frozen=True, slots=True)
class _Scatter:
    """How the runs of a test scatter about its fit: sum of squares, its freedom, and what is left of each run.

    `seen` (m, runs) has for each run, in its own `rows` of all, what is left of it, of unit variance in what is `free`
    (m, m), in which other runs of the test judge it. It comes from what the test sees by `maker` (m, m). `same` (m, m) is 1
    where two rows are of one run.
    """

    square: float
    freedom: int
    rows: Rows
    seen: Array
    free: Array
    maker: Array
    same: Array


@dataclass(frozen=True, slots=True)
class _Compared:
    """Two parts against one another, as in `AgainstOthers`; the p-value is not adjusted."""

    directions: int
    square: float
    statistic: float | None
    effective_directions: float
    degrees_of_freedom: float
    p_value: float


@dataclass(frozen=True, slots=True)
class _Looks:
    """Each test against all others, and each level of a test against all else; p-values by test, with all adjusted."""

    tests: Mapping[str, _Compared]
    p_values: Mapping[str, float]

    @property
    def disagreeing(self) -> tuple[str, ...]:
        return tuple(name for name, p in self.p_values.items() if p < LEVEL)


def tests_agreement(systems: Systems, solution: Solution, moments: Moments) -> TestsAgreement | None:
    """Whether the tests agree; None of one test.

    Two looks share the level, each with Holm's adjustment: at every test, against what runs scatter within tests; and at
    every force level of a test, against what the other runs scatter, since a level that is wrong is scatter of its test.

    Parameters
    ----------
    systems : Systems
    solution : Solution
        From all tests.
    moments : Moments
        About it, with what systematic influences change. What all tests share alike moves no difference between them.
    """
    if len(systems.tests) < 2:
        return None
    tests = _seen_by_run(systems, solution, moments)
    looks, scatter = _looks(tests), [_own_scatter(runs) for runs in tests.values()]
    freedom, reading = sum(one.freedom for one in scatter), _reading(systems)
    named, rest_agrees = _named(tests, looks.disagreeing) if looks.disagreeing else ((), True)
    level, run = _wrong_part(tests, named[0]) if len(named) == 1 and rest_agrees else (None, "")
    factors = {name: select(merged(systems.of(name).runs), solution.labels) for name in tests}
    precision = {run.test: run.precision for run in systems.runs}
    against = {}
    for name, one in looks.tests.items():
        rest = merge(*(factor for other, factor in factors.items() if other != name))
        rmse, fitted = _left_out(factors[name], rest, precision[name])
        p_value = None if one.statistic is None else looks.p_values[name]
        against[name] = AgainstOthers(
            directions=one.directions,
            square=one.square / reading**2,
            statistic=one.statistic,
            effective_directions=one.effective_directions,
            degrees_of_freedom=one.degrees_of_freedom,
            p_value=p_value,
            rmse=rmse,
            fitted=fitted,
        )
    return TestsAgreement(
        against=against,
        disagreeing=looks.disagreeing,
        named=named,
        rest_agrees=rest_agrees,
        level=level,
        run=run,
        scatter=float(np.sqrt(sum(one.square for one in scatter) / freedom)) / reading if freedom else nan,
        scatter_freedom=freedom,
    )


def tests_agree(found: TestsAgreement) -> Check:
    """The check of a verdict; not tested where no two tests determine the same, or nothing shows how runs scatter."""
    p_values = {name: one.p_value for name, one in found.against.items() if one.p_value is not None}
    facts = {
        "disagreeing": found.disagreeing,
        "named": found.named,
        "rest_agrees": found.rest_agrees,
        "level": found.level,
        "run": found.run,
        "p_values": p_values,
        "shared": max(one.directions for one in found.against.values()),
        "unshared": tuple(name for name, one in found.against.items() if not one.directions),
    }
    return Check(TESTS_AGREE, not found.disagreeing if p_values else None, facts)


def _reading(systems: Systems) -> float:
    """Standard deviation of a reading that counts one."""
    run = systems.runs[0]
    return float(systems.scatter[run.test] * np.sqrt(run.precision))


def _seen_by_run(systems: Systems, solution: Solution, moments: Moments) -> dict[str, list[_Run]]:
    """What every run sees, by test."""
    factors = [select(run.factor, solution.labels) for run in systems.runs]
    norms = moments.norms
    sizes = np.array([effect.influence.standard_uncertainty for effect in moments.effects])
    moved = sizes[:, np.newaxis, np.newaxis] * moments.moved
    parts = [np.linalg.svd(factor.R / norms) for factor in factors]
    ranks = [_rank(sizes) for _, sizes, _ in parts]
    first = 0
    found: dict[str, list[_Run]] = {name: [] for name in systems.tests}
    for k, (run, factor, (U, sizes, Vt), rank) in enumerate(zip(systems.runs, factors, parts, ranks, strict=True)):
        seen = _Seen(
            sizes[:rank, np.newaxis] * Vt[:rank],
            U[:, :rank].T @ factor.z,
            moved[:, k] @ Vt[:rank].T / sizes[:rank],
            np.eye(rank),
            np.arange(first, first + rank),
        )
        found[run.test].append(_Run(run.force, run.name, seen))
        first += rank
    return found


def _joined(parts: Sequence[_Seen]) -> _Seen:
    """What some runs together see."""
    design, seen, moved = _stacked(parts)
    U, sizes, Vt = np.linalg.svd(design, full_matrices=False)
    rank = _rank(sizes)
    own = U[:, :rank]
    basis, rows = _combined(parts, own)
    return _Seen(sizes[:rank, np.newaxis] * Vt[:rank], own.T @ seen, moved @ own, basis, rows)


def _stacked(parts: Sequence[_Seen]) -> tuple[Array, Array, Array]:
    """Design, numbers and what effects add to them, of parts below one another."""
    return (
        np.vstack([part.design for part in parts]),
        np.concatenate([part.seen for part in parts]),
        np.concatenate([part.moved for part in parts], axis=1),
    )


def _combined(parts: Sequence[_Seen], vectors: Array) -> tuple[Array, Rows]:
    """How combinations of what parts see come from what their runs see, each by itself; and which numbers these are."""
    ends = np.cumsum([len(part.seen) for part in parts])[:-1]
    pairs = zip(parts, np.split(vectors, ends), strict=True)
    return np.vstack([part.basis @ own for part, own in pairs]), np.concatenate([part.rows for part in parts])


def _contradictions(parts: Sequence[_Seen]) -> tuple[Array, Array, Array, Rows]:
    """What the parts say against one another, shape (q,), of unit variance; what the effects add; how it comes from all."""
    design, seen, moved = _stacked(parts)
    U, sizes, _ = np.linalg.svd(design)
    beyond = U[:, _rank(sizes) :]
    return beyond.T @ seen, moved @ beyond, *_combined(parts, beyond)


def _rank(sizes: Array) -> int:
    return int(np.sum(sizes > RANK_TOLERANCE * sizes.max(initial=0.0)))


def _own_scatter(runs: Sequence[_Run]) -> _Scatter:
    """How the runs of a test scatter about its fit: what is left of each, adjusted for its part in the fit (CR2)."""
    design, numbers, _ = _stacked([run.seen for run in runs])
    U, sizes, _ = np.linalg.svd(design, full_matrices=False)
    fit = U[:, : _rank(sizes)]
    maker = np.eye(len(fit)) - fit @ fit.T
    left, first, size = maker @ numbers, 0, len(fit)
    seen, free, same = np.zeros((size, len(runs))), np.zeros((size, size)), np.zeros((size, size))
    adjust = np.zeros((size, size))
    for k, run in enumerate(runs):
        own = slice(first, first + len(run.seen.seen))
        values, vectors = np.linalg.eigh(maker[own, own])
        judged = vectors[:, values > _ALONE]
        adjust[own, own] = judged / np.sqrt(values[values > _ALONE]) @ judged.T
        seen[own, k] = adjust[own, own] @ left[own]
        free[own, own], same[own, own] = judged @ judged.T, 1.0
        first = own.stop
    rows = np.concatenate([run.seen.rows for run in runs])
    return _Scatter(float(left @ left), size - fit.shape[1], rows, seen, free, adjust @ maker, same)


def _compared(parts: Sequence[_Seen], scatter: Sequence[_Scatter]) -> _Compared:
    """Whether parts agree, by the scatter of runs, as it is in each direction, and the effects in the variance.

    Effects are known and scatter is estimated, so that the variance has the more degrees of freedom the more of it effects
    make (Satterthwaite).
    """
    apart, moved, weights, rows = _contradictions(parts)
    q, square, freedom = len(apart), float(apart @ apart), sum(one.freedom for one in scatter)
    if not q or not freedom:
        return _Compared(q, square, None, 0.0, 0.0, 1.0)
    least = (_ROUNDING * float(np.linalg.norm(np.concatenate([part.seen for part in parts])))) ** 2
    pooled = max(sum(one.square for one in scatter) / freedom, least)
    values, vectors = np.linalg.eigh(moved.T @ moved)
    white = vectors / np.sqrt(np.maximum(values, 0.0) + pooled)
    by_run, degrees, unjudged = _covariance(weights @ white, rows, scatter, pooled)
    covariance = by_run + (moved @ white).T @ (moved @ white)
    total = float(np.trace(covariance))
    statistic = float(np.sum((apart @ white) ** 2)) / total
    shapes = 1.0 - (1.0 - _SHAPES) * unjudged
    directions = max(1.0, shapes * total**2 / float(np.sum(covariance**2)))
    degrees = min(shapes * degrees * (total / float(np.trace(by_run))) ** 2, _KNOWN)
    return _Compared(q, square, statistic, directions, degrees, float(fdtrc(directions, degrees, statistic)))


def _covariance(weights: Array, rows: Rows, scatter: Sequence[_Scatter], pooled: float) -> tuple[Array, float, float]:
    """Covariance of differences with these weights, shape (m, q), of the numbers of runs in `rows`, by run; the degrees of
    freedom of its trace; how unjudged it is.

    A direction in which no other run of its test judges a run has the pooled variance, or that of what is judged if this is
    greater: runs may scatter more in just the traces that count here. The share of such directions is how unjudged it is.
    """
    size, at = weights.shape[1], np.empty(rows.max() + 1, dtype=int)
    at[rows] = np.arange(len(rows))
    covariance, unjudged, trace, square = np.zeros((size, size)), weights.T @ weights, 0.0, 0.0
    for one in scatter:
        own = weights[at[one.rows]]
        off = own.T @ one.seen
        covariance += off @ off.T
        unjudged -= own.T @ one.free @ own
        gram = one.maker.T @ (own @ own.T * one.same) @ one.maker
        trace += float(np.trace(gram))
        square += float(np.sum(gram**2))
    left, freedom = max(float(np.trace(unjudged)), 0.0), sum(one.freedom for one in scatter)
    degrees = (trace + left) ** 2 / (square + left**2 / freedom)
    more = max(1.0, float(np.trace(covariance)) / (pooled * trace)) if trace > 0 else 1.0
    share = left / float(np.sum(weights**2))
    return covariance + more * pooled * unjudged + _FLOOR * pooled * np.eye(size), degrees, share


def _looks(tests: _Tests) -> _Looks:
    """Every test against the others, and every level of a test of several against all else."""
    whole = {name: _joined([run.seen for run in runs]) for name, runs in tests.items()}
    scatter = {name: _own_scatter(runs) for name, runs in tests.items()}
    by_test, by_level = {}, {}
    for name, runs in tests.items():
        others = [one for other, one in whole.items() if other != name]
        rest = [_joined(others)] if others else []
        by_test[name] = _compared([whole[name], *rest], list(scatter.values()))
        levels = sorted({run.level for run in runs})
        for level in levels if len(levels) > 1 else ():
            kept = [run for run in runs if run.level != level]
            alone = [run.seen for run in runs if run.level == level]
            about = [_own_scatter(kept), *(one for other, one in scatter.items() if other != name)]
            by_level[name, level] = _compared([_joined(alone), _joined([*rest, *(run.seen for run in kept)])], about)
    looks = 2 if by_level else 1
    tested, leveled = _holm(by_test), _holm(by_level)
    p_values = {
        name: min(1.0, looks * min([tested[name], *(p for (of, _), p in leveled.items() if of == name)])) for name in tests
    }
    return _Looks(by_test, p_values)


_Key = TypeVar("_Key")


def _holm(found: Mapping[_Key, _Compared]) -> dict[_Key, float]:
    """p-values adjusted for their number (Holm, 1979); 1 where nothing was compared."""
    ordered = sorted((key for key, one in found.items() if one.statistic is not None), key=lambda key: found[key].p_value)
    adjusted, greatest = dict.fromkeys(found, 1.0), 0.0
    for rank, key in enumerate(ordered):
        greatest = max(greatest, min(1.0, (len(ordered) - rank) * found[key].p_value))
        adjusted[key] = greatest
    return adjusted


def _without(tests: _Tests, name: str) -> dict[str, Sequence[_Run]]:
    return {other: runs for other, runs in tests.items() if other != name}


def _named(tests: _Tests, disagreeing: Sequence[str]) -> tuple[tuple[str, ...], bool]:
    """The tests without which the others agree; if there is none, the one that takes most of the disagreement with it.

    Looked for among the few that take most of it.
    """
    whole = {name: _joined([run.seen for run in runs]) for name, runs in tests.items()}

    def left(name: str) -> float:
        apart, *_ = _contradictions([one for other, one in whole.items() if other != name])
        return float(apart @ apart)

    most = sorted(disagreeing, key=left)[:_CANDIDATES]
    found = tuple(name for name in most if not _looks(_without(tests, name)).disagreeing)
    return (found, True) if found else (tuple(most[:1]), False)


def _wrong_part(tests: _Tests, name: str) -> tuple[float | None, str]:
    """The one level, and the one run, without which a test agrees with all others; None and empty if there is none."""
    own, rest = tests[name], _joined([run.seen for runs in _without(tests, name).values() for run in runs])
    others = [_own_scatter(runs) for runs in _without(tests, name).values()]

    def agree_with(kept: Sequence[_Run]) -> bool:
        about = [_own_scatter(kept), *others]
        if 2 * len(tests) * _compared([_joined([run.seen for run in kept]), rest], about).p_value < LEVEL:
            return False  # what all looks would say too, and they take long
        looks = _looks({**tests, name: kept})
        return bool(looks.tests[name].directions) and not looks.disagreeing

    levels, runs = sorted({run.level for run in own}), [run.name for run in own]
    if len(runs) < 2:
        return None, ""
    wrong = [name for name in runs if agree_with([run for run in own if run.name != name])]
    if len(levels) < 2:
        return None, wrong[0] if len(wrong) == 1 else ""
    off = [level for level in levels if agree_with([run for run in own if run.level != level])]
    return (off[0] if len(off) == 1 else None), (wrong[0] if len(wrong) == 1 else "")


def _left_out(one: Factor, rest: Factor, precision: float) -> tuple[float, int]:
    """RMSE of the readings of a test against the prediction from all others, and how much had to be fitted to it."""
    norms = np.hypot(one.column_norms, rest.column_norms)
    U, sizes, Vt = np.linalg.svd(rest.R / norms)
    rank = _rank(sizes)
    values = Vt[:rank].T @ (U[:, :rank].T @ rest.z / sizes[:rank])
    R = one.R / norms
    left, free = one.z - R @ values, R @ Vt[rank:].T
    own, spread, _ = np.linalg.svd(free, full_matrices=False)
    fitted = int(np.sum(spread > RANK_TOLERANCE * np.linalg.norm(R, 2)))
    left = left - own[:, :fitted] @ (own[:, :fitted].T @ left)
    return float(np.hypot(np.linalg.norm(left), one.residual_norm) / np.sqrt(precision * one.rows)), fitted
