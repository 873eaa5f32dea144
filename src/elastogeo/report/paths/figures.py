"""The figures of a prediction along a path: in plan view, along the way with its interval, split into its parts."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize, TwoSlopeNorm
from matplotlib.figure import Figure

from elastogeo.machine import Array
from elastogeo.prediction import DEVIATION_COMPONENTS, PathPrediction
from elastogeo.report.drawing.magnified import nice_step
from elastogeo.report.drawing.style import BLUE, FAINT, GREEN, GREY, INK, ORANGE, READABLE, SMALL, new_figure
from elastogeo.report.paths.rows import main_component, thinned_points, worst_point
from elastogeo.report.text import UM

_SIGNED = LinearSegmentedColormap.from_list("signed", ["#00527f", "#3d9bd4", "#d9d9d9", "#ef8a4a", "#a84a00"])
_POINTS = 700
"""Points of the path that are drawn, so that the file stays small."""
_REACH = 0.07
"""Part of the extent of the path by which the greatest deviation is drawn beside it."""
_PARTS = {"geometry": GREEN, "compliance": ORANGE, "spindle side": GREEN, "workpiece side": ORANGE, "tool": BLUE}
_WAYS = (("geometry", "compliance", "tool"), ("spindle side", "workpiece side", "tool"))
_TOGETHER = "together"


def plan_figure(found: PathPrediction) -> Figure:
    """The path from above, coloured by the deviation; beside it, magnified, where the tool really goes."""
    k = main_component(found)
    chosen = thinned_points(found.value[:, k], _POINTS)
    across = _plane(found)
    points, moved = found.path.points[chosen][:, across], np.nan_to_num(found.value[chosen][:, across])
    value = found.value[chosen, k] * UM
    figure = new_figure(READABLE * 0.92, width=READABLE)
    ax = figure.add_subplot()
    ax.set_aspect("equal", adjustable="datalim")
    drawn = np.append(True, (found.path.steps[1:] > 0) | (np.diff(found.path.block) == 0))[chosen]
    norm = _norm(value)
    extent = float(np.ptp(points, axis=0).max()) or 1.0
    largest = float(np.linalg.norm(moved, axis=1).max())
    if largest:
        factor = nice_step(_REACH * extent / largest)
        off = points + factor * moved
        off[~np.isfinite(value)] = np.nan
        ax.plot(*off.T, color=INK, linewidth=0.8, zorder=1, label=f"where the tool goes, deviation × {factor:g}")
    known = np.isfinite(value)
    unknown = found.asked[chosen, k] & ~known
    _stroke(ax, points, unknown & drawn, None, norm)
    _stroke(ax, points, known & drawn, value, norm)
    worst = worst_point(found)
    if worst is not None:
        ax.plot(*found.path.points[worst, across], "o", mfc="none", mec=INK, ms=7, zorder=4, label="greatest deviation")
    ax.plot(*points[0], ">", color=INK, ms=4, zorder=4, label="start")
    ax.set_xlabel(f"{'XYZ'[across[0]]} of the workpiece [mm]")
    ax.set_ylabel(f"{'XYZ'[across[1]]} of the workpiece [mm]")
    if known.any():
        bar = figure.colorbar(ScalarMappable(norm, _SIGNED), ax=ax, shrink=0.8, pad=0.02)
        bar.set_label(_label(found, k))
    if unknown.any():
        ax.plot([], [], ":", color=GREY, linewidth=2.2, label="not supported by these tests")
    figure.legend(loc="outside lower center", ncols=2)
    return figure


def way_figure(found: PathPrediction) -> Figure:
    """The deviation along the way, with its 95 % interval: the normal first, then the axes of the workpiece."""
    shown = [k for k in (3, 0, 1, 2) if np.isfinite(found.value[:, k]).any()]
    figure = new_figure(0.5 + 1.35 * max(len(shown), 1))
    axes = np.atleast_1d(figure.subplots(max(len(shown), 1), 1, sharex=True))
    for ax, k in zip(axes, shown, strict=False):
        _band(ax, found, k)
    axes[-1].set_xlabel("way along the path [mm]")
    return figure


def split_figure(found: PathPrediction) -> Figure:
    """What each part adds along the way, both ways to split it."""
    k = main_component(found)
    own = thinned_points(found.value[found.split_at, k], _POINTS)
    chosen = found.split_at[own]
    way, whole = found.path.travelled[chosen], found.value[chosen, k] * UM
    figure = new_figure(3.9)
    axes = figure.subplots(2, 1, sharex=True, sharey=True)
    for ax, names in zip(axes, _WAYS, strict=True):
        ax.axhline(0.0, color=FAINT, linewidth=0.7)
        ax.plot(way, whole, color=INK, linewidth=0.9, label=_TOGETHER)
        for name in names:
            if name in found.parts:
                values, wide = (one[own, k] * UM for one in (found.parts[name].value, found.parts[name].expanded))
                ax.plot(way, values, color=_PARTS[name], label=name)
                ax.fill_between(way, values - wide, values + wide, color=_PARTS[name], alpha=0.18, linewidth=0)
                if not np.isfinite(values).any():
                    ax.plot([], [], " ", label=f"({name}: not distinguished)")
        ax.set_ylabel("[µm]")
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes[0].set_title(_label(found, k), loc="left")
    axes[-1].set_xlabel("way along the path [mm]")
    return figure


def _plane(found: PathPrediction) -> list[int]:
    """The two axes of the workpiece in which the path extends most, in their order."""
    extent = np.ptp(found.path.points, axis=0)
    return sorted(np.argsort(-extent, kind="stable")[:2].tolist())


def _label(found: PathPrediction, k: int) -> str:
    if DEVIATION_COMPONENTS[k] == "normal":
        return f"deviation normal to the path, + to the {found.normal_to} [µm]"
    return f"deviation in {DEVIATION_COMPONENTS[k]} of the workpiece [µm]"


def _norm(value: Array) -> Normalize:
    """Colours about zero where the deviation changes its sign, else from end to end."""
    known = value[np.isfinite(value)]
    if not len(known) or not known.any():
        return Normalize(-1.0, 1.0)
    size = float(np.abs(known).max())
    return TwoSlopeNorm(0.0, -size, size)


def _stroke(ax: Axes, points: Array, shown: Array, value: Array | None, norm: Normalize) -> None:
    """The pieces of the path that end at the points shown: coloured, or grey and dotted."""
    pieces = np.stack([points[:-1], points[1:]], axis=1)[shown[1:]]
    if not len(pieces):
        return
    if value is None:
        ax.add_collection(LineCollection(list(pieces), colors=GREY, linewidths=2.2, linestyles=":", zorder=2))
    else:
        lines = LineCollection(list(pieces), cmap=_SIGNED, norm=norm, linewidths=3.0, zorder=3, capstyle="round")
        lines.set_array(value[1:][shown[1:]])
        ax.add_collection(lines)
    ax.plot(*points.T, alpha=0.0)


def _band(ax: Axes, found: PathPrediction, k: int) -> None:
    chosen = thinned_points(found.value[:, k], _POINTS)
    way, values, wide = found.path.travelled[chosen], found.value[chosen, k] * UM, found.expanded[chosen, k] * UM
    ax.axhline(0.0, color=FAINT, linewidth=0.7)
    ax.fill_between(way, values - wide, values + wide, color=BLUE, alpha=0.25, linewidth=0, label="95 %")
    ax.plot(way, values, color=BLUE)
    ax.set_ylabel(f"{DEVIATION_COMPONENTS[k]} [µm]")
    prior = found.prior_share[chosen, k] > 0
    if prior.any():
        ax.plot(way[prior], values[prior], ".", color=GREY, ms=2, label="rests on the stated prior")
    blank = found.asked[chosen, k] & ~np.isfinite(values)
    if blank.any():
        ax.plot(way[blank], np.zeros(int(blank.sum())), "x", color=GREY, ms=3, label="not supported")
    ax.legend(loc="upper right", fontsize=SMALL - 0.5, ncols=3)
