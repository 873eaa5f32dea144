"""Verdicts to be shown, made by a short program of its own from simulated tests: no line is that of the rule it imitates."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import stats

from elastogeo.changes import (
    ALARM,
    DRIFT,
    KINDS,
    NO_BASELINE,
    STEADY,
    STEP,
    SUSPECT,
    WATCH,
    Baseline,
    Cause,
    ChangePoint,
    ChangeVerdict,
    Drift,
    DueDate,
    Event,
    IndicatorState,
    OpenAlarm,
    Series,
    Step,
)

DAY_ONE = 19_700.0
"""9 December 2023."""
MACHINE = "Hermle C50 no. 3"
SERIES = "loaded ball bar, XY, R 150 mm, 36 to 742 N"
ORDINARY = {
    "stiffness X": ("stiffness", 16_100.0, 0.011),
    "stiffness Y": ("stiffness", 21_600.0, 0.011),
    "squareness XY": ("squareness", 1.3e-6, 2e-6),
    "backlash X": ("backlash", 0.6e-3, 0.4e-3),
    "backlash Y": ("backlash", 1.1e-3, 0.4e-3),
    "scale difference XY": ("scale", -31e-6, 3e-6),
    "straightness X in Y": ("straightness", 2.1e-3, 0.4e-3),
    "circular deviation": ("circular deviation", 31.4e-3, 0.8e-3),
}
"""Name, kind, level, scatter between tests (a share of the level where the kind is relative)."""


def series(tests, fault=None, names=tuple(ORDINARY), every=30.0, seed=1, aside=(), unknown=()):
    """A series of `tests` tests; `fault(k, name)` adds to test k, in scatters."""
    random = np.random.default_rng(seed)
    value = np.empty((tests, len(names)))
    for q, name in enumerate(names):
        kind, level, scatter = ORDINARY[name]
        scatter = scatter * abs(level) if KINDS[kind].relative else scatter
        added = [fault(k, name) if fault else 0.0 for k in range(tests)]
        value[:, q] = level + scatter * (random.standard_normal(tests) + added)
    for k, q in unknown:
        value[k, q] = np.nan
    date = DAY_ONE + every * np.arange(tests)
    return Series(
        name=SERIES,
        indicators=names,
        kinds=tuple(KINDS[ORDINARY[name][0]] for name in names),
        tests=tuple(f"test {k + 1}" for k in range(tests)),
        date=date,
        value=value,
        standard_uncertainty=0.002 * np.abs(value),
        temperature=20.0 + 3 * np.sin(2 * np.pi * date / 365.25),
        repeats=np.full(tests, -1),
        aside=np.isin(np.arange(tests), aside),
        instruments=("LDBB 0042",) * tests,
        simulated="tests/report/changes/cases.py",
        machine=MACHINE,
    )


def verdict(one, base=10, state=None, causes=(), cannot=(), events=(), due=None, alarm=None, drifting=(), **changes):
    """What might be said of a series whose first `base` tests are its baseline."""
    now = float(one.date[-1]) + 10 if len(one) else DAY_ONE
    baseline = Baseline(one.tests[:base], float(one.date[base - 1])) if base else None
    states = [_indicator(one, q, base, name in drifting) for q, name in enumerate(one.indicators)]
    steps = _steps(one, base, states)
    found = state or (NO_BASELINE if not base else WATCH if base < 6 else steps[-1].state if steps else STEADY)
    if found == SUSPECT:
        states = [replace(s, state=SUSPECT if s.state == ALARM else s.state) for s in states]
    if found not in (ALARM, SUSPECT):
        states = [replace(s, state=NO_BASELINE if not base else STEADY, change_point=None) for s in states]
    since = next((s.date for k, s in enumerate(steps) if all(t.state == found for t in steps[k:])), None)
    shifts = [s.change_point for s in states if s.change_point]
    made = ChangeVerdict(
        series=one,
        baseline=baseline,
        alpha=0.005,
        now=now,
        state=found,
        since=since,
        waiting=steps[-1].test if found == SUSPECT and steps else "",
        repeat_by=now if found == SUSPECT else None,
        steps=tuple(steps),
        not_judged={one.tests[k]: "set aside" for k in np.flatnonzero(one.aside)},
        indicators=tuple(states),
        change_point=shifts[0] if shifts else None,
        causes=tuple(causes),
        cannot_tell=tuple(cannot),
        verdict=(),
        events=tuple(events),
        due=due,
        alarm=alarm,
    )
    return replace(made, **changes)


def _indicator(one, q, base, drifting):
    value, date, kind, number = one.value[:, q], one.date, one.kinds[q], len(one)
    empty, name = np.full(number, np.nan), one.indicators[q]
    now = next((v for v, out in zip(value[::-1], one.aside[::-1], strict=True) if np.isfinite(v) and not out), np.nan)
    if base < 2:
        return IndicatorState(
            name, kind, now, 0.002 * abs(now), np.nan, np.nan, 0.0, np.nan, np.nan, -np.inf, np.inf, empty, empty, empty,
            np.full((number, 2), np.nan), np.nan, (np.nan, np.nan), NO_BASELINE,
        )  # fmt: skip
    mean = float(np.nanmean(value[:base]))
    prior = kind.reproducibility * (abs(mean) if kind.relative else 1.0)
    df = 6.0 + base - 1
    s = float(np.sqrt((6 * prior**2 + (base - 1) * np.nanvar(value[:base], ddof=1)) / df))
    limit = float(stats.t.ppf(1 - 0.005 / (4 * len(one.indicators)), df))
    half = limit * s * np.sqrt(1 + 1 / base)
    running, smooth = empty.copy(), mean
    for k in range(base, number):
        if np.isfinite(value[k]) and not one.aside[k]:
            smooth += 0.4 * (value[k] - smooth)
            running[k] = smooth
    judged = np.arange(number) >= base
    single = np.where(judged & ~one.aside, (value - mean) / (s * np.sqrt(1 + 1 / base)), np.nan)
    t2 = (running - mean) / (s * np.sqrt(0.25 + 1 / base))
    over = np.flatnonzero(np.nan_to_num(np.fmax(np.abs(single), np.abs(t2))) > limit)
    alarmed = len(over) > 0 and over[-1] == number - 1
    change, start = (smooth - mean), None
    if alarmed:
        first = int(over[0])
        start = ChangePoint(
            one.tests[first], float(date[first]), float(date[first - 1]),
            (float(date[max(first - 2, 0)]), float(date[first])), one.tests[first : first + 1],
        )  # fmt: skip
        change = float(np.nanmean(value[first:])) - mean
    return IndicatorState(
        name=name,
        kind=kind,
        now=float(now),
        standard_uncertainty=0.002 * abs(now),
        mean=mean,
        deviation=s,
        degrees_of_freedom=df,
        limit=limit,
        relevance=kind.relevance * (abs(mean) if kind.relative else 1.0),
        lower=0.8 * mean if kind.relative and drifting else -np.inf,
        upper=np.inf,
        single=single,
        running=t2,
        running_mean=running,
        expected=np.tile([mean - half, mean + half], (number, 1)),
        change=change,
        change_interval=(change - 1.1 * s, change + 1.1 * s),
        state=ALARM if alarmed else STEADY,
        change_point=start,
        drift=_drift(one, q, over, 0.8 * mean) if drifting and alarmed else None,
        shape=DRIFT if drifting and alarmed else STEP if alarmed else "",
    )


def _drift(one, q, over, wall):
    since = max(int(over[0]) - 4, 0)
    fit = stats.linregress(one.date[since:], one.value[since:, q])
    half = stats.t.ppf(0.975, len(one) - since - 2) * fit.stderr
    end = float(one.date[-1])
    at_end = fit.intercept + fit.slope * end
    at = [end + (wall - at_end) / slope for slope in (fit.slope, fit.slope - half, fit.slope + half)]
    return Drift(
        365.2425 * fit.slope, (365.2425 * (fit.slope - half), 365.2425 * (fit.slope + half)), float(one.date[since]),
        len(one) - since, at_end, end, wall, "tolerance", at[0], (min(at[1:]), max(at[1:])),
    )  # fmt: skip


def _steps(one, base, states):
    if not base:
        return []
    found = []
    for k in range(base, len(one)):
        if one.aside[k]:
            continue
        ratio = {s.name: float(np.nan_to_num(max(abs(s.single[k]), abs(s.running[k])) / s.limit)) for s in states}
        first = max(ratio, key=ratio.get)
        over = tuple(name for name, r in ratio.items() if r > 1)
        state = ALARM if over else STEADY
        if over and (not found or found[-1].state == STEADY):
            state = SUSPECT
        found.append(
            Step(
                one.tests[k],
                float(one.date[k]),
                state,
                over,
                ratio[first],
                first,
                confirmed=True if state == ALARM else None,
            )
        )
    return found


def guideway():
    """X becomes softer from test 27 of 34 on, straightness of X with it; two events, one test set aside, a drift."""

    def fault(k, name):
        more = max(k - 26, 0)
        return (
            -2.0 * more
            if name == "stiffness X"
            else 1.2 * more
            if name == "straightness X in Y"
            else -7.0 * (k == 19 and name == "stiffness X")
        )

    one = series(34, fault, aside=(19,))
    causes = (
        Cause("guideway X", 0.97, 0.91, ("stiffness X", "straightness X in Y"), (), ("carriage X",)),
        Cause("drive X", 0.55, 0.08, ("stiffness X",), ("backlash X", "straightness X in Y")),
    )
    events = (
        Event("repair", DAY_ONE + 400, "spindle serviced; baseline kept", "user 1"),
        Event("note", DAY_ONE + 580, "ball not seated; repeated the same day", "user 2"),
        Event("parameter edit", DAY_ONE + 768, "lubrication interval of X", "user 2"),
    )
    return verdict(
        one,
        causes=causes,
        cannot=(("guideway X", "carriage X"),),
        events=events,
        drifting=("stiffness X",),
        due=DueDate(float(one.date[-1]) + 30, 7.0, "not due"),
        alarm=OpenAlarm(float(one.date[28])),
    )


def collision():
    """X and Y are out of square at once; many events close together."""
    one = series(20, lambda k, name: 15.0 * (k >= 18 and name == "squareness XY"), every=28.0, seed=4)
    causes = (Cause("squareness XY", 0.99, 0.98, ("squareness XY",)),)
    crash = [Event("crash", float(one.date[18]) - 4 + k, f"collision, part {k}", "user 1") for k in range(5)]
    known = OpenAlarm(float(one.date[18]), float(one.date[19]), "A. Smith", "rails are measured on Monday")
    return verdict(one, causes=causes, events=crash, alarm=known)


def healthy(tests=24):
    one = series(tests, seed=7)
    return verdict(one, state=STEADY, due=DueDate(float(one.date[-1]) + 30, 7.0, "due"))


def suspect():
    one = series(15, lambda k, name: 8.0 * (k == 14 and name == "backlash Y"), seed=2)
    return verdict(one, state=SUSPECT)


def two_tests():
    return verdict(series(2, seed=3), base=0)


def no_baseline():
    return verdict(series(9, seed=3), base=0)


def short_baseline():
    return verdict(series(7, seed=3), base=4)


def many():
    """Two hundred tests, weekly, a drift at the end."""
    one = series(200, lambda k, name: -0.15 * max(k - 170, 0) * (name == "stiffness X"), every=7.0, seed=5)
    return verdict(one, base=20, drifting=("stiffness X",))


def nothing():
    """A series without a test."""
    return verdict(series(0), base=0)


CASES = {
    one.__name__: one
    for one in (guideway, collision, healthy, suspect, two_tests, no_baseline, short_baseline, many, nothing)
}
