"""Since when: the change point, by the likelihood of one step in the mean after the baseline. It never says whether."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.changes.references import Reference
from elastogeo.changes.series import Baseline, Flags, Series
from elastogeo.machine import Array
from elastogeo.result import Part

COVERAGE = 0.95


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ChangePoint(Part):
    """The first test after a change, as the likelihood has it, and those it may be as well.

    Attributes
    ----------
    test : str
        The likeliest first changed test.
    date : float [d]
        Of it.
    last_before : float [d]
        Date of the last test before it: the change lies between both.
    interval : tuple of 2 float [d]
        Between which dates it lies with 95 %: of the last test before the earliest that may be the first changed one, and of
        the latest that may be it.
    tests : tuple of str
        All that may be the first changed one.
    """

    test: str
    date: float
    last_before: float
    interval: tuple[float, float]
    tests: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Since:
    """The n tests that stand since the baseline, as they depart from it.

    Attributes
    ----------
    tests : tuple of str, length n
    date : array, shape (n,) [d]
    before : float [d]
        Date of the last test that is not among them: of the baseline, or when an alarm was closed as false.
    departure : array, shape (n, q)
        Less what the reference expects; NaN where a test does not determine an indicator.
    reference : Reference
    """

    tests: tuple[str, ...]
    date: Array
    before: float
    departure: Array
    reference: Reference

    def last_before(self, k: int) -> float:
        """Date of the last test before the k-th."""
        return float(self.date[k - 1]) if k else min(self.before, float(self.date[0]))


def since_baseline(series: Series, baseline: Baseline, reference: Reference, stands: Flags) -> Since:
    """What has been measured since the baseline."""
    at = np.flatnonzero(stands)
    warm = series.temperature[at, np.newaxis] - reference.temperature
    off = np.where(np.isfinite(warm) & (reference.slope != 0), warm, 0.0)
    own = set(baseline.tests)
    dates = [float(date) for test, date in zip(series.tests, series.date, strict=True) if test in own]
    return Since(
        tests=tuple(series.tests[i] for i in at),
        date=series.date[at],
        before=max(dates, default=baseline.since),
        departure=series.value[at] - reference.mean - reference.slope * off,
        reference=reference,
    )


def change_point_of(since: Since, chosen: Flags, latest: int) -> ChangePoint | None:
    """Where the mean of the chosen indicators stepped, together.

    Parameters
    ----------
    since : Since
    chosen : array of bool, shape (q,)
    latest : int
        The latest test that may be the first changed one: that of the alarm.

    Returns
    -------
    ChangePoint or None
        None if no test stands, or none is chosen.
    """
    if not len(since.tests) or not chosen.any() or latest < 0:
        return None
    weight = sum((_of_step(*one) for one in _chosen(since, chosen)), np.zeros(len(since.tests)))[: latest + 1]
    share = np.exp(weight - weight.max())
    share /= share.sum()
    order = np.argsort(-share, kind="stable")
    many = int(np.searchsorted(np.cumsum(share[order]), COVERAGE)) + 1
    kept = np.sort(order[:many])
    best = int(order[0])
    return ChangePoint(
        test=since.tests[best],
        date=float(since.date[best]),
        last_before=since.last_before(best),
        interval=(since.last_before(int(kept[0])), float(since.date[kept[-1]])),
        tests=tuple(since.tests[k] for k in kept),
    )


def _chosen(since: Since, chosen: Flags) -> Iterator[tuple[Array, float, float, float]]:
    """Of each chosen indicator its departures, tests of the baseline, deviation and degrees of freedom."""
    known = since.reference
    for c in np.flatnonzero(chosen):
        yield since.departure[:, c], float(known.count[c]), float(known.deviation[c]), float(known.degrees_of_freedom[c])


def squares_of_step(departure: Array, count: float) -> tuple[Array, Array]:
    """Of a step at each of n tests: the sum of squares that is left, and how many tests follow it.

    Parameters
    ----------
    departure : array, shape (n,)
        From the mean of a baseline; NaN where there is none.
    count : float
        Tests of the baseline, whose mean counts as so many.
    """
    shown = np.isfinite(departure)
    d = np.where(shown, departure, 0.0)
    number, total, square = (np.concatenate([[0.0], np.cumsum(one)]) for one in (shown.astype(float), d, d**2))
    n_after, sum_after = number[-1] - number[:-1], total[-1] - total[:-1]
    left = square[-1] - total[:-1] ** 2 / (count + number[:-1])
    return left - np.divide(sum_after**2, n_after, out=np.zeros_like(left), where=n_after > 0), n_after


def _of_step(departure: Array, count: float, deviation: float, freedom: float) -> Array:
    """Log of the probability that each test is the first changed one, means before and after unknown, up to a constant."""
    left, n_after = squares_of_step(departure, count)
    number = float(np.sum(np.isfinite(departure)))
    scale = -(freedom + number) / 2 * np.log1p(left / (freedom * deviation**2))
    before = count + number - n_after
    return np.where(n_after > 0, scale - (np.log(np.maximum(n_after, 1)) + np.log(before)) / 2, -np.inf)
