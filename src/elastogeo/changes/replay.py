"""All tests of a series after its baseline, one after the other through the charts: what was suspect, what was an alarm.

An alarm stays one until a person closes it, as repaired (another baseline) or as false (`Baseline.cleared`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from elastogeo.changes.charts import Judged, Running, Sides, read_charts, warmth_and_scatter
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
    state : str
    since : float [d]
    not_judged : dict of str to str
    single, running, running_mean : array, shape (n, q)
        NaN where a test was not judged.
    stands : array of bool, shape (n,)
        Judged since the last time that an alarm was closed as false, and no repeat took its place.
    sums : array, shape (4, q)
        Those of `Running` after the last test.
    suspect, alarm, over : array of int, shape (q,)
        Side of what is suspect, of what is part of the alarm, and on which the last test was beyond the limit; 0 where not.
    joined : array of int, shape (q,)
        The test by which each became part of the alarm.
    steps : list of Step
    last : int
        The test judged last; -1 before the first.
    asked : int
        The suspect test that waits for a repeat; -1 if none does.
    confirmed : bool or None
        Whether a second test confirmed the alarm: None without an alarm.
    """

    state: str
    since: float
    not_judged: dict[str, str]
    single: Array
    running: Array
    running_mean: Array
    stands: Flags
    sums: Array
    suspect: Sides
    alarm: Sides
    over: Sides
    joined: Counts
    steps: list[Step] = field(default_factory=list)
    last: int = -1
    asked: int = -1
    confirmed: bool | None = None

    @staticmethod
    def before(n: int, q: int, state: str, since: float, not_judged: dict[str, str]) -> Replay:
        """Before the first of n tests of q indicators."""
        none = np.zeros(q, dtype=np.int8)
        return Replay(
            state=state,
            since=since,
            not_judged=not_judged,
            single=np.full((n, q), np.nan),
            running=np.full((n, q), np.nan),
            running_mean=np.full((n, q), np.nan),
            stands=np.zeros(n, dtype=bool),
            sums=np.zeros((4, q)),
            suspect=none,
            alarm=none,
            over=none,
            joined=np.full(q, -1),
        )

    def clear(self, quiet: str, at: float) -> None:
        """A person closed the alarm as false: the running mean starts anew."""
        empty = Replay.before(len(self.stands), len(self.alarm), quiet, at, {})
        self.stands, self.sums, self.suspect, self.alarm = empty.stands, empty.sums, empty.suspect, empty.alarm
        self.over, self.joined, self.last, self.asked, self.confirmed = empty.over, empty.joined, -1, -1, None
        self.becomes(quiet, at)

    def expire(self, series: Series, rule: Rule, at: float) -> None:
        """A suspect test without a repeat is an alarm that nothing confirmed, once the waiting time is over."""
        if self.asked < 0 or at <= series.date[self.asked] + rule.wait:
            return
        self.join(self.suspect, self.asked)
        self.confirmed = bool(self.confirmed)
        self.becomes(ALARM, float(series.date[self.asked]) + rule.wait)
        self.suspect, self.asked = np.zeros_like(self.suspect), -1

    def join(self, sides: Sides, i: int) -> None:
        """Indicators, by the side on which they are off, become part of the alarm with a test."""
        new = (self.alarm == 0) & (sides != 0)
        self.alarm = np.where(new, sides, self.alarm).astype(np.int8)
        self.joined = np.where(new, i, self.joined)

    def becomes(self, state: str, at: float) -> None:
        """Another state, from then on."""
        if state != self.state:
            self.state, self.since = state, at


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
    not_judged: dict[str, str] = {}
    order = list(_judged(series, baseline, not_judged))
    cleared = [at for at in sorted(baseline.cleared) if at <= now or (order and at <= series.date[order[-1]])]
    answers = _answers(series, rule, order, cleared)
    running = _running(series, reference, rule, order, answers, cleared)
    rows = np.array(order, dtype=int)
    judged = read_charts(
        Running(*running), reference, rule, series.value[rows], series.temperature[rows], series.standard_uncertainty[rows]
    )
    found = Replay.before(n, q, quiet, baseline.since, not_judged)
    found.single[rows], found.running[rows] = judged.single, judged.running
    found.running_mean[rows] = _running_mean(judged, running)
    ratio = judged.ratio
    for at, i in enumerate(order):
        while cleared and cleared[0] <= series.date[i]:
            found.clear(quiet, cleared.pop(0))
        found.expire(series, rule, float(series.date[i]))
        _judge(found, series, judged, ratio[at], at, i, answers[at], quiet)
        found.sums = running[:, at]
    while cleared:
        found.clear(quiet, cleared.pop(0))
    found.expire(series, rule, now)
    return found


def _judged(series: Series, baseline: Baseline, not_judged: dict[str, str]) -> Iterator[int]:
    """The tests that are judged; why the others are not."""
    own = set(baseline.tests)
    shown = np.any(np.isfinite(series.value), axis=1)
    for i, test in enumerate(series.tests):
        if series.aside[i]:
            not_judged[test] = SET_ASIDE
        elif test in own:
            continue
        elif series.date[i] < baseline.since:
            not_judged[test] = BEFORE
        elif not shown[i]:
            not_judged[test] = NOTHING
        else:
            yield i


def _answers(series: Series, rule: Rule, order: Sequence[int], cleared: Sequence[float]) -> list[bool]:
    """Of each judged test whether it repeats the one before it in time: it takes its place in the running mean."""
    found = [False] * len(order)
    for at in range(1, len(order)):
        i, j = order[at], order[at - 1]
        between = any(series.date[j] < end <= series.date[i] for end in cleared)
        found[at] = int(series.repeats[i]) == j and series.date[i] <= series.date[j] + rule.wait and not between
    return found


def _running(
    series: Series,
    reference: Reference,
    rule: Rule,
    order: Sequence[int],
    answers: Sequence[bool],
    cleared: Sequence[float],
) -> Array:
    """The sums of `Running` after each judged test, shape (4, tests, q): as `step` has them, without an object a test."""
    rows = np.array(order, dtype=int)
    value = series.value[rows]
    off, scatter = warmth_and_scatter(reference, series.temperature[rows], series.standard_uncertainty[rows])
    here = np.isfinite(value) & np.isfinite(reference.mean)
    share, old = rule.smoothing, 1 - rule.smoothing
    departure = np.where(here, value - reference.mean - reference.slope * off, 0.0)
    added = np.stack([share * departure, np.full(value.shape, share), share**2 * scatter, share * off], axis=1)
    fading = np.array([old, old, old**2, old])[:, np.newaxis]
    sums = np.zeros((len(order), 4, value.shape[1]))
    running = before = np.zeros((4, value.shape[1]))
    ends = list(cleared)
    for at, i in enumerate(order):
        while ends and ends[0] <= series.date[i]:
            ends.pop(0)
            running = before = np.zeros_like(running)
        before = before if answers[at] else running
        running = np.where(here[at], fading * before + added[at], running)
        sums[at] = running
    return np.moveaxis(sums, 1, 0)


def _running_mean(judged: Judged, running: Array) -> Array:
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(np.isfinite(judged.running), judged.expected + running[0] / running[1], np.nan)


def _judge(found: Replay, series: Series, judged: Judged, ratio: Array, at: int, i: int, answers: bool, quiet: str) -> None:
    """What one test makes of the state."""
    before, over = found.suspect, judged.over[at]
    signal = bool(over.any())
    if signal or answers or found.asked >= 0:
        _suspected(found, series, judged, at, i, answers)
    found.over, found.last = over, i
    found.stands[i] = True
    if found.state == ALARM or found.alarm.any():
        found.becomes(ALARM, float(series.date[i]))
    elif found.suspect.any():
        whole = answers and not np.any((before != 0) & ~np.isfinite(judged.single[at]))
        found.asked = i if whole or not before.any() else found.asked
        found.becomes(SUSPECT, float(series.date[i]))
    else:
        found.asked = -1
        found.becomes(quiet, float(series.date[i]))
    found.steps.append(_step(found, series, judged, ratio, at, i, answers))


def _suspected(found: Replay, series: Series, judged: Judged, at: int, i: int, answers: bool) -> None:
    """A test that signals, or that follows a suspect one: what it confirms, and what is suspect after it."""
    before, over = found.suspect, judged.over[at]
    here = np.isfinite(judged.single[at])
    confirmed = answers & here & (before != 0) & np.any(judged.near[:, at] == before, axis=0)
    # by the test itself: the running mean still holds the one before it
    again = (over != 0) & (judged.near[0, at] == over) & (over == np.where(before != 0, before, found.over))
    sure = confirmed | (again & ((before != 0) | bool(found.alarm.any())))
    if answers:
        _answer(found, series, i, bool(sure.any()), not np.any((before != 0) & ~here))
    waiting = np.where(answers & here, 0, before)
    found.suspect = np.where(confirmed, 0, np.where(over != 0, over, waiting)).astype(np.int8)
    found.join(np.where(sure, np.where(over == 0, before, over), 0), i)
    if found.alarm.any():
        found.confirmed = bool(found.confirmed) or bool(sure.any())
        found.suspect, found.asked = np.zeros_like(found.suspect), -1


def _answer(found: Replay, series: Series, i: int, sure: bool, whole: bool) -> None:
    """A repeat takes the place of the test that it repeats, and of what that one repeated in part.

    One that does not determine all that was suspect takes no place: what it cannot show still stands, and waits.
    """
    j, at = found.last, len(found.steps) - 1
    while (whole or sure) and at >= 0 and found.stands[j]:
        step = found.steps[at]
        asked = step.state == SUSPECT or bool(step.over)
        found.stands[j] = not whole
        found.steps[at] = replace(step, confirmed=sure if asked else None, replaced="" if sure else series.tests[i])
        if not step.repeats:
            return
        j, at = int(series.repeats[j]), at - 1


def _step(found: Replay, series: Series, judged: Judged, ratio: Array, at: int, i: int, answers: bool) -> Step:
    furthest = np.argsort(-ratio, kind="stable")
    known = bool(np.isfinite(judged.single[at]).any())
    return Step(
        test=series.tests[i],
        date=float(series.date[i]),
        state=found.state,
        over=tuple(series.indicators[k] for k in furthest if judged.over[at, k]),
        ratio=float(ratio[furthest[0]]) if known else 0.0,
        first=series.indicators[furthest[0]] if known else "",
        repeats=series.tests[series.repeats[i]] if answers else "",
    )
