"""What there is to plan with: the machine, its tools, bars and forces, and the room between spindle and table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array, Feed, Forces, Length, Lengths, Machine, Point
from elastogeo.observe import Setup
from elastogeo.planning.offers.clearance import Clearance

LEAST_READINGS = 8
"""Readings of a full turn below which its shape is not seen."""


@dataclass(frozen=True, slots=True)
class Means:
    """What there is to plan with.

    Attributes
    ----------
    machine : Machine
        Its linear axes have a travel.
    tools : tuple of 3-vector [mm]
        Tool points in the last tool-branch frame; empty for the machine's own.
    forces : tuple of float [N]
        Force levels of every test, two different ones at least: one level does not tell compliance from geometry.
    radii : tuple of float [mm]
        Lengths of the bars that there are.
    feed : float [mm/s]
        Along a circle.
    readings : int
        Of a full turn, evenly spaced. A real run has many more, which its noise does not make independent.
    rotary : bool
        Whether rotary axes may stand anywhere in their travel; if not, they are held at zero.
    turning : bool
        Whether rotary axes may move within a test.
    clearance : Clearance
    margin : float [mm]
        Of the travel that a moving test leaves at each end, for feed-in and overshoot.
    engagements : tuple of float [mm]
        Of a roller in a ball.
    devices : mapping of str to Setup
        By instrument, set-ups that are known from tests: a ball-roller's with its drives.
    """

    machine: Machine
    tools: tuple[Point, ...] = ()
    forces: Forces = (100.0, 700.0)
    radii: Lengths = (100.0, 150.0)
    feed: Feed = 2000.0 / 60.0
    readings: int = 36
    rotary: bool = True
    turning: bool = True
    clearance: Clearance = field(default_factory=Clearance)
    margin: Length = 10.0
    engagements: Lengths = (0.08, 0.2)
    devices: Mapping[str, Setup] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse what no test can be planned with."""
        machine = self.machine
        endless = [joint.name for joint in machine.joints if not joint.is_rotary and not np.isfinite(joint.travel).all()]
        if endless:
            raise InputError(
                f"the travel of {' '.join(endless)} of machine {machine.name!r} is not known; state travel_mm of every "
                f"linear axis in the machine file, so that tests are planned within it"
            )
        if len({abs(force) for force in self.forces}) < 2 or not np.isfinite(self.forces).all():
            raise InputError(
                f"the force levels are {', '.join(f'{force:g}' for force in self.forces) or 'none'} N; it takes two "
                f"different ones: one level does not tell compliance from geometry"
            )
        if not self.radii or not all(0 < radius < inf for radius in self.radii):
            raise InputError(f"the lengths of the bars are {self.radii} mm; give one at least, all positive")
        if self.readings < LEAST_READINGS:
            raise InputError(f"{self.readings} readings of a turn are too few; plan with {LEAST_READINGS} or more")
        if not np.isfinite(np.array(self.tools, dtype=float)).all():
            raise InputError(f"the tool points are {self.tools}; each is three finite numbers [mm]")

    @property
    def tool_points(self) -> tuple[Point, ...]:
        """The tools, or the machine's own."""
        return self.tools or (self.machine.tool,)

    @property
    def linear(self) -> tuple[str, ...]:
        """The linear axes."""
        return tuple(joint.name for joint in self.machine.joints if not joint.is_rotary)

    @property
    def turnable(self) -> tuple[str, ...]:
        """The rotary axes that a plan may move: not the spindle."""
        return tuple(joint.name for joint in self.machine.joints if joint.is_rotary and joint.compliant)

    def travel(self, axis: str) -> tuple[float, float]:
        """Of an axis [mm or rad]; of a rotary one a full turn at most."""
        joint = self.machine.joints[self.machine.index(axis)]
        low, high = joint.travel
        return (max(low, -np.pi), min(high, np.pi)) if joint.is_rotary else (low, high)

    def within(self, commands: Array) -> bool:
        """Whether the linear axes stay within their travel by the margin, at commands of shape (m, n)."""
        for axis in self.linear:
            low, high = self.travel(axis)
            path = commands[:, self.machine.index(axis)]
            if path.min() < low + self.margin or path.max() > high - self.margin:
                return False
        return True

    def somewhere(self, random: np.random.Generator, margin: float = 0.0, share: float = 1.0) -> dict[str, float]:
        """Random commands of the linear axes [mm], within a share of their travel less a margin; rotary axes at zero."""
        place = {}
        for axis in self.linear:
            low, high = self.travel(axis)
            middle, half = (low + high) / 2, max((high - low) / 2 - margin, 0.0)
            place[axis] = float(middle + share * half * random.uniform(-1, 1))
        return place

    def turned(self, random: np.random.Generator) -> dict[str, float]:
        """Random commands of the rotary axes [rad]."""
        return {axis: float(random.uniform(*self.travel(axis))) for axis in self.turnable}


MINUTES_OF_SET_UP = 10.0
"""To place a bar or a sensor at a new place of the table and reference it."""

MINUTES_BETWEEN_RUNS = 0.5
"""To change the force and let it settle, with feed-in and overshoot."""


def minutes(runs: int, path: float, feed: float) -> float:
    """Minutes that a test takes: to set it up, and its runs of so much path [mm] each at a feed [mm/s]."""
    return MINUTES_OF_SET_UP + runs * (MINUTES_BETWEEN_RUNS + path / feed / 60.0)
