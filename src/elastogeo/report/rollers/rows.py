"""A stiffness map in words and numbers: the rows of its tables, for every reader."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np

from elastogeo.identification import ComparedForce, RigTest, Stiffness, StiffnessMap
from elastogeo.machine import Array
from elastogeo.report.drive_terms import effort_unit, term_name
from elastogeo.report.numbers import significant, value_with_uncertainty

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
    """One engagement, formatted: commanded, its mean force, and the stiffness [N/um] of each kind around the turn."""

    engagement: str
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
        LevelRow(
            engagement=f"{engagement * UM:.4g}",
            force=f"{secant.force[0]:.0f}",
            secant=_around(secant),
            increment="" if step is None else _around(step),
            modelled=_around(law),
        )
        for engagement, secant, step, law in zip(found.engagements, found.secants, increments, modelled, strict=True)
    )


def _around(found: Stiffness) -> str:
    low, high = _stiffness(float(found.stiffness.min())), _stiffness(float(found.stiffness.max()))
    return low if low == high else f"{low} to {high}"


def span(levels: Sequence[Stiffness]) -> str:
    """The stiffness of levels, of their mean compliance around the turn: from the first to the last, `16.9 to 15.6`."""
    first, last = (float(np.mean(level.compliance)) for level in (levels[0], levels[-1]))
    said = [_stiffness(1 / value if value > 0 else inf) for value in (first, last)]
    return said[0] if len(levels) == 1 or said[0] == said[1] else " to ".join(said)


def modelled_name(found: StiffnessMap) -> str:
    """What the slope of the best law is called: `modelled`, and that it does not hold where no law does."""
    return "modelled" if found.law.follows else "modelled, does not hold"


def overall_name(found: StiffnessMap) -> str:
    """What the stiffness by direction is: `modelled`, `increment 1010 to 1550 N`."""
    return kind_name(found.overall)


def balance_rows(found: StiffnessMap) -> tuple[BalanceRow, ...]:
    """The torque balances of the drives, as their motors feel them."""
    rows = []
    for axis, parameters in found.motors.items():
        for parameter in parameters:
            value, half = parameter.estimate.value, parameter.estimate.expanded()
            shown = value_with_uncertainty(value, half) if half else f"{value:g} (given)"
            rows.append(BalanceRow(axis, term_name(parameter.label), shown, parameter.unit))
    return tuple(rows)


def kind_name(found: Stiffness) -> str:
    """A stiffness by its kind and its forces: `secant, 1503 N`."""
    between = " to ".join(f"{force:.0f}" for force in found.force)
    return f"{found.kind}, {between} N" if between else f"{found.kind}, all engagements"


def _stiffness(value: float) -> str:
    return "∞" if value == inf else significant(value / UM, 3)


@dataclass(frozen=True, slots=True)
class TorqueRow:
    """One part of the effort of one motor, formatted: its greatest size along the turn."""

    axis: str
    part: str
    peak: str
    unit: str


@dataclass(frozen=True, slots=True)
class ForceRow:
    """One engagement against the dynamometer, formatted [N]."""

    engagement: str
    runs: str
    dynamometer: str
    current: str
    rms_difference: str


@dataclass(frozen=True, slots=True)
class RigRow:
    """One engagement without and with the rig, formatted, along the direction in which the rig gives way most [um/N]."""

    engagement: str
    without: str
    predicted: str
    measured: str


def torque_rows(found: StiffnessMap) -> tuple[TorqueRow, ...]:
    """The greatest size of each part of the effort, motor by motor."""
    rows = []
    for motor in found.torques:
        unit, factor = effort_unit(motor.unit)
        rows += [
            TorqueRow(motor.axis, term_name(part), significant(motor.peak(part) * factor, 3), unit) for part in motor.parts
        ]
    return tuple(rows)


def force_rows(found: StiffnessMap) -> tuple[ForceRow, ...]:
    """The force from the currents against the dynamometer, an engagement each: root mean squares over its runs."""
    if found.dynamometer is None:
        return ()
    levels: dict[float, list[ComparedForce]] = {}
    for force in found.dynamometer.forces:
        levels.setdefault(force.engagement, []).append(force)
    return tuple(
        ForceRow(
            engagement=f"{engagement * UM:.4g}",
            runs=str(len({force.run for force in forces})),
            dynamometer=_rms([force.dynamometer for force in forces]),
            current=_rms([force.current for force in forces]),
            rms_difference=_rms([force.current - force.dynamometer for force in forces]),
        )
        for engagement, forces in sorted(levels.items())
    )


def _rms(traces: Sequence[Array]) -> str:
    return significant(float(np.sqrt(np.mean([np.mean(trace**2) for trace in traces]))), 3)


def rig_rows(without: StiffnessMap, found: RigTest) -> tuple[RigRow, ...]:
    """Secants of the engagements that both tests have, and the slope of the supported laws."""
    k, rows = found.softest, []
    secants = {round(engagement, 6): secant for engagement, secant in zip(found.engagements, found.secants, strict=True)}
    for engagement, secant in zip(without.engagements, without.secants, strict=True):
        measured = secants.get(round(engagement, 6))
        if measured is not None:
            rows.append(
                RigRow(
                    f"secant at {engagement * UM:.4g} µm",
                    _compliance(secant.compliance[k]),
                    _compliance(secant.compliance[k] + found.rig[k]),
                    _compliance(measured.compliance[k]),
                )
            )
    halves = [np.diff(one.interval[k])[0] / 2 for one in (found.without, found.measured)]
    values = (found.without.compliance[k], found.measured.compliance[k])
    said = [value_with_uncertainty(value * UM, half * UM) for value, half in zip(values, halves, strict=True)]
    return (*rows, RigRow("modelled", said[0], _compliance(found.predicted[k]), said[1]))


def _compliance(value: float) -> str:
    return significant(value * UM, 4)
