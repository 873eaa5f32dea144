"""A record of one axis in one run: its motion and the effort of its drive, sample by sample."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from elastogeo.drive.differentiator import JUMP
from elastogeo.errors import InputError
from elastogeo.machine import ROTARY, Array

EFFORT_UNITS = ("A", "N mm", "N", "%")
"""What an effort may be in: the motor's current if its constant is not known, its torque, the force of a linear motor,
or percent of a rated value that is not known."""


@dataclass(frozen=True, slots=True, eq=False)
class DriveRecord:
    """Motion of an axis and effort of its drive.

    Attributes
    ----------
    run, axis : str
    time : array, shape (m,) [s]
        Increasing; gaps are allowed.
    position, velocity, acceleration : array, shape (m,) [mm, mm/s, mm/s^2; rad of a rotary axis]
    effort : array, shape (m,) [`effort_unit`]
        Positive if it drives the axis to greater positions.
    disturbance : mapping of str to array, shape (m,)
        Direction pattern of an unknown load by its name: `cos theta` of Eq. 6.7, `sin theta` of 6.8. The load itself, in
        the unit of the effort, is identified.
    effort_unit : str
        One of `EFFORT_UNITS`.
    cutoff : float or None [Hz]
        Of the low-pass that effort and motion went through (`differentiate`, `smoothed`): the friction of a reversal then
        goes through it as well. None if they stand as recorded.
    standing : array of bool, shape (m,), or None
        Where the axis stands, as the position shows before the low-pass; None where nothing was smoothed, and the velocity
        tells.
    """

    run: str
    axis: str
    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    effort: Array
    disturbance: Mapping[str, Array] = field(default_factory=dict)
    effort_unit: str = "A"
    cutoff: float | None = None
    standing: NDArray[np.bool_] | None = None

    def __post_init__(self) -> None:
        """Refuse a record that is none."""
        where = f"run {self.run}, axis {self.axis}"
        if self.effort_unit not in EFFORT_UNITS:
            raise InputError(f"{where}: the effort is in {self.effort_unit!r}; give it in {' or '.join(EFFORT_UNITS)}")
        columns = {
            "time": self.time,
            "position": self.position,
            "velocity": self.velocity,
            "acceleration": self.acceleration,
            "effort": self.effort,
            **self.disturbance,
        }
        for name, values in columns.items():
            if values.shape != (len(self.time),) or len(values) < 2:
                raise InputError(
                    f"{where}: {name} has the shape {values.shape} at {len(self.time)} times; a record has two samples or "
                    f"more, each with one value of everything"
                )
            if not np.isfinite(values).all():
                row = int(np.argmin(np.isfinite(values))) + 1
                raise InputError(f"{where}: sample {row} of {name} is no finite number; repair the log or cut it there")
        if self.standing is not None and self.standing.shape != self.time.shape:
            raise InputError(f"{where}: standing has {len(self.standing)} values at {len(self.time)} times; each needs one")
        if (np.diff(self.time) <= 0).any():
            raise InputError(f"{where}: the clock does not go forward at every sample; sort the log and remove doubles")

    @property
    def length_unit(self) -> str:
        """Unit of the position: mm, or rad of a rotary axis."""
        return "rad" if self.axis[:1] in ROTARY else "mm"

    @property
    def step(self) -> float:
        """Median time from sample to sample [s]."""
        return float(np.median(np.diff(self.time)))

    def moved(self, delay: float, neighbours: float = 0.0) -> tuple[Array, Array]:
        """Velocity and acceleration that an effort with this delay belongs to, shape (m,) each.

        Those of `time - delay`, between samples by interpolation; at the ends and in gaps only where `has_moved` says so.
        First each sample takes this share of the mean of its two neighbours, where it has both.
        """
        velocity, acceleration = self.velocity, self.acceleration
        if neighbours:
            near = np.diff(self.time) <= JUMP * self.step
            share = np.zeros(len(self.time))
            share[1:-1] = neighbours * (near[1:] & near[:-1])
            velocity, acceleration = _averaged(velocity, share), _averaged(acceleration, share)
        if not delay:
            return velocity, acceleration
        wanted = self.time - delay
        return np.interp(wanted, self.time, velocity), np.interp(wanted, self.time, acceleration)

    def has_moved(self, delay: float) -> NDArray[np.bool_]:
        """Whether the record has the motion of `time - delay`, shape (m,): not before its begin, after its end, in a gap."""
        if not delay:
            return np.ones(len(self.time), dtype=bool)
        wanted = self.time - delay
        after = np.clip(np.searchsorted(self.time, wanted), 1, len(self.time) - 1)
        near = self.time[after] - self.time[after - 1] <= JUMP * self.step
        return np.asarray(near & (wanted >= self.time[0]) & (wanted <= self.time[-1]))


def _averaged(values: Array, share: Array) -> Array:
    """Values with this share of the mean of their neighbours, shape (m,)."""
    mean = values.copy()
    mean[1:-1] = (values[2:] + values[:-2]) / 2
    return values + share * (mean - values)
