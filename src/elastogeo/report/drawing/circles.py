"""Deviations around a circle, magnified: what every figure of a circular test is drawn on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from elastogeo.identification import Identification
from elastogeo.report.drawing.magnified import Scale
from elastogeo.report.drawing.style import FAINT, GREY, INK, SMALL
from elastogeo.report.text import UM

_VALUES_AT = np.radians(67.5)
"""Angle [rad] at which the rings are labelled."""
_BEHIND = {"facecolor": "white", "edgecolor": "none", "pad": 0.6}
_SPOKES = ((0, "left", "center"), (90, "center", "bottom"), (180, "right", "center"), (270, "center", "top"))


def rings(ax: Axes, scale: Scale, axes: Sequence[str] = (), values: bool = False) -> None:
    """An empty polar drawing: the nominal circle, and a ring every division.

    Parameters
    ----------
    ax : Axes
    scale : Scale
    axes : sequence of str
        Names of the two directions of the plane, from which the angle counts; angles are written where they are not known.
    values : bool
        Whether each ring says its deviation [µm].
    """
    ax.set_aspect("equal")
    ax.set_axis_off()
    for k in range(scale.inner, scale.outer + 1):
        radius = scale.radius + k * scale.division * scale.magnification
        ring(ax, radius, GREY if k == 0 else FAINT, 1.1 if k == 0 else 0.6)
        if values:
            x, y = radius * np.cos(_VALUES_AT), radius * np.sin(_VALUES_AT)
            text = f"{k * scale.division * UM:+g}".replace("-", "−") if k else "0 µm"
            ax.text(x, y, text, ha="center", va="center", fontsize=SMALL - 1, color=GREY, zorder=5, bbox=_BEHIND)
    spokes(ax, scale.limit, axes)


def ring(ax: Axes, radius: float, colour: str, width: float, style: str = "-") -> None:
    """A full circle."""
    around = np.linspace(0, 2 * np.pi, 181)
    ax.plot(radius * np.cos(around), radius * np.sin(around), color=colour, linewidth=width, linestyle=style, zorder=1)


def spokes(ax: Axes, radius: float, axes: Sequence[str] = ()) -> None:
    """The four directions of a circular test, labelled with the axes, or with their angles."""
    names = [f"+{axes[0]}", f"+{axes[1]}", f"−{axes[0]}", f"−{axes[1]}"] if axes else [f"{at}°" for at, _, _ in _SPOKES]
    for (degrees, ha, va), name in zip(_SPOKES, names, strict=True):
        x, y = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        ax.plot([0, radius * x], [0, radius * y], color=FAINT, linewidth=0.6, zorder=0)
        ax.text(1.03 * radius * x, 1.03 * radius * y, name, ha=ha, va=va, fontsize=SMALL, color=GREY)


def division_note(scale: Scale, to_scale: bool) -> str:
    """What a ring means, and how much the deviations are magnified."""
    note = f"one division = {scale.division * UM:g} µm"
    return f"{note}; deviations are magnified {scale.magnification:g} times" if to_scale else note


def division_bar(ax: Axes, scale: Scale, to_scale: bool) -> None:
    """A bar as long as one division, with what it means."""
    length = scale.division * scale.magnification
    left, bottom = -scale.limit, -1.16 * scale.limit
    ax.plot([left, left + length], [bottom, bottom], color=INK, linewidth=1.4, marker="|", markersize=5, clip_on=False)
    note = division_note(scale, to_scale)
    ax.text(left + length + 0.05 * scale.limit, bottom, note, ha="left", va="center", fontsize=SMALL)


def is_angular(result: Identification) -> bool:
    """Whether the readings go around a circle."""
    return result.test.setup.pose_quantity == "angle"


def nominal_radius(result: Identification) -> float | None:
    """Radius [mm] of the circle that the test was to make, if it was to make one."""
    return result.test.setup.nominal_radius


def pose_axis(result: Identification) -> tuple[str, float]:
    """Label of what the readings count along, and the factor to its shown unit."""
    if is_angular(result):
        return "angle (°)", 180 / np.pi
    quantity = result.test.setup.pose_quantity
    unit = result.test.setup.file_units.get(quantity, "")
    return (f"{quantity} (°)", 180 / np.pi) if unit == "deg" else (f"{quantity} ({unit})" if unit else quantity, 1.0)


def plane_axes(result: Identification) -> tuple[str, ...]:
    """Names of the two directions of the plane of a circular test; none of a tilted one."""
    plane = next((fact.value for fact in result.test.setup.facts() if fact.name == "plane"), None)
    return tuple(plane) if isinstance(plane, str) and len(plane) == 2 else ()
