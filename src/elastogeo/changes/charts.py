"""Two charts of each indicator, one step a test: this test by itself, and the running mean of the tests so far.

All is closed form over arrays (..., q): one series, or thousands of machines at once, run the same lines. Small samples are
exact: mean and slope of the baseline count with their own uncertainty, in this test and in the running mean.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from elastogeo.changes.references import Reference
from elastogeo.changes.rules import Rule
from elastogeo.equality import ByValue
from elastogeo.machine import Array

Sides = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
Marks = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]


@dataclass(frozen=True, slots=True, eq=False)
class Running(ByValue):
    """The running mean of deviations from the reference, and what its variance is made of: sums over tests with weights w.

    Attributes
    ----------
    mean : array, shape (..., q)
        Sum of w (value - expected).
    weight : array, shape (..., q)
        Sum of w: 1 - (1 - smoothing)^t after t tests.
    scatter : array, shape (..., q)
        Sum of w^2, each test with its own variance in units of that between tests.
    warmth : array, shape (..., q) [K]
        Sum of w (temperature - that of the baseline).
    """

    mean: Array
    weight: Array
    scatter: Array
    warmth: Array


@dataclass(frozen=True, slots=True, eq=False)
class Charts(ByValue):
    """Where the charts stand after a test.

    Attributes
    ----------
    running : Running
    before : Running
        Without the last test: a repeat takes its place.
    suspect : array of int, shape (..., q)
        Side, 1 or -1, on which an indicator is suspect until a repeat answers; 0 where it is not.
    """

    running: Running
    before: Running
    suspect: Sides


@dataclass(frozen=True, slots=True, eq=False)
class Judged(ByValue):
    """What the charts say of one test. NaN where it does not determine an indicator.

    Attributes
    ----------
    expected : array, shape (..., q)
        By the reference, at the test's temperature.
    deviation : array, shape (..., q)
        Standard deviation of one such test about it, the reference's own uncertainty included.
    single, running : array, shape (..., q)
        T of this test and of the running mean: deviation over its standard deviation.
    limit : array, shape (..., q)
        Of both.
    over : array of int, shape (..., q)
        Side on which it is beyond the limit, in either chart, by as much as matters; 0 where it is not.
    near : array of int, shape (2, ..., q)
        The same of each chart with the share of limit and relevance that confirms.
    confirmed : array of bool, shape (..., q)
        Whether the test confirms what was suspect before it.
    """

    expected: Array
    deviation: Array
    single: Array
    running: Array
    limit: Array
    over: Sides
    near: Sides
    confirmed: Marks

    @property
    def ratio(self) -> Array:
        """Greatest |T| of both charts over the limit, shape (..., q); 0 where the test does not determine an indicator."""
        with np.errstate(invalid="ignore"):
            return np.nan_to_num(np.maximum(np.abs(self.single), np.abs(self.running)) / self.limit)


def start(reference: Reference) -> Charts:
    """Charts before the first test."""
    nothing = np.zeros(reference.mean.shape)
    empty = Running(nothing, nothing, nothing, nothing)
    return Charts(empty, empty, np.zeros(nothing.shape, dtype=np.int8))


def step(
    charts: Charts,
    reference: Reference,
    rule: Rule,
    value: Array,
    temperature: Array | float = np.nan,
    standard_uncertainty: Array | float = np.nan,
    answers: Marks | bool = False,
) -> tuple[Charts, Judged]:
    """Judge one test of each machine.

    Parameters
    ----------
    charts : Charts
    reference : Reference
    rule : Rule
    value : array, shape (..., q)
        NaN where the test does not determine an indicator: it is not judged, its running mean stays.
    temperature : float or array, shape (...) [degC]
        NaN where it is not known: the test may then be off by what the baseline's temperatures did.
    standard_uncertainty : float or array, shape (..., q)
        By this test; it counts where it is greater than the scatter between tests.
    answers : bool or array of bool, shape (...)
        Whether the test repeats the one before it because that was suspect. It takes its place in the running mean.

    Returns
    -------
    charts : Charts
        After the test. Suspect is what is beyond the limit, and what was suspect and the repeat did not determine. **What a
        repeat confirmed is not suspect any more**: it is an alarm, and `Judged.confirmed` says so once.
    judged : Judged
    """
    here = np.isfinite(value) & np.isfinite(reference.mean)
    again = np.asarray(answers)[..., np.newaxis]
    repeat = here & again
    before = _choose(again, charts.before, charts.running)
    off, scatter = warmth_and_scatter(reference, temperature, standard_uncertainty)
    departure = value - reference.mean - reference.slope * off
    running = _choose(here, _blend(before, rule.smoothing, departure, scatter, off), charts.running)
    judged = read_charts(running, reference, rule, value, temperature, standard_uncertainty)
    confirmed = repeat & confirms(judged, charts.suspect)
    waiting = np.where(repeat, 0, charts.suspect)
    suspect = np.where(confirmed, 0, np.where(judged.over != 0, judged.over, waiting)).astype(np.int8)
    return Charts(running, before, suspect), replace(judged, confirmed=confirmed)


def read_charts(
    running: Running,
    reference: Reference,
    rule: Rule,
    value: Array,
    temperature: Array | float = np.nan,
    standard_uncertainty: Array | float = np.nan,
) -> Judged:
    """What both charts say of tests whose running means are known, whatever was suspect: nothing is confirmed here.

    Parameters
    ----------
    running : Running
        After each test.
    reference, rule, value, temperature, standard_uncertainty
        As in `step`.
    """
    here = np.isfinite(value) & np.isfinite(reference.mean)
    off, scatter = warmth_and_scatter(reference, temperature, standard_uncertainty)
    expected = reference.mean + reference.slope * off
    s, number = reference.deviation, np.sum(here, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        one = s * np.sqrt(scatter + 1 / reference.count + off**2 / reference.spread)
        mean = s * np.sqrt(running.scatter + running.weight**2 / reference.count + running.warmth**2 / reference.spread)
        single = np.where(here, (value - expected) / one, np.nan)
        smooth = np.where(here, running.mean / mean, np.nan)
        limit = np.where(here, rule.limit(reference.degrees_of_freedom, number), np.nan)
        change = (value - expected, running.mean / running.weight)
    over = _side(single, change[0], limit, reference.relevance)
    over = np.where(over == 0, _side(smooth, change[1], limit, reference.relevance), over)
    over = np.where(reference.count >= rule.least_baseline, over, 0).astype(np.int8)
    least = rule.confirm * limit, rule.confirm * reference.relevance
    near = np.stack([_side(t, by, *least) for t, by in ((single, change[0]), (smooth, change[1]))])
    return Judged(expected, one, single, smooth, limit, over, near, np.zeros(over.shape, dtype=bool))


def confirms(judged: Judged, suspect: Sides) -> Marks:
    """Whether a test that repeats a suspect one is on its side, by the share of the limit that confirms, shape (..., q)."""
    return np.asarray((suspect != 0) & np.any(judged.near == suspect, axis=0))


def warmth_and_scatter(
    reference: Reference, temperature: Array | float, standard_uncertainty: Array | float
) -> tuple[Array, Array]:
    """Of tests how much warmer [K] than the baseline, and the variance of each in units of that between tests."""
    warm = np.asarray(temperature, dtype=float)[..., np.newaxis] - reference.temperature
    return np.where(np.isfinite(warm), warm, 0.0), _own_scatter(reference, warm, standard_uncertainty)


def _choose(where: Marks, one: Running, other: Running) -> Running:
    return Running(
        np.where(where, one.mean, other.mean),
        np.where(where, one.weight, other.weight),
        np.where(where, one.scatter, other.scatter),
        np.where(where, one.warmth, other.warmth),
    )


def _blend(before: Running, share: float, deviation: Array, scatter: Array, off: Array) -> Running:
    """One test more, each sum with its weights."""
    old = 1 - share
    return Running(
        old * before.mean + share * deviation,
        old * before.weight + share,
        old**2 * before.scatter + share**2 * scatter,
        old * before.warmth + share * off,
    )


def _own_scatter(reference: Reference, warm: Array, standard_uncertainty: Array | float) -> Array:
    """Variance of this test in units of that between tests: 1, or its own u^2, and what its temperature may have done."""
    u = np.where(np.isfinite(standard_uncertainty), standard_uncertainty, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        own = np.maximum((u / reference.deviation) ** 2, 1.0)
        return own + np.where(np.isfinite(warm), 0.0, (reference.unknown / reference.deviation) ** 2)


def _side(t: Array, change: Array, limit: Array, relevance: Array) -> Sides:
    """Of what is beyond the limit by as much as matters."""
    with np.errstate(invalid="ignore"):
        beyond = (np.abs(t) > limit) & (np.abs(change) >= relevance)
    return np.where(beyond, np.sign(t), 0).astype(np.int8)
