"""The tests of a series as a chart and a table show them: each with its mark."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.changes import ALARM, SUSPECT, ChangeVerdict, IndicatorState, Step
from elastogeo.report.days import date_said

BASELINE = "baseline"
ASIDE = "set aside"
QUIET = "judged"
UNJUDGED = "not judged"


@dataclass(frozen=True, slots=True)
class Point:
    """One test of a series, for one indicator.

    Attributes
    ----------
    place : int
        In the series.
    test : str
    date : float [d]
    value : float
        In the unit of the kind; NaN where the test does not determine it.
    standard_uncertainty, temperature : float
        NaN where there is none.
    mark : str
        `BASELINE`, `ASIDE`, `QUIET`, `UNJUDGED`, `SUSPECT` or `ALARM`.
    why : str
        Of one that is not judged, why; of a repeat, what it repeats.
    """

    place: int
    test: str
    date: float
    value: float
    standard_uncertainty: float
    temperature: float
    mark: str
    why: str = ""


def points_of(verdict: ChangeVerdict, one: IndicatorState) -> tuple[Point, ...]:
    """The tests of a series for one of its indicators, in their order."""
    return tuple(_points(verdict, one))


def _points(verdict: ChangeVerdict, one: IndicatorState) -> Iterator[Point]:
    column = verdict.series.indicators.index(one.name)
    series, steps = verdict.series, {step.test: step for step in verdict.steps}
    base = frozenset(() if verdict.baseline is None else verdict.baseline.tests)
    for place, test in enumerate(series.tests):
        mark, why = _mark(verdict, one, place, base, steps.get(test))
        yield Point(
            place,
            test,
            float(series.date[place]),
            float(series.value[place, column]),
            float(series.standard_uncertainty[place, column]),
            float(series.temperature[place]),
            mark,
            why,
        )


def _mark(
    verdict: ChangeVerdict, one: IndicatorState, place: int, base: frozenset[str], step: Step | None
) -> tuple[str, str]:
    """A test is marked where it moved this indicator: the others stay as they are in the alarm of one."""
    test = verdict.series.tests[place]
    if verdict.series.aside[place]:
        return ASIDE, verdict.not_judged.get(test, "")
    if test in base:
        return BASELINE, ""
    if step is None:
        return UNJUDGED, verdict.not_judged.get(test, "")
    if step.replaced:
        return ASIDE, f"{test_said(verdict, step.replaced)} took its place"
    why = f"repeats {test_said(verdict, step.repeats)}" if step.repeats else ""
    marked = one.name in step.over or (step.state == one.state == ALARM)
    return (step.state if marked and step.state in (ALARM, SUSPECT) else QUIET), why


def test_said(verdict: ChangeVerdict, test: str) -> str:
    """A test of a series by its date: `the test of 11 June 2026`; its name is a number where it comes from a store."""
    series = verdict.series
    return f"the test of {date_said(float(series.date[series.tests.index(test)]))}" if test in series.tests else test
