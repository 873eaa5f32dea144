"""Servo errors: `T_X1` [s] is by how much time X lags its command, `T_X2` [s^2] what it is off per acceleration.

On a circle a lag that all axes share moves the tool along the path and changes no radius: what a ball bar sees is the
mismatch, the difference of the lags.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.machine import Array, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source


@dataclass(frozen=True, slots=True)
class Rate:
    """Driver: minus the velocity (order 1) or the acceleration (order 2) of the axis."""

    axis: str
    order: int

    def __call__(self, situation: Situation) -> Array:
        """Values [mm/s, rad/s or mm/s^2] at every reading, shape (m,)."""
        return -situation.velocity(self.axis) if self.order == 1 else -situation.acceleration(self.axis)


@family
def servo_errors(machine: Machine) -> Iterator[Source]:
    """The lag of every axis but the spindle, and for linear axes the error per acceleration."""
    for joint in machine.joints:
        if joint.name == "S":
            continue
        for order, unit, kind in ((1, "s", "lag"), (2, "s^2", "error per acceleration")):
            if order == 1 or not joint.is_rotary:
                yield Source(
                    name=f"T_{joint.name}{order}",
                    unit=unit,
                    site=("motion", joint.name),
                    component=joint.direction + 3 * joint.is_rotary,
                    driver=Rate(joint.name, order),
                    meaning=f"servo {kind} of {joint.name}",
                )
