"""Whether the tests of a campaign agree; if not, which test, level or run does not.

What a test says and what all others say are two estimates. Where both determine a combination of the parameters they can
differ, and the sum of squares that the joint fit leaves over beyond that of the two fits is the square of the difference in
its own covariance (Chow, doi:10.2307/1910133). It is held against what runs scatter within tests, so that a test that
contradicts the others is not thought to be noise, and against the stated influences that the tests do not share.

A test that is wrong makes others disagree too. So the one is named whose removal makes the rest agree, not every test that
disagrees because of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from scipy.special import fdtrc

from elastogeo.estimate import RANK_TOLERANCE, Array, Solution, select
from elastogeo.identification.budget import moments_moved
from elastogeo.identification.check import Check
from elastogeo.identification.influences import Effect
from elastogeo.identification.systems import Systems, merged

TESTS_AGREE = "tests agree"

LEVEL = 0.05
"""Probability, where all tests agree, with which one is said not to: for all tests together (Holm)."""

_KNOWN = 1e9
"""Degrees of freedom of what is known: the F-distribution wants a number."""

_ROUNDING = 1e-12
"""Share of the readings that is their rounding error at most: less scatter than that is none."""


@dataclass(frozen=True, slots=True)
class AgainstOthers:
    """One test against all others.

    Attributes
    ----------
    directions : int
        How many combinations of the parameters it determines that the others determine too.
    statistic : float or None
        Mean square of the differences in these, in their variance: F-distributed with `directions` and
        `degrees_of_freedom` if the tests agree. None where they share nothing, or no runs show how runs scatter.
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
    statistic: float | None
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
        Those without which the others agree, each alone; where none is such, the one whose removal takes off most of the
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


@dataclass(frozen=True, slots=True)
class _Seen:
    """What some runs see: as many independent numbers of unit variance as their columns have rank.

    `design` (k, r), `seen` (k,) and `moved` (effects, k): what one standard uncertainty of each effect adds to them.
    """

    design: Array
    seen: Array
    moved: Array


_Part = tuple[float, str, _Seen]
"""Of a test: level, name and what is seen of one run."""

_Tests = Mapping[str, Sequence[_Part]]


@dataclass(frozen=True, slots=True)
class _Scatter:
    """Sum of squares of what runs see about the fit of their own test, over the variance of readings; its freedom."""

    square: float
    freedom: int
    least: float = 0.0

    @property
    def variance(self) -> float:
        return max(self.square / self.freedom, self.least) if self.freedom else np.nan


@dataclass(frozen=True, slots=True)
class _Compared:
    """Two parts against one another, as in `AgainstOthers`; the p-value is not adjusted."""

    directions: int
    statistic: float | None
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


def tests_agreement(systems: Systems, solution: Solution, effects: Sequence[Effect]) -> TestsAgreement | None:
    """Whether the tests agree; None of one test.

    Two looks share the level, each with Holm's adjustment: at every test, against what runs scatter within tests; and at
    every force level of a test, against what the other runs scatter, since a level that is wrong is scatter of its test.

    Parameters
    ----------
    systems : Systems
    solution : Solution
        From all tests.
    effects : sequence of Effect
        Systematic influences. What all tests share alike moves no difference between them.
    """
    if len(systems.tests) < 2:
        return None
    seen = _seen_by_run(systems, solution, effects)
    pairs = list(zip(systems.runs, seen, strict=True))
    tests = {name: [(run.force, run.name, one) for run, one in pairs if run.test == name] for name in systems.tests}
    looks, scatter = _looks(tests), _scatter(tests)
    named, rest_agrees = _named(tests, looks.disagreeing) if looks.disagreeing else ((), True)
    level, run = _wrong_part(tests, named[0]) if len(named) == 1 and rest_agrees else (None, "")
    against = {}
    for name, one in looks.tests.items():
        rmse, fitted = _left_out(name, systems, solution)
        p_value = None if one.statistic is None else looks.p_values[name]
        against[name] = AgainstOthers(one.directions, one.statistic, one.degrees_of_freedom, p_value, rmse, fitted)
    return TestsAgreement(
        against=against,
        disagreeing=looks.disagreeing,
        named=named,
        rest_agrees=rest_agrees,
        level=level,
        run=run,
        scatter=float(np.sqrt(scatter.variance)) / _reading(systems),
        scatter_freedom=scatter.freedom,
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


def _seen_by_run(systems: Systems, solution: Solution, effects: Sequence[Effect]) -> list[_Seen]:
    factors = [select(run.factor, solution.labels) for run in systems.runs]
    norms = np.linalg.norm([factor.column_norms for factor in factors], axis=0)
    moved = moments_moved(systems, solution, effects)
    found = []
    for k, factor in enumerate(factors):
        U, sizes, Vt = np.linalg.svd(factor.R / norms)
        rank = _rank(sizes)
        design = sizes[:rank, np.newaxis] * Vt[:rank]
        found.append(_Seen(design, U[:, :rank].T @ factor.z, moved[:, k] @ Vt[:rank].T / sizes[:rank]))
    return found


def _joined(parts: Sequence[_Seen]) -> _Seen:
    """What some runs together see."""
    every = _stacked(parts)
    U, sizes, Vt = np.linalg.svd(every.design, full_matrices=False)
    rank = _rank(sizes)
    basis = U[:, :rank]
    return _Seen(sizes[:rank, np.newaxis] * Vt[:rank], basis.T @ every.seen, every.moved @ basis)


def _stacked(parts: Sequence[_Seen]) -> _Seen:
    return _Seen(
        np.vstack([part.design for part in parts]),
        np.concatenate([part.seen for part in parts]),
        np.concatenate([part.moved for part in parts], axis=1),
    )


def _contradictions(parts: Sequence[_Seen]) -> tuple[Array, Array]:
    """What the parts say against one another, shape (q,), of unit variance; and what the effects add, (effects, q)."""
    every = _stacked(parts)
    U, sizes, _ = np.linalg.svd(every.design)
    beyond = U[:, _rank(sizes) :]
    return beyond.T @ every.seen, every.moved @ beyond


def _rank(sizes: Array) -> int:
    return int(np.sum(sizes > RANK_TOLERANCE * sizes.max(initial=0.0)))


def _scatter(tests: _Tests) -> _Scatter:
    """How runs scatter about the fit of their own test, over all tests."""
    every = [_own_scatter(parts) for parts in tests.values()]
    return _Scatter(sum(one.square for one in every), sum(one.freedom for one in every), _rounding(tests))


def _own_scatter(parts: Sequence[_Part]) -> _Scatter:
    apart = _contradictions([seen for _, _, seen in parts])[0] if parts else np.zeros(0)
    return _Scatter(float(apart @ apart), len(apart))


def _rounding(tests: _Tests) -> float:
    every = [seen.seen for parts in tests.values() for _, _, seen in parts]
    return (_ROUNDING * float(np.linalg.norm(np.concatenate(every)))) ** 2


def _compared(parts: Sequence[_Seen], scatter: _Scatter) -> _Compared:
    """Whether parts agree, by F with the scatter of runs and the effects in the variance.

    Effects are known and scatter is estimated, so that the variance has the more degrees of freedom the more of it effects
    make (Satterthwaite).
    """
    apart, moved = _contradictions(parts)
    q = len(apart)
    if not q or not scatter.freedom:
        return _Compared(q, None, 0.0, 1.0)
    variance, directions = np.linalg.eigh(moved.T @ moved)
    total = np.maximum(variance, 0.0) + scatter.variance
    statistic = float(np.mean((directions.T @ apart) ** 2 / total))
    share = float(np.mean(scatter.variance / total))
    freedom = min(scatter.freedom / share**2, _KNOWN)
    return _Compared(q, statistic, freedom, float(fdtrc(q, freedom, statistic)))


def _looks(tests: _Tests) -> _Looks:
    """Every test against the others, and every level of a test of several against all else."""
    whole = {name: _joined([seen for _, _, seen in parts]) for name, parts in tests.items()}
    scatter = {name: _own_scatter(parts) for name, parts in tests.items()}
    square, freedom = sum(one.square for one in scatter.values()), sum(one.freedom for one in scatter.values())
    least, by_test, by_level = _rounding(tests), {}, {}
    for name, parts in tests.items():
        others = [one for other, one in whole.items() if other != name]
        rest = [_joined(others)] if others else []
        by_test[name] = _compared([whole[name], *rest], _Scatter(square, freedom, least))
        levels = sorted({force for force, _, _ in parts})
        for level in levels if len(levels) > 1 else ():
            kept = [part for part in parts if part[0] != level]
            left, own = _own_scatter(kept), scatter[name]
            about = _Scatter(square - own.square + left.square, freedom - own.freedom + left.freedom, least)
            alone = [seen for force, _, seen in parts if force == level]
            by_level[name, level] = _compared([_joined(alone), _joined([*rest, *(s for _, _, s in kept)])], about)
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


def _without(tests: _Tests, name: str) -> dict[str, Sequence[_Part]]:
    return {other: parts for other, parts in tests.items() if other != name}


def _named(tests: _Tests, disagreeing: Sequence[str]) -> tuple[tuple[str, ...], bool]:
    """The tests without which the others agree; if there is none, the one that takes most of the disagreement with it."""
    found = tuple(name for name in disagreeing if not _looks(_without(tests, name)).disagreeing)
    if found:
        return found, True
    return (min(disagreeing, key=lambda name: _disagreement(_without(tests, name))),), False


def _disagreement(tests: _Tests) -> float:
    """What all runs say against one another, as a sum of squares."""
    apart, _ = _contradictions([seen for parts in tests.values() for _, _, seen in parts])
    return float(apart @ apart)


def _wrong_part(tests: _Tests, name: str) -> tuple[float | None, str]:
    """The one level, and the one run, without which a test agrees with all others; None and empty if there is none."""
    own = tests[name]

    def agree_with(kept: Sequence[_Part]) -> bool:
        looks = _looks({**tests, name: kept})
        return bool(looks.tests[name].directions) and not looks.disagreeing

    levels, runs = sorted({force for force, _, _ in own}), [run for _, run, _ in own]
    if len(runs) < 2:
        return None, ""
    wrong = [run for run in runs if agree_with([part for part in own if part[1] != run])]
    if len(levels) < 2:
        return None, wrong[0] if len(wrong) == 1 else ""
    off = [level for level in levels if agree_with([part for part in own if part[0] != level])]
    return (off[0] if len(off) == 1 else None), (wrong[0] if len(wrong) == 1 else "")


def _left_out(name: str, systems: Systems, solution: Solution) -> tuple[float, int]:
    """RMSE of the readings of a test against the prediction from all others, and how much had to be fitted to it."""
    labels = solution.labels
    one = select(merged([run for run in systems.runs if run.test == name]), labels)
    rest = select(merged([run for run in systems.runs if run.test != name]), labels)
    norms = np.hypot(one.column_norms, rest.column_norms)
    U, sizes, Vt = np.linalg.svd(rest.R / norms)
    rank = _rank(sizes)
    values = Vt[:rank].T @ (U[:, :rank].T @ rest.z / sizes[:rank])
    R = one.R / norms
    left, free = one.z - R @ values, R @ Vt[rank:].T
    own, spread, _ = np.linalg.svd(free, full_matrices=False)
    fitted = int(np.sum(spread > RANK_TOLERANCE * np.linalg.norm(R, 2)))
    left = left - own[:, :fitted] @ (own[:, :fitted].T @ left)
    precision = next(run.precision for run in systems.runs if run.test == name)
    return float(np.hypot(np.linalg.norm(left), one.residual_norm) / np.sqrt(precision * one.rows)), fitted
