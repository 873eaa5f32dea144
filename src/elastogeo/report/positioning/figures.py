"""The picture of a positioning test as ISO 230-2 draws it: deviations over the axis, by direction, with means and limits."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elastogeo.identification import PositioningResults
from elastogeo.report.drawing.style import BLUE, FAINT, GREY, INK, ORANGE, SMALL, new_figure
from elastogeo.report.positioning.tables import said_value
from elastogeo.report.scales import Scale, scale_for

_SIDES = ((0, 1.0, BLUE, "+"), (1, -1.0, ORANGE, "−"))
_SPANS = (("A", "A+", "A-"), ("E", "E+", "E-"), ("M",))
"""What is marked beside the plot: of both sides, else of the one there is."""


def deviations_figure(found: PositioningResults) -> Figure:
    """Every reading, the means and their two-sigma limits by direction, the mean of both sides, and what A, E, M span."""
    scale = scale_for(found.angular, found.rotary)
    figure = new_figure(3.8)
    ax = figure.subplots()
    ax.axhline(0.0, color=FAINT, linewidth=0.7, zorder=0)
    for column, sign, colour, name in _SIDES:
        _side(ax, found, scale, column, sign, colour, name)
    middle = found.targets.middle
    if not np.isnan(middle).all():
        place = found.targets.target * scale.place_factor
        ax.plot(place, middle * scale.factor, color=INK, linewidth=0.9, linestyle=(0, (4, 2)), label="mean of both sides")
    _spans(ax, found, scale)
    ax.set_xlabel(f"target ({scale.place_unit})")
    ax.set_ylabel(f"deviation ({scale.unit})")
    figure.legend(loc="outside upper center", ncols=5)
    return figure


def _side(ax: Axes, found: PositioningResults, scale: Scale, column: int, sign: float, colour: str, name: str) -> None:
    targets, here = found.targets, found.sense == sign
    if not here.any():
        return
    place = targets.target * scale.place_factor
    mean, limit = targets.mean[:, column] * scale.factor, 2 * targets.deviation[:, column] * scale.factor
    ax.plot(
        found.target[here] * scale.place_factor,
        found.reading[here] * scale.factor,
        ">" if sign > 0 else "<",
        color=colour,
        markersize=2.5,
        alpha=0.5,
        linewidth=0,
    )
    ax.plot(place, mean, color=colour, linewidth=1.6, label=f"mean, {name}")
    if not np.isnan(limit).all():
        ax.plot(place, mean + limit, color=colour, linewidth=0.7)
        ax.plot(place, mean - limit, color=colour, linewidth=0.7, label=f"mean ± 2 s, {name}")


def _spans(ax: Axes, found: PositioningResults, scale: Scale) -> None:
    """Arrows beside the plot, from the least to the greatest of what each value spans."""
    shown = [next((name for name in names if name in found.values), "") for names in _SPANS]
    left, right = ax.get_xlim()
    wide = right - left
    at = right
    for name in filter(None, shown):
        low, high = (end * scale.factor for end in _ends(found, name))
        at += 0.06 * wide
        arrow = {"arrowstyle": "<|-|>", "color": GREY, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7}
        ax.annotate("", xy=(at, high), xytext=(at, low), arrowprops=arrow)
        label = f"{name.replace('-', '−')} = {said_value(found.values[name], scale)}"
        ax.text(at - 0.008 * wide, (low + high) / 2, label, rotation=90, ha="right", va="center", fontsize=SMALL, color=INK)
    ticks = [tick for tick in ax.get_xticks() if left <= tick <= right]
    ax.set_xlim(left, at + 0.02 * wide)
    ax.set_xticks(ticks)


def _ends(found: PositioningResults, name: str) -> tuple[float, float]:
    targets = found.targets
    columns = {"+": [0], "-": [1]}.get(name[1:], [0, 1])
    mean = targets.middle[:, np.newaxis] if name == "M" else targets.mean[:, columns]
    limit = 2 * targets.deviation[:, columns] if name.startswith("A") else np.zeros_like(mean)
    return float(np.nanmin(mean - limit)), float(np.nanmax(mean + limit))
