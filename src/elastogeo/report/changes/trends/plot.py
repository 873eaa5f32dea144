"""The trend of an indicator as plain shapes, and its small trend beside a table: what `figures` draws, in a millisecond."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from math import ceil, floor, isfinite, log10

import numpy as np

from elastogeo.changes import ALARM, SUSPECT, WATCH, ChangeVerdict, IndicatorState
from elastogeo.report.changes.events import lettered
from elastogeo.report.changes.points import ASIDE, BASELINE, QUIET, UNJUDGED, Point, points_of
from elastogeo.report.changes.trends.dates import date_ticks
from elastogeo.report.changes.trends.ranges import apart, rows_of_letters, time_shown, values_shown, wall_said, walls_of
from elastogeo.report.changes.words import off_said, shown_unit, title_of, to_place_of, value_said
from elastogeo.report.days import month_said, short_date
from elastogeo.report.drawing.plots import Band, Circle, Entry, Line, Mark, Place, Plot, Shape, Text

_WIDE, _NARROW = (720.0, 410.0), (328.0, 250.0)
"""Width and height [px]."""
_LETTER, _LINE = 7.4, 16.0
"""Width of a letter at most, and height of a line of them [px]."""
_ROWS = 5
"""Of event letters, one below the other, where they would cover each other."""
_MOST_TICKS = 7
_FEW = 90
"""Tests up to which each has a large mark."""
_LAST = 24
"""Tests of a small trend."""
_SMALL = (92.0, 26.0)
"""Width and height of one [px]."""

_LOOKS = {
    BASELINE: ("circle", "blue", "baseline"),
    QUIET: ("circle", "ink", "test, 95 % interval"),
    SUSPECT: ("diamond", "care", "suspect"),
    ALARM: ("square", "bad", "in alarm"),
    ASIDE: ("ring", "soft", "set aside"),
    UNJUDGED: ("cross", "soft", "not judged"),
}


@dataclass
class _Chart:
    """What the parts of a chart share: where time and values lie [px], and what was drawn so far."""

    one: IndicatorState
    days: tuple[float, float]
    values: tuple[float, float]
    size: Place
    left: float
    right: float
    top: float
    bottom: float
    shapes: list[Shape] = field(default_factory=list)
    words: list[tuple[float, str, str]] = field(default_factory=list)
    """Of lines: height, text, kind."""
    legend: list[Entry] = field(default_factory=list)

    @property
    def is_wide(self) -> bool:
        return self.size == _WIDE

    def x(self, day: float) -> float:
        first, last = self.days
        return self.left + (day - first) / (last - first) * (self.right - self.left)

    def y(self, value: float) -> float:
        low, high = self.values
        return self.bottom - (value - low) / (high - low) * (self.bottom - self.top)


def trend_plot(verdict: ChangeVerdict, one: IndicatorState, since: float = -np.inf, narrow: bool = False) -> Plot:
    """One indicator over time.

    Parameters
    ----------
    verdict : ChangeVerdict
    one : IndicatorState
        Of its indicators.
    since : float [d]
        Tests before it are not drawn; all are if that would leave none.
    narrow : bool
        For a phone.
    """
    every = points_of(verdict, one)
    points = tuple(point for point in every if point.date >= since) or every
    days, values = time_shown(verdict, one, points), values_shown(one, points)
    width, height = size = _NARROW if narrow else _WIDE
    chart = _Chart(one, days, values, size, 44.0, width - (8.0 if narrow else 150.0), 44.0, height - 24.0)
    _grid(chart)
    _expected(chart, points)
    _drift(chart)
    _limits(chart)
    _events(chart, verdict)
    _running_mean(chart, points)
    _tests(chart, verdict, points)
    _above(chart, verdict, points)
    _words(chart)
    return Plot(width, height, tuple(chart.shapes), _alternative(verdict, one, points), tuple(chart.legend))


def spark_plot(verdict: ChangeVerdict, one: IndicatorState) -> Plot:
    """The last tests of an indicator, what is expected of one test behind them, the last one marked by its state."""
    width, height = _SMALL
    column = verdict.series.indicators.index(one.name)
    stands = ~verdict.series.aside & np.isfinite(verdict.series.value[:, column])
    value = verdict.series.value[stands, column][-_LAST:]
    expected = one.expected[stands][-_LAST:]
    known = expected[np.isfinite(expected).all(axis=1)]
    if not len(value):
        return Plot(width, height, ())
    every = np.concatenate((value, known.ravel()))
    low, span = float(every.min()), float(np.ptp(every)) or 1.0

    def y(at: float) -> float:
        return float(height - 4 - (at - low) / span * (height - 8))

    shapes: list[Shape] = []
    if len(known):
        below, above = (y(float(end)) for end in known[-1])
        shapes.append(Band(((0, below), (width, below), (width, above), (0, above))))
    x = np.linspace(3, width - 5, len(value)) if len(value) > 1 else [width - 5]
    line = tuple((float(a), y(float(b))) for a, b in zip(x, value, strict=True))
    kind = {ALARM: "bad", SUSPECT: "care", WATCH: "care"}.get(one.state, "ink")
    return Plot(width, height, (*shapes, Line(line, kind, 1.3), Mark(*line[-1], kind, size=3)))


def _grid(chart: _Chart) -> None:
    """Values and dates at their lines."""
    factor = shown_unit(chart.one.kind.unit).factor
    low, high = (value * factor for value in chart.values)
    step = _step((high - low) / _MOST_TICKS)
    for k in range(ceil(low / step), floor(high / step) + 1):
        y = chart.y(k * step / factor)
        chart.shapes.append(Line(((chart.left, y), (chart.right, y)), "line"))
        chart.shapes.append(Text(chart.left - 7, y + 4, _tick(k * step, step), "end"))
    ticks = date_ticks(*chart.days)
    room = (chart.right - chart.left) / max(len(ticks), 1)
    every = 1 if chart.is_wide else max(1, ceil(max(map(len, ticks.values()), default=0) * _LETTER / room))
    for day, words in list(ticks.items())[::every]:
        x, half = chart.x(day), len(words) * _LETTER / 2
        chart.shapes.append(Line(((x, chart.bottom), (x, chart.bottom + 5)), "soft"))
        chart.shapes.append(Text(min(max(x, half), chart.size[0] - half), chart.bottom + 19, words, "middle"))


def _step(least: float) -> float:
    """The least of 1, 2, 5 times a power of ten that is not below `least`."""
    power = 10.0 ** floor(log10(least))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= least * (1 - 1e-9))


def _tick(value: float, step: float) -> str:
    places = max(-floor(log10(step) + 1e-9), 0)
    return f"{value:.{places}f}".replace("-", "−")


def _expected(chart: _Chart, points: Sequence[Point]) -> None:
    """Within which one test is expected, drawn on to the end of what is shown."""
    one = chart.one
    shown = [(point.date, *one.expected[point.place]) for point in points]
    known = [(day, float(low), float(high)) for day, low, high in shown if isfinite(low) and isfinite(high)]
    if not known:
        return
    known.append((chart.days[1], *known[-1][1:]))
    upper = [(chart.x(day), chart.y(high)) for day, _, high in known]
    lower = [(chart.x(day), chart.y(low)) for day, low, _ in known]
    chart.shapes.append(Band((*upper, *reversed(lower))))
    chart.legend.append(Entry("area", "band", "expected of one test, if nothing changed"))
    if isfinite(one.mean):
        y = chart.y(one.mean)
        chart.shapes.append(Line(((chart.x(known[0][0]), y), (chart.right, y)), "blue"))
        if chart.is_wide:
            chart.words.append((y, f"baseline {value_said(one, one.mean)}", "blue"))


def _drift(chart: _Chart) -> None:
    """The line of the drift, and the cone within which it goes on."""
    drift = chart.one.drift
    if drift is None:
        return
    end = chart.days[1]

    def at(slope: float, day: float) -> Place:
        return chart.x(day), chart.y(drift.at_end + slope / 365.2425 * (day - drift.end))

    low, high = (at(slope, end) for slope in drift.interval)
    cone = _within((at(0.0, drift.end), low, high), chart.top, chart.bottom)
    line = _within((at(drift.per_year, max(drift.since, chart.days[0])), at(drift.per_year, end)), chart.top, chart.bottom)
    if cone:
        chart.shapes.append(Band(tuple(cone), "cone"))
    if len(line) > 1:
        chart.shapes.append(Line(tuple(line[:2]), "orange", 1.6))
    shown = shown_unit(chart.one.kind.unit)
    half = (drift.interval[1] - drift.interval[0]) / 2 * shown.factor
    said = f"drift {to_place_of(drift.per_year * shown.factor, half)} {shown.name} a year"
    if drift.limit_at is not None:
        said = f"{said}; limit reached in {month_said(drift.limit_at)} if it goes on"
    chart.legend.append(Entry("line", "orange", said))


def _within(points: Sequence[Place], top: float, bottom: float) -> list[Place]:
    """What of a closed line lies between two heights [px] (Sutherland and Hodgman 1974)."""
    found = list(points)
    for edge, side in ((top, 1.0), (bottom, -1.0)):
        kept: list[Place] = []
        for k, (x, y) in enumerate(found):
            before = found[k - 1]
            inside, was = side * (y - edge) >= 0, side * (before[1] - edge) >= 0
            if inside != was:
                share = (edge - before[1]) / (y - before[1])
                kept.append((before[0] + share * (x - before[0]), edge))
            if inside:
                kept.append((x, y))
        found = kept
    return found


def _limits(chart: _Chart) -> None:
    """What must not be passed; a limit that is far off is named at the edge."""
    for wall in walls_of(chart.one):
        y, is_set = chart.y(wall), wall in (chart.one.lower, chart.one.upper)
        inside = chart.top <= y <= chart.bottom
        kind = "bad" if is_set else "soft"
        if inside:
            pen = (1.6, (7.0, 4.0)) if is_set else (1.0, (2.0, 3.0))
            chart.shapes.append(Line(((chart.left, y), (chart.right, y)), kind, *pen))
        arrow = "" if inside else " ↑" if y < chart.top else " ↓"
        said = f"{wall_said(chart.one, wall)} {value_said(chart.one, wall)}{arrow}"
        chart.words.append((min(max(y, chart.top), chart.bottom), said, kind))


def _running_mean(chart: _Chart, points: Iterable[Point]) -> None:
    mean = chart.one.running_mean
    known = tuple((chart.x(p.date), chart.y(float(mean[p.place]))) for p in points if isfinite(mean[p.place]))
    if known:
        chart.shapes.append(Line(known, "blue", 1.6))
        chart.legend.append(Entry("line", "blue", "running mean"))


def _tests(chart: _Chart, verdict: ChangeVerdict, points: Sequence[Point]) -> None:
    """Each test with its mark and its interval; one that is set aside far off is at the edge."""
    size = 3.6 if chart.is_wide and len(points) <= _FEW else 2.4
    drawn: list[Mark] = []
    for point in points:
        if not isfinite(point.value):
            continue
        shape, kind, _ = _LOOKS[point.mark]
        mark = Mark(
            chart.x(point.date), chart.y(point.value), kind, shape, size, _said(verdict, chart.one, point), link=point.test
        )
        if not chart.top <= mark.y <= chart.bottom:
            above = mark.y < chart.top
            drawn.append(replace(mark, y=chart.top if above else chart.bottom, shape="up" if above else "down"))
            continue
        u = point.standard_uncertainty
        if point.mark != ASIDE and isfinite(u):
            low, high = chart.y(point.value - 2 * u), chart.y(point.value + 2 * u)
            mark = replace(mark, low=min(low, chart.bottom), high=max(high, chart.top))
        drawn.append(mark)
    chart.shapes += drawn
    there = {point.mark for point in points if isfinite(point.value)}
    chart.legend[:0] = [Entry(shape, kind, words) for mark, (shape, kind, words) in _LOOKS.items() if mark in there]


def _said(verdict: ChangeVerdict, one: IndicatorState, point: Point) -> str:
    """`11 Jun 2026: 15.53 N/µm, −3.5 %, air 21.4 °C; in alarm`."""
    unit = shown_unit(one.kind.unit)
    off = point.value - one.mean
    parts = [f"{value_said(one, point.value)} {unit.name}"]
    if isfinite(off) and point.mark != BASELINE:
        parts.append(f"{off_said(one, off)} off the baseline")
    if isfinite(point.temperature):
        parts.append(f"{point.temperature:.1f} °C")
    if serial := verdict.series.instruments[point.place]:
        parts.append(f"instrument {serial}")
    what = "" if point.mark == QUIET else f"; {_LOOKS[point.mark][2]}"
    return f"{short_date(point.date)}: {', '.join(parts)}{what}{f': {point.why}' if point.why else ''}"


def _events(chart: _Chart, verdict: ChangeVerdict) -> None:
    """A letter for each event that lies in the time shown, one above the other where they would cover each other."""
    first, last = chart.days
    shown = {name: event.date for name, event in lettered(verdict.events).items() if first <= event.date <= last}
    near = 20 / (chart.right - chart.left) * (last - first)
    for (name, day), row in zip(shown.items(), rows_of_letters(shown.values(), near, _ROWS), strict=True):
        x = chart.x(day)
        chart.shapes.append(Line(((x, chart.top), (x, chart.bottom)), "soft", 1.0, (2.0, 3.0)))
        if row is not None:
            x, y = max(x, chart.left + 4), chart.bottom - 12 - 20 * row
            chart.shapes.append(Circle(x, y, 9, "soft", filled=True))
            chart.shapes.append(Text(x, y + 4, name, "middle", "paper", strong=True, size=12))


def _above(chart: _Chart, verdict: ChangeVerdict, points: Sequence[Point]) -> None:
    """The unit, a bar over the tests of the baseline, and when the alarm, or the suspicion, began."""
    unit = shown_unit(chart.one.kind.unit).name
    chart.shapes.append(Text(0, 14, unit, kind="ink"))
    taken = len(unit) * _LETTER + 8
    days = [point.date for point in points if point.mark == BASELINE]
    if days:
        words = f"baseline: {len(days)} test{'' if len(days) == 1 else 's'}"
        x, end = chart.x(min(days)), chart.x(max(days))
        chart.shapes.append(Line(((x, chart.top - 8), (max(end, x + 4), chart.top - 8)), "blue", 4.0))
        start = min(max(x, 0.0), chart.size[0] - len(words) * _LETTER)
        chart.shapes.append(Text(start, chart.top - 14, words, kind="blue"))
    if (
        chart.one.state not in (ALARM, SUSPECT)
        or verdict.since is None
        or not chart.days[0] <= verdict.since <= chart.days[1]
    ):
        return
    x, kind = chart.x(verdict.since), "bad" if chart.one.state == ALARM else "care"
    chart.shapes.append(Line(((x, 18), (x, chart.bottom)), kind))
    words = f"{verdict.state} {short_date(verdict.since)}"
    half = len(words) * (_LETTER + 1.0) / 2
    middle = min(max(x, taken + half), chart.size[0] - half)
    chart.shapes.append(Text(middle, 14, words, "middle", kind, strong=True))


def _words(chart: _Chart) -> None:
    """The names of the lines, at the right edge, moved apart where they would cover each other; on a phone above them."""
    wanted = sorted(chart.words)
    for place, (_, words, kind) in zip(apart([y / _LINE for y, _, _ in wanted]), wanted, strict=True):
        if chart.is_wide:
            chart.shapes.append(Text(chart.right + 6, place * _LINE + 4, words, kind=kind))
        else:
            chart.shapes.append(Text(chart.right - 4, place * _LINE - 4, words, "end", kind))


def _alternative(verdict: ChangeVerdict, one: IndicatorState, points: Sequence[Point]) -> str:
    said = f"{title_of(one.name)} of {len(points)} test{'' if len(points) == 1 else 's'}"
    if points:
        ends = dict.fromkeys(short_date(day) for day in (points[0].date, points[-1].date))
        said = f"{said}, {' to '.join(ends)}"
    unit = shown_unit(one.kind.unit).name
    now = f", now {value_said(one, one.now)} {unit}" if isfinite(one.now) else ""
    base = f", baseline {value_said(one, one.mean)} {unit}" if isfinite(one.mean) else ""
    return f"{said}{base}{now}: {verdict.state if one.state == ALARM else one.state}."
