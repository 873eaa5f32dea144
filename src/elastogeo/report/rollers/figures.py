"""The figures of a stiffness map: the rose, stiffness by engagement, torques along the turn, dynamometer, rig."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from elastogeo.identification import ComparedForce, Stiffness, StiffnessMap, TorqueParts
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import plane_axes
from elastogeo.report.drawing.magnified import nice_step
from elastogeo.report.drawing.style import (
    BLUE,
    FAINT,
    GREEN,
    GREY,
    INK,
    ORANGE,
    READABLE,
    SMALL,
    force_colours,
    new_figure,
)
from elastogeo.report.drive_terms import effort_unit, term_name
from elastogeo.report.rollers.rows import UM, kind_name, modelled_name

_RINGS = 4
_VALUES_AT = np.radians(67.5)
"""Angle [rad] at which the rings are labelled."""
_RING: Any = {
    "fontsize": SMALL,
    "color": GREY,
    "zorder": 5,
    "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.8},
}


def stiffness_figure(found: StiffnessMap) -> Figure:
    """Stiffness by direction: what stands for the machine with its interval, and the increment of each engagement."""
    overall = found.overall
    figure = new_figure(READABLE * 1.05, width=READABLE)
    ax = figure.add_subplot(projection="polar")
    low, high = (_closed(bound) / UM for bound in overall.stiffness_interval.T)
    around = _closed(overall.angle, turn=2 * np.pi)
    ax.fill_between(around, low, np.where(np.isfinite(high), high, low), color=BLUE, alpha=0.18, linewidth=0)
    colours = force_colours([step.force[-1] for step in found.increments])
    for step in (step for step in found.increments if step is not overall):
        ax.plot(around, _closed(step.stiffness) / UM, color=colours[step.force[-1]], linewidth=0.9, label=kind_name(step))
    ax.plot(around, _closed(overall.stiffness) / UM, color=BLUE, linewidth=1.8, label=f"{kind_name(overall)}, with 95 %")
    most = float(max(bound[np.isfinite(bound)].max() for bound in (high, _closed(overall.stiffness) / UM)))
    apart = nice_step(most / _RINGS * 2)
    rings = [apart * k for k in range(1, int(most / apart) + 1)]
    ax.set_ylim(0.0, 1.03 * most)
    ax.set_yticks(rings, [])
    for value in rings:
        ax.text(_VALUES_AT, value, f"{value:g}", ha="center", va="center", **_RING)
    ax.set_xticks(np.deg2rad(range(0, 360, 45)), _spokes(plane_axes(found.joints)))
    ax.tick_params(axis="x", pad=0)
    ax.grid(color=FAINT, linewidth=0.7)
    ax.spines["polar"].set_color(FAINT)
    ax.set_title("stiffness [N/µm]" + (", simulated" if found.joints.test.simulated else ""), pad=18)
    figure.legend(loc="outside lower center", ncols=2)
    return figure


def _spokes(names: tuple[str, ...]) -> list[str]:
    """Names of the directions every 45 degrees: the axes of the plane, as far as they are known."""
    axes = {0: f"+{names[0]}", 90: f"+{names[1]}", 180: f"−{names[0]}", 270: f"−{names[1]}"} if names else {}
    return [axes.get(at, f"{at}°") for at in range(0, 360, 45)]


def levels_figure(found: StiffnessMap) -> Figure:
    """Secant, increment and modelled stiffness by engagement, along the two directions of the plane (Figure 6.10)."""
    figure = new_figure(2.9)
    axes = figure.subplots(1, 2, sharey=True)
    names = plane_axes(found.joints) or ("0°", "90°")
    commanded = np.array(found.engagements) * UM
    for ax, k, name in zip(axes, (0, len(found.overall.angle) // 4), names, strict=True):
        _bars(ax, commanded, found.secants, k, ORANGE, "secant (Eq. 6.5)", "o-")
        half = np.diff(commanded) / 2
        _bars(ax, commanded[:-1] + half, found.increments, k, BLUE, "increment", "s", across=half)
        at = commanded if len(found.modelled) > 1 else commanded[[0, -1]]
        modelled = found.modelled if len(found.modelled) > 1 else found.modelled * 2
        ax.plot(
            at, [level.stiffness[k] / UM for level in modelled], "--", color=INK, linewidth=1.0, label=modelled_name(found)
        )
        ax.set_title(f"along {name}")
        ax.set_xlabel("commanded engagement [µm]")
        ax.set_xticks(commanded)
    axes[0].set_ylabel("stiffness [N/µm]")
    axes[0].legend(loc="best")
    return figure


def torques_figure(found: StiffnessMap) -> Figure:
    """What each motor takes along the turn, and the parts of it (Figure 6.5)."""
    figure = new_figure(0.4 + 2.4 * len(found.torques))
    axes = np.atleast_1d(figure.subplots(len(found.torques), 1, sharex=True))
    for ax, motor in zip(axes, found.torques, strict=True):
        _torques(ax, motor)
    axes[-1].set_xlabel("angle [°]")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def dynamometer_figure(found: StiffnessMap) -> Figure:
    """Force from the currents and of the dynamometer around the turn, a run of each engagement (Figure 6.7)."""
    assert found.dynamometer is not None
    columns: dict[str, dict[float, ComparedForce]] = {}
    for force in found.dynamometer.forces:
        columns.setdefault(force.column, {}).setdefault(force.engagement, force)
    figure = new_figure(0.4 + 2.4 * len(columns))
    for ax, (column, levels) in zip(
        np.atleast_1d(figure.subplots(len(columns), 1, sharex=True)), columns.items(), strict=True
    ):
        colours = force_colours(sorted(levels))
        for engagement, force in sorted(levels.items()):
            angle, order = _around(force.angle)
            ax.plot(angle, force.dynamometer[order], color=FAINT, linewidth=3.0, zorder=1)
            ax.plot(angle, force.current[order], color=colours[engagement], label=f"{engagement * UM:.4g} µm")
        ax.plot([], [], color=FAINT, linewidth=3.0, label="dynamometer")
        ax.set_ylabel(f"force in {column[-1]} [N]")
        ax.set_xticks(range(0, 361, 90))
    ax.set_xlabel("angle [°]")
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=6)
    return figure


def rig_figure(found: StiffnessMap) -> Figure:
    """Compliance without the rig, with it and as predicted by direction; stiffness by engagement (Figures 6.13, 6.14)."""
    assert found.rig is not None
    rig = found.rig
    figure = new_figure(3.1)
    left, right = figure.subplots(1, 2)
    angle = np.rad2deg(rig.without.angle)
    for one, colour, name in ((rig.without, BLUE, "without the rig"), (rig.measured, ORANGE, "with the rig")):
        low, high = one.interval.T * UM
        left.fill_between(angle, low, high, color=colour, alpha=0.2, linewidth=0)
        left.plot(angle, one.compliance * UM, color=colour, label=name)
    left.plot(angle, rig.predicted * UM, "--", color=INK, linewidth=1.0, label="predicted (Eq. 6.16)")
    left.set_xlabel("direction [°]")
    left.set_xticks(range(0, 361, 90))
    left.set_ylabel("compliance [µm/N]")
    left.set_ylim(bottom=0)
    left.legend(loc="center")
    k = rig.softest
    _bars(right, np.array(found.engagements) * UM, found.secants, k, BLUE, "without the rig", "o-")
    _bars(right, np.array(rig.engagements) * UM, rig.secants, k, ORANGE, "with the rig", "o-")
    predicted = [1 / (secant.compliance[k] + rig.rig[k]) / UM for secant in found.secants]
    right.plot(np.array(found.engagements) * UM, predicted, "--", color=INK, linewidth=1.0)
    right.set_xlabel("commanded engagement [µm]")
    right.set_ylabel("secant stiffness [N/µm]")
    right.set_title(f"at {angle[k]:.0f}°, where the rig is softest")
    right.set_ylim(bottom=0)
    return figure


def _torques(ax: Axes, motor: TorqueParts) -> None:
    unit, factor = effort_unit(motor.unit)
    angle, order = _around(motor.angle)

    def line(values: Array) -> Array:
        return np.asarray(np.where(motor.counts, values * factor, np.nan)[order])

    colours = {"load": BLUE, "coulomb": ORANGE, "viscous": GREEN, "inertia": "#cc79a7"}
    ax.plot(angle, line(motor.recorded), color=FAINT, linewidth=2.2, label="recorded")
    ax.plot(angle, line(np.sum(list(motor.parts.values()), axis=0)), color=INK, linewidth=0.7, label="sum of the parts")
    for part, values in motor.parts.items():
        ax.plot(angle, line(values), color=colours.get(part, GREY), linewidth=1.1, label=term_name(part))
    ax.set_ylabel(f"{motor.axis} [{unit}]")
    ax.set_xticks(range(0, 361, 90))


def _bars(
    ax: Axes,
    at: Array,
    levels: tuple[Stiffness, ...],
    k: int,
    colour: str,
    label: str,
    style: str,
    across: Array | None = None,
) -> None:
    """Stiffness of levels in one direction with its interval; an end that no data give is not drawn."""
    values = np.array([level.stiffness[k] for level in levels]) / UM
    low, high = np.array([level.stiffness_interval[k] for level in levels]).T / UM
    sizes = np.array([values - low, np.where(np.isfinite(high), high - values, 0.0)])
    shown = np.isfinite(values)
    ax.errorbar(
        at[shown],
        values[shown],
        yerr=sizes[:, shown],
        xerr=None if across is None else across[shown],
        fmt=style,
        color=colour,
        markersize=3.5,
        linewidth=1.0,
        capsize=2,
        label=label,
    )


def _around(angle: Array) -> tuple[Array, NDArray[np.intp]]:
    """The angle [°] of one turn, increasing, and the order of the samples that gives it."""
    turned = np.abs(angle - angle[0]) < 2 * np.pi
    degrees = np.where(turned, np.rad2deg(angle) % 360, np.nan)
    order = np.argsort(degrees)[: int(turned.sum())]
    return degrees[order], order


def _closed(values: Array, turn: float = 0.0) -> Array:
    """The values with the first once more at their end."""
    return np.append(values, values[0] + turn)
