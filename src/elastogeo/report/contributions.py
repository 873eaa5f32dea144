"""How much each parameter moves the readings."""

from __future__ import annotations

from matplotlib.figure import Figure

from elastogeo.identify import Identification
from elastogeo.report.style import BLUE, FAINT, INK, ORANGE, SMALL, new_figure
from elastogeo.report.text import UM, in_micrometres


def contributions_figure(result: Identification) -> Figure:
    """Peak-to-peak part of each parameter in the trace at the highest force [µm], signed, greatest first."""
    ranked = sorted(result.parameters, key=lambda p: abs(p.peak_to_peak))
    spans = [p.peak_to_peak * UM for p in ranked]
    figure = new_figure(0.75 + 0.27 * len(ranked))
    ax = figure.subplots()
    if result.test.resolution is not None:
        resolution = result.test.resolution * UM
        ax.axvspan(-resolution, resolution, color=FAINT, zorder=0, linewidth=0)
    ax.barh(range(len(ranked)), spans, color=[BLUE if s >= 0 else ORANGE for s in spans], height=0.62, zorder=2)
    ax.axvline(0, color=INK, linewidth=0.7, zorder=3)
    for k, p in enumerate(ranked):
        text = f"{in_micrometres(p.peak_to_peak)} µm · {100 * p.share:.1f} %".replace("-", "−")
        side, aligned = (4, "left") if spans[k] >= 0 else (-4, "right")
        ax.annotate(
            text, (spans[k], k), (side, 0), textcoords="offset points", ha=aligned, va="center", fontsize=SMALL, zorder=4
        )
    ax.set_yticks(range(len(ranked)), [p.name for p in ranked])
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    low, high = min(0.0, *spans), max(0.0, *spans)
    room = 0.28 * ((high - low) or 1.0)
    ax.set_xlim(low - (room if low < 0 else 0.02 * room), high + (room if high > 0 else 0.02 * room))
    force = max((level.force for level in result.levels), key=abs)
    label = f"peak to peak at {force:g} N, with the sign of the parameter (µm)"
    ax.set_xlabel(label if result.test.resolution is None else f"{label}; grey: ± resolution")
    return figure
