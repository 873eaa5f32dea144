"""Measured and predicted traces around the circle, and what is left between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MultipleLocator

from elastogeo.identification import Identification, Trace
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import (
    division_bar,
    is_angular,
    nominal_radius,
    plane_axes,
    pose_axis,
    rings,
)
from elastogeo.report.drawing.magnified import Scale, around, centre_part, scale_for, thinned
from elastogeo.report.drawing.style import (
    BLUE,
    GREY,
    INK,
    SMALL,
    direction_colours,
    force_colours,
    multiples,
    new_figure,
)
from elastogeo.report.numbers import significant
from elastogeo.report.text import reading_unit

_SENSES = {1: "CCW", -1: "CW"}
_ARROW_AT, _ARROW = np.radians(135.0), np.radians(14.0)
"""Angle [rad] about which the arrows of direction stand, outside the rings, and half the angle that they span."""

Predicted = Mapping[str, Sequence[tuple[Array, Array]]]
"""By run the traces that are predicted of it: poses and deviations [mm]."""


def traces_figure(result: Identification) -> Figure:
    """Measured and predicted readings of every level: around the nominal circle, or along what the run counts."""
    predicted = {trace.run: [(trace.pose, trace.predicted)] for trace in result.traces}
    return _drawn(result, result.traces, predicted, "predicted")


def local_traces_figure(result: Identification) -> Figure:
    """Measured readings of one run a level, and what each local estimate that holds the level predicts (4.12, 5.11)."""
    runs = {trace.run: trace for trace in result.traces}
    predicted = {
        one.run: [(one.pose, one.columns @ local.solution.values) for local in result.local if one.force in local.forces]
        for one in result.responses
    }
    return _drawn(result, [runs[one.run] for one in result.responses], predicted, "predicted locally")


def residuals_figure(result: Identification) -> Figure:
    """Measured minus predicted readings of every level."""
    levels = [level.force for level in result.levels]
    label, factor = pose_axis(result)
    unit = reading_unit(result)
    columns, height = 2 if len(levels) > 3 else 1, 0.8 if len(levels) > 1 else 1.4
    figure, axes = multiples(len(levels), columns, height, 0.22, label, f"measured − predicted ({unit.name})", sharey=True)
    largest = max(float(np.abs(t.measured - t.predicted).max()) for t in result.traces) * unit.factor or 1.0
    for ax, level in zip(axes, result.levels, strict=True):
        for trace, again in of_level(result.traces, level.force):
            pose, left = thinned(trace.pose, (trace.measured - trace.predicted) * unit.factor, len(result.traces))
            ax.plot(pose * factor, left, color=BLUE, linewidth=0.35 if again else 0.6, alpha=0.45 if again else 1.0)
        ax.axhline(0, color=INK, linewidth=0.6)
        ax.set_ylim(-1.1 * largest, 1.1 * largest)
        ax.set_title(f"{level.force:g} N", loc="left", fontweight="bold", pad=3)
        ax.set_title(
            f"RMSE {significant(level.rmse * unit.factor)} {unit.name}", loc="right", fontsize=SMALL, color=GREY, pad=3
        )
        if is_angular(result):
            ax.xaxis.set_major_locator(MultipleLocator(90))
        ax.margins(x=0.01)
    return figure


def of_level(traces: Sequence[Trace], force: float) -> Iterator[tuple[Trace, bool]]:
    """The traces of a level, each with whether it repeats one; repeats first, so that they are drawn below."""
    chosen = [trace for trace in traces if trace.force == force]
    yield from ((trace, True) for trace in chosen[1:])
    yield chosen[0], False


def _drawn(result: Identification, traces: Sequence[Trace], predicted: Predicted, name: str) -> Figure:
    if is_angular(result):
        centred = {trace.run: _centred(trace, predicted[trace.run]) for trace in traces}
        return _around(result, traces, centred, name)
    return _along(result, traces, predicted, name)


def _around(result: Identification, drawn: Sequence[Trace], lines: Predicted, name: str) -> Figure:
    """Of each run the measured trace, the first of its lines, and those predicted, all others."""
    figure = new_figure(6.0)
    ax = figure.subplots()
    every = np.concatenate([values for of_run in lines.values() for _, values in of_run])
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
        _draw(ax, lines[trace.run], scale, colours[sense][force], len(drawn), again)
    for sense in colours:
        strongest = max((trace for trace in drawn if senses[trace.run] == sense), key=lambda trace: abs(trace.force))
        _direct(ax, *lines[strongest.run][0], scale, colours[sense][max(forces, key=abs)], sense)
    division_bar(ax, scale, nominal_radius(result) is not None)
    _legend(ax, colours, result.reference_force, name)
    return figure


def _centred(trace: Trace, predicted: Sequence[tuple[Array, Array]]) -> list[tuple[Array, Array]]:
    """The measured trace, then those predicted, without what the offset of its centre makes of the readings."""
    lines = [(trace.pose, trace.measured), *predicted]
    return [(pose, values - centre_part(trace.pose, trace.measured, pose)) for pose, values in lines]


def _draw(ax: Axes, lines: Sequence[tuple[Array, Array]], scale: Scale, colour: str, traces: int, again: bool) -> None:
    measured, *predicted = lines
    width, alpha = (0.4, 0.6) if again else (1.9, 1.0)
    ax.plot(*around(*measured, scale, traces), color=colour, linewidth=width, alpha=alpha, zorder=3)
    for line in () if again else predicted:
        ax.plot(*around(*line, scale, traces), color=INK, linewidth=0.7, linestyle=(0, (4, 3)), zorder=4)


def _direct(ax: Axes, pose: Array, measured: Array, scale: Scale, colour: str, sense: int) -> None:
    """Where a trace begins, and which way it goes."""
    r = scale.radius + scale.magnification * measured
    x, y = r * np.cos(pose), r * np.sin(pose)
    outside = scale.limit * (1.02 if sense > 0 else 1.06)
    start = 0 if (pose[-1] - pose[0]) * sense >= 0 else len(x) - 1
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


def _legend(ax: Axes, colours: dict[int, dict[float, str]], reference: float | None, name: str) -> None:
    handles = [
        Line2D([], [], color=colour, linewidth=2.2, label=f"{_SENSES[sense]}, {force:g} N" if force else _SENSES[sense])
        for sense, by_force in colours.items()
        for force, colour in list(by_force.items())[::-1]
    ]
    handles += [
        Line2D([], [], color=INK, linewidth=0.9, linestyle=(0, (4, 2)), label=name),
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


def _along(result: Identification, traces: Sequence[Trace], lines: Predicted, name: str) -> Figure:
    figure = new_figure(3.6)
    ax = figure.subplots()
    label, factor = pose_axis(result)
    unit = reading_unit(result)
    for force, colour in force_colours([level.force for level in result.levels]).items():
        for trace, again in of_level(traces, force):
            pose, measured = broken(*thinned(trace.pose, trace.measured * unit.factor, len(traces)))
            said = "_" if again else f"{force:g} N"
            ax.plot(pose * factor, measured, color=colour, linewidth=0.4 if again else 1.6, label=said)
            for at, predicted in lines[trace.run]:
                pose, values = broken(*thinned(at, predicted * unit.factor, len(traces)))
                ax.plot(pose * factor, values, color=INK, linewidth=0.7, linestyle=(0, (4, 3)), label="_")
    ax.plot([], [], color=INK, linewidth=0.7, linestyle=(0, (4, 3)), label=name)
    ax.set_xlabel(label)
    ax.set_ylabel(f"reading ({unit.name})")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def broken(pose: Array, values: Array) -> tuple[Array, Array]:
    """A line that breaks where the next sensor begins: where the pose jumps back over more than half of its span."""
    back = np.flatnonzero(np.abs(np.diff(pose)) > np.ptp(pose) / 2) + 1
    return np.insert(pose, back, np.nan), np.insert(values, back, np.nan)
