"""Has the machine changed? The whole series judged anew: a pure function of tests, baseline, rule and time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import hypot, inf, nan, sqrt

import numpy as np

from elastogeo.changes.causes import Cause, causes_of
from elastogeo.changes.change_points import ChangePoint, Since, change_point_of, since_baseline, weights_of_step
from elastogeo.changes.checks import checks_of
from elastogeo.changes.drifts import DRIFT, YEAR, Drift, Line, drift_of, line_of, shape_of, weights_of_ramp
from elastogeo.changes.priors import Prior
from elastogeo.changes.references import Reference, reference_of
from elastogeo.changes.replay import Replay, replay
from elastogeo.changes.result import ALARM, NO_BASELINE, STEADY, SUSPECT, WATCH, ChangeVerdict, IndicatorState
from elastogeo.changes.rules import Rule
from elastogeo.changes.series import Baseline, Flags, Series, Tolerance
from elastogeo.estimate import coverage_factor
from elastogeo.machine import Array


def judge(
    series: Series,
    baseline: Baseline | None,
    prior: Prior | None = None,
    rule: Rule | None = None,
    now: float = inf,
    tolerances: Mapping[str, Tolerance] | None = None,
) -> ChangeVerdict:
    """Whether a machine has changed, by one series of its tests.

    Parameters
    ----------
    series : Series
        n tests, q indicators.
    baseline : Baseline or None
        None: nothing is judged.
    prior : Prior, optional
        Scatter that a fleet expects; by default that of the kinds.
    rule : Rule, optional
    now : float [d]
        When it is judged: a suspect test without a repeat is an alarm once its waiting time is over. By default that time is
        over for all.
    tolerances : mapping of str to Tolerance, optional
        By indicator.

    Raises
    ------
    InputError
        If the baseline or a tolerance names what the series does not have.
    """
    rule, tolerances = rule or Rule(), dict(tolerances or {})
    if baseline is None:
        return _without_baseline(series, rule, now, tolerances)
    relevance = {name: given.relevance for name, given in tolerances.items() if given.relevance is not None}
    reference = reference_of(series, baseline, prior, relevance)
    found = replay(series, baseline, reference, rule, now)
    since = since_baseline(series, baseline, reference, found.stands)
    indicators = tuple(
        _indicator(series, since, rule, found, k, tolerances.get(name, Tolerance()))
        for k, name in enumerate(series.indicators)
    )
    waiting = series.tests[found.asked] if found.state == SUSPECT else ""
    together = [_weights(since, k, one.shape) for k, one in enumerate(indicators) if one.state == ALARM]
    shown = np.logical_or.reduce(np.isfinite(since.departure[:, found.alarm != 0]), axis=1)
    point = change_point_of(since, together, _latest(found, found.alarm != 0), shown)
    causes, cannot_tell = ((), ()) if point is None else _causes(series, since, found, point)
    return ChangeVerdict(
        series=series,
        baseline=baseline,
        alpha=rule.alpha,
        now=now,
        state=_state(found, reference, indicators),
        since=found.since if reference.count.any() else None,
        waiting=waiting,
        repeat_by=float(series.date[found.asked]) + rule.wait if waiting else None,
        steps=tuple(found.steps),
        not_judged=found.not_judged,
        indicators=indicators,
        change_point=point,
        causes=causes,
        cannot_tell=cannot_tell,
        verdict=checks_of(series, baseline, prior, rule, since, found, indicators, point, causes),
    )


def _without_baseline(series: Series, rule: Rule, now: float, tolerances: Mapping[str, Tolerance]) -> ChangeVerdict:
    """All that is known without a baseline: the last values."""
    n, q = series.value.shape
    none, zero = np.full(q, nan), np.zeros(q)
    reference = Reference(none, none, none, zero, none, zero, none, np.full(q, inf), zero)
    found = Replay.before(n, q, NO_BASELINE, nan, {})
    found.stands = ~series.aside & np.isfinite(series.value).any(axis=1)
    since = Since((), np.zeros(0), nan, np.zeros((0, q)), np.zeros((0, q)), reference)
    indicators = tuple(
        _indicator(series, since, rule, found, k, tolerances.get(name, Tolerance()))
        for k, name in enumerate(series.indicators)
    )
    return ChangeVerdict(series, None, rule.alpha, now, NO_BASELINE, None, "", None, (), {}, indicators, None, (), (), ())


def _state(found: Replay, reference: Reference, indicators: Sequence[IndicatorState]) -> str:
    """Of the series: a steady one that drifts is watched."""
    if not reference.count.any():
        return NO_BASELINE
    drifts = found.state == STEADY and any(one.state == WATCH and one.drift is not None for one in indicators)
    return WATCH if drifts else found.state


def _causes(
    series: Series, since: Since, found: Replay, point: ChangePoint
) -> tuple[tuple[Cause, ...], tuple[tuple[str, ...], ...]]:
    """What the whole set of indicators points to, those that did not move among them."""
    if series.signatures is None:
        return (), ()
    known = since.reference
    first = since.tests.index(point.test)
    after = since.departure[first:]
    number = np.sum(np.isfinite(after), axis=0)
    warm = np.sum(np.where(np.isfinite(after), since.leverage[first:], 0.0), axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        change = np.nansum(after, axis=0) / number
        heavy = known.degrees_of_freedom / np.maximum(known.degrees_of_freedom - 2, 1.0)  # of Student's t: its variance
        deviation = known.deviation * np.sqrt(heavy * (1 / number + 1 / known.count + (warm / number) ** 2))
    changed = [name for name, side in zip(series.indicators, found.alarm, strict=True) if side]
    return causes_of(change, deviation, series.signatures, series.indicators, changed)


def _latest(found: Replay, chosen: Flags) -> int:
    """The latest test that may be the first changed one of the chosen indicators, counted among those that stand; or -1."""
    joined = found.joined[chosen]
    if not len(joined):
        return -1
    at = np.flatnonzero(found.stands)
    return min(int(np.searchsorted(at, joined.min())), len(at) - 1)


def _indicator(series: Series, since: Since, rule: Rule, found: Replay, k: int, tolerance: Tolerance) -> IndicatorState:
    reference = since.reference
    shown = np.flatnonzero(found.stands & np.isfinite(series.value[:, k]))
    last = int(shown[-1]) if len(shown) else -1
    limit = _limit(reference, rule, k)
    expected, width = _expected(series, reference, k)
    plain = IndicatorState(
        name=series.indicators[k],
        kind=series.kinds[k],
        now=float(series.value[last, k]) if last >= 0 else nan,
        standard_uncertainty=float(series.standard_uncertainty[last, k]) if last >= 0 else nan,
        mean=float(reference.mean[k]),
        deviation=float(reference.deviation[k]),
        degrees_of_freedom=float(reference.degrees_of_freedom[k]),
        limit=limit,
        relevance=float(reference.relevance[k]),
        lower=-inf if tolerance.lower is None else tolerance.lower,
        upper=inf if tolerance.upper is None else tolerance.upper,
        single=found.single[:, k],
        running=found.running[:, k],
        running_mean=found.running_mean[:, k],
        expected=np.column_stack([expected - limit * width, expected + limit * width]),
        change=nan,
        change_interval=(nan, nan),
        state=_state_of(since, rule, found, k),
    )
    if plain.state == ALARM:
        return _changed(plain, since, found, k)
    change, half = _by_running_mean(reference, found, k)
    plain = replace(plain, change=change, change_interval=(change - half, change + half))
    return _drifting(plain, since, k) if plain.state == STEADY else plain


def _limit(reference: Reference, rule: Rule, k: int) -> float:
    number = np.array([np.sum(np.isfinite(reference.mean))])
    return float(rule.limit(reference.degrees_of_freedom[[k]], number)[0])


def _state_of(since: Since, rule: Rule, found: Replay, k: int) -> str:
    """Of one indicator, drifts aside."""
    count = since.reference.count[k]
    if not count:
        return NO_BASELINE
    if found.alarm[k]:
        return ALARM
    if found.state == SUSPECT and found.suspect[k]:
        return SUSPECT
    return STEADY if count >= rule.least_baseline else WATCH


def _expected(series: Series, reference: Reference, k: int) -> tuple[Array, Array]:
    """Of each test by the reference at its temperature, and the standard deviation of one such test, shape (n,)."""
    warm = series.temperature - reference.temperature[k]
    off = np.where(np.isfinite(warm) & (reference.slope[k] != 0), warm, 0.0)
    unknown = np.where(np.isfinite(warm), 0.0, reference.unknown[k])
    with np.errstate(invalid="ignore", divide="ignore"):
        own = 1 + (unknown / reference.deviation[k]) ** 2 + 1 / reference.count[k] + off**2 / reference.spread[k]
        return reference.mean[k] + reference.slope[k] * off, reference.deviation[k] * np.sqrt(own)


def _by_running_mean(reference: Reference, found: Replay, k: int) -> tuple[float, float]:
    """How far the running mean is off, with half the width of its 95 % interval; NaN before the first test."""
    total, weight, scatter, warmth = (float(one) for one in found.sums[:, k])
    if not weight > 0:
        return nan, nan
    variance = scatter + weight**2 / float(reference.count[k]) + warmth**2 / float(reference.spread[k])
    factor = float(coverage_factor(reference.degrees_of_freedom[[k]])[0])
    return total / weight, factor * float(reference.deviation[k]) * sqrt(variance) / weight


def _changed(plain: IndicatorState, since: Since, found: Replay, k: int) -> IndicatorState:
    """An indicator in alarm: since when, by how much, step or drift, how fast."""
    latest = _latest(found, np.arange(len(found.alarm)) == k)
    shape = shape_of(since, k, latest) if latest >= 0 else ""
    shown = np.isfinite(since.departure[:, k])
    point = change_point_of(since, [_weights(since, k, shape)], latest, shown)
    if point is None:
        return plain
    first = since.tests.index(point.test)
    after = first + np.flatnonzero(shown[first:])
    departure, leverage = since.departure[after, k], since.leverage[after, k]
    change, own = float(departure.mean()), plain.deviation * hypot(1 / sqrt(len(after)), float(leverage.mean()))
    line = line_of(since.date[after], departure, plain.deviation, plain.degrees_of_freedom, leverage)
    drift = None
    if shape == DRIFT and line is not None and abs(line.t) > line.factor and line.slope * found.alarm[k] > 0:
        drift = _drift(plain, line, since, k)
        change, own = line.at(line.last)
    half = float(coverage_factor(np.array([plain.degrees_of_freedom]))[0]) * hypot(own, _of_mean(plain, since, k))
    return replace(
        plain, change=change, change_interval=(change - half, change + half), change_point=point, drift=drift, shape=shape
    )


def _weights(since: Since, k: int, shape: str) -> Array:
    return weights_of_ramp(since, k) if shape == DRIFT else weights_of_step(since, k)


def _drifting(plain: IndicatorState, since: Since, k: int) -> IndicatorState:
    """An indicator within its limits: watched if it runs into one within a year."""
    line = line_of(since.date, since.departure[:, k], plain.deviation, plain.degrees_of_freedom, since.leverage[:, k])
    if line is None or abs(line.t) <= plain.limit:
        return plain
    drift = _drift(plain, line, since, k)
    soon = drift.limit_at is None or drift.limit_at <= drift.end + YEAR
    return replace(plain, state=WATCH, drift=drift) if soon else plain


def _drift(plain: IndicatorState, line: Line, since: Since, k: int) -> Drift:
    return drift_of(line, plain.mean, _of_mean(plain, since, k), plain.relevance, plain.lower, plain.upper)


def _of_mean(plain: IndicatorState, since: Since, k: int) -> float:
    """Standard deviation of the mean of the baseline."""
    return plain.deviation / sqrt(float(since.reference.count[k]))
