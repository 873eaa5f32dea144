"""Axis commands of a commanded path: does the tool really arrive, at the right speed, on any topology?

The judge is a forward kinematics of its own, in 4 x 4 matrices, one pose at a time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import MachineError, PathError
from elastogeo.machine import Array, Joint, Machine, follow, parse_topology, workpiece_ball
from elastogeo.observe import Circle

TILTED = ((1.0, 1.0, 0.0), (1.0, -1.0, 3.0))


@dataclass(frozen=True)
class Path:
    """A path on a topology: the plane, the held rotary axes, the moving ones."""

    topology: str
    plane: str | tuple = "XY"
    centre: dict[str, float] = field(default_factory=dict)
    rotary_turn: dict[str, float] = field(default_factory=dict)
    bar_turn: float = 1.0
    in_workpiece: bool = False
    straight: bool = False

    def __str__(self) -> str:
        frame = "workpiece" if self.in_workpiece else "foundation"
        moving = "".join(self.rotary_turn) or "no rotary"
        return f"{self.topology}-{self.plane if isinstance(self.plane, str) else 'tilted'}-{moving} moves-{frame}"


PATHS = (
    Path("wFYXt", "XY", straight=True),
    Path("wXYFt", "XY", {"X": 30.0, "Y": -20.0}, straight=True),
    Path("wXFYt", "XY", straight=True),
    Path("wYXFZt", "ZX"),
    Path("wXYFZt", "YZ"),
    Path("wCAFYXZSt", "XY", {"X": 100.0, "Z": -300.0, "A": -0.4, "C": 1.1}),
    Path("wCAFYXZSt", TILTED, {"A": 0.7, "C": -2.0}, in_workpiece=True),
    Path("wCAFYXZSt", "XY", {"X": 50.0, "Y": 80.0}, {"C": 1.0}, bar_turn=0.0),
    Path("wCAFYXZSt", "XY", {"X": 50.0, "Y": 80.0, "A": 0.3}, {"C": -1.0, "A": 0.1}, in_workpiece=True),
    Path("wCAYfXZt", "YZ", {"A": 0.35, "C": 0.9}),
    Path("wCAYfXZt", TILTED, {"Z": 40.0}, {"C": 0.5}, in_workpiece=True),
    Path("wFXYZBCt", "XY", {"B": 0.6, "C": -0.8}),
    Path("wFXYZBCt", "ZX", {"X": 25.0}, {"B": 1.0, "C": 0.25}, bar_turn=0.0),
    Path("wXFYZBCt", TILTED, {"B": -0.4}, {"C": 2.0}),
    Path("wBXFZYt", "ZX", {"B": 0.5}),
    Path("wXBFZYt", "ZX", {"B": 0.3}, {"B": 0.1}, in_workpiece=True),  # the table carries X
    Path("wCBXFYZt", "YZ", {"C": 1.0}, {"B": -0.5}),
    Path("wAFXYZBt", TILTED, {"A": 0.2, "B": 0.1}, {"A": 0.3, "B": -0.4}),
    Path("wZFXYCt", "XY", {"C": 3.0}, {"C": 1.0}),
    Path("wCYFXZBt", "YZ", {"C": 0.4}, {"C": -1.0, "B": 0.2}, in_workpiece=True),
)
ANGLE = np.linspace(-0.7, 5.9, 15)
RATE = 0.8


def homogeneous(rotation: Array, origin: Array) -> Array:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation, origin
    return T


def turned(vector: Array) -> Array:
    """Rodrigues' formula."""
    angle = np.linalg.norm(vector) or 1.0
    x, y, z = vector / angle
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def ends(machine: Machine, commands: Array) -> tuple[Array, Array]:
    """4 x 4 transforms from the foundation to the table and to the last tool-branch carriage."""
    T = {}
    for branch, sign in ((machine.topology.workpiece[::-1], -1.0), (machine.topology.tool, 1.0)):
        end = np.eye(4)
        for axis in branch:
            k = machine.index(axis)
            joint, move = machine.joints[k], sign * commands[k]
            unit = np.eye(3)["XYZABC".index(axis) % 3 if axis != "S" else 2]
            end = end @ homogeneous(turned(np.array(joint.tilt)), np.array(joint.offset))
            turning = turned(unit * move) if joint.is_rotary else np.eye(3)
            end = end @ homogeneous(turning, np.zeros(3) if joint.is_rotary else unit * move)
        T[sign] = end
    return T[-1.0], T[1.0]


def circle_of(path: Path) -> Circle:
    return Circle(
        120.0, path.plane, path.centre, path.in_workpiece, path.bar_turn, bar_start=0.3, rotary_turn=path.rotary_turn
    )


def machine_of(path: Path, make_machine: Callable[..., Machine]) -> Machine:
    """Inclined axes and link offsets at random; a machine without Z must stay in its plane."""
    return make_machine(path.topology, tool=(15.0, -8.0, -140.0), seed=None if path.straight else 3)


def travelled(path: Path) -> Array:
    """From the workpiece ball to the tool, shape (m, 3) [mm], in the frame of the plane: written down anew."""
    named = {"XY": np.eye(3)[[0, 1]], "YZ": np.eye(3)[[1, 2]], "ZX": np.eye(3)[[2, 0]]}
    first, second = named[path.plane] if isinstance(path.plane, str) else np.array(path.plane)
    first, second = first / np.linalg.norm(first), second / np.linalg.norm(second)
    bar = 0.3 + path.bar_turn * ANGLE
    return 120.0 * (np.outer(np.cos(bar), first) + np.outer(np.sin(bar), second))


@pytest.mark.parametrize("path", PATHS, ids=str)
def test_the_tool_arrives_on_the_path(path: Path, make_machine: Callable[..., Machine]) -> None:
    machine = machine_of(path, make_machine)
    commands = follow(machine, path.centre, circle_of(path).motion(ANGLE, RATE))
    table, carriage = ends(machine, np.array([path.centre.get(axis, 0.0) for axis in machine.axes]))
    ball = np.linalg.solve(table, carriage @ np.append(machine.tool, 1.0))
    assert_allclose(workpiece_ball(machine, path.centre), ball[:3], atol=1e-9)
    for pose, wanted, displacement in zip(commands.position, travelled(path), commands.displacement, strict=True):
        table, carriage = ends(machine, pose)
        apart = (carriage @ np.append(machine.tool, 1.0) - table @ ball)[:3]
        if path.in_workpiece:
            wanted = table[:3, :3] @ wanted
        assert_allclose(apart, wanted, atol=1e-8)
        assert_allclose(displacement, wanted, atol=1e-8)


@pytest.mark.parametrize("path", PATHS, ids=str)
def test_rotary_axes_do_as_told(path: Path, make_machine: Callable[..., Machine]) -> None:
    machine = machine_of(path, make_machine)
    commands = follow(machine, path.centre, circle_of(path).motion(ANGLE, RATE))
    for joint in machine.joints:
        if joint.is_rotary:
            turn = path.rotary_turn.get(joint.name, 0.0)
            expected = path.centre.get(joint.name, 0.0) + turn * ANGLE
            assert_allclose(commands.position[:, machine.index(joint.name)], expected, atol=1e-12)
            assert_allclose(commands.velocity[:, machine.index(joint.name)], turn * RATE, atol=1e-12)


@pytest.mark.parametrize("path", PATHS, ids=str)
def test_velocities_are_the_derivative_of_the_commands(path: Path, make_machine: Callable[..., Machine]) -> None:
    machine = machine_of(path, make_machine)
    h = 1e-4
    commands, after, before, far_after, far_before = (
        follow(machine, path.centre, circle_of(path).motion(ANGLE + step, RATE)) for step in (0, h, -h, 2 * h, -2 * h)
    )
    near, far = after.position - before.position, far_after.position - far_before.position
    derivative = (8 * near - far) / (12 * h) * RATE
    assert np.abs(commands.velocity).max() > 1.0
    assert_allclose(commands.velocity, derivative, atol=1e-8 * np.abs(derivative).max())


def test_the_plane_and_the_angle_count_as_in_iso_230_4(make_machine: Callable[..., Machine]) -> None:
    machine = make_machine("wFXYZt")
    quarter = np.array([0.0, np.pi / 2])
    for plane, (first, second) in {"XY": (0, 1), "YZ": (1, 2), "ZX": (2, 0)}.items():
        position = follow(machine, {}, Circle(100.0, plane).motion(quarter, 1.0)).position
        assert_allclose(position, 100.0 * np.eye(3)[[first, second]], atol=1e-12)


def test_an_axis_of_the_workpiece_branch_has_the_command_of_the_tools_relative_motion(
    make_machine: Callable[..., Machine],
) -> None:
    """ISO 841: +X is the tool moving to +x relative to the workpiece, whichever of the two moves."""
    motion = Circle(100.0).motion(ANGLE, 1.0)
    tool_moves, table_moves = (make_machine(topology) for topology in ("wFYXt", "wXYFt"))
    one, other = follow(tool_moves, {}, motion), follow(table_moves, {}, motion)
    for axis in "XY":
        assert_allclose(one.position[:, tool_moves.index(axis)], other.position[:, table_moves.index(axis)], atol=1e-12)


def test_another_tool_point_may_be_named(make_machine: Callable[..., Machine]) -> None:
    path = PATHS[7]
    machine = machine_of(path, make_machine)
    tool = np.array([1.0, 2.0, -50.0])
    motion = circle_of(path).motion(ANGLE, RATE)
    named = follow(machine, path.centre, motion, tool)
    own = follow(replace(machine, tool=tuple(tool)), path.centre, motion)
    assert_allclose(named.position, own.position)
    assert np.abs(named.position - follow(machine, path.centre, motion).position).max() > 1.0


@pytest.mark.parametrize(
    ("topology", "plane", "direction"), [("wFYXt", "YZ", "Z"), ("wFXZt", "XY", "Y"), ("wCFt", "XY", "X")]
)
def test_a_path_off_the_linear_axes_is_unreachable(
    topology: str, plane: str, direction: str, make_machine: Callable[..., Machine]
) -> None:
    motion = Circle(120.0, plane).motion(ANGLE, 1.0)
    with pytest.raises(PathError, match=f"cannot make this path: along {direction} it would be off by up to 1[12]"):
        follow(make_machine(topology), {}, motion)


def test_a_rotary_axis_that_tilts_the_path_away_makes_it_unreachable(make_machine: Callable[..., Machine]) -> None:
    machine = make_machine("wAFYXt")
    motion = Circle(120.0, in_workpiece=True).motion(ANGLE, 1.0)
    follow(machine, {"A": 0.0}, motion)
    with pytest.raises(PathError, match=r"along Z .* no linear axis moves there"):
        follow(machine, {"A": 0.1}, motion)


def test_a_path_out_of_travel_is_refused() -> None:
    topology = parse_topology("wCFYXt")
    joints = (Joint("C", travel=(-1.0, 1.0)), Joint("Y"), Joint("X", travel=(-100.0, 400.0)))
    machine = Machine("small", topology, joints)
    motion = Circle(120.0).motion(ANGLE, 1.0)
    with pytest.raises(PathError, match=r"needs X from -1[0-9.]+ to 1[0-9.]+ mm, its travel is -100 to 400 mm; move"):
        follow(machine, {}, motion)
    follow(machine, {"X": 100.0}, motion)
    with pytest.raises(PathError, match=r"needs C from .* rad, its travel is -1 to 1 rad"):
        follow(machine, {"X": 100.0}, Circle(120.0, rotary_turn={"C": 1.0}).motion(ANGLE, 1.0))


def test_an_axis_that_the_machine_has_not_is_named(make_machine: Callable[..., Machine]) -> None:
    machine = make_machine("wFYXt")
    with pytest.raises(MachineError, match="has no axis 'C'"):
        follow(machine, {"C": 1.0}, Circle(100.0).motion(ANGLE, 1.0))
    with pytest.raises(MachineError, match="has no axis 'B'"):
        follow(machine, {}, Circle(100.0, rotary_turn={"B": 1.0}).motion(ANGLE, 1.0))


def test_a_motion_may_be_any_path(make_machine: Callable[..., Machine]) -> None:
    """Not only circles: a straight line of 50 mm."""
    machine = make_machine("wXFYZt", seed=9)
    line = np.outer(np.linspace(0, 50, 11), [0.6, 0.0, 0.8])
    motion = replace(Circle(1.0).motion(np.zeros(11), 0.0), displacement=line, rate=np.tile([0.6, 0.0, 0.8], (11, 1)))
    commands = follow(machine, {}, motion)
    start, stop = (ends(machine, pose) for pose in commands.position[[0, -1]])
    point = np.append(machine.tool, 1.0)
    ball = np.linalg.solve(start[0], start[1] @ point)
    assert_allclose((stop[1] @ point - stop[0] @ ball)[:3], line[-1], atol=1e-9)
    assert_allclose(np.diff(commands.position, axis=0) / 5.0, commands.velocity[:-1], atol=1e-9)


def test_accelerations_of_a_path_fixed_to_a_turned_workpiece_are_those_of_its_commands() -> None:
    """The table stands at an odd angle: the acceleration turns with the path, as the position and the velocity do."""
    machine = Machine("table", parse_topology("wCFXYZt"))
    time = np.linspace(0.0, 1.0, 2001)
    motion = Circle(150.0, in_workpiece=True).motion(2.0 * time, 2.0)
    commands = follow(machine, {"C": 0.7}, motion)
    assert commands.acceleration is not None
    numerical = np.gradient(commands.velocity, time, axis=0, edge_order=2)
    assert_allclose(commands.acceleration[2:-2], numerical[2:-2], atol=1e-3)
