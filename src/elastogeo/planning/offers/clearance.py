"""Whether bar, table and spindle keep clear of one another: cones about the spindle and about the normal of the table.

A ball bar, a probe or a roller between the two balls must not come near the spindle, which stands behind the tool ball, nor
near the post, which stands under the workpiece ball; and the spindle must not stand below the table. These are angles: they
need no dimensions, which machine files do not have. **It is no collision check of a real machine:** the fixture, the head
and the guards are not known; drive every planned test once without the bar.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import radians

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Angle, Array, Machine, loop_frames
from elastogeo.observe import Observations

Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]
"""One for each reading, shape (m,)."""

CONE, SPINDLE_TO_TABLE = radians(40.0), radians(95.0)


@dataclass(frozen=True, slots=True)
class Clearance:
    """How far apart bar, spindle and table must stay.

    Attributes
    ----------
    cone : float [rad]
        Least angle between the bar and the spindle at the tool ball, and between the bar and the post at the workpiece ball.
    spindle_to_table : float [rad]
        Greatest angle between the spindle and the normal of the table: beyond a right angle it comes from below.
    """

    cone: Angle = CONE
    spindle_to_table: Angle = SPINDLE_TO_TABLE

    def __post_init__(self) -> None:
        """Refuse degrees given as radians."""
        for name, value in (("cone", self.cone), ("angle of spindle to table", self.spindle_to_table)):
            if not 0 <= value <= np.pi:
                raise InputError(f"the {name} is {value:g} rad; it must be 0 to pi: is it in degrees?")

    def free(self, machine: Machine, observations: Observations) -> Flags:
        """Whether each reading is clear, shape (m,): of a bar along its direction, from the workpiece to the tool."""
        spindle, normal = _spindle_and_normal(machine, observations.commands)
        bar = observations.direction[:, :3]
        near = np.cos(self.cone)
        at_tool = np.sum(-bar * spindle, axis=1) <= near
        at_workpiece = np.sum(bar * -normal, axis=1) <= near
        return np.asarray(at_tool & at_workpiece & self._before_the_table(spindle, normal))

    def stands(self, machine: Machine, commands: Array) -> Flags:
        """Whether the spindle stands before the table, at axis commands of shape (m, n): shape (m,)."""
        return np.broadcast_to(self._before_the_table(*_spindle_and_normal(machine, commands)), len(commands))

    def _before_the_table(self, spindle: Array, normal: Array) -> Flags:
        return np.asarray(np.sum(spindle * normal, axis=1) >= np.cos(self.spindle_to_table))


def _spindle_and_normal(machine: Machine, commands: Array) -> tuple[Array, Array]:
    """Directions of the spindle and of the table's normal, shape (m or 1, 3)."""
    frames = loop_frames(machine, commands)
    return frames.tool.vector(np.array([0.0, 0.0, 1.0])), frames.workpiece.vector(table_normal(machine))


@lru_cache(maxsize=64)
def table_normal(machine: Machine) -> Array:
    """Normal of the table in the workpiece frame, shape (3,): up, where no axis has moved."""
    frames = loop_frames(machine, np.zeros((1, len(machine.axes))))
    return np.asarray(frames.workpiece.components(-np.array([machine.gravity]))[0])


def longest_arc(free: Flags) -> tuple[int, int]:
    """First reading and length of the longest unbroken part of a full turn, `free` of shape (m,), around its end too."""
    if free.all():
        return 0, len(free)
    if not free.any():
        return 0, 0
    first = int(np.argmin(free))
    rolled = np.roll(free, -first).astype(int)
    steps = np.diff(np.concatenate([[0], rolled, [0]]))
    starts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
    best = int(np.argmax(ends - starts))
    return int(starts[best] + first) % len(free), int(ends[best] - starts[best])
