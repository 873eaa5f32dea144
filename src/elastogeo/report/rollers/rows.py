"""A stiffness map in words and figures: rows for every reader, and the polar figure."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.identification import Stiffness, StiffnessMap
from elastogeo.report.extra import needs_report_extra
from elastogeo.report.numbers import significant, value_with_uncertainty

if TYPE_CHECKING:
    from matplotlib.figure import Figure

UM = 1000.0
"""Micrometres in a millimetre; N/um are thousands of N/mm."""


@dataclass(frozen=True, slots=True)
class StiffnessRow:
    """One direction, formatted.

    Attributes
    ----------
    direction : str
        In degrees.
    compliance : str
        `value ± U` in um/N.
    stiffness, stiffness_interval : str
        In N/um.
    """

    direction: str
    compliance: str
    stiffness: str
    stiffness_interval: str


@dataclass(frozen=True, slots=True)
class LevelRow:
    """One engagement, formatted: its mean force, and least to greatest stiffness [N/um] of each kind around the turn."""

    force: str
    secant: str
    increment: str
    modelled: str


@dataclass(frozen=True, slots=True)
class BalanceRow:
    """One parameter of a drive's torque balance, formatted."""

    axis: str
    parameter: str
    value: str
    unit: str


def stiffness_rows(found: StiffnessMap) -> tuple[StiffnessRow, ...]:
    """The map, a row a direction."""
    overall = found.overall
    half = (overall.interval[:, 1] - overall.interval[:, 0]) / 2
    rows = []
    bounds = overall.stiffness_interval
    for k, angle in enumerate(overall.angle):
        low, high = bounds[k]
        rows.append(
            StiffnessRow(
                direction=f"{np.rad2deg(angle):.0f}",
                compliance=value_with_uncertainty(overall.compliance[k] * UM, half[k] * UM),
                stiffness=_stiffness(overall.stiffness[k]),
                stiffness_interval=f"{_stiffness(low)} to {_stiffness(high)}",
            )
        )
    return tuple(rows)


def level_rows(found: StiffnessMap) -> tuple[LevelRow, ...]:
    """How the stiffness goes with the engagement, a row each; an increment stands at its greater engagement."""
    modelled = found.modelled if len(found.modelled) > 1 else found.modelled * len(found.secants)
    increments = (None, *found.increments)
    return tuple(
        LevelRow(f"{secant.force[0]:.0f}", _around(secant), "" if step is None else _around(step), _around(law))
        for secant, step, law in zip(found.secants, increments, modelled, strict=True)
    )


def _around(found: Stiffness) -> str:
    low, high = _stiffness(float(found.stiffness.min())), _stiffness(float(found.stiffness.max()))
    return low if low == high else f"{low} to {high}"


def overall_name(found: StiffnessMap) -> str:
    """What the stiffness by direction is: `modelled`, `increment 1010 to 1550 N`."""
    return _named(found.overall)


def balance_rows(found: StiffnessMap) -> tuple[BalanceRow, ...]:
    """The torque balances of the drives, as their motors feel them."""
    rows = []
    for axis, parameters in found.motors.items():
        for parameter in parameters:
            value, half = parameter.estimate.value, parameter.estimate.expanded()
            shown = value_with_uncertainty(value, half) if half else f"{value:g} (given)"
            rows.append(BalanceRow(axis, parameter.label, shown, parameter.unit))
    return tuple(rows)


def stiffness_figure(found: StiffnessMap) -> Figure:
    """Stiffness by direction: what stands for the machine with its interval, and the increment of each engagement.

    Raises
    ------
    MissingExtraError
        If matplotlib is not installed.
    """
    with needs_report_extra():
        from elastogeo.report.drawing.style import BLUE, force_colours, house_style, new_figure
    with house_style():
        figure = new_figure(5.2)
        ax = figure.add_subplot(projection="polar")
        ax.tick_params(axis="x", pad=1)
        figure.set_layout_engine("constrained", rect=(0.05, 0.0, 0.95, 1.0))
        low, high = (_closed(bound) / UM for bound in found.overall.stiffness_interval.T)
        around = _closed(found.overall.angle, turn=2 * np.pi)
        ax.fill_between(around, low, np.where(np.isfinite(high), high, low), color=BLUE, alpha=0.15, linewidth=0)
        ax.plot(around, _closed(found.overall.stiffness) / UM, color=BLUE, label=f"{_named(found.overall)}, 95 %")
        colours = force_colours([step.force[-1] for step in found.increments])
        for step in found.increments:
            ax.plot(around, _closed(step.stiffness) / UM, color=colours[step.force[-1]], linewidth=0.8, label=_named(step))
        ax.set_ylim(0.0, 1.15 * float(np.max(found.overall.stiffness[np.isfinite(found.overall.stiffness)])) / UM)
        ax.set_title("volumetric stiffness (N/µm)" + (", simulated" if found.joints.test.simulated else ""))
        figure.legend(loc="outside right upper")
    return figure


def _named(found: Stiffness) -> str:
    between = " to ".join(f"{force:.0f}" for force in found.force)
    return f"{found.kind}, {between} N" if between else f"{found.kind}, all engagements"


def _closed(
    values: np.ndarray[tuple[int], np.dtype[np.float64]], turn: float = 0.0
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """The values with the first once more at their end."""
    return np.append(values, values[0] + turn)


def _stiffness(value: float) -> str:
    return "∞" if value == inf else significant(value / UM, 3)
