"""Between the forces of the drives and the force at the tool, by virtual work (Eqs. 6.12 to 6.15), on any topology.

An axis command is the motion of the tool relative to the workpiece (ISO 841), so the force that a drive must hold for a
wrench W on the tool is the rate of W's work per command: `tau = J^T W`, with the column of J along (about) the axis at its
motion frame, and the sign of the branch and the sign of the command undone by each other.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.errors import RankError
from elastogeo.machine import Array, Machine, carried_to, loop_frames

UNSEEN = 1e-6
"""A singular value of the unit directions of the axes below this: the drives do not see a force along its direction."""


def joint_forces(machine: Machine, commands: Array, wrench: Array, axes: Sequence[str], tool: Array | None = None) -> Array:
    """Work of a wrench per command of each axis: what its drive must hold against.

    Parameters
    ----------
    machine : Machine
    commands : array, shape (m, n) [mm, rad]
        In the order of `machine.axes`.
    wrench : array, shape (m, 6) [N, N mm]
        On the tool at the functional point, foundation components; its reaction acts on the workpiece.
    axes : sequence of str, length k
    tool : array, shape (3,) [mm], optional
        Functional point in the last tool-branch frame, when it is not the machine's own.

    Returns
    -------
    array, shape (m, k) [N of linear axes, N mm of rotary ones]
        Eq. 6.15, `tau = J^T F`: positive where the wrench pushes the axis to greater commands.
    """
    frames = loop_frames(machine, commands, tool)
    forces = np.empty((len(wrench), len(axes)))
    for k, axis in enumerate(axes):
        joint = machine.joints[machine.index(axis)]
        # A workpiece-side joint enters J with a minus and moves by the negative of its command: together, a plus.
        carried = carried_to(frames.joints[axis].motion, frames.point, wrench)
        forces[:, k] = carried[:, joint.direction + (3 if joint.is_rotary else 0)]
    return forces


def tool_force(machine: Machine, commands: Array, forces: Array, axes: Sequence[str], tool: Array | None = None) -> Array:
    """Force at the tool from the forces of the drives of linear axes: the inverse of `joint_forces` for a pure force.

    Parameters
    ----------
    machine, commands, tool
        As in `joint_forces`.
    forces : array, shape (m, k) [N]
        That the wrench exerts on each axis, per command.
    axes : sequence of str, length k
        Linear axes, of independent directions.

    Returns
    -------
    array, shape (m, 3) [N]
        On the tool, foundation components. Of the directions that the axes span: what pushes across all of them, their
        drives do not feel, and it is taken as zero.

    Raises
    ------
    RankError
        If two of the axes move along the same direction, or one is rotary.
    """
    rotary = [axis for axis in axes if machine.joints[machine.index(axis)].is_rotary]
    if rotary:
        raise RankError(f"the force at the tool follows from linear axes; leave out {', '.join(rotary)}")
    frames = loop_frames(machine, commands, tool)
    directions = np.stack(
        np.broadcast_arrays(
            *(frames.joints[axis].motion.rotation[:, :, machine.joints[machine.index(axis)].direction] for axis in axes)
        ),
        axis=1,
    )
    if np.linalg.svd(directions, compute_uv=False).min() < UNSEEN:
        raise RankError(f"axes {', '.join(axes)} do not move in independent directions; their drives give no one force")
    return np.asarray(np.einsum("mij,mj->mi", np.linalg.pinv(directions), forces))
