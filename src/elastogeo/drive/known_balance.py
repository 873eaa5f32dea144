"""What is known of a drive's own torques beforehand: Eq. 6.6 with its parameters as a test file may give them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.drive.balance import TorqueBalance
from elastogeo.drive.feed_drive import FeedDrive
from elastogeo.drive.model import PLAIN, TorqueModel
from elastogeo.drive.terms import Motion
from elastogeo.errors import InputError
from elastogeo.estimate import Estimate
from elastogeo.machine import ROTARY, Array, Damping, Feed, Inertia, Torque


@dataclass(frozen=True, slots=True)
class KnownBalance:
    """The torques that a rotary motor needs for its axis alone, as far as they are known.

    Attributes
    ----------
    axis : str
    inertia : float or None [N mm s^2]
        J_T, all that turns and moves with the motor, seen at its shaft; None, here and below, if it is not known.
    viscous : float or None [N mm s/rad]
        B_T.
    coulomb : float or None [N mm]
        tau_c.
    constant : float or None [N mm]
        Gravity, preload.
    smooth_speed : float or None [mm/s, or rad/s of a rotary axis]
        Speed over which the Coulomb torque changes its sign, `tanh(v / smooth_speed)`; None for a sharp sign.
    """

    axis: str
    inertia: Inertia | None = None
    viscous: Damping | None = None
    coulomb: Torque | None = None
    constant: Torque | None = None
    smooth_speed: Feed | None = None

    def __post_init__(self) -> None:
        """Refuse torques that would drive the motor."""
        sizes = [size for size in (self.inertia, self.viscous, self.coulomb, 0.0) if size is not None]
        if min(sizes) < 0 or not np.isfinite([*sizes, self.constant or 0.0]).all():
            raise InputError(f"the balance of axis {self.axis} has an inertia or a friction that is negative or no number")
        if self.smooth_speed is not None and not self.smooth_speed > 0:
            raise InputError(f"the balance of axis {self.axis} has a smooth speed {self.smooth_speed:g}: not positive")


def known_terms(known: KnownBalance, drive: FeedDrive) -> dict[str, float]:
    """What is known, by the label of its term, against the motion of the axis.

    Parameters
    ----------
    known : KnownBalance
    drive : FeedDrive
        With its transmission.

    Raises
    ------
    InputError
        If the transmission is not known.
    """
    ratio = drive.transmission_ratio
    if ratio is None:
        raise InputError(f"the drive of axis {drive.axis} has no pitch_mm and no pinion_radius_mm; how fast does it turn?")
    sizes = (known.inertia, known.viscous, known.coulomb, known.constant)
    per_motion = (1.0 / ratio, 1.0 / ratio, 1.0, 1.0)
    return {term: size * factor for term, size, factor in zip(PLAIN, sizes, per_motion, strict=True) if size is not None}


def known_torque_balance(known: KnownBalance, drive: FeedDrive, least_speed: float = 0.0) -> TorqueBalance:
    """The balance of a drive whose torques are known: without uncertainty, against the motion of its axis.

    What is not known counts as zero.

    Parameters
    ----------
    known : KnownBalance
    drive : FeedDrive
        With its transmission.
    least_speed : float [mm/s; rad/s of a rotary axis]
        Of the samples that the balance may be held against.

    Raises
    ------
    InputError
        If the transmission is not known.
    """
    model = TorqueModel(PLAIN, least_speed, known.smooth_speed)
    length = "rad" if drive.axis in ROTARY else "mm"
    terms = known_terms(known, drive)
    return TorqueBalance(
        axis=drive.axis,
        model=model,
        labels=model.labels,
        values=np.array([terms.get(label, 0.0) for label in model.labels]),
        covariance=np.zeros((len(model.labels), len(model.labels))),
        degrees_of_freedom=np.full(len(model.labels), np.inf),
        residual_std=0.0,
        units={label: unit.format(effort="N mm", length=length) for t in model.chosen for label, unit in t.units.items()},
        effort_unit="N mm",
    )


def balance_effort(known: KnownBalance, drive: FeedDrive, velocity: Array, acceleration: Array) -> Array:
    """Torque [N mm] that a motor needs to move its axis, shape (m,): Eq. 6.6 without its disturbance.

    Parameters
    ----------
    known : KnownBalance
    drive : FeedDrive
        With its transmission.
    velocity, acceleration : array, shape (m,) [mm/s, mm/s^2; rad/s, rad/s^2 of a rotary axis]
        Of the axis.

    Raises
    ------
    InputError
        If the transmission is not known.
    """
    balance = known_torque_balance(known, drive)
    motion = Motion(velocity, acceleration, known.smooth_speed)
    return np.hstack([term.columns(motion) for term in balance.model.chosen]) @ balance.values


@dataclass(frozen=True, slots=True)
class MotorParameter:
    """One parameter of a torque balance, as the motor feels it.

    Attributes
    ----------
    label : str
    estimate : Estimate
        In `unit`.
    unit : str
    """

    label: str
    estimate: Estimate
    unit: str


_AT_SHAFT = {"inertia": "kg m²", "viscous": "N m s/rad"}
"""Units of what goes with the speed of the shaft; the others are torques."""


def motor_parameters(balance: TorqueBalance, drive: FeedDrive) -> tuple[MotorParameter, ...]:
    """A balance against the motion of an axis, turned to the motor's shaft (Table 6.4); one in N or A stays as it is."""
    sizes = np.sqrt(np.diag(balance.covariance))
    numbers = zip(balance.values, sizes, balance.degrees_of_freedom, strict=True)
    found = zip(balance.labels, (Estimate(float(v), float(u), float(f)) for v, u, f in numbers), strict=True)
    if balance.effort_unit != "N mm" or drive.transmission_ratio is None:
        return tuple(MotorParameter(label, estimate, balance.units[label]) for label, estimate in found)
    parameters = []
    for label, estimate in found:
        kind = label.split()[0]
        factor = 1e-3 * (drive.transmission_ratio if kind in _AT_SHAFT else 1.0)
        unit = _AT_SHAFT.get(kind, "N m")
        parameters.append(MotorParameter(label, estimate.scaled(factor), unit))
    return tuple(parameters)
