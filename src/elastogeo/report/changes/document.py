"""A verdict on a series as a JSON document, `elastogeo.change/1`. Values are in `unit`, dates in UTC as ISO 8601 has them.

machine, series, simulated : whose tests, by which recipe; from what they are simulated, empty if they were measured
state, since, sentence : `alarm`, `suspect`, `watch`, `no baseline`, `steady`; since when; the answer
points_to, cannot_tell, next, next_test : components, sets of components, what to do, when the next test is due
alarm : {number, opened, acknowledged, who, why, held_by}, or null
indicators : [{code, kind, unit, now, u, mean, s, df, limit, change, change95, state, since, since95, drift, spark}]
    `u` is the standard uncertainty by the last test itself, `s` the standard deviation between tests, `spark` the values of
    the last tests; drift {per_year, per_year95, limit, limit_is, limit_at, limit_at95}, or null.
chart : {indicator, unit, points, baseline, expected, running_mean, tolerance, drift, events}, of the worst indicator
    points [{test, date, value, u, temperature, mark, why, instrument}]; baseline {tests, mean, s, df}; `expected` [[low,
    high]] and `running_mean` along the points.
causes : [{component, share, score, supported_by, against, alike}]
baseline, alpha : {tests, since} or null; the false-alarm probability that the limits are made from
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from elastogeo.changes import ChangeVerdict, Drift, Event, IndicatorState
from elastogeo.report.changes.answers import machine_of, next_action, points_to, sentence_of_change, series_said, worst_of
from elastogeo.report.changes.events import lettered
from elastogeo.report.changes.points import points_of
from elastogeo.report.days import iso_date
from elastogeo.report.document import document, verdict_entries

_SPARK = 24
"""Tests of a small trend."""


def change_json(verdict: ChangeVerdict) -> dict[str, Any]:
    """The document of a verdict on a series."""
    return document("elastogeo.change/1", {**change_entries(verdict), "verdict": verdict_entries(verdict.verdict)})


def change_entries(verdict: ChangeVerdict) -> dict[str, Any]:
    """What the document says but for its checks."""
    worst = worst_of(verdict)
    return {
        "machine": machine_of(verdict),
        "series": series_said(verdict),
        "simulated": verdict.series.simulated,
        **answer_entries(verdict),
        "alarm": _alarm(verdict),
        "indicators": indicator_entries(verdict),
        "chart": None if worst is None else chart_entries(verdict, worst),
        "causes": [
            {
                "component": cause.component,
                "share": cause.share,
                "score": cause.score,
                "supported_by": cause.supported_by,
                "against": cause.against,
                "alike": cause.alike,
            }
            for cause in verdict.causes
        ],
        "baseline": None
        if verdict.baseline is None
        else {"tests": verdict.baseline.tests, "since": iso_date(verdict.baseline.since)},
        "alpha": verdict.alpha,
        "judged_at": iso_date(verdict.now),
    }


def answer_entries(verdict: ChangeVerdict) -> dict[str, Any]:
    """The answer."""
    return {
        "state": verdict.state,
        "since": iso_date(verdict.since),
        "sentence": sentence_of_change(verdict),
        "points_to": points_to(verdict),
        "cannot_tell": verdict.cannot_tell,
        "next": next_action(verdict),
        "next_test": None if verdict.due is None else iso_date(verdict.due.at),
        "waiting_for_repeat_of": verdict.waiting,
        "repeat_by": iso_date(verdict.repeat_by),
    }


def indicator_entries(verdict: ChangeVerdict) -> list[dict[str, Any]]:
    """Every indicator."""
    column = {name: k for k, name in enumerate(verdict.series.indicators)}
    return [
        {
            "code": one.name,
            "kind": one.kind.name,
            "unit": one.kind.unit,
            "now": one.now,
            "u": one.standard_uncertainty,
            "mean": one.mean,
            "s": one.deviation,
            "df": one.degrees_of_freedom,
            "limit": one.limit,
            "relevance": one.relevance,
            "change": one.change,
            "change95": one.change_interval,
            "state": one.state,
            "since": None if one.change_point is None else iso_date(one.change_point.date),
            "since95": None if one.change_point is None else [iso_date(day) for day in one.change_point.interval],
            "shape": one.shape,
            "drift": drift_entry(one.drift),
            "spark": verdict.series.value[~verdict.series.aside, column[one.name]][-_SPARK:],
        }
        for one in verdict.indicators
    ]


def drift_entry(drift: Drift | None) -> dict[str, Any] | None:
    """How fast; null where there is no drift."""
    if drift is None:
        return None
    return {
        "per_year": drift.per_year,
        "per_year95": drift.interval,
        "since": iso_date(drift.since),
        "tests": drift.tests,
        "limit": drift.limit,
        "limit_is": drift.limit_is,
        "limit_at": iso_date(drift.limit_at),
        "limit_at95": [iso_date(day) for day in drift.limit_at_interval],
    }


def chart_entries(verdict: ChangeVerdict, one: IndicatorState) -> dict[str, Any]:
    """The trend of one indicator."""
    points = points_of(verdict, one)
    return {
        "indicator": one.name,
        "unit": one.kind.unit,
        "points": [
            {
                "test": point.test,
                "date": iso_date(point.date),
                "value": point.value,
                "u": point.standard_uncertainty,
                "temperature": point.temperature,
                "mark": point.mark,
                "why": point.why,
                "instrument": verdict.series.instruments[point.place],
            }
            for point in points
        ],
        "baseline": None
        if verdict.baseline is None
        else {"tests": len(verdict.baseline.tests), "mean": one.mean, "s": one.deviation, "df": one.degrees_of_freedom},
        "expected": one.expected,
        "running_mean": one.running_mean,
        "tolerance": {"lower": one.lower, "upper": one.upper},
        "drift": drift_entry(one.drift),
        "events": event_entries(verdict.events),
    }


def event_entries(events: Iterable[Event]) -> list[dict[str, Any]]:
    """Events by their letters."""
    return [
        {
            "letter": name,
            "date": iso_date(event.date),
            "kind": event.kind,
            "note": event.note,
            "who": event.who,
            "instrument": event.instrument,
        }
        for name, event in lettered(events).items()
    ]


def _alarm(verdict: ChangeVerdict) -> dict[str, Any] | None:
    one = verdict.alarm
    if one is None:
        return None
    return {
        "number": one.number,
        "opened": iso_date(one.opened),
        "acknowledged": iso_date(one.acknowledged),
        "who": one.who,
        "why": one.why,
        "held_by": one.held_by,
    }
