"""The view of one indicator over time: its chart, and its tests, the newest first."""

from __future__ import annotations

from math import inf
from typing import Any

from elastogeo.changes import ChangeVerdict, IndicatorState, Trend
from elastogeo.report.changes.answers import machine_of, series_said, worst_of
from elastogeo.report.changes.change_view import trend_picture
from elastogeo.report.changes.document import chart_entries
from elastogeo.report.changes.parts_view import state_line
from elastogeo.report.changes.rows import test_table
from elastogeo.report.changes.words import MARKS, TONES, title_of
from elastogeo.report.days import simulated_said
from elastogeo.report.document import document
from elastogeo.report.later import Later, LaterRows
from elastogeo.report.view import Badge, View, views


@views(Trend)
def trend_view(trend: Trend) -> View:
    """All that is shown of one indicator."""
    verdict = trend.verdict
    one = verdict[trend.indicator] if trend.indicator else worst_of(verdict)
    whole = Later(lambda: _document(verdict, one))
    return View(
        kind="Trend",
        title="No indicator" if one is None else title_of(one.name),
        subtitle=f"{machine_of(verdict)}: {series_said(verdict)}",
        origin=simulated_said(verdict.series.simulated),
        badge=None if one is None else Badge(MARKS[one.state], title_of(one.state), TONES[one.state]),
        sentence="No test determines an indicator yet." if one is None else f"{title_of(state_line(one))}.",
        picture=None if one is None or not len(verdict.series) else trend_picture(verdict, one, since=_since(trend)),
        document=whole,
        rows=LaterRows(lambda: whole["chart"]["points"] if whole["chart"] else ()),
        tables=() if one is None else (test_table(verdict, one, trend.first),),
    )


def _document(verdict: ChangeVerdict, one: IndicatorState | None) -> dict[str, Any]:
    chart = None if one is None else chart_entries(verdict, one)
    entries = {"machine": machine_of(verdict), "series": series_said(verdict), "chart": chart or None}
    return document("elastogeo.trend/1", entries)


def _since(trend: Trend) -> float:
    """From when on it is drawn [d]."""
    dates = trend.verdict.series.date
    return -inf if trend.days is None or not len(dates) else float(dates[-1]) - trend.days
