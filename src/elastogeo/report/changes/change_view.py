"""The view of a verdict on one series: the trend of what changed most, what it means, what to do next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import inf, isfinite
from typing import TYPE_CHECKING, Any

from elastogeo.changes import ALARM, DRIFT, NO_BASELINE, SUSPECT, ChangeVerdict, IndicatorState, as_suspected
from elastogeo.estimate import Estimate
from elastogeo.report.changes.answers import (
    advice,
    cannot_tell,
    component_said,
    machine_of,
    points_to,
    sentence_of_change,
    series_said,
    worst_of,
)
from elastogeo.report.changes.document import change_json
from elastogeo.report.changes.points import test_said
from elastogeo.report.changes.rows import cause_table, event_table, indicator_table, resolves_said, test_table
from elastogeo.report.changes.trends.plot import trend_plot
from elastogeo.report.changes.words import (
    MARKS,
    TONES,
    change_interval_said,
    change_said,
    predicate,
    shown_unit,
    title_of,
    value_said,
)
from elastogeo.report.days import date_said, month_said, short_date, simulated_said
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.later import Later, LaterRows
from elastogeo.report.numbers import pretty, said_estimate, value_with_uncertainty
from elastogeo.report.view import Badge, KeyValue, Picture, Section, View, said, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@views(ChangeVerdict)
def change_view(verdict: ChangeVerdict) -> View:
    """All that is shown of a verdict."""
    return told(verdict, Later(lambda: change_json(verdict)))


def told(verdict: ChangeVerdict, document: Mapping[str, Any]) -> View:
    """All that is shown of a verdict, with this document."""
    worst = worst_of(verdict)
    return View(
        kind="Change",
        title=machine_of(verdict),
        subtitle=subtitle(verdict),
        origin=simulated_said(verdict.series.simulated),
        badge=badge(verdict),
        head=tuple(_head(verdict)),
        sentence=sentence_of_change(verdict),
        strong=strong_words(verdict, worst),
        advice=advice(verdict),
        values=() if worst is None else tuple(_values(verdict, worst)),
        picture=None if worst is None or not len(verdict.series) else trend_picture(verdict, worst),
        checks=said(verdict.verdict),
        document=document,
        rows=LaterRows(lambda: document["indicators"]),
        tables=(indicator_table(verdict),) if verdict.indicators else (),
        sections=tuple(sections(verdict, worst)),
    )


def strong_words(verdict: ChangeVerdict, worst: IndicatorState | None) -> tuple[str, ...]:
    """What the answer is about: the change, and what it points to."""
    seen = as_suspected(verdict) or worst
    if verdict.state not in (ALARM, SUSPECT) or seen is None:
        return ()
    change = predicate(seen).removeprefix("is ").removeprefix("has ")
    return (change, *(component_said(one).removeprefix("the ") for one in points_to(verdict)))


def subtitle(verdict: ChangeVerdict) -> str:
    """The series, where the title is the machine."""
    tests = len(verdict.series)
    count = f"{tests} test{'' if tests == 1 else 's'}"
    return f"{series_said(verdict)}, {count}" if verdict.series.machine else count


def badge(verdict: ChangeVerdict) -> Badge:
    """The state in words and shape, since when, and whether a person knows."""
    since = f" since {date_said(verdict.since)}" if verdict.state in (ALARM, SUSPECT) and verdict.since is not None else ""
    known = "" if verdict.alarm is None else f", {'not ' if verdict.alarm.acknowledged is None else ''}acknowledged"
    sure = "" if verdict.state != ALARM or verdict.is_confirmed else ", unconfirmed"
    return Badge(MARKS[verdict.state], f"{title_of(verdict.state)}{since}{sure}{known}", TONES[verdict.state])


def trend_picture(verdict: ChangeVerdict, one: IndicatorState, name: str = "trend", since: float = -inf) -> Picture:
    """One indicator over time; as plain shapes its tests since a day [d]."""
    off = f" It is {verdict.state}." if verdict.baseline is not None else ""
    return Picture(
        name,
        f"{title_of(one.name)} over time. {_caption(verdict, one)}",
        f"{title_of(one.name)} of {len(verdict.series)} tests over time.{off}",
        lambda: _drawn("trend_figure", verdict, one),
        plain=lambda: trend_plot(verdict, one, since),
        narrow=lambda: trend_plot(verdict, one, since, narrow=True),
    )


def _caption(verdict: ChangeVerdict, one: IndicatorState) -> str:
    parts = []
    if verdict.baseline is not None and isfinite(one.limit):
        parts.append("Shaded: where one test is expected if nothing changed; the running mean finds smaller changes.")
    if verdict.events:
        parts.append("Letters are events, listed below.")
    return " ".join(parts)


def _values(verdict: ChangeVerdict, one: IndicatorState) -> Iterator[KeyValue]:
    shown = shown_unit(one.kind.unit)
    if isfinite(one.now):
        now = _now(one)
        meaning = "last test, with the scatter between tests" if "±" in now else "last test"
        yield KeyValue(title_of(one.name), now, shown.name, meaning)
    if isfinite(one.mean):
        yield KeyValue("Baseline", value_said(one, one.mean), shown.name, _of_tests(verdict))
    if isfinite(one.change) and verdict.state != NO_BASELINE and verdict.steps:
        seen = as_suspected(verdict) or one
        number, _, unit = change_said(seen).rpartition(" ")
        yield KeyValue("Change", number, unit, f"95 %: {change_interval_said(seen)}")
    if one.change_point is not None:
        low, high = one.change_point.interval
        yield KeyValue("Since", date_said(one.change_point.date), "", f"95 %: {date_said(low)} to {date_said(high)}")
    if one.drift is not None and (one.state != ALARM or one.shape == DRIFT):
        yield _drift_value(one)
    elif one.state not in (ALARM, SUSPECT) and resolves_said(one):
        number, _, unit = resolves_said(one).rpartition(" ")
        yield KeyValue("Seen by one test", number, unit, "from this change on; the running mean shows smaller ones")


def _now(one: IndicatorState) -> str:
    """The last value with U of 95 % from the scatter between tests, as one test repeats it."""
    factor = shown_unit(one.kind.unit).factor
    if not (isfinite(one.deviation) and one.deviation > 0 and one.degrees_of_freedom > 0):
        return value_said(one, one.now)
    scatter = Estimate(one.now * factor, one.deviation * factor, one.degrees_of_freedom)
    return pretty(said_estimate(scatter))


def _of_tests(verdict: ChangeVerdict) -> str:
    if verdict.baseline is None:
        return ""
    own = set(verdict.baseline.tests)
    tests = sum(test in own and not out for test, out in zip(verdict.series.tests, verdict.series.aside, strict=True))
    return f"{tests} test{'' if tests == 1 else 's'}"


def _drift_value(one: IndicatorState) -> KeyValue:
    drift = one.drift
    assert drift is not None
    shown = shown_unit(one.kind.unit)
    half = (drift.interval[1] - drift.interval[0]) / 2
    at = "limit passed" if isfinite(drift.limit) else ""
    if drift.limit_at is not None:
        at = f"limit reached in {month_said(drift.limit_at)} if it goes on"
    speed = pretty(value_with_uncertainty(drift.per_year * shown.factor, half * shown.factor))
    return KeyValue("Drift", speed, f"{shown.name}/year", at)


def _head(verdict: ChangeVerdict) -> Iterator[tuple[str, str]]:
    series = verdict.series
    if len(series):
        yield "Tests", f"{len(series)}, {_span([float(day) for day in series.date])}"
    if verdict.baseline is not None and verdict.baseline.tests:
        base = [float(day) for test, day in zip(series.tests, series.date, strict=True) if test in verdict.baseline.tests]
        yield "Baseline", ", ".join(filter(None, (_of_tests(verdict), _span(base))))
    if series.simulated:
        yield "Data", "simulated"
    instruments = ", ".join(dict.fromkeys(filter(None, series.instruments)))
    if instruments:
        yield "Instruments", instruments
    if verdict.due is not None and verdict.due.at is not None:
        yield "Next test", f"{verdict.due.state}, {date_said(verdict.due.at)}"
    if verdict.alarm is not None and verdict.alarm.why:
        yield "Acknowledged", f"{verdict.alarm.who}, {date_said(verdict.alarm.acknowledged)}: {verdict.alarm.why}"
    yield "Judged on", date_said(verdict.now)


def _span(days: list[float]) -> str:
    return " to ".join(dict.fromkeys((short_date(days[0]), short_date(days[-1])))) if days else ""


def sections(verdict: ChangeVerdict, worst: IndicatorState | None) -> Iterator[Section]:
    """All below the first screen."""
    if verdict.indicators:
        yield Section("Indicators", tables=(indicator_table(verdict),))
    causes = cause_table(verdict)
    if causes is not None:
        yield Section("What the change points to", tables=(causes,), points=cannot_tell(verdict))
    events = event_table(verdict)
    if events is not None:
        yield Section("What happened", tables=(events,))
    if len(verdict.series) and len(verdict.indicators) > 1:
        yield Section("Every indicator over time", pictures=(_every_picture(verdict),))
    if worst is not None and len(verdict.series):
        yield Section("Tests", tables=(test_table(verdict, worst, 0),))
    yield Section("How it is judged", points=tuple(_how(verdict)))


def _every_picture(verdict: ChangeVerdict) -> Picture:
    return Picture(
        "indicators",
        "Every indicator over time; marks and lines as above.",
        f"The trends of {len(verdict.indicators)} indicators",
        lambda: _drawn("every_figure", verdict),
    )


def _how(verdict: ChangeVerdict) -> Iterator[str]:
    number = len(verdict.indicators)
    if verdict.baseline is not None and number:
        yield (
            f"Each test is judged by itself and by a running mean, over {number} indicator{'' if number == 1 else 's'}. "
            f"Of the tests of a machine that has not changed {100 * verdict.alpha:.2g} % are suspect. Only a repeat, or a "
            f"week without one, makes an alarm."
        )
        yield (
            "The scatter between the tests of the baseline sets the limits, together with what is usual for the kind; the "
            "uncertainty that the tests state is its floor."
        )
    if verdict.baseline is not None:
        yield "The baseline is frozen: a person sets it, and sets another after a repair."
    for test, why in verdict.not_judged.items():
        yield f"{title_of(test_said(verdict, test))} is not judged: {why}."
    yield "Indicators are what the test determines by itself; a parameter that is only known in a sum is none."


def _drawn(name: str, *parts: object) -> Figure:
    with needs_report_extra():
        from elastogeo.report.changes.trends import figures
    figure: Figure = getattr(figures, name)(*parts)
    return figure
