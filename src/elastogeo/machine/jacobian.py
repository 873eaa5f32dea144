"""The geometric Jacobian, and its transpose, of a structural loop.

One function carries the whole algebra. For a twist or a wrench `v` at the functional point, `J^T v` at a frame is its first
three components along the frame's axes, and its last three plus the moment of the first about the frame's origin. Read with
a wrench, that is the load at the joint (virtual work); read with an instrument's sensitive direction, it is how much the
reading changes for each small twist of the joint. Rows of J follow from the six unit twists.
"""

from __future__ import annotations

import numpy as np

from elastogeo.estimate import Array
from elastogeo.machine.frames import Frame, loop_frames
from elastogeo.machine.machine import Machine

COMPONENTS = "XYZABC"


def carried_to(frame: Frame, point: Array, v: Array, side: float = 1.0) -> Array:
    """Carry a wrench, or a sensitive direction, from the functional point to a frame: the block of `J^T v`.

    Parameters
    ----------
    frame : Frame
        Where it is carried to, at m poses.
    point : array, shape (m, 3) or (1, 3) [mm]
        Functional point in the foundation.
    v : array, shape (m, 6)
        Wrench on the tool (force [N], moment [N mm]) or unit twist (translation, rotation), foundation components.
    side : float
        +1 for a frame of the tool branch, -1 for one of the workpiece branch.

    Returns
    -------
    array, shape (m, 6), Fortran order
        Load or sensitivity along X, Y, Z and about A, B, C of the frame.

    Notes
    -----
    Eq. 4.5 of the thesis, `W_joint = J^T W_t`, for both branches: the reaction of the wrench acts on the workpiece.
    """
    force, moment = frame.components(v[:, :3]), frame.components(v[:, 3:])
    lever = frame.components(point - frame.origin)
    carried = np.empty((len(v), 6), order="F")
    carried[:, :3] = force
    carried[:, 3:] = moment
    if lever.any():
        for i, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
            carried[:, 3 + i] += lever[:, j] * force[:, k]
            carried[:, 3 + i] -= lever[:, k] * force[:, j]
    if side < 0:
        np.negative(carried, out=carried)
    return carried


def jacobian(machine: Machine, commands: Array, tool: Array | None = None) -> Array:
    """Geometric Jacobian: twist of the tool relative to the workpiece per small twist at each joint's motion frame.

    Parameters
    ----------
    machine : Machine
        With n joints.
    commands : array, shape (m, n) [mm, rad]
        Axis commands in the order of `machine.axes`.
    tool : array, shape (3,) [mm], optional
        Functional point in the last tool-branch frame, when it is not the machine's own.

    Returns
    -------
    array, shape (m, 6, 6 n)
        Columns run over the joints in the order of `machine.axes`, and over X Y Z A B C within each. Units: mm/mm, mm/rad,
        rad/rad. Eq. 4.8; for X and Y alone it is Eq. 4.21.
    """
    frames = loop_frames(machine, commands, tool)
    m = len(np.atleast_2d(commands))
    J = np.empty((m, 6, 6 * len(machine.axes)))
    for row, unit in enumerate(np.eye(6)):
        v = np.broadcast_to(unit, (m, 6))
        for k, axis in enumerate(machine.axes):
            joint = frames.joints[axis]
            J[:, row, 6 * k : 6 * k + 6] = carried_to(joint.motion, frames.point, v, joint.side)
    return J
