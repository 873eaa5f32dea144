"""A machine: whether it has changed, and what that points to; one of its indicators over time; its tests."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query, Response

from elastogeo.changes import Trend
from elastogeo.report import View, html_page, pdf_page, view_of
from elastogeo.report.changes import MOST_TESTS
from elastogeo.web.answering import Shown, download, last_page
from elastogeo.web.asking import Ask, Asked, NotFound
from elastogeo.web.fields import Number, Word
from elastogeo.web.pages import Pages

pages = Pages()

SPANS = {"year": 366.0, "all": None}
"""How long before the last test a trend begins [d]."""
FEW = 8
"""Tests on the page of the machine."""
Series = Annotated[int | None, Query(ge=0, le=2**53)]
"""Key of one; none: the worst."""


@pages.shows("/machines/{key:int}")
def machine(asked: Ask, key: int, series: Series = None, indicator: Word = "", span: Word = "all") -> Shown:
    """A machine by one of its series, by default the worst, and one of its indicators over time."""
    known = asked.machine(key)
    state = asked.history.machine_shown(key, series)
    shown = state.series[0] if state.series else None
    if shown is not None and indicator and indicator not in shown:
        raise NotFound("This series has no such indicator.")
    trend = None if shown is None else view_of(Trend(shown, indicator, SPANS.get(span)))
    context = {
        "machine": known,
        "trend": trend,
        "few": FEW,
        "asked_for": {"series": series, "indicator": indicator, "span": "" if span == "all" else span},
        "spans": SPANS,
        "alarm": None if shown is None else shown.alarm,
    }
    return Shown("machines/machine.html.j2", view_of(state), part="machines/trend.html.j2", context=context)


@pages.shows("/machines/{key:int}/tests")
def every_test(asked: Ask, key: int, series: Series = None, indicator: Word = "", page: Number = 1) -> Shown:
    """The tests of one series of a machine, the newest first, with what each says of one indicator."""
    known = asked.machine(key)
    state = asked.history.machine_shown(key, series)
    if not state.series:
        raise NotFound("This machine has no test yet.")
    if indicator and indicator not in state.series[0]:
        raise NotFound("This series has no such indicator.")
    trend = Trend(state.series[0], indicator, None, MOST_TESTS * (page - 1))
    context = {
        "machine": known,
        "whole": view_of(state),
        "asked_for": {"series": series, "indicator": indicator},
        "page": page,
        "pages": last_page(len(state.series[0].series), MOST_TESTS),
    }
    return Shown("machines/tests.html.j2", view_of(trend), context=context)


@pages.gives("/machines/{key:int}/report.html", media="text/html")
def report_page(asked: Ask, key: int, series: Series = None) -> Response:
    """The report of a machine as one page that opens offline."""
    return download(html_page(_report(asked, key, series)), f"machine-{key}.html", "text/html; charset=utf-8")


@pages.gives("/machines/{key:int}/report.pdf", media="application/pdf")
def report_document(asked: Ask, key: int, series: Series = None) -> Response:
    """The report of a machine as PDF."""
    return download(pdf_page(_report(asked, key, series)), f"machine-{key}.pdf", "application/pdf")


def _report(asked: Asked, key: int, series: int | None) -> View:
    asked.machine(key)
    return view_of(asked.history.machine_shown(key, series))
