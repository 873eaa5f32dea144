"""Cyclic errors of a screw or a scale: `P_XXc1`, `P_XXs1`, cosine and sine of one period per pitch, along the axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import COMPONENTS, Array, Joint, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source, twist_unit

LISTED_ORDERS = (1, 2)


@dataclass(frozen=True, slots=True)
class PitchHarmonic:
    """Driver: cosine or sine of the turns of the screw."""

    axis: str
    pitch: float
    order: int
    part: str

    def __call__(self, situation: Situation) -> Array:
        """Values at every reading, shape (m,)."""
        phase = 2 * np.pi * self.order / self.pitch * situation.command(self.axis)
        return np.asarray(np.cos(phase) if self.part == "c" else np.sin(phase))


@family
def cyclic_errors(machine: Machine) -> Iterator[Source]:
    """Cyclic positioning errors of every axis whose pitch the machine file gives."""
    for joint in machine.joints:
        if joint.pitch is not None:
            yield from (_cyclic(joint, joint.pitch, n, part) for n in LISTED_ORDERS for part in "cs")


def _cyclic(joint: Joint, pitch: float, order: int, part: str) -> Source:
    along = joint.direction + 3 * joint.is_rotary
    return Source(
        name=f"P_{COMPONENTS[along]}{joint.name}{part}{order}",
        unit=twist_unit(along),
        site=("motion", joint.name),
        component=along,
        driver=PitchHarmonic(joint.name, pitch, order, part),
        meaning=f"cyclic error of {joint.name}, {'cosine' if part == 'c' else 'sine'}, {order} per pitch",
    )
