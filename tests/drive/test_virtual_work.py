"""Virtual work: the forces of the drives are the rate of the wrench's work, on any topology."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from elastogeo.drive import joint_forces, tool_force
from elastogeo.errors import RankError
from elastogeo.machine import Joint, Machine, loop_frames, parse_topology

TOPOLOGIES = ("wFYXt", "wCAYfXZt", "wXYFZt", "wCBXFYZt", "wAFXYZBt", "[w C' A' b Y X Z (C1) t]")


def machine_of(topology: str) -> Machine:
    parsed = parse_topology(topology)
    random = np.random.default_rng(len(topology))
    joints = tuple(
        Joint(axis, offset=tuple(random.uniform(-200, 200, 3)), tilt=tuple(random.uniform(-0.3, 0.3, 3)))
        for axis in parsed.axes
    )
    return Machine(name=topology, topology=parsed, joints=joints, tool=(10.0, -20.0, -150.0))


def poses(machine: Machine, count: int = 5) -> np.ndarray:
    random = np.random.default_rng(1)
    spans = np.array([0.8 if joint.is_rotary else 100.0 for joint in machine.joints])
    return random.uniform(-1, 1, (count, len(machine.axes))) * spans


def work(machine: Machine, before: np.ndarray, after: np.ndarray, wrench: np.ndarray) -> np.ndarray:
    """What a wrench does between two nearby poses, on the point of the tool against the same point of the workpiece."""
    one, other = loop_frames(machine, before), loop_frames(machine, after)
    on_workpiece = one.workpiece.components(one.point - one.workpiece.origin)
    moved = other.point - other.workpiece.point(on_workpiece)
    turned = [
        (Rotation.from_matrix(b @ a.T)).as_rotvec()
        for a, b in zip(
            np.broadcast_to(one.tool.rotation, (len(before), 3, 3)),
            np.broadcast_to(other.tool.rotation, (len(before), 3, 3)),
            strict=True,
        )
    ]
    carried = [
        (Rotation.from_matrix(b @ a.T)).as_rotvec()
        for a, b in zip(
            np.broadcast_to(one.workpiece.rotation, (len(before), 3, 3)),
            np.broadcast_to(other.workpiece.rotation, (len(before), 3, 3)),
            strict=True,
        )
    ]
    twist = np.hstack([moved, np.array(turned) - np.array(carried)])
    return np.sum(wrench * twist, axis=1)


@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_the_force_of_a_drive_is_the_work_of_the_wrench_per_command(topology: str) -> None:
    machine = machine_of(topology)
    commands = poses(machine)
    wrench = np.random.default_rng(2).standard_normal((len(commands), 6)) * [100, 100, 100, 1e4, 1e4, 1e4]
    forces = joint_forces(machine, commands, wrench, machine.axes)
    for k, axis in enumerate(machine.axes):
        step = 1e-6 if machine.joints[k].is_rotary else 1e-4
        up, down = commands.copy(), commands.copy()
        up[:, k] += step
        down[:, k] -= step
        rate = (work(machine, commands, up, wrench) - work(machine, commands, down, wrench)) / (2 * step)
        assert_allclose(forces[:, k], rate, rtol=1e-6, atol=1e-3, err_msg=axis)


@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_the_force_at_the_tool_comes_back_from_the_drives(topology: str) -> None:
    machine = machine_of(topology)
    commands = poses(machine)
    axes = [axis for axis in machine.axes if axis in "XYZ"]
    force = np.random.default_rng(3).standard_normal((len(commands), 3)) * 500
    wrench = np.hstack([force, np.zeros_like(force)])
    seen = tool_force(machine, commands, joint_forces(machine, commands, wrench, axes), axes)
    if len(axes) == 3:
        assert_allclose(seen, force, rtol=1e-9, atol=1e-9)
    else:  # what pushes across both axes, they do not feel
        again = joint_forces(machine, commands, np.hstack([seen, np.zeros_like(seen)]), axes)
        assert_allclose(again, joint_forces(machine, commands, wrench, axes), rtol=1e-9, atol=1e-9)
        assert np.linalg.norm(seen) <= np.linalg.norm(force)


def test_a_rotary_axis_gives_no_force_at_the_tool() -> None:
    machine = machine_of("wCAYfXZt")
    with pytest.raises(RankError, match="follows from linear axes; leave out C"):
        tool_force(machine, poses(machine), np.ones((5, 2)), ["X", "C"])


def test_axes_along_one_direction_give_no_force_at_the_tool() -> None:
    machine = machine_of("wFYXt")
    with pytest.raises(RankError, match="axes X, X do not move in independent directions"):
        tool_force(machine, poses(machine), np.ones((5, 2)), ["X", "X"])
