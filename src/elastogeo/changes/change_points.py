"""Since when: the change point, by the likelihood of one change after the baseline. It never says whether."""

from __future__ import annotations

from collections.abc import Iterable
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
    leverage : array, shape (n, q)
        Of the temperature: standard deviation of what is expected at it, by the slope alone, in those between tests. It has
        the sign of warmer, for the slope is one and the same in all tests.
    reference : Reference
    """

    tests: tuple[str, ...]
    date: Array
    before: float
    departure: Array
    leverage: Array
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
    cleared = [end for end in baseline.cleared if len(at) and end <= series.date[at[0]]]
    return Since(
        tests=tuple(series.tests[i] for i in at),
        date=series.date[at],
        before=max([max(dates, default=baseline.since), *cleared]),
        departure=series.value[at] - reference.mean - reference.slope * off,
        leverage=off / np.sqrt(reference.spread),
        reference=reference,
    )


def change_point_of(since: Since, weights: Iterable[Array], latest: int, shown: Flags) -> ChangePoint | None:
    """Since when indicators changed, together.

    Parameters
    ----------
    since : Since
    weights : iterable of array, shape (n,)
        Of each of these indicators, `weights_of_step`, or `weights_of_ramp` where it drifts.
    latest : int
        The latest test that may be the first changed one: that of the alarm.
    shown : array of bool, shape (n,)
        The tests that determine one of these indicators at least: no other can be the first to show a change, or the last
        not to.

    Returns
    -------
    ChangePoint or None
        None if no test stands, or there is no indicator.
    """
    every = list(weights)
    may = np.flatnonzero(shown[: latest + 1])
    if not every or not len(may):
        return None
    weight = np.sum(every, axis=0)[may]
    before = np.append(min(since.before, float(since.date[may[0]])), since.date[may[:-1]])
    share = np.exp(weight - weight.max())
    share /= share.sum()
    order = np.argsort(-share, kind="stable")
    many = int(np.searchsorted(np.cumsum(share[order]), COVERAGE)) + 1
    kept = np.sort(order[:many])
    best = int(order[0])
    return ChangePoint(
        test=since.tests[may[best]],
        date=float(since.date[may[best]]),
        last_before=float(before[best]),
        interval=(float(before[kept[0]]), float(since.date[may[kept[-1]]])),
        tests=tuple(since.tests[k] for k in may[kept]),
    )


def weights_of_step(since: Since, c: int) -> Array:
    """Log of the probability that the mean of an indicator stepped at each of n tests, up to a constant, shape (n,).

    The means before and after are unknown, the scatter is that of the reference with its degrees of freedom.
    """
    known = since.reference
    departure, count = since.departure[:, c], float(known.count[c])
    left, n_after = squares_of_step(departure, count)
    before = count + float(np.sum(np.isfinite(departure))) - n_after
    unknown = (np.log(np.maximum(n_after, 1)) + np.log(before)) / 2
    return np.where(n_after > 0, likelihood(since, c, left) - unknown, -np.inf)


def likelihood(since: Since, c: int, left: Array) -> Array:
    """Log-likelihood of sums of squares that are left of an indicator, up to a constant: Student's, as the scatter is."""
    freedom, deviation = float(since.reference.degrees_of_freedom[c]), float(since.reference.deviation[c])
    number = float(np.sum(np.isfinite(since.departure[:, c])))
    return np.asarray(-(freedom + number) / 2 * np.log1p(left / (freedom * deviation**2)))


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
