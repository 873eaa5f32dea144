"""The table of observations: what every instrument is made into.

A reading is the projection of the tool-to-workpiece displacement on the instrument's sensitive direction. So an observation
is a pose, a sensitive direction, the wrench that acted, the velocity, the reading. Everything above this room sees nothing
else of an instrument.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import RANK_TOLERANCE
from elastogeo.machine import Array, Workpiece

Rows = np.ndarray[tuple[int], np.dtype[np.intp]]
"""Numbers of readings, shape (k,)."""


@dataclass(frozen=True, slots=True)
class ObservedInfluence:
    """A systematic influence that came in with the observations themselves, alike in all runs of the test.

    Attributes
    ----------
    label : str
        One label may name several influences: they count together.
    standard_uncertainty : float
        Of the influence quantity.
    degrees_of_freedom : float
        Of that uncertainty.
    wrench : array, shape (m, 6) [N, N mm]
        Change of the wrench per unit of the quantity.
    reading : array, shape (m,) [mm or rad]
        Change of the reading per unit of the quantity.
    force : float [N]
        Change of the force of the whole run per unit of the quantity: what changes the wrench in proportion stands here, and
        not in `wrench`.
    """

    label: str
    standard_uncertainty: float
    degrees_of_freedom: float
    wrench: Array
    reading: Array
    force: float = 0.0

    def rows(self, part: slice | Rows) -> ObservedInfluence:
        """The same influence on some of the readings."""
        return replace(self, wrench=self.wrench[part], reading=self.reading[part])


@dataclass(frozen=True, slots=True)
class Observations:
    """Readings of one run, in the units of the house (mm, N, rad, s, N mm), in the foundation frame.

    Attributes
    ----------
    run : str
        Name of the run; of a part of it that counts as a run, with the part behind a comma.
    force : float [N]
        Force level of the run.
    pose : array, shape (m,)
        What the readings count along: the angle of a bar [rad], the force of a ramp [N], ...
    commands : array, shape (m, n) [mm, rad]
        Axis commands, in the order of the machine's axes.
    velocity : array, shape (m, n) [mm/s, rad/s]
        Their time derivatives.
    acceleration : array, shape (m, n) [mm/s^2], or None
        Of the linear axes; None where it is not known.
    centre : array, shape (n,) [mm, rad]
        Axis commands at the centre of the test, about which polynomials of the commands are taken.
    direction : array, shape (m, 6)
        Sensitive direction: a unit twist (translation, rotation).
    wrench : array, shape (m, 6) [N, N mm]
        Wrench on the tool at the functional point; its reaction acts on the workpiece.
    reading : array, shape (m,) [mm or rad]
        With `correction` subtracted.
    correction : array, shape (m,) [mm or rad]
        What the set-up adds to the recorded reading and was subtracted.
    tool : array, shape (3,) [mm]
        Functional point in the frame of the last tool-branch carriage.
    workpiece : array, shape (3,) or (m, 3) [mm]
        The point measured against, in the frame of the last workpiece-branch carriage; one for each reading where the
        instrument measures against a line or a face rather than a point.
    length : float [mm]
        Nominal distance of the two points if the instrument reads its change; infinite if it reads the displacement along
        a fixed direction.
    collinear : float
        A column of the design whose distance from the span of others is a smaller share of its length is not told from
        them: rounding, or what the noise of a measured force makes of it.
    influences : tuple of ObservedInfluence
        What is uncertain in wrench and reading together, and alike in all runs.
    sense : array, shape (m, n), or None
        Way in which each axis moved last, +1 or -1, 0 if it did not, where the readings are taken at standstill; None where
        the velocity says it.
    nominal : array, shape (m,) [mm or rad], or None
        What the instrument measures on a perfect machine, where the reading is the departure from it; None for nothing.
    instant : array, shape (m,), or None
        Number of the instant at which each reading was taken, from 0, where several sensors are read at once and the rows
        stand sensor after sensor; None where they stand in the order of time.
    weight : Workpiece or None
        What lies on the table and loads the joints that carry it.
    span : tuple of str, or None
        The joints across which the instrument reads, where its two ends are not tool and workpiece: it sees the twists of
        these joints and of no other place, while the wrench loads them all. None for the whole loop.
    """

    run: str
    force: float
    pose: Array
    commands: Array
    velocity: Array
    acceleration: Array | None
    centre: Array
    direction: Array
    wrench: Array
    reading: Array
    correction: Array
    tool: Array
    workpiece: Array
    length: float = float("inf")
    collinear: float = RANK_TOLERANCE
    influences: tuple[ObservedInfluence, ...] = ()
    sense: Array | None = None
    nominal: Array | None = None
    span: tuple[str, ...] | None = None
    instant: Array | None = None
    weight: Workpiece | None = None

    def __len__(self) -> int:
        """How many readings."""
        return len(self.reading)

    def sees(self, axis: str) -> bool:
        """Whether a twist at a joint, or at an end of the loop (no axis), moves what the instrument reads."""
        return self.span is None or axis in self.span

    @property
    def instants(self) -> Array:
        """Numbers of the instants of the readings, shape (m,), in the order of time."""
        return np.arange(len(self), dtype=float) if self.instant is None else self.instant

    def with_reading(self, reading: Array) -> Observations:
        """The same observations with other readings, shape (m,)."""
        return replace(self, reading=reading)

    def rows(self, first: int, last: int) -> Observations:
        """A block of the readings."""
        return self.at(slice(first, last))

    def at(self, part: slice | Rows) -> Observations:
        """Some of the readings: a block, or by their numbers, shape (k,)."""
        return replace(
            self,
            pose=self.pose[part],
            commands=self.commands[part],
            velocity=self.velocity[part],
            acceleration=None if self.acceleration is None else self.acceleration[part],
            direction=self.direction[part],
            wrench=self.wrench[part],
            reading=self.reading[part],
            correction=self.correction[part],
            workpiece=self.workpiece if self.workpiece.ndim == 1 else self.workpiece[part],
            influences=tuple(influence.rows(part) for influence in self.influences),
            sense=None if self.sense is None else self.sense[part],
            nominal=None if self.nominal is None else self.nominal[part],
            instant=None if self.instant is None else self.instant[part],
        )


def check_observations(observations: Observations) -> Observations:
    """The same observations, if every number is finite and there is a reading at all.

    Raises
    ------
    InputError
        With the run, the quantity and the first reading that is not finite.
    """
    name = observations.run
    if not len(observations):
        raise InputError(f"run {name!r} has no reading")
    if not isfinite(observations.force):
        raise InputError(f"run {name!r}: the force is {observations.force}, it must be a finite number of newtons")
    for quantity in ("commands", "velocity", "direction", "wrench", "reading", "pose"):
        values = np.atleast_2d(getattr(observations, quantity).T)
        if not np.isfinite(values).all():
            row = int(np.flatnonzero(~np.isfinite(values).all(axis=0))[0])
            raise InputError(f"run {name!r}: the {quantity} of reading {row + 1} is no finite number")
    return observations
