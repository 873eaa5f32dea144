"""The views of what people want of the series, with `elastogeo.settings/1` and `elastogeo.series/1`, their documents.

series : [{number, machine, place, series, state, tests, baseline, limits, interval_days, grace_days}]; `baseline` is {tests,
    set_at, who, why, holds} or null; `limits` counts the indicators with a tolerance
wanted : the same of one series
indicators : [{name, unit, mean, now, lower, upper, matters, matters_unit, by_default, set_at, who, why}] in the unit shown;
    `matters` is the least change that is an alarm, `by_default` whether it is the kind's own
tests : [{number, name, at, temperature_degC, aside, in_baseline, state}], the last first
baselines : all that were set, the last first
simulated : from what the tests are simulated, or null
"""

from __future__ import annotations

from math import isfinite

from elastogeo.changes import (
    NO_BASELINE,
    IndicatorState,
    KeptSettings,
    SeriesRecord,
    SetBaseline,
    TestOfSeries,
    WantedOfIndicator,
    WantedOfSeries,
)
from elastogeo.report.changes.words import MARKS, TONES, marked, shown_unit, value_said
from elastogeo.report.days import date_said, iso_date, short_date, simulated_said
from elastogeo.report.document import document
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.view import Badge, KeyValue, Section, Table, View, line_of, lines, views

_PERCENT = 100.0


@lines(SetBaseline)
def baseline_line(one: SetBaseline) -> str:
    """`10 tests, set 3 May 2026 by A. Miller: after the repair`."""
    ended = "" if one.holds else "; it holds no more"
    return f"{one.tests} tests, set {date_said(one.set_at)} by {one.who}: {one.why}{ended}"


@lines(WantedOfSeries)
def wanted_line(one: WantedOfSeries) -> str:
    """`Mill 3, XY 150: 10 tests in the baseline, every 30 days`."""
    return f"{one.machine}, {one.series}: {_baseline_said(one)}, {_interval_said(one)}"


@lines(WantedOfIndicator)
def limits_line(one: WantedOfIndicator) -> str:
    """`stiffness X: 13 to 20 N/µm, a change matters from 3 % on`."""
    lower, upper, matters, unit, share = entered_values(one)
    between = " to ".join(part for part in (lower, upper) if part)
    return f"{one.name}: {f'{between} {unit}, ' if between else ''}a change matters from {matters} {share} on"


@lines(TestOfSeries)
def test_line(one: TestOfSeries) -> str:
    """`test 12, 11 June 2026: in the baseline`."""
    return f"test {one.key}, {date_said(one.at)}: {_test_state(one)}"


@views(KeptSettings)
def settings_view(result: KeptSettings) -> View:
    """What people have set: of each series its baseline, its limits, how often it is tested."""
    entries = [_entry(one) for one in result.series]
    table = Table(
        ("Machine", "Series", "State", "Tests", "Baseline", "Limits", "Interval"),
        tuple(
            (
                one.machine,
                one.series,
                marked(one.state),
                str(one.tests),
                _baseline_said(one),
                str(one.limits or "none"),
                _interval_said(one),
            )
            for one in result.series
        ),
        words=(0, 1, 2, 4, 5, 6),
        title="Series",
        name="series",
        keys=tuple(one.key for one in result.series),
    )
    return View(
        kind="Settings",
        title=result.store,
        origin=simulated_said(result.simulated),
        sentence=_answer(result),
        document=document(
            "elastogeo.settings/1", {"now": iso_date(result.now), "series": entries, "simulated": result.simulated or None}
        ),
        rows=[entry | {"baseline": entry["baseline"] is not None} for entry in entries],
        tables=(table,) if entries else (),
        sections=(Section("Series", tables=(table,)),) if entries else (),
    )


@views(SeriesRecord)
def series_view(result: SeriesRecord) -> View:
    """One series: its limits and the tests that its baseline is made of."""
    one, verdict = result.wanted, result.verdict
    by_name = {state.name: state for state in verdict.indicators}
    limits = Table(
        ("Indicator", "Unit", "Baseline", "Now", "Least", "Greatest", "A change matters from", "As", "Said by"),
        tuple(_limits(wanted, by_name[wanted.name]) for wanted in result.indicators),
        words=(0, 1, 7, 8),
        name="limits",
        keys=tuple(wanted.name for wanted in result.indicators),
        note="Beyond least or greatest the machine is out of its tolerance. A change smaller than the one that matters is "
        "no alarm, however sure it is; where nobody said one, it is that of the kind.",
    )
    fields = Table(
        ("Least", "Greatest", "Unit", "A change matters from", "Unit"),
        tuple(
            (lower, upper, unit, matters, share)
            for lower, upper, matters, unit, share in map(entered_values, result.indicators)
        ),
        name="fields",
        keys=limits.keys,
    )
    tests = Table(
        ("Date", "Test", "Air [°C]", "State"),
        tuple(
            (
                short_date(test.at),
                test.name,
                significant(test.temperature, 3) if isfinite(test.temperature) else "",
                _test_state(test),
            )
            for test in result.tests
        ),
        words=(0, 1, 3),
        name="tests",
        keys=tuple(test.key for test in result.tests),
    )
    baselines = Table(
        ("Set", "Tests", "Who", "Why", "Now"),
        tuple(
            (date_said(set_.set_at), str(set_.tests), set_.who, set_.why, "holds" if set_.holds else "holds no more")
            for set_ in result.baselines
        ),
        words=(0, 2, 3, 4),
        name="baselines",
    )
    rows = [_indicator(wanted, by_name[wanted.name]) for wanted in result.indicators]
    found = {
        "now": iso_date(result.now),
        "wanted": _entry(one),
        "indicators": rows,
        "tests": [
            {
                "number": test.key,
                "name": test.name,
                "at": iso_date(test.at),
                "temperature_degC": test.temperature,
                "aside": test.aside,
                "in_baseline": test.in_baseline,
                "state": test.state or None,
            }
            for test in result.tests
        ],
        "baselines": [_baseline(set_) for set_ in result.baselines],
        "simulated": verdict.series.simulated or None,
    }
    named = (("Limits", limits), ("Tests", tests), ("Baselines", baselines))
    return View(
        kind="Series",
        title=one.machine,
        subtitle=one.series,
        origin=simulated_said(verdict.series.simulated),
        head=(
            ("Baseline", _baseline_said(one)),
            ("Interval", _interval_said(one)),
            ("Next test", "" if verdict.due is None else line_of(verdict.due)),
        ),
        sentence=_series_answer(result),
        values=(
            KeyValue("Interval", _entered(one.interval), "days", "between tests"),
            KeyValue("Grace", _entered(one.grace), "days", "that a test may be late"),
        ),
        document=document("elastogeo.series/1", found),
        rows=rows,
        tables=(*(table for _, table in named if table.rows), fields),
        sections=tuple(Section(title, tables=(table,)) for title, table in named if table.rows),
        badge=Badge(MARKS[verdict.state], verdict.state.capitalize(), TONES[verdict.state]),
    )


def entered_values(one: WantedOfIndicator) -> tuple[str, str, str, str, str]:
    """Least, greatest, the least change that matters, as a person enters them, with their units; empty for none."""
    unit = shown_unit(one.kind.unit)
    share = _PERCENT if one.kind.relative else unit.factor
    matters = one.kind.relevance if one.relevance is None else one.relevance
    lower, upper = (_entered(None if value is None else value * unit.factor) for value in (one.lower, one.upper))
    return lower, upper, _entered(matters * share), unit.name, "%" if one.kind.relative else unit.name


def _entered(value: float | None) -> str:
    """As a field of a form takes it: a plain point and minus."""
    return "" if value is None else f"{value:.10g}"


def _limits(one: WantedOfIndicator, state: IndicatorState) -> tuple[str, ...]:
    lower, upper, matters, unit, share = entered_values(one)
    said = f"{one.who}: {one.why} ({short_date(one.set_at)})" if one.set_at is not None else ""
    whose = "of its kind" if one.relevance is None else "set"
    values = (value_said(state, state.mean), value_said(state, state.now), pretty(lower), pretty(upper))
    return one.name, unit, *values, f"{matters} {share}", whose, said


def _indicator(one: WantedOfIndicator, state: IndicatorState) -> dict[str, object]:
    unit = shown_unit(one.kind.unit)
    matters = one.kind.relevance if one.relevance is None else one.relevance
    return {
        "name": one.name,
        "unit": unit.name,
        "mean": state.mean * unit.factor,
        "now": state.now * unit.factor,
        "lower": None if one.lower is None else one.lower * unit.factor,
        "upper": None if one.upper is None else one.upper * unit.factor,
        "matters": matters * (_PERCENT if one.kind.relative else unit.factor),
        "matters_unit": "%" if one.kind.relative else unit.name,
        "by_default": one.relevance is None,
        "set_at": iso_date(one.set_at),
        "who": one.who or None,
        "why": one.why or None,
    }


def _entry(one: WantedOfSeries) -> dict[str, object]:
    return {
        "number": one.key,
        "machine": one.machine,
        "place": one.place or None,
        "series": one.series,
        "state": one.state,
        "tests": one.tests,
        "baseline": None if one.baseline is None else _baseline(one.baseline),
        "limits": one.limits,
        "interval_days": one.interval,
        "grace_days": one.grace,
    }


def _baseline(one: SetBaseline) -> dict[str, object]:
    return {"tests": one.tests, "set_at": iso_date(one.set_at), "who": one.who, "why": one.why, "holds": one.holds}


def _baseline_said(one: WantedOfSeries) -> str:
    if one.baseline is None:
        return "none"
    if not one.baseline.holds:
        return "none since the repair"
    return f"{one.baseline.tests} tests, set {short_date(one.baseline.set_at)}"


def _interval_said(one: WantedOfSeries) -> str:
    return (
        "no date"
        if one.interval is None
        else f"every {significant(one.interval, 3)} days, {significant(one.grace, 3)} late at most"
    )


def _test_state(one: TestOfSeries) -> str:
    if one.aside:
        return "set aside"
    return "in the baseline" if one.in_baseline else marked(one.state) if one.state else "not judged"


def _answer(result: KeptSettings) -> str:
    count = len(result.series)
    if not count:
        return "There is no series yet: the first test of a machine makes one."
    bare = sum(one.state == NO_BASELINE for one in result.series)
    undated = sum(one.interval is None for one in result.series)
    parts = [f"{count} series"]
    parts += [f"{bare} without a baseline: nothing is judged there"] if bare else []
    parts += [f"{undated} without a date for the next test"] if undated else []
    return f"{', '.join(parts)}."


def _series_answer(result: SeriesRecord) -> str:
    one = result.wanted
    if one.state == NO_BASELINE:
        why = "its alarm was closed as repaired" if one.baseline is not None else "none was set"
        return f"This series has no baseline, since {why}: choose the tests that count as its ordinary state."
    assert one.baseline is not None
    return f"The baseline is {line_of(one.baseline)}."
