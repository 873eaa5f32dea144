"""A tool path as poses of the machine, with what it looks like from the workpiece: points, directions of travel, normals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError, PathError
from elastogeo.estimate import Array
from elastogeo.machine.commands import Motion, follow
from elastogeo.machine.frames import check_commands, loop_frames
from elastogeo.machine.machine import Machine

POINTS = 4096
"""Points of a path that are worked on at a time."""

CORNER = 0.94
"""Cosine of the turn (20 degrees) from which two chords make a corner: the direction there is that of the chord before."""

ALONG_THE_TOOL = 1e-3
"""A path whose direction is this close to that of the tool (a plunge) has no normal across both."""

STANDING = 1e-9
"""A velocity this much smaller than the greatest of the path counts as none."""

_NEAR = 1e-3
UP = (0.0, 0.0, 1.0)
"""Direction of a tool from its tip to its holder, in the frame of the last carriage of the tool branch."""

Rows = np.ndarray[tuple[int], np.dtype[np.intp]]
Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]


@dataclass(frozen=True, eq=False)
class ToolPath(ByValue):
    """Poses along which a tool is commanded.

    Attributes
    ----------
    machine : Machine
    commands : array, shape (m, n) [mm, rad]
        In the order of `machine.axes`.
    velocity : array, shape (m, n) [mm/s, rad/s]
        Of every axis; in the same proportion, but of no known size, where the path is not `timed`.
    steps : array, shape (m,) [mm]
        Way of the tool to each point from the one before, seen from the workpiece; 0 for the first, and behind a rapid move.
    block : array of int, shape (m,)
        The block (line of the program, row of a list) that each pose is of.
    cutting : array of bool, shape (m,)
        Whether the tool cuts.
    timed : bool
        Whether the feed is known.
    tool : array, shape (3,) [mm]
        The functional point in the frame of the last tool-branch carriage.
    tool_axis : array, shape (3,)
        From the tip to the holder, in the same frame, a unit vector.
    name : str
        Where it comes from.
    """

    machine: Machine
    commands: Array
    velocity: Array
    steps: Array
    block: Rows
    cutting: Flags
    timed: bool
    tool: Array
    tool_axis: Array
    name: str = "path"

    def __len__(self) -> int:
        return len(self.commands)

    def slices(self, points: int = POINTS) -> Iterator[slice]:
        """The path in pieces."""
        return (slice(first, min(first + points, len(self))) for first in range(0, len(self), points))

    @cached_property
    def points(self) -> Array:
        """Where the tool is commanded, shape (m, 3) [mm], in the frame of the workpiece (the table)."""
        return points_at(self.machine, self.commands, self.tool)

    @cached_property
    def axis(self) -> Array:
        """Direction of the tool, from tip to holder, shape (m, 3) or (1, 3), in the frame of the workpiece."""
        rotary = [k for k, joint in enumerate(self.machine.joints) if joint.is_rotary]
        if not any(np.ptp(self.commands[:, k]) for k in rotary):
            return self._axis_at(slice(0, 1))
        return np.concatenate([self._axis_at(part) for part in self.slices()])

    @cached_property
    def travelled(self) -> Array:
        """Length of the way up to each point, shape (m,) [mm], seen from the workpiece."""
        return np.cumsum(self.steps)

    @cached_property
    def speed(self) -> Array:
        """Of the tool relative to the workpiece, shape (m,) [mm/s]; in proportion only where the path is not `timed`."""
        return np.asarray(np.linalg.norm(self._motion, axis=1))

    @cached_property
    def tangent(self) -> Array:
        """Direction of travel, shape (m, 3), in the frame of the workpiece: a unit vector, zero where nothing moves."""
        speed = self.speed[:, np.newaxis]
        moves = speed > STANDING * speed.max()
        return np.asarray(np.divide(self._motion, speed, out=np.zeros_like(self._motion), where=moves))

    @cached_property
    def left(self) -> Array:
        """Normal of the path to the left of the travel, seen from the holder, shape (m, 3), in the frame of the workpiece.

        NaN where the tool moves along itself or stands.
        """
        across = np.cross(np.broadcast_to(self.axis, self.tangent.shape), self.tangent)
        length = np.linalg.norm(across, axis=1, keepdims=True)
        return np.asarray(np.divide(across, length, out=np.full_like(across, np.nan), where=length > ALONG_THE_TOOL))

    @cached_property
    def sense(self) -> Array:
        """Way in which each axis moved last, shape (m, n): +1, -1, or 0 before it has moved at all."""
        moved = np.where(np.abs(self.velocity) > STANDING * np.abs(self.velocity).max(axis=0), np.sign(self.velocity), 0.0)
        last = np.where(moved != 0, np.arange(len(moved))[:, np.newaxis], 0)
        np.maximum.accumulate(last, axis=0, out=last)
        return np.asarray(np.take_along_axis(moved, last, axis=0))

    @cached_property
    def _motion(self) -> Array:
        """Velocity of the tool point in the frame of the workpiece, shape (m, 3): from a little before to a little after."""
        size = np.abs(self.velocity).max(axis=1, keepdims=True)
        ahead = np.divide(_NEAR * self.velocity, size, out=np.zeros_like(self.velocity), where=size > 0)
        chord = points_at(self.machine, self.commands + ahead, self.tool)
        chord -= points_at(self.machine, self.commands - ahead, self.tool)
        return np.asarray(chord * size / (2 * _NEAR))

    def _axis_at(self, part: slice) -> Array:
        frames = loop_frames(self.machine, self.commands[part], self.tool)
        axis = frames.workpiece.components(frames.tool.vector(self.tool_axis))
        return np.asarray(np.broadcast_to(axis, (part.stop - part.start, 3)))


def points_at(machine: Machine, commands: Array, tool: Array) -> Array:
    """Where the tool is commanded, shape (m, 3) [mm], in the frame of the workpiece."""
    found = np.empty((len(commands), 3))
    for first in range(0, len(commands), POINTS):
        frames = loop_frames(machine, commands[first : first + POINTS], tool)
        found[first : first + POINTS] = frames.workpiece.components(frames.point - frames.workpiece.origin)
    return found


def path_of_commands(
    machine: Machine,
    commands: Array,
    feed: Array | float | None = None,
    block: Array | None = None,
    cutting: Array | None = None,
    tool: Array | None = None,
    name: str = "path",
) -> ToolPath:
    """The path of a table of axis commands.

    Parameters
    ----------
    machine : Machine
        With n axes.
    commands : array, shape (m, n) [mm, rad]
        In the order of `machine.axes`.
    feed : array, shape (m,), or float [mm/s], optional
        Of the tool relative to the workpiece.
    block : array of int, shape (m,), optional
        One block for all if it is not given.
    cutting : array of bool, shape (m,), optional
        The tool cuts everywhere if it is not given.
    tool : array, shape (3,) [mm], optional
        Tip of the tool in the last tool-branch frame, if not the machine's own.
    name : str

    Raises
    ------
    MachineError
        If a command is no number, or there is not one for each axis.
    PathError
        If an axis would leave its travel, there is one point only, or all are the same.
    """
    commands = check_commands(machine, commands)
    m = len(commands)
    check_travel(machine, commands, name)
    feeds = np.atleast_1d(np.asarray(1.0 if feed is None else feed, dtype=float))
    if len(feeds) not in (1, m) or not (feeds > 0).all() or not np.isfinite(feeds).all():
        raise InputError(f"{name}: a feed is positive, one for all points or one for each of {m}; got {feeds[:3]} mm/s")
    blocks = np.zeros(m, dtype=np.intp) if block is None else np.asarray(block, dtype=np.intp)
    tip = np.asarray(machine.tool if tool is None else tool, dtype=float)
    chords = np.diff(points_at(machine, commands, tip), axis=0)
    steps = np.append(0.0, np.linalg.norm(chords, axis=1))
    if not steps.any():
        raise PathError(f"{name}: a path has at least two points that differ; {m} arrived, all at one place")
    return ToolPath(
        machine,
        commands,
        _rates(np.diff(commands, axis=0), chords, steps[1:], blocks) * feeds[:, np.newaxis],
        steps,
        blocks,
        np.ones(m, dtype=bool) if cutting is None else np.asarray(cutting, dtype=bool),
        feed is not None,
        tip,
        np.array(UP),
        name,
    )


def path_of_points(
    machine: Machine,
    points: Array,
    zero: Mapping[str, float] | None = None,
    rotary: Mapping[str, Array] | None = None,
    feed: Array | float | None = None,
    block: Array | None = None,
    cutting: Array | None = None,
    tool: Array | None = None,
    name: str = "path",
) -> ToolPath:
    """The path of a table of tool points.

    Parameters
    ----------
    machine : Machine
    points : array, shape (m, 3) [mm]
        From the zero of the workpiece, along the axes of its frame (the table's): they turn with it.
    zero : mapping of str to float [mm, rad], optional
        Axis commands at which the tip of the tool is at the zero of the workpiece; an axis that is not named is at zero.
    rotary : mapping of str to array, shape (m,) [rad], optional
        Commands of rotary axes; those that are not named stay where they are at `zero`.
    feed, block, cutting, tool, name
        As in `path_of_commands`.

    Raises
    ------
    PathError
        If the machine cannot reach a point.
    """
    points = np.atleast_2d(np.asarray(points, dtype=float))
    if points.shape[1:] != (3,) or not np.isfinite(points).all():
        raise InputError(f"{name}: tool points are x, y, z in mm, all finite; got the shape {points.shape}")
    still = np.zeros_like(points)
    turning = {axis: np.asarray(angle, dtype=float) for axis, angle in (rotary or {}).items()}
    motion = Motion(points, still, still, turning, dict.fromkeys(turning, 0.0), in_workpiece=True)
    made = follow(machine, zero or {}, motion, tool)
    return path_of_commands(machine, made.position, feed, block, cutting, tool, name)


def _rates(change: Array, chords: Array, steps: Array, block: Rows) -> Array:
    """Change of every command per way of the tool, shape (m, n).

    That of the chord to a point; halfway to that of the next chord, where it is of the same block and makes no corner.
    """
    moves = np.flatnonzero(steps > 0)
    per_way = change[moves] / steps[moves, np.newaxis]
    unit = chords[moves] / steps[moves, np.newaxis]
    latest = np.searchsorted(moves, np.arange(len(steps) + 1) - 1, side="right") - 1
    before, after = np.maximum(latest, 0), np.minimum(latest + 1, len(moves) - 1)
    same = np.append(block[1:] == block[:-1], False)
    smooth = same & (np.einsum("mi,mi->m", unit[before], unit[after]) > CORNER)
    return np.asarray(np.where(smooth[:, np.newaxis], (per_way[before] + per_way[after]) / 2, per_way[before]))


def check_travel(machine: Machine, commands: Array, name: str) -> None:
    """Refuse a path that leaves the travel of an axis.

    Raises
    ------
    PathError
        With the first point, the axis, its command and its travel.
    """
    for k, joint in enumerate(machine.joints):
        low, high = joint.travel
        outside = (commands[:, k] < low) | (commands[:, k] > high)
        if outside.any():
            row, unit = int(np.argmax(outside)), "rad" if joint.is_rotary else "mm"
            raise PathError(
                f"{name}: point {row + 1} wants {joint.name} at {commands[row, k]:g} {unit}, its travel is {low:g} to "
                f"{high:g} {unit} ({int(outside.sum())} such points); move the workpiece zero"
            )
