"""All tests of a series after its baseline, one after the other through the charts: what was suspect, what was an alarm.

An alarm stays one until a person closes it, as repaired (another baseline) or as false (`Baseline.cleared`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from elastogeo.changes.charts import Charts, Judged, Sides, start, step
from elastogeo.changes.references import Reference
from elastogeo.changes.result import ALARM, STEADY, SUSPECT, WATCH, Step
from elastogeo.changes.rules import Rule
from elastogeo.changes.series import Baseline, Counts, Flags, Series
from elastogeo.machine import Array

SET_ASIDE = "set aside"
BEFORE = "before the baseline"
NOTHING = "nothing determined"


@dataclass(slots=True, eq=False)
class Replay:
    """Where the replay stands; after the last test, what it found. n tests, q indicators.

    Attributes
    ----------
    charts : Charts
    state : str
    since : float [d]
    steps : list of Step
    not_judged : dict of str to str
    single, running, running_mean : array, shape (n, q)
        NaN where a test was not judged.
    stands : array of bool, shape (n,)
        Judged since the last time that an alarm was closed as false, and no repeat took its place.
    alarm : array of int, shape (q,)
        Side of what is part of the alarm; 0 for what is not.
    over : array of int, shape (q,)
        Side on which the last test was beyond the limit.
    joined : array of int, shape (q,)
        The test by which each became part of the alarm.
    last : int
        The test judged last; -1 before the first.
    asked : int
        The suspect test that waits for a repeat; -1 if none does.
    confirmed : bool or None
        Whether a second test confirmed the alarm: None without an alarm.
    """

    charts: Charts
    state: str
    since: float
    single: Array
    running: Array
    running_mean: Array
    stands: Flags
    alarm: Sides
    over: Sides
    steps: list[Step] = field(default_factory=list)
    not_judged: dict[str, str] = field(default_factory=dict)
    joined: Counts = field(default_factory=lambda: np.zeros(0, dtype=int))
    last: int = -1
    asked: int = -1
    confirmed: bool | None = None


def replay(series: Series, baseline: Baseline, reference: Reference, rule: Rule, now: float) -> Replay:
    """The tests after the baseline, in their order, up to now.

    Parameters
    ----------
    series : Series
    baseline : Baseline
    reference : Reference
    rule : Rule
    now : float [d]
        A test that is dated after it counts all the same: the clock went back, not the test.
    """
    n, q = series.value.shape
    quiet = STEADY if np.any(reference.count >= rule.least_baseline) else WATCH
    nothing = np.full((n, q), np.nan)
    none = np.zeros(q, dtype=np.int8)
    found = Replay(
        start(reference),
        quiet,
        baseline.since,
        nothing,
        nothing.copy(),
        nothing.copy(),
        np.zeros(n, dtype=bool),
        none,
        none,
        joined=np.full(q, -1),
    )
    cleared = sorted(baseline.cleared)
    for i in _judged(series, baseline, found):
        while cleared and cleared[0] <= series.date[i]:
            _clear(found, reference, quiet, cleared.pop(0))
        _expire(found, series, rule, float(series.date[i]))
        _judge(found, series, reference, rule, i, quiet)
    while cleared and cleared[0] <= now:
        _clear(found, reference, quiet, cleared.pop(0))
    _expire(found, series, rule, now)
    return found


def _judged(series: Series, baseline: Baseline, found: Replay) -> Iterator[int]:
    """The tests that are judged; why the others are not."""
    own = set(baseline.tests)
    for i, test in enumerate(series.tests):
        if series.aside[i]:
            found.not_judged[test] = SET_ASIDE
        elif test in own:
            continue
        elif series.date[i] < baseline.since:
            found.not_judged[test] = BEFORE
        elif not np.isfinite(series.value[i]).any():
            found.not_judged[test] = NOTHING
        else:
            yield i


def _clear(found: Replay, reference: Reference, quiet: str, at: float) -> None:
    """A person closed the alarm as false: the running mean starts anew."""
    found.charts = start(reference)
    found.stands[:] = False
    found.alarm, found.over = np.zeros_like(found.alarm), np.zeros_like(found.over)
    found.joined = np.full_like(found.joined, -1)
    found.last, found.asked, found.confirmed = -1, -1, None
    _becomes(found, quiet, at)


def _expire(found: Replay, series: Series, rule: Rule, at: float) -> None:
    """A suspect test without a repeat is an alarm that nothing confirmed, once the waiting time is over."""
    if found.asked < 0 or at <= series.date[found.asked] + rule.wait:
        return
    _join(found, found.charts.suspect, found.asked)
    found.confirmed = bool(found.confirmed)
    _answered(found, float(series.date[found.asked]) + rule.wait)


def _join(found: Replay, sides: Sides, i: int) -> None:
    """Indicators, by the side on which they are off, become part of the alarm with a test."""
    new = (found.alarm == 0) & (sides != 0)
    found.alarm = np.where(new, sides, found.alarm).astype(np.int8)
    found.joined = np.where(new, i, found.joined)


def _answered(found: Replay, at: float) -> None:
    """What was suspect is an alarm now."""
    found.charts = replace(found.charts, suspect=np.zeros_like(found.charts.suspect))
    found.asked = -1
    _becomes(found, ALARM, at)


def _becomes(found: Replay, state: str, at: float) -> None:
    if state != found.state:
        found.state, found.since = state, at


def _judge(found: Replay, series: Series, reference: Reference, rule: Rule, i: int, quiet: str) -> None:
    """One test through the charts, and what it makes of the state."""
    before, date = found.charts.suspect, float(series.date[i])
    answers = found.last >= 0 and int(series.repeats[i]) == found.last and bool(before.any() or found.over.any())
    found.charts, judged = step(
        found.charts, reference, rule, series.value[i], float(series.temperature[i]), series.standard_uncertainty[i], answers
    )
    _keep(found, judged, i)
    again = (judged.over != 0) & (judged.over == np.where(before != 0, before, found.over))
    sure = judged.confirmed | (again & ((before != 0) | (found.alarm.any())))
    if answers:
        _answer(found, series, i, bool(sure.any()))
    _join(found, np.where(sure, np.where(judged.over == 0, before, judged.over), 0), i)
    found.over, found.last = judged.over, i
    if found.alarm.any():
        found.confirmed = bool(found.confirmed) or bool(sure.any())
        _answered(found, date)
    elif found.charts.suspect.any():
        found.asked = i if answers or found.asked < 0 else found.asked
        _becomes(found, SUSPECT, date)
    else:
        found.asked = -1
        _becomes(found, quiet, date)
    found.steps.append(_step(found, series, judged, i, answers))


def _keep(found: Replay, judged: Judged, i: int) -> None:
    found.single[i], found.running[i] = judged.single, judged.running
    held = found.charts.running
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(np.isfinite(judged.running), judged.expected + held.mean / held.weight, np.nan)
    found.running_mean[i] = mean
    found.stands[i] = True


def _answer(found: Replay, series: Series, i: int, sure: bool) -> None:
    """A repeat takes the place of the test that it repeats."""
    j = found.last
    found.stands[j] = False
    at = next(k for k in reversed(range(len(found.steps))) if found.steps[k].test == series.tests[j])
    found.steps[at] = replace(found.steps[at], confirmed=sure, replaced="" if sure else series.tests[i])


def _step(found: Replay, series: Series, judged: Judged, i: int, answers: bool) -> Step:
    ratio = judged.ratio
    furthest = np.argsort(-ratio, kind="stable")
    known = bool(np.isfinite(judged.single).any())
    return Step(
        test=series.tests[i],
        date=float(series.date[i]),
        state=found.state,
        over=tuple(series.indicators[k] for k in furthest if judged.over[k]),
        ratio=float(ratio.max()) if known else 0.0,
        first=series.indicators[furthest[0]] if known else "",
        repeats=series.tests[series.repeats[i]] if answers else "",
    )
