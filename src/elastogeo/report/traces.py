"""Measured and predicted traces around the circle, and what is left between them."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MultipleLocator

from elastogeo.identify import Identification, Trace
from elastogeo.identify.systems import same_force
from elastogeo.machine import Array
from elastogeo.observe import LoadedBallBar
from elastogeo.report.numbers import significant
from elastogeo.report.style import (
    BLUE,
    FAINT,
    GREY,
    INK,
    SMALL,
    force_colours,
    grid,
    new_figure,
    nice_step,
    thinned,
)
from elastogeo.report.text import UM

_OUTWARD, _INWARD = 0.8, 0.6
"""The greatest deviations are drawn at most at these parts of the nominal radius."""
_DIVISIONS = 6
_EDGE = 1e-9
_SPOKES = ((0, "left", "center"), (90, "center", "bottom"), (180, "right", "center"), (270, "center", "top"))


def traces_figure(result: Identification) -> Figure:
    """Measured and predicted readings of every level: around the nominal circle, or along what the run counts."""
    return _around(result) if is_angular(result) else _along(result)


def residuals_figure(result: Identification) -> Figure:
    """Measured minus predicted readings [µm] of every level."""
    levels = [level.force for level in result.levels]
    figure, axes = grid(len(levels), 2 if len(levels) > 3 else 1, 1.25, sharey=True)
    largest = max(float(np.abs(t.measured - t.predicted).max()) for t in result.traces) * UM or 1.0
    label, factor = _pose_axis(result)
    for ax, level in zip(axes, result.levels, strict=True):
        for trace, again in _of_level(result, level.force):
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


def is_angular(result: Identification) -> bool:
    """Whether the readings go around a circle."""
    return result.test.setup.quantities[0] == "angle"


def nominal_radius(result: Identification) -> float | None:
    """Radius [mm] of the circle that the test was to make, if it was to make one."""
    setup = result.test.setup
    return setup.circle.radius if isinstance(setup, LoadedBallBar) else None


def spokes(ax: Axes, radius: float) -> None:
    """The four directions of a circular test, labelled with their angles."""
    for degrees, ha, va in _SPOKES:
        x, y = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        ax.plot([0, radius * x], [0, radius * y], color=FAINT, linewidth=0.6, zorder=0)
        ax.text(1.03 * radius * x, 1.03 * radius * y, f"{degrees}°", ha=ha, va=va, fontsize=SMALL, color=GREY)


def ring(ax: Axes, radius: float, colour: str, width: float, style: str = "-") -> None:
    """A full circle."""
    around = np.linspace(0, 2 * np.pi, 181)
    ax.plot(radius * np.cos(around), radius * np.sin(around), color=colour, linewidth=width, linestyle=style, zorder=1)


def _around(result: Identification) -> Figure:
    figure = new_figure(5.2)
    ax = figure.subplots()
    ax.set_aspect("equal")
    ax.set_axis_off()
    every = np.concatenate([values for t in result.traces for values in (t.measured, t.predicted)])
    inward, outward = max(-float(every.min()), 0.0), max(float(every.max()), 0.0)
    radius = nominal_radius(result) or 1.0
    magnification = nice_step(radius / (max(outward / _OUTWARD, inward / _INWARD) or 1.0))
    division = nice_step((inward + outward or 1.0) / _DIVISIONS * 2)
    inner, outer = -ceil(inward / division - _EDGE), max(ceil(outward / division - _EDGE), 1)
    for k in range(inner, outer + 1):
        ring(ax, radius + k * division * magnification, GREY if k == 0 else FAINT, 1.1 if k == 0 else 0.6)
    limit = radius + (outer + 0.3) * division * magnification
    spokes(ax, limit)
    colours = _draw_levels(ax, result, radius, magnification)
    _division_bar(ax, limit, division, magnification, nominal_radius(result) is not None)
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


def _draw_levels(ax: Axes, result: Identification, radius: float, magnification: float) -> dict[float, str]:
    colours = force_colours([level.force for level in result.levels])
    for force, colour in colours.items():
        for trace, again in _of_level(result, force):
            measured = _drawn(trace.pose, trace.measured, radius, magnification, len(result.traces))
            ax.plot(*measured, color=colour, linewidth=0.4 if again else 1.9, alpha=0.6 if again else 1.0, zorder=3)
            if not again:
                predicted = _drawn(trace.pose, trace.predicted, radius, magnification, len(result.traces))
                ax.plot(*predicted, color=INK, linewidth=0.7, linestyle=(0, (4, 3)), zorder=4)
    return colours


def _drawn(angle: Array, deviation: Array, radius: float, magnification: float, traces: int) -> tuple[Array, Array]:
    """Nominal circle plus magnified deviation, as points of the plane; the gap of a full turn is closed."""
    angle, deviation = thinned(angle, deviation, traces)
    gap = 2 * np.pi - float(np.ptp(angle))
    if 0 < gap < 3 * 2 * np.pi / len(angle):
        angle, deviation = np.append(angle, angle[0]), np.append(deviation, deviation[0])
    r = radius + magnification * deviation
    return r * np.cos(angle), r * np.sin(angle)


def _division_bar(ax: Axes, limit: float, division: float, magnification: float, to_scale: bool) -> None:
    length = division * magnification
    left, bottom = -limit, -1.16 * limit
    ax.plot([left, left + length], [bottom, bottom], color=INK, linewidth=1.4, marker="|", markersize=5, clip_on=False)
    note = f"one division = {division * UM:g} µm"
    if to_scale:
        note += f"; deviations are magnified {magnification:g} times"
    ax.text(left + length + 0.05 * limit, bottom, note, ha="left", va="center", fontsize=SMALL)


def _along(result: Identification) -> Figure:
    figure = new_figure(3.6)
    ax = figure.subplots()
    label, factor = _pose_axis(result)
    for force, colour in force_colours([level.force for level in result.levels]).items():
        for trace, again in _of_level(result, force):
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


def _pose_axis(result: Identification) -> tuple[str, float]:
    return ("angle (°)", 180 / np.pi) if is_angular(result) else (result.test.setup.quantities[0], 1.0)


def _of_level(result: Identification, force: float) -> Iterator[tuple[Trace, bool]]:
    """The traces of a level, each with whether it repeats one; repeats first, so that they are drawn below."""
    chosen = [trace for trace in result.traces if same_force(trace.force, force)]
    yield from ((trace, True) for trace in chosen[1:])
    yield chosen[0], False
