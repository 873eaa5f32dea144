"""Where every frame of the structural loop is, at many poses at once.

Shapes put the reading first, `(m, 3)`; memory holds each component contiguous (Fortran order), so that a component of all
readings is one fast vector. What does not change along the poses is stored once, with a first length of 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from elastogeo.errors import MachineError
from elastogeo.estimate import Array
from elastogeo.machine.machine import Joint, Machine
from elastogeo.machine.places import TOOL, WORKPIECE

UPRIGHT: Array = np.eye(3)[np.newaxis]
"""The rotation of every frame that stands as the foundation does: this very array is passed on along the loop, so that
such a frame is known without looking at numbers, and costs no rotation."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A frame `A` seen from the foundation `F`, at m poses.

    Attributes
    ----------
    rotation : array, shape (m, 3, 3) or (1, 3, 3)
        Columns are the axes of the frame in foundation coordinates.
    origin : array, shape (m, 3) or (1, 3) [mm]
        Origin in foundation coordinates.
    """

    rotation: Array
    origin: Array

    def point(self, local: Array) -> Array:
        """Foundation coordinates, shape (m, 3), of a point given in this frame, shape (3,) or (m, 3) [mm]."""
        return self.origin + self.vector(local)

    def vector(self, local: Array) -> Array:
        """Foundation components, shape (m, 3), of a vector given in this frame, shape (3,) or (m, 3)."""
        local = np.atleast_2d(local)
        return local if self.rotation is UPRIGHT else _turned(self.rotation, local)

    def components(self, vector: Array) -> Array:
        """Components along this frame's axes, shape (m, 3), of a vector given in the foundation, shape (m, 3)."""
        return vector if self.rotation is UPRIGHT else _turned(self.rotation.transpose(0, 2, 1), vector)


@dataclass(frozen=True, slots=True)
class JointFrames:
    """The two frames of a joint.

    Attributes
    ----------
    location : Frame
        Before the joint's motion, fixed to the link before it: where location errors act.
    motion : Frame
        The carriage: where error motions and compliance act.
    side : float
        +1 on the tool branch, -1 on the workpiece branch: the sign with which a twist here moves the tool relative to
        the workpiece.
    """

    location: Frame
    motion: Frame
    side: float


@dataclass(frozen=True, slots=True)
class LoopFrames:
    """Every frame of the structural loop at m poses.

    Attributes
    ----------
    joints : dict of str to JointFrames
        By axis letter.
    tool : Frame
        Last carriage of the tool branch.
    workpiece : Frame
        Last carriage of the workpiece branch (the table).
    point : array, shape (m, 3) or (1, 3) [mm]
        The functional point of the tool in the foundation.
    places : dict of str to tuple of Frame, float
        Of each place that the machine declares its frame, and the sign of its branch.
    """

    joints: dict[str, JointFrames]
    tool: Frame
    workpiece: Frame
    point: Array
    places: dict[str, tuple[Frame, float]] = field(default_factory=dict)

    def carried_at(self, name: str) -> tuple[Frame, float]:
        """Where the load of an axis or a place acts, by its name: the frame, and the sign of its branch."""
        joint = self.joints.get(name)
        return self.places[name] if joint is None else (joint.motion, joint.side)


Site = tuple[str, str]
"""Where a small twist acts: ("location", axis), ("motion", axis), ("place", its name), ("tool", "") or ("workpiece", "")."""

GROUND = Frame(UPRIGHT, np.zeros((1, 3)))


def check_commands(machine: Machine, commands: Array) -> Array:
    """Axis commands as an array of shape (m, n), finite.

    Raises
    ------
    MachineError
        If the shape is not (m, number of axes) or a command is no finite number.
    """
    commands = np.atleast_2d(np.asarray(commands, dtype=float))
    if commands.ndim != 2 or commands.shape[1] != len(machine.axes) or not len(commands):
        raise MachineError(
            f"axis commands of {machine.name!r} must have the shape (m, {len(machine.axes)}), one column per axis "
            f"{' '.join(machine.axes)}; got {commands.shape}"
        )
    if not np.isfinite(commands).all():
        row, column = np.argwhere(~np.isfinite(commands))[0]
        raise MachineError(f"the command of axis {machine.axes[column]} at pose {row} is {commands[row, column]}")
    return commands


def loop_frames(
    machine: Machine, commands: Array, tool: Array | None = None, twists: Mapping[Site, Array] | None = None
) -> LoopFrames:
    """Place every frame of the machine at the commanded poses, by exact products of transforms.

    A command is the motion of the tool relative to the workpiece (ISO 841): a joint of the workpiece branch moves by its
    negative.

    Parameters
    ----------
    machine : Machine
    commands : array, shape (m, n) [mm, rad]
        Axis commands in the order of `machine.axes`.
    tool : array, shape (3,) [mm], optional
        Functional point in the last tool-branch frame, when it is not the machine's own.
    twists : mapping of Site to array, shape (m, 6) [mm, rad], optional
        Errors and deflections: translation and rotation vector, of any size, along the frame on which they act.

    Returns
    -------
    LoopFrames
    """
    twists = twists or {}
    commands = check_commands(machine, commands)
    travels = dict(zip(machine.axes, commands.T, strict=True))
    described = {joint.name: joint for joint in machine.joints}
    joints: dict[str, JointFrames] = {}
    ends: list[Frame] = []
    places: dict[str, tuple[Frame, float]] = {}

    def through_places(on: str, carriage: Frame, side: float) -> Frame:
        for place in machine.places:
            if place.on == on:
                offset = np.asarray(place.offset)
                at = Frame(carriage.rotation, carriage.point(offset))
                places[place.name] = at, side
                twisted = _twisted(at, twists.get(("place", place.name)))
                carriage = carriage if twisted is at else Frame(twisted.rotation, twisted.point(-offset))
        return carriage

    for side, end, branch in (
        (-1.0, WORKPIECE, reversed(machine.topology.workpiece)),
        (1.0, TOOL, iter(machine.topology.tool)),
    ):
        frame = GROUND
        for axis in branch:
            joint = described[axis]
            location = _twisted(_located(frame, joint), twists.get(("location", axis)))
            moved = _moved(location, joint, side * steady(travels[axis]))
            frame = _twisted(moved, twists.get(("motion", axis)))
            joints[axis] = JointFrames(location, frame, side)
            frame = through_places(axis, frame, side)
        ends.append(through_places(end, frame, side))
    workpiece, carriage = ends
    point = carriage.point(np.asarray(machine.tool if tool is None else tool, dtype=float))
    return LoopFrames(joints, carriage, workpiece, point, places)


def steady(values: Array) -> Array:
    """The values, or the first alone (shape (1,)) if all are equal: what does not move is computed once."""
    return values[:1] if (values == values[0]).all() else values


def rotation_matrix(vector: Array) -> Array:
    """Rotation matrices, shape (m, 3, 3), of rotation vectors, shape (m, 3) [rad]; exact for any angle.

    Rodrigues: I + sin(a)/a K + (1 - cos(a))/a^2 K^2, where K v is the vector times v, and a its length.
    """
    x, y, z = np.asarray(vector, dtype=float).T
    none = np.zeros_like(x)
    cross = np.stack([none, -z, y, z, none, -x, -y, x, none], axis=-1).reshape(-1, 3, 3)
    turns = np.sqrt(x * x + y * y + z * z)[:, np.newaxis, np.newaxis] / np.pi
    once, twice = np.sinc(turns), 0.5 * np.sinc(turns / 2) ** 2
    return np.asarray(np.eye(3) + once * cross + twice * (cross @ cross))


def _turned(rotation: Array, vectors: Array) -> Array:
    """Rotation times vector at each pose, shape (m, 3); either may hold for all poses."""
    if len(rotation) == 1:
        return np.asarray((rotation[0] @ vectors.T).T)
    return np.asarray(np.einsum("mij,mj->mi", rotation, vectors))


def _located(link: Frame, joint: Joint) -> Frame:
    origin = link.point(np.asarray(joint.offset)) if any(joint.offset) else link.origin
    if not any(joint.tilt):
        return Frame(link.rotation, origin)
    return Frame(link.rotation @ rotation_matrix(np.asarray([joint.tilt])), origin)


def _moved(location: Frame, joint: Joint, travel: Array) -> Frame:
    if not joint.is_rotary:
        return Frame(location.rotation, _along(location, joint.direction, travel))
    if not travel.any():
        return location
    vectors = np.zeros((len(travel), 3))
    vectors[:, joint.direction] = travel
    return Frame(location.rotation @ rotation_matrix(vectors), location.origin)


def _twisted(frame: Frame, twist: Array | None) -> Frame:
    if twist is None:
        return frame
    return Frame(frame.rotation @ rotation_matrix(twist[:, 3:]), frame.point(twist[:, :3]))


def _along(location: Frame, direction: int, travel: Array) -> Array:
    axis = location.rotation[:, :, direction]
    return location.origin + np.multiply(axis.T, travel, order="C").T
