"""The checks of a verdict on a series: whether it changed, and whether there is ground to say so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isfinite

import numpy as np
from scipy.special import fdtrc, ndtri, stdtrit

from elastogeo.changes.causes import Cause
from elastogeo.changes.change_points import ChangePoint, Since
from elastogeo.changes.drifts import YEAR
from elastogeo.changes.priors import Prior, default_prior
from elastogeo.changes.references import Reference
from elastogeo.changes.replay import Replay
from elastogeo.changes.result import ALARM, CONFIRMED, SUSPECT, IndicatorState
from elastogeo.changes.rules import Rule
from elastogeo.changes.series import Baseline, Series
from elastogeo.identification import Check
from elastogeo.machine import Array

UNCHANGED = "machine unchanged"
EXPLAINED = "change explained by one component"
TOLERATED = "within tolerance"
LONG_ENOUGH = "baseline long enough"
STEADY_BASELINE = "baseline steady"
EXPECTED_SCATTER = "scatter as expected"
TEMPERATURE = "temperature known"
INDEPENDENT = "tests independent"

SURE = 0.01
"""Probability of a false alarm of a check, all indicators together."""

FEWEST = 4
"""Tests of a baseline from which it has a trend."""

_KNOWN = 1e9
"""Degrees of freedom of a scatter that is known."""

FEWEST_PAIRS = 8
"""Pairs of successive tests from which they are told to depend on one another."""


def checks_of(
    series: Series,
    baseline: Baseline,
    prior: Prior | None,
    rule: Rule,
    since: Since,
    found: Replay,
    indicators: Sequence[IndicatorState],
    point: ChangePoint | None,
    causes: Sequence[Cause],
) -> tuple[Check, ...]:
    """All checks of a series that has a baseline; what does not apply is left out."""
    reference = since.reference
    made_of = set(baseline.tests)
    own = [k for k, test in enumerate(series.tests) if test in made_of and not series.aside[k]]
    expected = _known(prior, default_prior(series.kinds, reference.mean))
    departure = series.value - reference.mean - reference.slope * _warmth(series, reference)
    every = (
        _unchanged(found, reference, rule, indicators),
        *_confirmed(found, indicators, series, causes),
        *_tolerated(indicators),
        _long_enough(reference, rule, series.indicators),
        _steady(series.date[own], departure[own], expected, series.indicators),
        _expected(departure[own], reference, expected, series),
        _temperature(series, own, found, reference),
        _independent(series, own, departure, since, point),
    )
    return tuple(every)


def _known(prior: Prior | None, stated: Prior) -> Prior:
    """What a fleet expects, and what is stated of the kinds that it says nothing of."""
    if prior is None:
        return stated
    freedom, deviation = np.broadcast_arrays(prior.degrees_of_freedom, prior.deviation)
    return Prior(
        np.where(np.isfinite(freedom), freedom, stated.degrees_of_freedom),
        np.where(np.isfinite(deviation), deviation, stated.deviation),
    )


def _warmth(series: Series, reference: Reference) -> Array:
    warm = series.temperature[:, np.newaxis] - reference.temperature
    return np.where(np.isfinite(warm) & (reference.slope != 0), warm, 0.0)


def _unchanged(found: Replay, reference: Reference, rule: Rule, indicators: Sequence[IndicatorState]) -> Check:
    tests = int(np.sum(found.stands))
    judged = bool(tests) and bool(np.any(reference.count >= rule.least_baseline))
    passed = None if not judged or found.state == SUSPECT else found.state != ALARM
    changed = tuple(one.name for one in indicators if one.state == ALARM)
    facts = {"state": found.state, "tests": tests, "indicators": len(indicators), "changed": changed}
    return Check(UNCHANGED, passed, {**facts, "alpha": rule.alpha})


def _confirmed(
    found: Replay, indicators: Sequence[IndicatorState], series: Series, causes: Sequence[Cause]
) -> Iterator[Check]:
    """Of an alarm alone."""
    if found.state != ALARM:
        return
    yield Check(CONFIRMED, bool(found.confirmed), {"since": found.since})
    known = series.signatures is not None
    named = tuple(cause.component for cause in causes)
    changed = [one.name for one in indicators if one.state == ALARM]
    left = tuple(name for name in changed if causes and name in causes[0].against)
    facts = {"components": named, "left": left, "signatures": known}
    yield Check(EXPLAINED, bool(named) and not left if known else None, facts)


def _tolerated(indicators: Sequence[IndicatorState]) -> Iterator[Check]:
    """Where a person has set a tolerance: whether what the machine is now, by its running mean, lies in it."""
    asked = [one for one in indicators if isfinite(one.lower) or isfinite(one.upper)]
    if not asked:
        return
    now = {one.name: one.mean + one.change for one in asked}
    known = [one for one in asked if isfinite(now[one.name])]
    beyond = {one.name: now[one.name] for one in known if not one.lower <= now[one.name] <= one.upper}
    rest = tuple(one.name for one in asked if one not in known)
    told = tuple(one.name for one in known)
    facts = {"asked": told, "unknown": rest, "beyond": beyond, "units": {one.name: one.kind.unit for one in asked}}
    yield Check(TOLERATED, not beyond if known else None, facts)


def _long_enough(reference: Reference, rule: Rule, names: Sequence[str]) -> Check:
    """Of every indicator that the baseline determines: those that it determines too seldom are only watched."""
    tests = int(min(reference.count[reference.count > 0], default=0))
    few = tuple(name for name, count in zip(names, reference.count, strict=True) if 0 < count < rule.least_baseline)
    some = np.any(reference.count >= rule.least_baseline)
    facts = {"tests": tests, "least": rule.least_baseline, "watched": few if some else ()}
    return Check(LONG_ENOUGH, tests >= rule.least_baseline, facts, decisive=True)


def _steady(date: Array, departure: Array, prior: Prior, names: Sequence[str]) -> Check:
    """Whether the tests of the baseline have no trend: else a change was going on while it was made."""
    trends: dict[str, float] = {}
    tried = 0
    freedoms, deviations = (np.broadcast_to(one, len(names)) for one in (prior.degrees_of_freedom, prior.deviation))
    for k, name in enumerate(names):
        shown = np.isfinite(departure[:, k])
        off = date[shown] - date[shown].mean() if shown.any() else np.zeros(0)
        spread = float(off @ off)
        if len(off) < FEWEST or not spread > 0:
            continue
        tried += 1
        d = departure[shown, k] - departure[shown, k].mean()
        slope = float(off @ d) / spread
        freedom = float(freedoms[k]) + len(off) - 2
        variance = (freedoms[k] * deviations[k] ** 2 + float(np.sum((d - slope * off) ** 2))) / freedom
        if abs(slope) * np.sqrt(spread / variance) > -stdtrit(freedom, SURE / (2 * len(names))):
            trends[name] = slope * YEAR
    return Check(STEADY_BASELINE, not trends if tried else None, {"trends": trends, "tests": len(date)})


def _expected(departure: Array, reference: Reference, prior: Prior, series: Series) -> Check:
    """Whether the baseline scatters by no more than what is expected of its kind: badly seated balls, a loose post."""
    beyond: dict[str, tuple[float, float]] = {}
    tried = 0
    for k, name in enumerate(series.indicators):
        shown = departure[np.isfinite(departure[:, k]), k]
        freedom = len(shown) - 1 - int(reference.slope[k] != 0)
        expected = float(np.broadcast_to(prior.deviation, reference.mean.shape)[k])
        if freedom < FEWEST - 1 or not expected > 0:
            continue
        tried += 1
        squares = float(np.sum((shown - shown.mean()) ** 2))
        worth = min(float(np.broadcast_to(prior.degrees_of_freedom, reference.mean.shape)[k]), _KNOWN)
        if fdtrc(freedom, worth, squares / freedom / expected**2) < SURE / len(series.indicators):
            beyond[name] = (float(np.sqrt(squares / freedom)), expected)
    units = {name: kind.unit for name, kind in zip(series.indicators, series.kinds, strict=True)}
    return Check(EXPECTED_SCATTER, not beyond if tried else None, {"beyond": beyond, "units": units})


def _temperature(series: Series, own: Sequence[int], found: Replay, reference: Reference) -> Check:
    """Whether every test says how warm the machine was: without it a season counts as a change."""
    steps = {step.test for step in found.steps}
    judged = [k for k, test in enumerate(series.tests) if test in steps]
    used = [*own, *judged]
    without = int(np.sum(~np.isfinite(series.temperature[used]))) if used else 0
    slopes = {name: float(slope) for name, slope in zip(series.indicators, reference.slope, strict=True) if slope != 0}
    facts: Mapping[str, object] = {"tests": len(used), "without": without, "corrected": tuple(slopes)}
    return Check(TEMPERATURE, not without if used else None, facts)


def _independent(series: Series, own: Sequence[int], departure: Array, since: Since, point: ChangePoint | None) -> Check:
    """Whether successive tests depart from the baseline by themselves: pooled over indicators, before any change."""
    until = np.inf if point is None else point.date
    before = {test for test, date in zip(since.tests, since.date, strict=True) if date < until}
    before |= {series.tests[k] for k in own}
    kept = [k for k, test in enumerate(series.tests) if test in before]
    total, pairs = 0.0, 0
    for k in range(len(series.indicators)):
        d = departure[kept, k]
        d = d[np.isfinite(d)]
        if len(d) <= FEWEST_PAIRS:
            continue
        d = d - d.mean()
        variance = float(np.mean(d**2))
        if variance > 0:
            total += float(d[1:] @ d[:-1]) / variance + 1.0  # of n normal numbers less their mean it is -1 on average
            pairs += len(d) - 1
    correlation = total / pairs if pairs else 0.0
    passed = None if not pairs else bool(correlation * np.sqrt(pairs) <= -ndtri(SURE))
    return Check(INDEPENDENT, passed, {"correlation": correlation, "pairs": pairs, "indicators": len(series.indicators)})
