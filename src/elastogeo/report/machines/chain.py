"""The kinematic chain of a machine, drawn from its file (as Figures 4.1 to 4.4 and 6.1 of the thesis draw theirs)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from elastogeo.machine import Machine
from elastogeo.report.drawing.style import BLUE, GREY, INK, ORANGE, SMALL, new_figure

_VIEW = np.array([[np.cos(np.pi / 6), 0.5], [-np.cos(np.pi / 6), 0.5], [0.0, 1.0]])
"""Directions in which x, y and z are drawn, shape (3, 2): isometric."""
_APART, _WIDTH, _HEIGHT = 3.2, 1.5, 0.62


def chain_figure(machine: Machine) -> Figure:
    """Both branches from the foundation up: each joint a box with its axis, its direction of motion and its offset."""
    of_tool = [machine.in_tool_branch(joint.name) for joint in machine.joints]
    workpiece = [k for k, own in enumerate(of_tool) if not own][::-1]
    tool = [k for k, own in enumerate(of_tool) if own]
    rows = max(len(workpiece), len(tool)) + 1
    figure = new_figure(1.2 + 0.62 * rows)
    ax = figure.subplots()
    ax.set_aspect("equal")
    ax.set_axis_off()
    for x, indices, colour, end in ((0.0, workpiece, ORANGE, "workpiece"), (_APART, tool, BLUE, "tool")):
        ax.plot([x, x], [0, len(indices) + 1], color=colour, linewidth=2.4, zorder=1)
        for row, k in enumerate(indices, 1):
            _joint(ax, machine, k, (x, float(row)))
        ax.text(x, len(indices) + 1.12, end, color=colour, fontweight="bold", ha="center", va="bottom")
    ax.plot([-0.8, _APART + 0.8], [0, 0], color=GREY, linewidth=5, solid_capstyle="butt")
    ax.text(_APART / 2, -0.18, "foundation", color=GREY, fontsize=SMALL, ha="center", va="top")
    _triad(ax, (_APART / 2, rows - 0.2))
    ax.set_xlim(-1.6, _APART + 2.9)
    ax.set_ylim(-0.6, rows + 0.7)
    return figure


def _joint(ax: Axes, machine: Machine, k: int, at: tuple[float, float]) -> None:
    joint, (x, y) = machine.joints[k], at
    style = "round,pad=0,rounding_size=0.3" if joint.is_rotary else "square,pad=0"
    box = FancyBboxPatch(
        (x - _WIDTH / 2, y - _HEIGHT / 2), _WIDTH, _HEIGHT, boxstyle=style, facecolor="white", edgecolor=INK
    )
    ax.add_patch(box)
    ax.text(x - 0.32, y, joint.name, ha="center", va="center", fontweight="bold", color=INK, zorder=4)
    along = 0.26 * _VIEW[joint.direction]
    ends = {"arrowstyle": "->" if joint.is_rotary else "<->", "color": INK, "linewidth": 1.2}
    middle = np.array([x + 0.32, y])
    ax.annotate("", xy=tuple(middle + along), xytext=tuple(middle - along), arrowprops=ends, zorder=4)
    if joint.is_rotary:
        ax.plot(*middle, marker="o", markersize=9, markerfacecolor="none", markeredgecolor=INK, zorder=4)
    if any(joint.offset):
        offset = ", ".join(f"{value:g}" for value in joint.offset).replace("-", "−")
        ax.text(x + _WIDTH / 2 + 0.12, y, f"({offset}) mm", fontsize=SMALL, color=GREY, va="center")


def _triad(ax: Axes, at: tuple[float, float]) -> None:
    """The directions of the foundation."""
    for along, name in zip(_VIEW, "xyz", strict=True):
        tip = np.asarray(at) + 0.4 * along
        ax.annotate("", xy=tuple(tip), xytext=at, arrowprops={"arrowstyle": "->", "color": GREY})
        x, y = np.asarray(at) + 0.55 * along
        ax.text(float(x), float(y), name, color=GREY, fontsize=SMALL, ha="center", va="center")
