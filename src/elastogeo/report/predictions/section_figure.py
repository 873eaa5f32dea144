"""A section through a map as a figure of a report."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from elastogeo.prediction import MapSection
from elastogeo.report.document import UM
from elastogeo.report.predictions.section_plot import levels_of
from elastogeo.report.predictions.volume import SOFT

_UNTOLD = "#d9d9d9"


def section_figure(section: MapSection) -> Figure:
    """Stiffness in colour with numbered contours, grey where nothing is known."""
    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    axes = figure.add_subplot()
    across, up = section.along
    field = np.ma.masked_invalid((section.stiffness / UM).T)
    axes.set_facecolor(_UNTOLD)
    colours = LinearSegmentedColormap.from_list("soft", list(reversed(SOFT)))
    drawn = axes.pcolormesh(across, up, field, cmap=colours, shading="nearest")
    levels = levels_of(section.stiffness / UM)
    if levels:
        axes.clabel(axes.contour(across, up, field, levels=levels, colors="black", linewidths=0.7), fontsize=8)
    if section.known.any():
        figure.colorbar(drawn, ax=axes, label="stiffness [N/µm]")
    axes.set_xlabel(f"{section.axes[0]} [mm]")
    axes.set_ylabel(f"{section.axes[1]} [mm]")
    axes.set_aspect("equal")
    return figure
