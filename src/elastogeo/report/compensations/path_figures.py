"""The deviation along a path: before, by how much the program is moved, what is expected after, on one scale."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elastogeo.machine import Array
from elastogeo.prediction.compensation import PathCompensation
from elastogeo.report.drawing.style import BLUE, FAINT, GREEN, GREY, ORANGE, new_figure
from elastogeo.report.text import UM

_COLOURS = {"x": BLUE, "y": ORANGE, "z": GREEN}
_BAND = 0.18
_REACH = 0.12
"""Of the size of the path, to which the greatest deviation is drawn."""


def along_path_figure(found: PathCompensation) -> Figure:
    """Deviation before, correction and deviation after over the way, with 95 % bands."""
    figure = new_figure(4.6)
    panels = figure.subplots(3, 1, sharex=True, sharey=True)
    way = found.before.path.travelled
    for ax in panels:
        ax.axhline(0.0, color=FAINT, linewidth=0.7, zorder=0)
        ax.set_ylabel("µm")
    for k, name in enumerate("xyz"):
        if name not in found.components:
            continue
        colour = _COLOURS[name]
        _drawn(panels[0], way, found.before.value[:, k], found.before.expanded[:, k], colour, name)
        _drawn(panels[1], way, found.shift[:, k], None, colour, name)
        _drawn(panels[2], way, found.value[:, k], found.expanded[:, k], colour, name)
    for ax, title in zip(panels, ("deviation predicted", "the program is moved", "expected after"), strict=True):
        ax.set_title(title, loc="left")
    panels[2].set_xlabel("way along the path (mm)")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=4)
    return figure


def _drawn(ax: Axes, way: Array, value: Array, doubt: Array | None, colour: str, name: str) -> None:
    ax.plot(way, value * UM, color=colour, label=name)
    if doubt is not None:
        ax.fill_between(way, (value - doubt) * UM, (value + doubt) * UM, color=colour, alpha=_BAND, linewidth=0)


def contour_figure(found: PathCompensation) -> Figure:
    """The path from above, with the deviation before and after drawn much too large."""
    path = found.before.path
    meant = path.points[:, :2]
    size = float(np.ptp(meant, axis=0).max()) or 1.0
    before, after = (np.nan_to_num(one[:, :2]) for one in (found.before.value, found.value))
    greatest = float(np.linalg.norm(before, axis=1).max()) or 1.0
    factor = _REACH * size / greatest
    figure = new_figure(4.6)
    ax = figure.subplots()
    for part in np.split(np.arange(len(meant)), np.flatnonzero(path.steps[1:] == 0) + 1):
        first = part[0] == 0
        ax.plot(*meant[part].T, color=GREY, linewidth=0.8, label="meant" if first else None)
        for off, colour, name in ((before, ORANGE, "before"), (after, BLUE, "after")):
            ax.plot(*(meant + factor * off)[part].T, color=colour, linewidth=1.2, label=name if first else None)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("x of the workpiece (mm)")
    ax.set_ylabel("y (mm)")
    ax.set_title(f"deviations {round(factor, 1 - int(np.floor(np.log10(factor)))):g} times too large", loc="left")
    figure.legend(loc="outside upper right", ncols=3)
    return figure
