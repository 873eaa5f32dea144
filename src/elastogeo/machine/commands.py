"""From a commanded tool path to axis commands, on any topology.

The rotary axes are given (held, or moving along the path); the linear axes then follow from one small linear system, since
with the rotary axes known the tool-to-workpiece position is affine in the linear commands.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import PathError
from elastogeo.estimate import Array
from elastogeo.machine.frames import LoopFrames, loop_frames
from elastogeo.machine.machine import Machine

UNREACHABLE_MM = 1e-9
"""How far, in mm per mm of path, a pose may miss the path before it counts as unreachable."""


@dataclass(frozen=True, slots=True)
class Motion:
    """Where the tool is commanded to go, relative to the workpiece, along a path of m poses.

    Attributes
    ----------
    displacement : array, shape (m, 3) [mm]
        From the centre of the path (the workpiece ball) to the tool.
    rate, acceleration : array, shape (m, 3) [mm/s, mm/s^2]
        Its time derivatives.
    rotary : mapping of str to array, shape (m,) [rad]
        Commands of the rotary axes that move along the path; the others stay at the centre pose.
    rotary_rate : mapping of str to float [rad/s]
        Their time derivatives.
    in_workpiece : bool
        Whether `displacement` is given in the (turning) workpiece frame rather than in the foundation.
    """

    displacement: Array
    rate: Array
    acceleration: Array
    rotary: Mapping[str, Array]
    rotary_rate: Mapping[str, float]
    in_workpiece: bool = False


@dataclass(frozen=True, slots=True)
class Commands:
    """Axis commands along a path.

    Attributes
    ----------
    position : array, shape (m, n) [mm, rad]
        In the order of `machine.axes`.
    velocity : array, shape (m, n) [mm/s, rad/s]
        Their time derivatives.
    acceleration : array, shape (m, n) [mm/s^2], or None
        Of the linear axes; None where a rotary axis turns along the path.
    displacement : array, shape (m, 3) [mm]
        From the workpiece ball to the tool, in the foundation.
    ball : array, shape (3,) [mm]
        The workpiece ball in the workpiece frame.
    """

    position: Array
    velocity: Array
    acceleration: Array | None
    displacement: Array
    ball: Array


def follow(machine: Machine, centre: Mapping[str, float], motion: Motion, tool: Array | None = None) -> Commands:
    """Axis commands that make the tool follow a path about the workpiece ball.

    The workpiece ball sits where the tool is at the centre pose.

    Parameters
    ----------
    machine : Machine
    centre : mapping of str to float [mm, rad]
        Axis commands at which the tool is at the centre of the path; an axis not named is at zero.
    motion : Motion
    tool : array, shape (3,) [mm], optional
        Functional point in the last tool-branch frame, when it is not the machine's own.

    Returns
    -------
    Commands

    Raises
    ------
    PathError
        If the linear axes cannot reach the path, or an axis would leave its travel.
    """
    frames = _at_centre(machine, centre, tool)
    ball = _ball(frames)
    position = np.empty((len(motion.displacement), len(machine.axes)), order="F")
    position[:] = [centre.get(axis, 0.0) for axis in machine.axes]
    for axis, angle in motion.rotary.items():
        position[:, machine.index(axis)] = angle
    linear = [axis for axis in machine.axes if axis in "XYZ"]

    if motion.rotary:
        frames = loop_frames(machine, position, tool)
    target = frames.workpiece.vector(motion.displacement) if motion.in_workpiece else motion.displacement
    directions = _directions(frames, linear)
    inverse = np.asarray(np.linalg.pinv(directions), dtype=float)
    shift = target - (frames.point - frames.workpiece.point(ball))
    moves = _applied(inverse, shift)
    _check_reached(machine, _applied(np.eye(3) - directions @ inverse, shift), target)
    for k, axis in enumerate(linear):
        position[:, machine.index(axis)] += moves[:, k]
    _check_travel(machine, position)

    velocity = np.zeros_like(position)
    rate = motion.rate
    if motion.in_workpiece:
        rate = frames.workpiece.vector(rate)
    if motion.rotary:
        rate = rate + _turning_rate(machine, position, ball, tool, motion, target)
        for axis, speed in motion.rotary_rate.items():
            velocity[:, machine.index(axis)] = speed
    _put(velocity, machine, linear, _applied(inverse, rate))
    acceleration = None
    if not motion.rotary:
        acceleration = np.zeros_like(position)
        turned = frames.workpiece.vector(motion.acceleration) if motion.in_workpiece else motion.acceleration
        _put(acceleration, machine, linear, _applied(inverse, turned))
    return Commands(position, velocity, acceleration, target, ball)


def workpiece_ball(machine: Machine, centre: Mapping[str, float], tool: Array | None = None) -> Array:
    """Where the workpiece ball sits in the workpiece frame, shape (3,) [mm]: where the tool is at the centre pose."""
    return _ball(_at_centre(machine, centre, tool))


def _put(columns: Array, machine: Machine, linear: list[str], values: Array) -> None:
    for k, axis in enumerate(linear):
        columns[:, machine.index(axis)] = values[:, k]


def _at_centre(machine: Machine, centre: Mapping[str, float], tool: Array | None) -> LoopFrames:
    for axis in centre:
        machine.index(axis)
    return loop_frames(machine, np.array([[centre.get(axis, 0.0) for axis in machine.axes]]), tool)


def _ball(frames: LoopFrames) -> Array:
    return np.asarray(frames.workpiece.components(frames.point - frames.workpiece.origin)[0])


def _directions(frames: LoopFrames, linear: list[str]) -> Array:
    """Directions in which the linear axes move the tool relative to the workpiece, shape (m or 1, 3, k)."""
    locations = [frames.joints[axis].location.rotation[:, :, "XYZ".index(axis)] for axis in linear]
    return np.stack(np.broadcast_arrays(*locations), axis=-1) if linear else np.zeros((1, 3, 0))


def _applied(matrix: Array, vectors: Array) -> Array:
    """Matrix times vector at each pose; a matrix that holds for all poses is stored once."""
    if len(matrix) == 1:
        return np.asarray((matrix[0] @ vectors.T).T)
    return np.asarray(np.einsum("mij,mj->mi", matrix, vectors))


def _turning_rate(
    machine: Machine, position: Array, ball: Array, tool: Array | None, motion: Motion, target: Array
) -> Array:
    """What the linear axes must add, shape (m, 3) [mm/s], because rotary axes turn tool and workpiece ball."""
    frames = loop_frames(machine, position, tool)
    ball_at = frames.workpiece.point(ball)
    rate = np.zeros((len(position), 3))
    for axis, speed in motion.rotary_rate.items():
        joint = frames.joints[axis]
        about = joint.motion.rotation[:, :, machine.joints[machine.index(axis)].direction] * speed
        carried = frames.point if joint.side > 0 else ball_at
        rate -= np.cross(about, carried - joint.motion.origin)
        if motion.in_workpiece and joint.side < 0:
            rate -= np.cross(about, target)
    return rate


def _check_reached(machine: Machine, missed: Array, target: Array) -> None:
    worst = np.abs(missed).max(axis=0)
    if worst.max() > UNREACHABLE_MM * max(1.0, np.abs(target).max()):
        raise PathError(
            f"machine {machine.name!r} ({machine.topology.compact}) cannot make this path: along "
            f"{'XYZ'[int(worst.argmax())]} it would be off by up to {worst.max():.6g} mm, no linear axis moves there; "
            f"choose a plane of its linear axes or move a rotary axis along"
        )


def _check_travel(machine: Machine, position: Array) -> None:
    for k, joint in enumerate(machine.joints):
        low, high = joint.travel
        least, most = position[:, k].min(), position[:, k].max()
        if least < low or most > high:
            unit = "rad" if joint.is_rotary else "mm"
            raise PathError(
                f"machine {machine.name!r}: the path needs {joint.name} from {least:g} to {most:g} {unit}, its travel is "
                f"{low:g} to {high:g} {unit}; move the centre or take a smaller radius"
            )
