"""Measured and predicted traces around the circle, and what is left between them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MultipleLocator

from elastogeo.identification import Identification, Trace, same_force
from elastogeo.report.drawing.circles import (
    Scale,
    around,
    division_bar,
    is_angular,
    nominal_radius,
    pose_axis,
    rings,
    scale_for,
)
from elastogeo.report.drawing.style import BLUE, GREY, INK, SMALL, force_colours, grid, new_figure, thinned
from elastogeo.report.numbers import significant
from elastogeo.report.text import UM


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
    chosen = [trace for trace in result.traces if same_force(trace.force, force)]
    yield from ((trace, True) for trace in chosen[1:])
    yield chosen[0], False


def _around(result: Identification) -> Figure:
    figure = new_figure(5.2)
    ax = figure.subplots()
    every = np.concatenate([values for t in result.traces for values in (t.measured, t.predicted)])
    scale = scale_for(every, nominal_radius(result) or 1.0)
    rings(ax, scale)
    colours = _draw_levels(ax, result, scale)
    division_bar(ax, scale, nominal_radius(result) is not None)
    _legend(ax, colours, result.reference_force)
    return figure


def _legend(ax: Axes, colours: dict[float, str], reference: float | None) -> None:
    handles = [Line2D([], [], color=colour, linewidth=2.2, label=f"{force:g} N") for force, colour in colours.items()][::-1]
    handles += [
        Line2D([], [], color=INK, linewidth=0.9, linestyle=(0, (4, 2)), label="predicted"),
        Line2D([], [], color=GREY, linewidth=1.1, label="nominal circle"),
    ]
    title = "measured at" if reference is None else f"measured, over {reference:g} N"
    ax.legend(
        handles=handles,
        loc="center left",
        bbox_to_anchor=(1.06, 0.5),
        title=title,
        title_fontproperties={"weight": "bold", "size": SMALL},
        alignment="left",
        labelspacing=0.7,
    )


def _draw_levels(ax: Axes, result: Identification, scale: Scale) -> dict[float, str]:
    colours = force_colours([level.force for level in result.levels])
    for force, colour in colours.items():
        for trace, again in of_level(result, force):
            measured = around(trace.pose, trace.measured, scale, len(result.traces))
            ax.plot(*measured, color=colour, linewidth=0.4 if again else 1.9, alpha=0.6 if again else 1.0, zorder=3)
            if not again:
                predicted = around(trace.pose, trace.predicted, scale, len(result.traces))
                ax.plot(*predicted, color=INK, linewidth=0.7, linestyle=(0, (4, 3)), zorder=4)
    return colours


def _along(result: Identification) -> Figure:
    figure = new_figure(3.6)
    ax = figure.subplots()
    label, factor = pose_axis(result)
    for force, colour in force_colours([level.force for level in result.levels]).items():
        for trace, again in of_level(result, force):
            pose, measured = thinned(trace.pose, trace.measured * UM, len(result.traces))
            name = "_" if again else f"{force:g} N"
            ax.plot(pose * factor, measured, color=colour, linewidth=0.4 if again else 1.6, label=name)
            pose, predicted = thinned(trace.pose, trace.predicted * UM, len(result.traces))
            ax.plot(pose * factor, predicted, color=INK, linewidth=0.7, linestyle=(0, (4, 3)), label="_")
    ax.plot([], [], color=INK, linewidth=0.7, linestyle=(0, (4, 3)), label="predicted")
    ax.set_xlabel(label)
    ax.set_ylabel("reading (µm)")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
