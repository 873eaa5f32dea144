"""The trend of an indicator: its tests, its baseline, what is expected of one test, the running mean, where it is going."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from elastogeo.changes import ALARM, SUSPECT, ChangeVerdict, Event, IndicatorState
from elastogeo.report.changes.events import lettered
from elastogeo.report.changes.points import ASIDE, BASELINE, UNJUDGED, Point, points_of
from elastogeo.report.changes.trends.dates import date_ticks
from elastogeo.report.changes.trends.ranges import apart, rows_of_letters, time_shown, values_shown, wall_said, walls_of
from elastogeo.report.changes.words import change_said, marked, shown_unit, title_of, value_said
from elastogeo.report.days import short_date
from elastogeo.report.drawing.style import BLUE, GREY, INK, ORANGE, READABLE, SMALL, multiples

_HEIGHT = 4.1
_LEFT, _RIGHT, _TOP, _BOTTOM = 0.52, 1.14, 0.36, 0.84
"""Room about the chart [in]: for the values, the words at its right, those above, the dates with the legend."""
_FEW = 60
"""Tests up to which each has a large mark."""
_LINE = 0.155
"""Height of a line of small letters [in]."""
_ROWS = 3
"""Of event letters, one below the other, where they would cover each other."""


@dataclass
class _Chart:
    """What the parts of a chart share."""

    ax: Axes
    factor: float
    words: list[tuple[float, str, str]] = field(default_factory=list)
    """At the right: height, text, colour."""
    handles: list[Line2D | Patch] = field(default_factory=list)


def trend_figure(verdict: ChangeVerdict, one: IndicatorState) -> Figure:
    """One indicator over time."""
    figure = Figure(figsize=(READABLE, _HEIGHT))
    place = (_LEFT / READABLE, _BOTTOM / _HEIGHT, 1 - (_LEFT + _RIGHT) / READABLE, 1 - (_TOP + _BOTTOM) / _HEIGHT)
    shown = shown_unit(one.kind.unit)
    chart = _Chart(figure.add_axes(place), shown.factor)
    points = points_of(verdict, one)
    _time(chart, verdict, one, points)
    _expected(chart, one, points)
    _tests(chart, points, len(points) > _FEW)
    _running_mean(chart, one, points)
    _drift(chart, one)
    _heights(chart, one, points)
    _limits(chart, one)
    _baseline(chart, points)
    _since(chart, one, verdict)
    _events(chart, verdict.events)
    _words(chart)
    chart.ax.set_title(shown.name, loc="left", x=-(_LEFT - 0.08) / (READABLE - _LEFT - _RIGHT), fontsize=SMALL)
    figure.legend(handles=chart.handles, loc="lower left", ncols=3, borderaxespad=0.2, handlelength=1.6, columnspacing=1.4)
    return figure


def _time(chart: _Chart, verdict: ChangeVerdict, one: IndicatorState, points: Sequence[Point]) -> None:
    """The time that is shown."""
    chart.ax.set_xlim(*time_shown(verdict, one, points))
    ticks = date_ticks(*chart.ax.get_xlim())
    chart.ax.set_xticks(list(ticks), list(ticks.values()))


def _expected(chart: _Chart, one: IndicatorState, points: Sequence[Point]) -> None:
    """Within which one test is expected, drawn on to the end of what is shown."""
    low, high = (one.expected[:, side] * chart.factor for side in (0, 1))
    known = np.flatnonzero(np.isfinite(low) & np.isfinite(high))
    if not len(known):
        return
    day = np.array([points[int(k)].date for k in known])
    end = chart.ax.get_xlim()[1]
    day, low, high = np.append(day, end), np.append(low[known], low[known[-1]]), np.append(high[known], high[known[-1]])
    chart.ax.fill_between(day, low, high, color=BLUE, alpha=0.13, linewidth=0, zorder=0)
    chart.handles.append(Patch(facecolor=BLUE, alpha=0.13, label="expected of one test"))
    if isfinite(one.mean):
        chart.ax.plot([day[0], end], [one.mean * chart.factor] * 2, color=BLUE, linewidth=0.7, zorder=1)
        chart.words.append((one.mean * chart.factor, f"baseline {value_said(one, one.mean)}", BLUE))


_LOOKS = {
    BASELINE: ("o", BLUE, True, "baseline"),
    "judged": ("o", INK, True, "test, 95 % interval"),
    SUSPECT: ("D", ORANGE, False, "suspect"),
    ALARM: ("s", ORANGE, True, "in alarm"),
    ASIDE: ("o", GREY, False, "set aside"),
    UNJUDGED: ("x", GREY, True, "not judged"),
}


def _tests(chart: _Chart, points: Iterable[Point], many: bool) -> None:
    """Each test with its mark; the interval by the test itself."""
    by_mark = {mark: [point for point in points if point.mark == mark and isfinite(point.value)] for mark in _LOOKS}
    for mark, (shape, colour, filled, label) in _LOOKS.items():
        found = by_mark[mark]
        if not found:
            continue
        day, value = [point.date for point in found], [point.value * chart.factor for point in found]
        half = [2 * chart.factor * _finite(point.standard_uncertainty) for point in found]
        if mark != ASIDE:
            chart.ax.errorbar(day, value, yerr=half, fmt="none", ecolor=colour, elinewidth=0.7, zorder=2)
        size = 2.2 if many and mark != ALARM else 3.6
        face = colour if filled else "white"
        style: Any = {"marker": shape, "color": colour, "markerfacecolor": face, "markersize": size, "markeredgewidth": 0.9}
        chart.ax.plot(day, value, linestyle="none", zorder=4, **style)
        chart.handles.append(Line2D([], [], linestyle="none", label=label, **style))


def _finite(value: float) -> float:
    return value if isfinite(value) else 0.0


def _running_mean(chart: _Chart, one: IndicatorState, points: Sequence[Point]) -> None:
    known = [k for k in range(len(points)) if isfinite(one.running_mean[k])]
    if known:
        mean = one.running_mean[known] * chart.factor
        chart.ax.plot([points[k].date for k in known], mean, color=BLUE, linewidth=1.3, zorder=3)
        chart.handles.append(Line2D([], [], color=BLUE, linewidth=1.3, label="running mean"))


def _drift(chart: _Chart, one: IndicatorState) -> None:
    """The line of the drift, and the cone within which it goes on."""
    drift = one.drift
    if drift is None:
        return
    end = chart.ax.get_xlim()[1]
    ahead = np.array([drift.end, end])
    slope = np.array([drift.per_year, *drift.interval]) / 365.2425
    line, low, high = ((drift.at_end + s * (ahead - drift.end)) * chart.factor for s in slope)
    start = (drift.at_end + slope[0] * (drift.since - drift.end)) * chart.factor
    chart.ax.fill_between(ahead, low, high, color=ORANGE, alpha=0.16, linewidth=0, zorder=1)
    chart.ax.plot([drift.since, *ahead], [start, *line], color=ORANGE, linewidth=1.0, linestyle=(0, (5, 2)), zorder=2)
    chart.handles.append(Line2D([], [], color=ORANGE, linestyle=(0, (5, 2)), linewidth=1.0, label="drift, if it goes on"))


def _heights(chart: _Chart, one: IndicatorState, points: Sequence[Point], below: float = 0.2) -> None:
    """The values that are shown; tests set aside far off are at the edge."""
    chart.ax.set_ylim(*(chart.factor * value for value in values_shown(one, points, below)))
    bottom, top = chart.ax.get_ylim()
    for point in points:
        at = point.value * chart.factor
        if point.mark == ASIDE and isfinite(at) and not bottom < at < top:
            edge, shape = (top, "^") if at >= top else (bottom, "v")
            chart.ax.plot(point.date, edge, shape, color=GREY, clip_on=False, markersize=4)


def _limits(chart: _Chart, one: IndicatorState) -> None:
    low, high = chart.ax.get_ylim()
    for wall in walls_of(one):
        tolerance, at = wall in (one.lower, one.upper), wall * chart.factor
        inside = low < at < high
        if inside:
            chart.ax.axhline(at, color=INK, linewidth=0.9, linestyle=(0, (4, 2)) if tolerance else (0, (1, 2)), zorder=1)
        arrow = "" if inside else " ↑" if at >= high else " ↓"
        chart.words.append((min(max(at, low), high), f"{wall_said(one, wall)} {value_said(one, wall)}{arrow}", INK))


def _baseline(chart: _Chart, points: Iterable[Point]) -> None:
    """A bar above the tests of the baseline."""
    days = [point.date for point in points if point.mark == BASELINE]
    if not days:
        return
    above, count = chart.ax.get_xaxis_transform(), len(days)
    chart.ax.plot([min(days), max(days)], [1.0, 1.0], color=BLUE, linewidth=2.2, transform=above, clip_on=False)
    words = f"baseline: {count} test{'' if count == 1 else 's'}"
    chart.ax.text(min(days), 1.015, words, color=BLUE, fontsize=SMALL, va="bottom", transform=above)


def _since(chart: _Chart, one: IndicatorState, verdict: ChangeVerdict) -> None:
    """When the alarm, or the suspicion, began."""
    if one.state not in (ALARM, SUSPECT) or verdict.since is None:
        return
    above = chart.ax.get_xaxis_transform()
    chart.ax.axvline(verdict.since, color=ORANGE, linewidth=0.8, zorder=1)
    left, right = chart.ax.get_xlim()
    late = (verdict.since - left) / (right - left) > 0.55
    words = f"{verdict.state} {short_date(verdict.since)}"
    base = [point for point in points_of(verdict, one) if point.mark == BASELINE]
    close = bool(base) and (verdict.since - min(p.date for p in base)) / (right - left) < 0.75
    chart.ax.text(
        verdict.since, 1.015 + (0.05 if close else 0.0), words, color=ORANGE, fontsize=SMALL, fontweight="bold", va="bottom",
        ha="right" if late else "left", transform=above,
    )  # fmt: skip


def _events(chart: _Chart, events: tuple[Event, ...]) -> None:
    """A letter for each event that lies in the time shown, one below the other where they would cover each other."""
    left, right = chart.ax.get_xlim()
    apart_by = 0.2 / (READABLE - _LEFT - _RIGHT) * (right - left)
    above = chart.ax.get_xaxis_transform()
    shown = {name: event.date for name, event in lettered(events).items() if left <= event.date <= right}
    for (name, day), row in zip(shown.items(), rows_of_letters(shown.values(), apart_by, _ROWS), strict=True):
        chart.ax.axvline(day, color=GREY, linewidth=0.7, linestyle=(0, (1, 2)), zorder=0)
        if row is None:
            continue
        ground = {"boxstyle": "circle,pad=0.2", "facecolor": GREY, "edgecolor": "none"}
        style: Any = {"fontsize": 6.5, "color": "white", "ha": "center", "va": "center", "zorder": 6, "bbox": ground}
        chart.ax.text(day, 0.035 + 0.062 * row, name, transform=above, **style)


def _words(chart: _Chart) -> None:
    """The names of the lines at the right edge, moved apart where they would cover each other."""
    low, high = chart.ax.get_ylim()
    tall = (_HEIGHT - _TOP - _BOTTOM) / _LINE
    wanted = sorted(((at - low) / (high - low) * tall, text, colour) for at, text, colour in chart.words)
    for place, (_, text, colour) in zip(apart([at for at, _, _ in wanted]), wanted, strict=True):
        at = (1.02, place / tall)
        chart.ax.text(*at, text, color=colour, fontsize=SMALL, va="center", ha="left", transform=chart.ax.transAxes)


def every_figure(verdict: ChangeVerdict) -> Figure:
    """All indicators over time, each with its baseline and what is expected of one test."""
    figure, axes = multiples(len(verdict.indicators), 2, 1.15, 0.3, "")
    for ax, one in zip(axes, verdict.indicators, strict=True):
        chart, points = _Chart(ax, shown_unit(one.kind.unit).factor), points_of(verdict, one)
        _time(chart, verdict, one, points)
        _expected(chart, one, points)
        _tests(chart, points, many=True)
        _running_mean(chart, one, points)
        _heights(chart, one, points, below=0.07)
        state = f"{marked(one.state)}, {change_said(one)}" if isfinite(one.change) else marked(one.state)
        ax.set_title(f"{title_of(one.name)} ({shown_unit(one.kind.unit).name})", loc="left", fontsize=SMALL)
        ax.set_title(state, loc="right", fontsize=SMALL, color=ORANGE if one.state in (ALARM, SUSPECT) else GREY)
        ax.yaxis.set_major_locator(MaxNLocator(nbins=4))
    return figure
