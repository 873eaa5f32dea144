"""Three pictures of one error on one scale: before, what the control adds, what is expected after."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elastogeo.machine import Array
from elastogeo.prediction.compensation import CompensatedError
from elastogeo.report.drawing.style import BLUE, FAINT, ORANGE, new_figure
from elastogeo.report.scales import scale_of

_SIDES = ((0, BLUE, "+"), (1, ORANGE, "−"))
_BAND = 0.18
_MARKED = 50
"""Points that are marked, each."""


def compensation_figure(one: CompensatedError) -> Figure:
    """Error before with its interval, correction, and error expected after with its interval, over the position."""
    scale, before, after = scale_of(one.error), one.error, one.residual
    figure = new_figure(4.6)
    panels = figure.subplots(3, 1, sharex=True, sharey=True)
    place = before.position * scale.place_factor
    u = scale.factor
    _drawn(panels[0], place, before.value * u, before.uncertainty * u)
    _drawn(panels[1], place, one.correction * u, None)
    _drawn(panels[2], place, after.value * u, after.uncertainty * u)
    for ax, title in zip(panels, ("error found", "correction of the control", "expected after"), strict=True):
        ax.set_title(title, loc="left")
        ax.set_ylabel(scale.unit)
    panels[2].set_xlabel(f"{before.axis} ({scale.place_unit})")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=3)
    return figure


def _drawn(ax: Axes, place: Array, value: Array, doubt: Array | None) -> None:
    ax.axhline(0.0, color=FAINT, linewidth=0.7, zorder=0)
    for k, colour, sign in _SIDES:
        marker = "o" if len(place) <= _MARKED else ""
        ax.plot(place, value[:, k], color=colour, marker=marker, markersize=2.5, label=f"come to in {sign}")
        if doubt is not None and np.isfinite(doubt[:, k]).all():
            low, high = value[:, k] - doubt[:, k], value[:, k] + doubt[:, k]
            ax.fill_between(place, low, high, color=colour, alpha=_BAND, linewidth=0, label="95 %" if k == 0 else None)
