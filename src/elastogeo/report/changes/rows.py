"""The tables of a verdict: indicators, tests, events, causes."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite

import numpy as np

from elastogeo.changes import ALARM, SUSPECT, ChangeVerdict, IndicatorState
from elastogeo.report.changes.answers import component_said
from elastogeo.report.changes.events import event_said, lettered
from elastogeo.report.changes.points import ASIDE, BASELINE, QUIET, Point, points_of
from elastogeo.report.changes.trends.plot import spark_plot
from elastogeo.report.changes.words import (
    MARKS,
    TONES,
    change_interval_said,
    change_said,
    marked,
    off_said,
    shown_unit,
    size_said,
    title_of,
    value_said,
)
from elastogeo.report.days import date_said, short_date
from elastogeo.report.numbers import whole_percent
from elastogeo.report.view import Table

MOST_TESTS = 60
"""Tests in the table; the JSON holds all."""
_TONES = {**TONES, QUIET: "good"}
_FAINT = 0.005
"""Score below which a component is not listed."""


def indicator_table(verdict: ChangeVerdict) -> Table:
    """Every indicator: now, its change with its interval, its state, since when."""
    rows = tuple(_indicator_row(verdict, one) for one in verdict.indicators)
    strong = tuple(k for k, one in enumerate(verdict.indicators) if one.state == ALARM)
    return Table(
        ("indicator", "now", "baseline", "unit", "change", "95 %", "state", "since"),
        rows,
        words=(0, 3, 6, 7),
        title="All indicators against the baseline" if verdict.baseline is not None else "All indicators",
        note=_note_of_indicators(verdict),
        strong=strong,
        name="indicators",
        keys=tuple(one.name for one in verdict.indicators),
        tones=tuple(TONES[one.state] for one in verdict.indicators),
        sparks=tuple(spark_plot(verdict, one) for one in verdict.indicators),
    )


def _indicator_row(verdict: ChangeVerdict, one: IndicatorState) -> tuple[str, ...]:
    known = isfinite(one.change)
    point = one.change_point
    since = short_date(point.date) if point is not None else short_date(verdict.since) if one.state == SUSPECT else ""
    return (
        title_of(one.name),
        value_said(one, one.now) if isfinite(one.now) else "",
        value_said(one, one.mean) if isfinite(one.mean) else "",
        shown_unit(one.kind.unit).name,
        change_said(one) if known else "",
        change_interval_said(one) if known and all(map(isfinite, one.change_interval)) else "",
        marked(one.state),
        since,
    )


def _note_of_indicators(verdict: ChangeVerdict) -> str:
    if verdict.baseline is None:
        return ""
    return (
        "The change is that of the mean since it changed, of a line at the last test where it drifts, of the running mean "
        "where it did not change; it is corrected for temperature where that is known, the value now is not."
    )


def test_table(verdict: ChangeVerdict, one: IndicatorState, first: int) -> Table:
    """The tests, the newest first, each with its mark and what it says of one indicator; from the one at `first` on."""
    shown = shown_unit(one.kind.unit)
    points = points_of(verdict, one)[::-1][first : first + MOST_TESTS]
    rows = tuple(_test_row(one, point, verdict.series.instruments[point.place]) for point in points)
    left = len(verdict.series) - first - len(rows)
    return Table(
        ("date", "test", f"{one.name} [{shown.name}]", "change", "air [°C]", "instrument", "state", "remark"),
        rows,
        words=(0, 1, 5, 6, 7),
        note=f"{left} older tests are in the JSON." if left > 0 else "",
        name="tests",
        keys=tuple(point.test for point in points),
        tones=tuple(_TONES.get(point.mark, "none") for point in points),
    )


def _test_row(one: IndicatorState, point: Point, instrument: str) -> tuple[str, ...]:
    off = point.value - one.mean
    return (
        short_date(point.date),
        point.test,
        value_said(one, point.value) if isfinite(point.value) else "not determined",
        off_said(one, off) if isfinite(off) and point.mark != BASELINE else "",
        f"{point.temperature:.1f}" if isfinite(point.temperature) else "",
        instrument,
        _mark_said(point.mark),
        point.why,
    )


def _mark_said(mark: str) -> str:
    words = {QUIET: marked("steady"), BASELINE: "● baseline", ASIDE: "○ set aside"}
    return words.get(mark) or (marked(mark) if mark in MARKS else f"× {mark}")


def event_table(verdict: ChangeVerdict) -> Table | None:
    """The events by their letters, the newest first; none where nothing happened."""
    rows = tuple((name, date_said(event.date), event_said(event)) for name, event in lettered(verdict.events).items())
    return Table(("", "date", "what happened"), rows[::-1], words=(0, 1, 2), name="events") if rows else None


def cause_table(verdict: ChangeVerdict) -> Table | None:
    """The components that the changed set may come from, the likeliest first; none where none is known."""
    rows = tuple(_cause_rows(verdict))
    return (
        Table(
            ("component", "likelihood [%]", "explains [%]", "because of", "against it", "not told from"),
            rows,
            words=(0, 3, 4, 5),
            note="How likely each component is among those listed, and how much of the changes it explains.",
            name="causes",
        )
        if rows
        else None
    )


def _cause_rows(verdict: ChangeVerdict) -> Iterator[tuple[str, ...]]:
    for cause in verdict.causes:
        if cause.score >= _FAINT or cause is verdict.causes[0]:
            yield (
                title_of(component_said(cause.component).removeprefix("the ")),
                whole_percent(cause.score),
                whole_percent(cause.share),
                ", ".join(cause.supported_by),
                ", ".join(cause.against),
                ", ".join(component_said(one).removeprefix("the ") for one in cause.alike),
            )


def resolves_said(one: IndicatorState) -> str:
    """By how much the next test must be off to be a signal, with its unit: half of what is expected of one test.

    It is never less than the least change that matters: a smaller one is no signal.
    """
    known = np.flatnonzero(np.isfinite(one.expected).all(axis=1))
    if not len(known):
        return ""
    low, high = one.expected[known[-1]]
    half = max((high - low) / 2, one.relevance)
    if one.kind.relative and one.mean:
        return f"{size_said(100 * half / abs(one.mean))} %"
    shown = shown_unit(one.kind.unit)
    return f"{size_said(half * shown.factor)} {shown.name}"
