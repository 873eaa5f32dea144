"""Measured and predicted traces around the circle, and what is left between them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MultipleLocator

from elastogeo.identification import Identification, Trace
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import (
    Scale,
    around,
    centre_part,
    division_bar,
    is_angular,
    nominal_radius,
    plane_axes,
    pose_axis,
    rings,
    scale_for,
)
from elastogeo.report.drawing.style import (
    BLUE,
    GREY,
    INK,
    SMALL,
    direction_colours,
    force_colours,
    grid,
    new_figure,
    thinned,
)
from elastogeo.report.numbers import significant
from elastogeo.report.text import UM

_SENSES = {1: "CCW", -1: "CW"}
_ARROW_AT, _ARROW = np.radians(135.0), np.radians(14.0)
"""Angle [rad] about which the arrows of direction stand, outside the rings, and half the angle that they span."""


def traces_figure(result: Identification) -> Figure:
    """Measured and predicted readings of every level: around the nominal circle, or along what the run counts."""
    return _around(result) if is_angular(result) else _along(result)


def residuals_figure(result: Identification) -> Figure:
    """Measured minus predicted readings [µm] of every level."""
    levels = [level.force for level in result.levels]
    figure, axes = grid(len(levels), 2 if len(levels) > 3 else 1, 1.25 if len(levels) > 1 else 2.0, sharey=True)
    largest = max(float(np.abs(t.measured - t.predicted).max()) for t in result.traces) * UM or 1.0
    label, factor = pose_axis(result)
    for ax, level in zip(axes, result.levels, strict=True):
        for trace, again in of_level(result, level.force):
            pose, left = thinned(trace.pose, (trace.measured - trace.predicted) * UM, len(result.traces))
            ax.plot(pose * factor, left, color=BLUE, linewidth=0.35 if again else 0.6, alpha=0.45 if again else 1.0)
        ax.axhline(0, color=INK, linewidth=0.6)
        ax.set_ylim(-1.1 * largest, 1.1 * largest)
        ax.set_title(f"{level.force:g} N", loc="left", fontweight="bold", pad=3)
        ax.set_title(f"RMSE {significant(level.rmse * UM)} µm", loc="right", fontsize=SMALL, color=GREY, pad=3)
        if is_angular(result):
            ax.xaxis.set_major_locator(MultipleLocator(90))
        ax.margins(x=0.01)
    figure.supxlabel(label, fontsize=8.5)
    figure.supylabel("measured − predicted (µm)", fontsize=8.5)
    return figure


def of_level(result: Identification, force: float) -> Iterator[tuple[Trace, bool]]:
    """The traces of a level, each with whether it repeats one; repeats first, so that they are drawn below."""
    chosen = [trace for trace in result.traces if trace.force == force]
    yield from ((trace, True) for trace in chosen[1:])
    yield chosen[0], False


def _around(result: Identification) -> Figure:
    figure = new_figure(6.0)
    ax = figure.subplots()
    drawn = [_centred(trace) for trace in result.traces]
    every = np.concatenate([values for trace in drawn for values in (trace.measured, trace.predicted)])
    scale = scale_for(every, nominal_radius(result) or 1.0)
    rings(ax, scale, plane_axes(result), values=True)
    senses = {run.name: run.sense for run in result.test.runs}
    forces = [level.force for level in result.levels]
    colours = {sense: direction_colours(forces, sense) for sense in sorted({senses[t.run] for t in drawn}, reverse=True)}
    seen: set[tuple[float, int]] = set()
    for trace in sorted(drawn, key=lambda trace: abs(trace.force)):
        force = min(forces, key=lambda level: abs(level - trace.force))
        sense = senses[trace.run]
        again = (force, sense) in seen
        seen.add((force, sense))
        _draw(ax, trace, scale, colours[sense][force], len(drawn), again)
    for sense in colours:
        strongest = max((trace for trace in drawn if senses[trace.run] == sense), key=lambda trace: abs(trace.force))
        _direct(ax, strongest, scale, colours[sense][max(forces, key=abs)], sense)
    division_bar(ax, scale, nominal_radius(result) is not None)
    _legend(ax, colours, result.reference_force)
    return figure


def _centred(trace: Trace) -> Trace:
    """The trace without what the offset of its centre makes of the readings."""
    part = centre_part(trace.pose, trace.measured)
    return replace(trace, measured=trace.measured - part, predicted=trace.predicted - part)


def _draw(ax: Axes, trace: Trace, scale: Scale, colour: str, traces: int, again: bool) -> None:
    measured = around(trace.pose, trace.measured, scale, traces)
    ax.plot(*measured, color=colour, linewidth=0.4 if again else 1.9, alpha=0.6 if again else 1.0, zorder=3)
    if not again:
        predicted = around(trace.pose, trace.predicted, scale, traces)
        ax.plot(*predicted, color=INK, linewidth=0.7, linestyle=(0, (4, 3)), zorder=4)


def _direct(ax: Axes, trace: Trace, scale: Scale, colour: str, sense: int) -> None:
    """Where a trace begins, and which way it goes."""
    r = scale.radius + scale.magnification * trace.measured
    x, y = r * np.cos(trace.pose), r * np.sin(trace.pose)
    outside = scale.limit * (1.02 if sense > 0 else 1.06)
    start = 0 if (trace.pose[-1] - trace.pose[0]) * sense >= 0 else len(x) - 1
    ax.plot([x[start]], [y[start]], marker="o", markersize=5.5, color=colour, markeredgecolor=INK, zorder=6)
    ends = outside * np.exp(1j * (_ARROW_AT + sense * np.array([-_ARROW, _ARROW])))
    arrow = {
        "arrowstyle": "-|>",
        "color": colour,
        "linewidth": 1.8,
        "mutation_scale": 13,
        "connectionstyle": f"arc3,rad={0.12 * sense}",
    }
    ax.annotate("", xy=(ends[1].real, ends[1].imag), xytext=(ends[0].real, ends[0].imag), arrowprops=arrow, zorder=6)


def _legend(ax: Axes, colours: dict[int, dict[float, str]], reference: float | None) -> None:
    handles = [
        Line2D([], [], color=colour, linewidth=2.2, label=f"{_SENSES[sense]}, {force:g} N" if force else _SENSES[sense])
        for sense, by_force in colours.items()
        for force, colour in list(by_force.items())[::-1]
    ]
    handles += [
        Line2D([], [], color=INK, linewidth=0.9, linestyle=(0, (4, 2)), label="predicted"),
        Line2D([], [], color=GREY, linewidth=1.1, label="nominal circle"),
        Line2D([], [], color=GREY, marker="o", linestyle="", markersize=5, label="start"),
    ]
    title = "measured, centre removed" if reference is None else f"over {reference:g} N, centre removed"
    ax.legend(
        handles=handles,
        loc="center left",
        bbox_to_anchor=(1.06, 0.5),
        title=title,
        title_fontproperties={"weight": "bold", "size": SMALL},
        alignment="left",
        labelspacing=0.6,
    )


def _along(result: Identification) -> Figure:
    figure = new_figure(3.6)
    ax = figure.subplots()
    label, factor = pose_axis(result)
    for force, colour in force_colours([level.force for level in result.levels]).items():
        for trace, again in of_level(result, force):
            pose, measured = _broken(*thinned(trace.pose, trace.measured * UM, len(result.traces)))
            name = "_" if again else f"{force:g} N"
            ax.plot(pose * factor, measured, color=colour, linewidth=0.4 if again else 1.6, label=name)
            pose, predicted = _broken(*thinned(trace.pose, trace.predicted * UM, len(result.traces)))
            ax.plot(pose * factor, predicted, color=INK, linewidth=0.7, linestyle=(0, (4, 3)), label="_")
    ax.plot([], [], color=INK, linewidth=0.7, linestyle=(0, (4, 3)), label="predicted")
    ax.set_xlabel(label)
    ax.set_ylabel("reading (µm)")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _broken(pose: Array, values: Array) -> tuple[Array, Array]:
    """A line that breaks where the next sensor begins: where the pose jumps back over more than half of its span."""
    back = np.flatnonzero(np.abs(np.diff(pose)) > np.ptp(pose) / 2) + 1
    return np.insert(pose, back, np.nan), np.insert(values, back, np.nan)
