"""Servo errors: `T_X1` [s] is by how much time X lags its command, `T_X2` [s^2] by what it falls short per acceleration.

Both count along the axis's own command, on either branch.

On a circle a lag that all axes share moves the tool along the path and changes no radius: what a ball bar sees is the
mismatch, the difference of the lags.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.machine import Array, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Sign, Source


@dataclass(frozen=True, slots=True)
class Rate:
    """Driver: minus the commanded velocity (order 1) or acceleration (order 2), as a twist of the axis's carriage."""

    axis: str
    order: int

    def __call__(self, situation: Situation) -> Array:
        """Values [mm/s, rad/s or mm/s^2] at every reading, shape (m,)."""
        rate = situation.velocity(self.axis) if self.order == 1 else situation.acceleration(self.axis)
        return -situation.side(self.axis) * rate


@family
def servo_errors(machine: Machine) -> Iterator[Source]:
    """The lag of every axis but the spindle, and for linear axes the error per acceleration."""
    for joint in machine.joints:
        if joint.name == "S":
            continue
        for order, unit, kind, sign in (
            (1, "s", "lag", "lag"),
            (2, "s^2", "error per acceleration", "acceleration"),
        ):
            if order == 1 or not joint.is_rotary:
                yield Source(
                    name=f"T_{joint.name}{order}",
                    unit=unit,
                    site=("motion", joint.name),
                    component=joint.direction + 3 * joint.is_rotary,
                    driver=Rate(joint.name, order),
                    meaning=f"servo {kind} of {joint.name}",
                    sign=Sign(sign, joint.name),
                )
