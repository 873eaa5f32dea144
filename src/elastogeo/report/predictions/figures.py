"""The pictures of a map: slices of the volume in colour, along one axis with its interval, ellipsoids in the volume."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure

from elastogeo.machine import Array
from elastogeo.prediction import ComplianceMap, Place
from elastogeo.report.drawing.style import BLUE, FAINT, GREY, INK, ORANGE, SMALL, new_figure
from elastogeo.report.predictions.document import NM
from elastogeo.report.predictions.volume import SOFT

Plane = tuple[int, int, int | None, int]
"""Which axes of the grid go right, up and across the slices, and which slice it is."""
_SOFT = LinearSegmentedColormap.from_list("soft", SOFT)
_SLICES = 3
_ELLIPSOID = 0.16
"""Greatest semi-axis of an ellipsoid, of the size of the volume."""


def slices_figure(found: ComplianceMap) -> Figure:
    """The compliance in slices through the volume; along one axis as a line with its interval."""
    wide = [k for k, count in enumerate(found.grid.shape) if count > 1]
    if len(wide) < 2:
        return _line_figure(found, wide[0] if wide else 0)
    return _coloured(found, found.compliance * NM, "compliance [nm/N]", marked=True)


def uncertainty_figure(found: ComplianceMap) -> Figure:
    """U in the same slices."""
    return _coloured(found, found.expanded * NM, "U (95 %) [nm/N]", marked=False)


def design_figure(found: ComplianceMap) -> Figure:
    """How much softer the machine is than its design, in the same slices."""
    assert found.design is not None
    return _coloured(found, (found.compliance - found.design.compliance) * NM, "measured less design [nm/N]", marked=False)


def ellipsoids_figure(found: ComplianceMap) -> Figure:
    """At the corners and in the middle how far a force of one size in every direction moves the tool along itself."""
    figure = new_figure(4.8)
    ax: Any = figure.add_subplot(projection="3d")
    ends = np.array([[one[0], one[-1]] for one in found.grid.along])
    span = float(np.ptp(ends, axis=1).max()) or 1.0
    softest = [one.at_tool.principal[0].compliance.value for one in found.corners]
    scale = ScalarMappable(Normalize(min(0.9 * min(softest), 0.99 * max(softest)) * NM, max(softest) * NM), _SOFT)
    for place, soft in zip(found.corners, softest, strict=True):
        _ellipsoid(ax, found, place, _ELLIPSOID * span / max(softest), scale.to_rgba(np.array([soft * NM]))[0])
    for axis, name in zip("xyz", found.grid.axes, strict=False):
        getattr(ax, f"set_{axis}label")(f"{name} [mm]")
    ax.set_aspect("equal")
    for pane in (ax.xaxis, ax.yaxis, ax.zaxis):
        pane.pane.set_facecolor("white")
        pane.pane.set_edgecolor(FAINT)
    figure.colorbar(scale, ax=ax, label="softest direction [nm/N]", shrink=0.6, aspect=25)
    return figure


def _coloured(found: ComplianceMap, values: Array, label: str, marked: bool) -> Figure:
    planes = _planes(found)
    layers = _layers(found, planes[2])
    figure = new_figure(3.5 if len(layers) > 1 else 4.6)
    panels = np.atleast_1d(figure.subplots(1, len(layers), sharey=True))
    finite = values[np.isfinite(values)]
    scale = Normalize(float(finite.min()), float(finite.max())) if finite.size else Normalize(0.0, 1.0)
    for ax, layer in zip(panels, layers, strict=True):
        _slice(ax, found, values, scale, (*planes, layer))
        if marked:
            _marks(ax, found, (*planes, layer))
    panels[0].set_ylabel(f"{found.grid.axes[planes[1]]} [mm]")
    shades = ScalarMappable(scale, _SOFT)
    figure.colorbar(shades, ax=list(panels), label=label, location="bottom", shrink=0.7, aspect=45)
    return figure


def _slice(ax: Axes, found: ComplianceMap, values: Array, scale: Normalize, plane: Plane) -> None:
    """One slice in colour, hatched where the tests do not tell: no value, or one that rests on a prior."""
    first, second, across, layer = plane
    shown = np.where(found.supported, values, np.nan)
    cut, told = (
        one if across is None else np.moveaxis(one, (first, second, across), (0, 1, 2))[:, :, layer]
        for one in (values, shown)
    )
    along, up = found.grid.along[first], found.grid.along[second]
    known = np.ma.masked_invalid(cut.T)
    ax.set_facecolor("#eeeeee")
    ax.pcolormesh(along, up, known, cmap=_SOFT, norm=scale, shading="nearest", rasterized=True)
    if not np.isfinite(told).all():
        missing = np.repeat(np.repeat(~np.isfinite(told.T), 2, axis=0), 2, axis=1).astype(float)
        edges = [_edges(one) for one in (along, up)]
        ax.contourf(*edges, missing, levels=[0.5, 1.5], colors="none", hatches=["////"])
    ax.set_aspect("equal")
    ax.set_xlabel(f"{found.grid.axes[first]} [mm]")
    if across is not None:
        ax.set_title(f"{found.grid.axes[across]} = {found.grid.along[across][layer]:.6g} mm".replace("-", "\N{MINUS SIGN}"))


def _edges(along: Array) -> Array:
    """Both ends of the cell of each place, in order."""
    half = np.abs(np.diff(along)).min() / 2 * 0.999
    return np.sort(np.concatenate([along - half, along + half]))


def _planes(found: ComplianceMap) -> tuple[int, int, int | None]:
    """Which axes of the grid go right and up, and which across the slices."""
    wide = [k for k, count in enumerate(found.grid.shape) if count > 1]
    others = [k for k in range(len(found.grid.shape)) if k not in wide[:2]]
    return wide[0], wide[1], others[0] if others else None


def _layers(found: ComplianceMap, across: int | None) -> list[int]:
    if across is None:
        return [0]
    count = found.grid.shape[across]
    return sorted({0, count // 2, count - 1}) if count >= _SLICES else list(range(count))


def _marks(ax: Axes, found: ComplianceMap, plane: Plane) -> None:
    first, second, across, layer = plane
    for place, mark, name in ((found.softest, "v", "softest"), (found.stiffest, "^", "stiffest")):
        if place is not None and (across is None or place.index[across] == layer):
            x, y = (found.grid.along[k][place.index[k]] for k in (first, second))
            ax.plot(x, y, mark, color=INK, markersize=6, markerfacecolor="white", clip_on=False, zorder=5)
            left = x > np.mean(found.grid.along[first])
            ax.annotate(
                name,
                (x, y),
                xytext=(-7 if left else 7, 0),
                textcoords="offset points",
                ha="right" if left else "left",
                va="center",
                fontsize=SMALL,
                color=INK,
            )


def _line_figure(found: ComplianceMap, axis: int) -> Figure:
    figure = new_figure(3.2)
    ax = figure.subplots()
    along, value, half = found.grid.along[axis], found.compliance.ravel() * NM, found.expanded.ravel() * NM
    ax.fill_between(along, value - half, value + half, color=BLUE, alpha=0.2, linewidth=0, label="95 %")
    ax.plot(along, value, color=BLUE, marker="o" if len(along) < 2 else None, label="compliance")
    if found.acceptance is not None:
        ax.axhline(found.acceptance.limit * NM, color=ORANGE, linewidth=1.0, linestyle=(0, (4, 2)), label="limit")
    ax.set_xlabel(f"{found.grid.axes[axis]} [mm]")
    ax.set_ylabel("compliance [nm/N]")
    ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    figure.legend(loc="outside upper center", ncols=3)
    return figure


def _ellipsoid(ax: Any, found: ComplianceMap, place: Place, scale: float, colour: Any) -> None:
    """A wire ellipsoid whose semi-axes are the principal compliances."""
    axes = np.array([one.direction for one in place.at_tool.principal])
    sizes = np.array([max(one.compliance.value, 0.0) for one in place.at_tool.principal]) * scale
    centre = np.zeros(3)
    centre[: len(place.index)] = [found.grid.along[k][i] for k, i in enumerate(place.index)]
    around, up = np.linspace(0, 2 * np.pi, 25), np.linspace(0, np.pi, 13)
    ball = np.stack(
        [np.outer(np.cos(around), np.sin(up)), np.outer(np.sin(around), np.sin(up)), np.outer(np.ones(25), np.cos(up))],
        axis=-1,
    )
    points = centre + (ball[..., : len(axes)] * sizes) @ axes
    ax.plot_wireframe(*np.moveaxis(points, -1, 0), color=colour, linewidth=0.4)
    for direction, size in zip(axes, sizes, strict=True):
        ends = np.array([centre - direction * size, centre + direction * size]).T
        ax.plot(*ends, color=GREY if size < sizes[0] else INK, linewidth=0.9)
