"""The catalogue of response patterns: what each parameter, or group that cannot be distinguished, does to a trace (4.4)."""

from __future__ import annotations

from textwrap import wrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from elastogeo.identification import Identification, Pattern
from elastogeo.report.drawing.circles import is_angular, ring
from elastogeo.report.drawing.magnified import thinned
from elastogeo.report.drawing.style import BLUE, FAINT, GREY, INK, ORANGE, SMALL, grid

_NOMINAL, _SWING = 1.0, 0.45
_EDGE = 1.03
_POINTS_AS_OF = 200
"""Patterns are smooth: they are drawn with as few points as if the figure had this many traces."""
_COLUMNS, _LINE, _LINES = 4, 24, 3


def patterns_figure(result: Identification) -> Figure:
    """One small polar plot per group, each scaled to its own size; outward of the nominal circle is positive."""
    patterns = result.patterns
    named = {p.name: p.separated for p in result.parameters}
    columns = min(_COLUMNS, 3 if len(patterns) in (3, 5, 6, 9) else _COLUMNS)
    figure, axes = grid(len(patterns), columns, 2.15 if columns == _COLUMNS else 2.5)
    for ax, pattern in zip(axes, patterns, strict=True):
        if is_angular(result):
            _around(ax, pattern)
        else:
            pose, response = thinned(pattern.pose, pattern.response, _POINTS_AS_OF)
            ax.plot(pose, response, color=BLUE)
            ax.axhline(0, color=GREY, linewidth=0.7)
        _title(ax, pattern, named)
    return figure


def _around(ax: Axes, pattern: Pattern) -> None:
    ax.set_aspect("equal")
    ax.set_axis_off()
    limit = _EDGE * (_NOMINAL + _SWING)
    for degrees in (0, 90):
        x, y = limit * np.cos(np.radians(degrees)), limit * np.sin(np.radians(degrees))
        ax.plot([-x, x], [-y, y], color=FAINT, linewidth=0.6, zorder=0)
    ring(ax, _NOMINAL, GREY, 0.8)
    angle, response = thinned(pattern.pose, pattern.response, _POINTS_AS_OF)
    radius = _NOMINAL + _SWING * response
    for outward, colour in ((True, BLUE), (False, ORANGE)):
        kept = np.maximum(radius, _NOMINAL) if outward else np.minimum(radius, _NOMINAL)
        xs = np.concatenate([kept * np.cos(angle), (_NOMINAL * np.cos(angle))[::-1]])
        ys = np.concatenate([kept * np.sin(angle), (_NOMINAL * np.sin(angle))[::-1]])
        ax.add_artist(Polygon(np.column_stack([xs, ys]), color=colour, alpha=0.22, linewidth=0, zorder=2))
    closed = np.arange(len(angle) + 1) % len(angle) if np.ptp(angle) > 1.9 * np.pi else np.arange(len(angle))
    ax.plot((radius * np.cos(angle))[closed], (radius * np.sin(angle))[closed], color=INK, linewidth=1.1, zorder=3)
    ax.set_xlim(-limit, limit)
    ax.set_ylim(-limit, limit)


def _title(ax: Axes, pattern: Pattern, named: dict[str, bool]) -> None:
    """The retained name in bold over those that it cannot be told from; all alike if compliance and geometry are mixed."""
    first = next((name for name in pattern.names if name in named), None)
    if first is not None and not named[first]:
        ax.set_title("\n".join(wrap(" or ".join(pattern.names), _LINE)), fontsize=SMALL, color=INK, pad=4)
        return
    others = [name for name in pattern.names if name != first]
    lines = wrap(", ".join(others), _LINE)
    if len(lines) > _LINES:
        left = len(others) - sum(line.count("_") for line in lines[: _LINES - 1])
        lines = [*lines[: _LINES - 1], f"and {left} more"]
    text = "\n".join(lines)
    if first is None:
        ax.set_title(f"{text}\n(not retained)", fontsize=SMALL, color=GREY)
    elif not others:
        ax.set_title(first, weight="bold", pad=4)
    else:
        ax.set_title(f"like {text}", fontsize=SMALL, color=GREY, pad=4)
        rise = 5.5 + 9.5 * len(lines)
        frame = ("axes fraction", "offset points")
        ax.annotate(first, (0.5, 1), (0, rise), xycoords=frame[0], textcoords=frame[1], ha="center", weight="bold")
