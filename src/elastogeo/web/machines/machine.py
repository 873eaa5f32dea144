"""A machine: whether it has changed, and what that points to; one of its indicators over time; its tests."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, Response

from elastogeo.changes import Trend
from elastogeo.report import html_page, pdf_page, view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask, Asked, NotFound
from elastogeo.web.pages import Pages

pages = Pages()

SPANS = {"year": 366.0, "all": None}
"""How long before the last test a trend begins [d]."""
ON_A_PAGE = 60
FEW = 8
"""Tests on the page of the machine."""
Name = Annotated[str, Query(max_length=200)]
Key = Annotated[int | None, Query(ge=0, le=2**62)]


@pages.shows("/machines/{key:int}")
def machine(asked: Ask, key: int, series: Key = None, indicator: Name = "", span: Name = "all") -> Shown:
    """A machine by one of its series, by default the worst, and one of its indicators over time."""
    known = asked.machine(key)
    state = asked.history.machine_shown(key, series)
    shown = state.series[0] if state.series else None
    if shown is not None and indicator and indicator not in shown:
        raise NotFound("This series has no such indicator.")
    trend = None if shown is None else view_of(Trend(shown, indicator, SPANS.get(span)))
    chosen = next(
        (row.series_key for row in state.rows if shown is not None and shown.series.name.endswith(row.series)), None
    )
    context = {
        "machine": known,
        "trend": trend,
        "few": FEW,
        "asked_for": {"series": series, "indicator": indicator, "span": "" if span == "all" else span},
        "spans": SPANS,
        "series_key": series if series is not None else chosen,
        "alarm": None if shown is None else shown.alarm,
    }
    return Shown("machines/machine.html.j2", view_of(state), part="machines/trend.html.j2", context=context)


@pages.shows("/machines/{key:int}/tests")
def every_test(
    asked: Ask, key: int, series: Key = None, indicator: Name = "", page: Annotated[int, Query(ge=1, le=100_000)] = 1
) -> Shown:
    """The tests of one series of a machine, the newest first, with what each says of one indicator."""
    known = asked.machine(key)
    state = asked.history.machine_shown(key, series)
    if not state.series:
        raise NotFound("This machine has no test yet.")
    if indicator and indicator not in state.series[0]:
        raise NotFound("This series has no such indicator.")
    trend = Trend(state.series[0], indicator, None, ON_A_PAGE * (page - 1))
    context = {
        "machine": known,
        "whole": view_of(state),
        "asked_for": {"series": series, "indicator": indicator},
        "page": page,
        "pages": max(-(-len(state.series[0].series) // ON_A_PAGE), 1),
    }
    return Shown("machines/tests.html.j2", view_of(trend), context=context)


@pages.gives("/machines/{key:int}/report.html", media="text/html")
def report_page(asked: Ask, key: int, series: Key = None) -> Response:
    """The report of a machine as one page that opens offline."""
    return _file(
        asked, key, "html", "text/html; charset=utf-8", html_page(view_of(asked.history.machine_shown(key, series)))
    )


@pages.gives("/machines/{key:int}/report.pdf", media="application/pdf")
def report_document(asked: Ask, key: int, series: Key = None) -> Response:
    """The report of a machine as PDF."""
    return _file(asked, key, "pdf", "application/pdf", pdf_page(view_of(asked.history.machine_shown(key, series))))


def _file(asked: Asked, key: int, ending: str, media: str, content: str | bytes) -> Response:
    asked.machine(key)
    return Response(
        content, media_type=media, headers={"Content-Disposition": f'attachment; filename="machine-{key}.{ending}"'}
    )
