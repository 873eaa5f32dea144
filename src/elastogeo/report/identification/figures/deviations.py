"""Where the ball of a nest goes: three deviations over the poses, measured and predicted, under the rotary axes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elastogeo.identification import BallDeviations, Identification, ball_deviations
from elastogeo.machine import Array
from elastogeo.report.drawing.style import BLUE, FAINT, GREY, INK, SMALL, force_colours, new_figure
from elastogeo.report.text import UM

_AXES = {"A": INK, "B": GREY, "C": BLUE}
_HEIGHTS = (0.7, 1.0, 1.0, 1.0)
_JUMP = 4.0
"""A step of a rotary axis that is so many times its usual one is the way to the next motion, not a part of one."""


def deviations_figure(result: Identification) -> Figure:
    """Deviations [µm] of the tool from the workpiece ball along X, Y, Z of the foundation, over the number of the pose."""
    runs = ball_deviations(result)
    figure = new_figure(4.8)
    rotary, *axes = figure.subplots(4, 1, sharex=True, gridspec_kw={"height_ratios": _HEIGHTS})
    _commands(rotary, runs[0].rotary)
    colours = force_colours([level.force for level in result.levels])
    seen: set[float] = set()
    for run in runs:
        _draw(axes, run, colours[run.force], run.force in seen)
        seen.add(run.force)
    for ax, letter in zip(axes, "XYZ", strict=True):
        ax.axhline(0, color=INK, linewidth=0.6)
        ax.set_ylabel(f"{letter} (µm)")
        for at in _jumps(runs[0].rotary):
            ax.axvline(at + 0.5, color=FAINT, linewidth=0.8)
    axes[-1].set_xlabel("pose")
    _legend(rotary, colours)
    return figure


def _commands(ax: Axes, rotary: Mapping[str, Array]) -> None:
    for axis, values in rotary.items():
        ax.plot(*_line(np.rad2deg(values), _jumps(rotary)), color=_AXES[axis], linewidth=1.2, label=axis)
    ax.set_ylabel("axis (°)")
    for at in _jumps(rotary):
        ax.axvline(at + 0.5, color=FAINT, linewidth=0.8)


def _draw(axes: list[Axes], run: BallDeviations, colour: str, again: bool) -> None:
    breaks = _jumps(run.rotary)
    for k, ax in enumerate(axes):
        measured, predicted = (_line(values[:, k] * UM, breaks) for values in (run.measured, run.predicted))
        ax.plot(*measured, color=colour, linewidth=0.4 if again else 2.0, alpha=0.6 if again else 1.0)
        if not again:
            ax.plot(*predicted, color=INK, linewidth=0.8, linestyle=(0, (4, 3)), zorder=4)


def _legend(ax: Axes, colours: Mapping[float, str]) -> None:
    for force, colour in colours.items():
        ax.plot([], [], color=colour, linewidth=1.8, label=f"measured, {force:g} N" if force else "measured")
    ax.plot([], [], color=INK, linewidth=0.9, linestyle=(0, (4, 2)), label="predicted")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=SMALL)


def _line(values: Array, breaks: list[int]) -> tuple[Array, Array]:
    """Points of a line over the number of the pose, broken where another motion begins."""
    pose = np.arange(1.0, len(values) + 1)
    return np.insert(pose, breaks, np.nan), np.insert(values, breaks, np.nan)


def _jumps(rotary: Mapping[str, Array]) -> list[int]:
    """After how many poses a rotary axis goes much farther than it usually does from one to the next."""
    found: set[int] = set()
    for values in rotary.values():
        step = np.abs(np.diff(values))
        found |= {int(k) + 1 for k in np.flatnonzero(step > _JUMP * np.median(step[step > 0]))}
    return sorted(found)
