"""The circles of two tests, one over the other at the same magnification."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.changes import CircleTrace, ComparedTests
from elastogeo.machine import Array
from elastogeo.report.days import short_date
from elastogeo.report.drawing.magnified import Scale, around, centre_part, scale_for
from elastogeo.report.drawing.plots import Entry, Plot
from elastogeo.report.drawing.polar import (
    DIRECTIONS,
    SENSES,
    Frame,
    direction_arrow,
    magnified_note,
    ring_shapes,
    trace_line,
)
from elastogeo.report.text import UM
from elastogeo.report.view import Picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE, NARROW = 396.0, 320.0
_SAME = 0.03
"""Share by which two levels that are one differ at most."""
_EARLIER = (5.0, 3.0)
"""Dashes of the earlier test."""


def levels_of(result: ComparedTests) -> tuple[float, ...]:
    """The force levels [N] that both tests have, the highest first, as the later one says them."""
    before = [trace.force for trace in result.traces if not trace.later]
    after = sorted({trace.force for trace in result.traces if trace.later}, key=abs, reverse=True)
    return tuple(force for force in after if any(_alike(force, other) for other in before))


def circle_pictures(result: ComparedTests) -> tuple[Picture, ...]:
    """A picture for each level that both tests have, all at one magnification, the highest level first."""
    levels = levels_of(result)
    if not levels or result.radius is None:
        return ()
    lines = {force: _lines(result, force) for force in levels}
    scale = scale_for(np.concatenate([values for every in lines.values() for _, _, values in every]), result.radius)
    return tuple(_picture(result, force, lines[force], scale) for force in levels)


_Lines = list[tuple[CircleTrace, Array, Array]]


def _picture(result: ComparedTests, force: float, lines: _Lines, scale: Scale) -> Picture:
    at = f" at {force:g} N" if force else ""
    before, after = short_date(result.before.date), short_date(result.after.date)
    return Picture(
        name=f"circles-{force:g}",
        caption=f"Measured{at}: {before} dashed, {after} drawn through; without the offset of the centre. "
        f"{magnified_note(scale)}",
        alternative=f"The circles{at} of both tests, one over the other: {_said(lines)}.",
        draw=lambda: _figure(result, lines, scale),
        plain=lambda: _plain(result, lines, scale, SIZE),
        narrow=lambda: _plain(result, lines, scale, NARROW),
    )


def _said(lines: _Lines) -> str:
    """Ranges of the deviations, for those who cannot see them."""
    ends = [(trace, UM * values.min(), UM * values.max()) for trace, _, values in lines]
    parts = [f"{'later' if of.later else 'earlier'} {SENSES[of.sense]} {low:.1f} to {high:.1f} µm" for of, low, high in ends]
    return "; ".join(parts).replace("-", "−")


def _lines(result: ComparedTests, force: float) -> _Lines:
    """The traces of a level without what the offset of their centres makes; the earlier test last, its dashes on top."""
    chosen = sorted((trace for trace in result.traces if _alike(trace.force, force)), key=lambda trace: not trace.later)
    return [
        (trace, trace.angle, trace.deviation - centre_part(trace.angle, trace.deviation, trace.angle)) for trace in chosen
    ]


def _plain(result: ComparedTests, lines: _Lines, scale: Scale, size: float) -> Plot:
    frame = Frame(scale, size, size)
    drawn = [
        trace_line(
            frame, angle, values, DIRECTIONS[trace.sense], 2.0 if trace.later else 1.5, () if trace.later else _EARLIER
        )
        for trace, angle, values in lines
    ]
    senses = sorted({trace.sense for trace, _, _ in lines}, reverse=True)
    arrows = [shape for sense in senses for shape in direction_arrow(frame, sense)]
    shapes = (*ring_shapes(frame, result.axes), *drawn, *arrows)
    return Plot(size, size, shapes, f"Circles of both tests: {_said(lines)}.", tuple(_legend(result, senses)))


def _legend(result: ComparedTests, senses: list[int]) -> Iterator[Entry]:
    before, after = short_date(result.before.date), short_date(result.after.date)
    for sense in senses:
        yield Entry("line", DIRECTIONS[sense], f"{SENSES[sense]}, {after}")
        yield Entry("dashes", DIRECTIONS[sense], f"{SENSES[sense]}, {before}")


def _figure(result: ComparedTests, lines: _Lines, scale: Scale) -> Figure:
    from elastogeo.report.drawing.circles import division_bar, rings
    from elastogeo.report.drawing.style import BLUE, ORANGE, new_figure

    colours = {1: BLUE, -1: ORANGE}
    figure = new_figure(6.0)
    ax = figure.subplots()
    rings(ax, scale, result.axes, values=True)
    for trace, angle, values in lines:
        style = "-" if trace.later else (0, _EARLIER)
        day = short_date((result.after if trace.later else result.before).date)
        label = f"{SENSES[trace.sense]}, {day}"
        ax.plot(
            *around(angle, values, scale, len(lines)),
            color=colours[trace.sense],
            linewidth=1.2,
            linestyle=style,
            label=label,
        )
    division_bar(ax, scale, True)
    ax.legend(loc="upper left", bbox_to_anchor=(0.98, 1.0))
    return figure


def _alike(one: float, other: float) -> bool:
    return abs(one - other) <= _SAME * max(abs(one), abs(other))
