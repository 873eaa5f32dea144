"""What happens where an axis turns back: backlash, lateral play, and the spike of friction.

`B_XX` is the backlash of X (its reversal value: what is lost when it turns back), `B_YX` its lateral play in y. The axis
falls short of its command by half of it. `S_XX` is the height of a spike that dies away within `SPIKE_LENGTH` of travel
after the turn. All count along the axis's own command, the motion of the tool relative to the workpiece: a positive value
means the same whichever of the two the axis carries.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import COMPONENTS, Array, Joint, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Sign, Source, twist_unit

SPIKE_LENGTH = 0.1
"""Travel [mm or degrees] after a reversal in which its spike falls to 37 %."""

FADED = 10.0
"""After so many lengths a spike is over: an arc that begins later has none."""


@dataclass(frozen=True, slots=True)
class Lag:
    """Driver: minus half the sense of the axis's command, as a twist of its carriage."""

    axis: str

    def __call__(self, situation: Situation) -> Array:
        """-1/2, 0 or 1/2 at every reading, shape (m,)."""
        return -0.5 * situation.side(self.axis) * situation.sense(self.axis)


@dataclass(frozen=True, slots=True)
class AfterReversal:
    """Driver: minus the sense of the command, dying away with the travel since the axis turned back.

    So near a turn the acceleration is as good as constant, and the travel is `v^2 / (2 a)`: what a reading says by itself,
    wherever in the run, or in its arc, it stands.
    """

    axis: str
    length: float

    def __call__(self, situation: Situation) -> Array:
        """Values between -1 and 1 at every reading, shape (m,); 0 where the axis slows down, or has long turned."""
        sense, acceleration = situation.sense(self.axis), situation.acceleration(self.axis)
        to_speed = situation.velocity(self.axis) ** 2 / 2
        after = (sense * acceleration > 0) & (to_speed < FADED * self.length * np.abs(acceleration))
        spike = np.zeros(len(sense))
        spike[after] = -sense[after] * np.exp(-to_speed[after] / np.abs(acceleration[after]) / self.length)
        return situation.side(self.axis) * spike


@family
def reversal_errors(machine: Machine) -> Iterator[Source]:
    """Backlash and lateral play, translations and rotations, of every axis but the spindle; a spike along each."""
    for joint in machine.joints:
        if joint.name == "S":
            continue
        along = joint.direction + 3 * joint.is_rotary
        yield from (_play(joint, d, along) for d in range(6))
        yield Source(
            name=f"S_{COMPONENTS[along]}{joint.name}",
            unit=twist_unit(along),
            site=("motion", joint.name),
            component=along,
            driver=AfterReversal(joint.name, np.deg2rad(SPIKE_LENGTH) if joint.is_rotary else SPIKE_LENGTH),
            meaning=f"reversal spike of {joint.name}",
            sign=Sign("spike", joint.name),
        )


def _play(joint: Joint, d: int, along: int) -> Source:
    kind = "backlash" if d == along else f"{'angular' if d >= 3 else 'lateral'} play ({COMPONENTS[d]})"
    return Source(
        name=f"B_{COMPONENTS[d]}{joint.name}",
        unit=twist_unit(d),
        site=("motion", joint.name),
        component=d,
        driver=Lag(joint.name),
        meaning=f"{kind} of {joint.name}",
        sign=Sign("backlash", joint.name) if d == along else Sign("play", joint.name, COMPONENTS[d]),
    )
