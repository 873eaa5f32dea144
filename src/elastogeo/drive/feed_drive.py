"""A feed drive: from the motor's current to its torque, to the force at the joint (Eqs. 6.6, 6.10, 6.11)."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, pi

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import InputError
from elastogeo.machine import Array, ForcePerCurrent, Length, TorquePerCurrent

Mask = NDArray[np.bool_]

LOSS_UNCERTAINTY = 0.25
"""Relative standard uncertainty of the losses of a transmission that is driven back, where nothing is stated of them."""


@dataclass(frozen=True, slots=True)
class FeedDrive:
    """What turns a motor's current into a force at the joint of an axis.

    Three kinds: a rotary motor on a screw (`torque_constant`, `pitch`), on a rack (`torque_constant`, `pinion_radius`), or
    a linear motor (`force_constant`). For a rotary axis, a motor on a gear or a torque motor (`torque_constant` alone).

    Attributes
    ----------
    axis : str
    torque_constant : float or None [N mm/A]
        k_t of a rotary motor.
    force_constant : float or None [N/A]
        Of a linear motor.
    pitch : float or None [mm]
        Travel of the screw per turn, h.
    pinion_radius : float or None [mm]
        Pitch radius of the pinion that runs on a rack.
    gear_ratio : float
        Turns of the motor per turn of the screw, pinion or table.
    efficiency : float
        Share of the motor's power that arrives at the axis while the motor drives it, eta.
    back_efficiency : float or None
        Share of the load's power that arrives at the motor while the load drives the axis; None if it is not known
        (`back_driven`).
    sense : int
        +1 if a positive current moves the axis to greater positions, -1 if to smaller ones.
    relative_uncertainty : float
        Relative standard uncertainty of the force per current: of motor constant, transmission and efficiency together,
        in both directions of the power alike.
    """

    axis: str
    torque_constant: TorquePerCurrent | None = None
    force_constant: ForcePerCurrent | None = None
    pitch: Length | None = None
    pinion_radius: Length | None = None
    gear_ratio: float = 1.0
    efficiency: float = 1.0
    back_efficiency: float | None = None
    sense: int = 1
    relative_uncertainty: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a drive that contradicts itself."""
        where = f"the drive of axis {self.axis}"
        if self.torque_constant is not None and self.force_constant is not None:
            raise InputError(
                f"{where} has a torque constant and a force constant; a rotary motor has the first, a linear one the second"
            )
        if self.force_constant is not None and (self.pitch or self.pinion_radius):
            raise InputError(f"{where} is a linear motor, which turns no screw and no pinion; leave pitch and radius out")
        if self.pitch is not None and self.pinion_radius is not None:
            raise InputError(f"{where} has a pitch and a pinion radius; a screw has the first, a rack the second")
        sizes = (self.torque_constant, self.force_constant, self.pitch, self.pinion_radius, self.gear_ratio)
        if any(size is not None and not (size > 0 and isfinite(size)) for size in sizes):
            raise InputError(f"{where} has a constant, pitch, radius or ratio that is not a positive number")
        if not 0 < self.efficiency <= 1:
            raise InputError(f"{where} has the efficiency {self.efficiency:g}; it lies between 0 and 1 (90 % is 0.9)")
        if self.back_efficiency is not None and not 0 < self.back_efficiency <= 1:
            raise InputError(
                f"{where} has the back_efficiency {self.back_efficiency:g}; it lies above 0 and up to 1 (one that cannot be "
                f"driven back shows no load while it is)"
            )
        if self.back_efficiency is None and self.efficiency <= 0.5:
            raise InputError(
                f"{where} has the efficiency {self.efficiency:g}: at 0.5 or less friction alone holds any load, "
                f"which its motor does not feel; state the back_efficiency that it has"
            )
        if not 0 <= self.relative_uncertainty < 1:
            raise InputError(
                f"{where} has the relative uncertainty {self.relative_uncertainty:g}; it lies between 0 and 1 (5 % is 0.05)"
            )
        if self.sense not in (1, -1):
            raise InputError(f"{where} has the sense {self.sense}; write 1 or -1")

    @property
    def motor_constant(self) -> float | None:
        """Effort of the motor per current [N mm/A, or N/A of a linear motor]; None if it is not known."""
        return self.torque_constant if self.force_constant is None else self.force_constant

    @property
    def transmission_ratio(self) -> float | None:
        """Travel of the axis per turn of the motor, r_g [mm/rad, or rad/rad of a rotary axis] (Eq. 6.11).

        1 for a linear motor, whose effort is a force already; None if neither pitch nor radius is known.
        """
        if self.force_constant is not None:
            return 1.0
        if self.axis in "ABCS":
            return 1.0 / self.gear_ratio
        if self.pitch is not None:
            return self.pitch / (2 * pi) / self.gear_ratio
        return None if self.pinion_radius is None else self.pinion_radius / self.gear_ratio

    @property
    def back_driven(self) -> float:
        """Share of the load's power that arrives at the motor while the load drives the axis.

        If it is not stated: `2 - 1 / eta`. Friction in proportion to the load takes the same part of its torque whichever
        way the power flows: `1 + e` times the ideal torque one way (`eta = 1 / (1 + e)`), `1 - e` times the other.
        """
        return 2.0 - 1.0 / self.efficiency if self.back_efficiency is None else self.back_efficiency

    @property
    def back_uncertainty(self) -> float:
        """Relative standard uncertainty of `back_driven` beside that of the force per current: 0 if it is stated."""
        if self.back_efficiency is not None:
            return 0.0
        return LOSS_UNCERTAINTY * (1.0 - self.back_driven) / self.back_driven

    def force_per_effort(self, driving: Mask | None = None) -> Array | float:
        """Force at the joint per effort of the motor [1/mm; N mm per N mm of a rotary axis; 1 of a linear motor].

        Parameters
        ----------
        driving : array of bool, shape (m,), optional
            Where the motor drives its axis against the load, so that losses lower the force: `eta / r_g`. Elsewhere the load
            drives the axis against the motor, and losses lower the effort: `1 / (eta_back r_g)`. Default everywhere.

        Raises
        ------
        InputError
            If the transmission is not known.
        """
        if self.transmission_ratio is None:
            raise InputError(
                f"the drive of axis {self.axis} has no pitch_mm and no pinion_radius_mm; its torque gives no force"
            )
        forward = self.efficiency / self.transmission_ratio
        if driving is None:
            return forward
        return np.where(driving, forward, 1.0 / (self.back_driven * self.transmission_ratio))


def effort_from_current(drive: FeedDrive, current: Array) -> Array:
    """Torque [N mm] of a rotary motor, force [N] of a linear one, shape (m,), from its current, shape (m,) [A] (Eq. 6.6).

    Raises
    ------
    InputError
        If the motor's constant is not known.
    """
    return _effort_per_current(drive) * current


def current_from_effort(drive: FeedDrive, effort: Array) -> Array:
    """Current [A], shape (m,), that a motor takes for a torque [N mm] or, if it is a linear one, a force [N], shape (m,).

    Raises
    ------
    InputError
        As `effort_from_current`.
    """
    return effort / _effort_per_current(drive)


def force_from_effort(drive: FeedDrive, effort: Array, driving: Mask | None = None) -> Array:
    """Force at the joint, shape (m,) [N; N mm of a rotary axis], of a torque or force of its motor (Eqs. 6.10, 6.11).

    `driving`: where the motor drives the axis, as in `FeedDrive.force_per_effort`.
    """
    return np.asarray(drive.force_per_effort(driving) * effort)


def effort_from_force(drive: FeedDrive, force: Array, driving: Mask | None = None) -> Array:
    """Torque or force of the motor, shape (m,) [N mm or N], that holds a force at the joint, shape (m,) [N or N mm].

    `driving`: where the motor drives the axis, as in `FeedDrive.force_per_effort`.
    """
    return np.asarray(force / drive.force_per_effort(driving))


def _effort_per_current(drive: FeedDrive) -> float:
    if drive.motor_constant is None:
        raise InputError(
            f"the drive of axis {drive.axis} has neither torque_constant_N_m_per_A nor force_constant_N_per_A; "
            f"its current gives no torque"
        )
    return drive.sense * drive.motor_constant
