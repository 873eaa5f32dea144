"""The model of the torque balance: its terms, the laws among them, and which samples it may be held against."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.drive.differentiator import smoothed
from elastogeo.drive.dwells import standstill
from elastogeo.drive.records import DriveRecord
from elastogeo.drive.terms import Motion, Term, term_named
from elastogeo.errors import InputError
from elastogeo.machine import Array

PLAIN = ("inertia", "viscous", "coulomb", "constant")
"""The terms of Eq. 6.6 and a constant."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class TorqueModel:
    """Which terms an effort is made of, and the laws among them that are not linear in a parameter.

    Attributes
    ----------
    terms : tuple of str
    least_speed : float or None [mm/s; rad/s of a rotary axis]
        Slower samples are left out: near standstill friction takes any value up to that of breaking loose, and no sign
        says which. None leaves out what each record itself shows to be at rest (`standstill`), and with a sharp sign what
        is no faster than its noise there. With a sharp sign, samples at exactly zero are always left out.
    smooth_speed : float or None [mm/s]
        Of the law `tanh(v / smooth_speed)` in place of the sign.
    stribeck_speed : float or None [mm/s]
        Of the term `stribeck`.
    delay : float [s]
        Of the effort's channel against the motion's: positive if the effort is recorded late.
    neighbours : float
        Share, 0 to 0.5, that the mean of its two neighbours has in the motion of a sample: for channels that a control does
        not sample at one instant. A fraction of a delay averages neighbours as well; this tells whether that is all it does.
    """

    terms: tuple[str, ...] = PLAIN
    least_speed: float | None = None
    smooth_speed: float | None = None
    stribeck_speed: float | None = None
    delay: float = 0.0
    neighbours: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a model that is none."""
        if not self.terms or len(set(self.terms)) < len(self.terms):
            raise InputError(f"the terms {', '.join(self.terms) or 'of none'} cannot be used; name one or more, each once")
        found = self.chosen
        if self.least_speed is not None and not (np.isfinite(self.least_speed) and self.least_speed >= 0):
            raise InputError(f"least_speed is {self.least_speed:g}; write 0 or a positive speed")
        for name, speed in (("smooth_speed", self.smooth_speed), ("stribeck_speed", self.stribeck_speed)):
            if speed is not None and not (np.isfinite(speed) and speed > 0):
                raise InputError(f"{name} is {speed:g}; write a positive speed, or leave it out")
        if not np.isfinite(self.delay):
            raise InputError(f"the delay of the effort is {self.delay:g} s; write a number")
        if not 0 <= self.neighbours <= 0.5:
            raise InputError(f"the share of the neighbours is {self.neighbours:g}; write a number from 0 to 0.5")
        if any(term.name == "stribeck" for term in found) != (self.stribeck_speed is not None):
            raise InputError("the term stribeck and a stribeck_speed belong together; give both or neither")

    @property
    def chosen(self) -> tuple[Term, ...]:
        """Its terms."""
        return tuple(map(term_named, self.terms))

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of its parameters."""
        return tuple(label for term in self.chosen for label in term.units)

    @property
    def sharp(self) -> bool:
        """Whether it takes the sign of the velocity."""
        return self.smooth_speed is None and any(term.signed for term in self.chosen)


def motion_columns(record: DriveRecord, model: TorqueModel) -> tuple[tuple[str, ...], Array]:
    """Names of the parameters, and the effort per unit of each at every sample, shape (m, p) (Eq. 6.7 without the load)."""
    velocity, acceleration = record.moved(model.delay, model.neighbours)
    motion = Motion(velocity, acceleration, model.smooth_speed, model.stribeck_speed)
    return model.labels, np.hstack([_passed(record, term, term.columns(motion)) for term in model.chosen])


def _passed(record: DriveRecord, term: Term, columns: Array) -> Array:
    """Columns after the low-pass of the record, shape (m, k): what jumps at a reversal is no part of the motion's own.

    Inertia and viscous friction are linear in a motion that went through it already.
    """
    if record.cutoff is None or not term.signed:
        return columns
    passed = np.column_stack([smoothed(record.time, column, record.cutoff) for column in columns.T])
    return np.where(np.isnan(passed), columns, passed)


def usable(record: DriveRecord, model: TorqueModel) -> Mask:
    """Which samples the model may be held against, shape (m,): moving, and with a motion at their delay."""
    speed = np.abs(record.velocity)
    if model.least_speed is None:
        rest = standstill(record)
        moving = ~rest.near & (speed > rest.speed if model.sharp else True)
    else:
        moving = speed > model.least_speed if model.sharp or model.least_speed else np.ones(len(speed), dtype=bool)
    return np.asarray(moving & record.has_moved(model.delay))
