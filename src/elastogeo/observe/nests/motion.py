"""How rotary axes move while the linear axes keep the ball in the nest: K1 to K4 of ISO 10791-6 and their like."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array, AxisCommands


@dataclass(frozen=True, slots=True)
class BallMotion:
    """One motion of rotary axes; the linear axes follow the ball.

    Attributes
    ----------
    start, end : mapping of str to float [rad]
        Commands of the rotary axes at its start and its end; the same axes in both. An axis not named stays.
    there_and_back : bool
        Whether it ends where it starts, with the cosine of its path (as K4 swings its table), rather than at an even rate.
    name : str
    """

    start: AxisCommands = field(default_factory=dict)
    end: AxisCommands = field(default_factory=dict)
    there_and_back: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse a motion of nothing."""
        if not self.start or set(self.start) != set(self.end):
            raise InputError(
                f"the motion {self.name!r} starts with {', '.join(self.start) or 'no axis'} and ends with "
                f"{', '.join(self.end) or 'no axis'}; name the same rotary axes in both, such as start = {{ C_deg = 0 }}, "
                f"end = {{ C_deg = 360 }}"
            )

    def commands(self, along: Array) -> dict[str, Array]:
        """Commands by axis, shape (m,) [rad], at parts of the motion from 0 to 1, shape (m,)."""
        part = (1 - np.cos(2 * np.pi * along)) / 2 if self.there_and_back else along
        return {axis: start + (self.end[axis] - start) * part for axis, start in self.start.items()}


def planned_commands(motions: Sequence[BallMotion], centre: Mapping[str, float], angle: Array) -> dict[str, Array]:
    """Commands by axis, shape (m,) [rad], of motions one after the other.

    Parameters
    ----------
    motions : sequence of BallMotion
    centre : mapping of str to float [rad]
        Where the axes stand that a motion does not move.
    angle : array, shape (m,) [rad]
        How far along all motions together each reading is: a full turn goes through all of them, each an equal part.
    """
    along = np.remainder(angle / (2 * np.pi), 1.0) * len(motions)
    which = np.minimum(along.astype(int), len(motions) - 1)
    axes = dict.fromkeys(axis for motion in motions for axis in motion.start)
    commands = {axis: np.full(len(angle), float(centre.get(axis, 0.0))) for axis in axes}
    for number, motion in enumerate(motions):
        at = which == number
        for axis, values in motion.commands(along[at] - number).items():
            commands[axis][at] = values
    return commands
