"""Tool paths: what they look like from the workpiece, held against what the path was made of."""

import numpy as np
import pytest

from elastogeo.errors import InputError, MachineError, PathError
from elastogeo.formats import read_machine
from elastogeo.machine import (
    Arc,
    ConstantForce,
    Line,
    Machine,
    MeasuredForce,
    Program,
    Rapid,
    ToolPath,
    loop_frames,
    parse_topology,
    path_of_commands,
    path_of_points,
    path_of_program,
)

THREE = Machine("three", parse_topology("wFXYZt"))
HERMLE = read_machine("hermle_c50")
ANGLE = np.linspace(0, 2 * np.pi, 73)


def circle(machine: Machine = THREE, radius: float = 50.0) -> np.ndarray:
    commands = np.zeros((len(ANGLE), len(machine.axes)))
    commands[:, machine.index("X")] = radius * np.cos(ANGLE)
    commands[:, machine.index("Y")] = radius * np.sin(ANGLE)
    return commands


def wrench(force: ConstantForce | MeasuredForce, path: ToolPath) -> np.ndarray:
    frames = loop_frames(path.machine, path.commands, path.tool)
    return force.on_tool(path, slice(0, len(path)), frames.workpiece)


def test_a_circle_knows_its_tangent_its_inside_and_its_speed() -> None:
    path = path_of_commands(THREE, circle(), feed=10.0)
    inner = slice(1, -1)
    assert path.tangent[inner] == pytest.approx(np.column_stack([-np.sin(ANGLE), np.cos(ANGLE), 0 * ANGLE])[inner], abs=1e-7)
    assert path.left[inner] == pytest.approx(-np.column_stack([np.cos(ANGLE), np.sin(ANGLE), 0 * ANGLE])[inner], abs=1e-7)
    assert path.speed[inner] == pytest.approx(10.0, rel=2e-3)  # of the mean of two chords
    assert path.travelled[-1] == pytest.approx(72 * 100 * np.sin(np.radians(2.5)))


def test_a_corner_keeps_the_direction_of_the_way_to_it() -> None:
    corner = np.array([[0.0, 0, 0], [10, 0, 0], [10, 10, 0], [10, 10, 0], [10, 20, 0]])
    path = path_of_commands(THREE, corner)
    assert path.tangent == pytest.approx(np.array([[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0], [0, 1, 0]], dtype=float))
    assert path.left[1] == pytest.approx([0, 1, 0])


def test_a_plunge_has_no_normal_and_an_axis_that_stands_keeps_its_sense() -> None:
    plunge = np.array([[0.0, 0, 0], [10, 0, 0], [10, 0, -5], [5, 0, -5]])
    path = path_of_commands(THREE, plunge)
    assert np.isnan(path.left[2]).all()
    assert path.sense[:, 0].tolist() == [1, 1, 1, -1]
    assert path.sense[:, 1].tolist() == [0, 0, 0, 0]
    assert path.sense[:, 2].tolist() == [0, 0, -1, -1]


def test_tool_points_are_reached_with_the_table_turning() -> None:
    """Points are of the workpiece: from it, the tool is where the table says, whatever A and C do."""
    points = np.column_stack([20 * np.cos(ANGLE), 20 * np.sin(ANGLE), 0.1 * ANGLE])
    turning = {"C": 2 * ANGLE, "A": 0.3 * np.sin(ANGLE)}
    path = path_of_points(HERMLE, points, {"X": 30.0, "Z": -100.0}, turning)
    assert path.points - path.points[0] == pytest.approx(points - points[0], abs=1e-9)
    assert np.ptp(path.commands[:, HERMLE.index("C")]) == pytest.approx(4 * np.pi)
    tilted = np.degrees(np.arccos(path.axis[:, 2]))
    assert tilted == pytest.approx(np.degrees(np.abs(0.3 * np.sin(ANGLE))), abs=1e-6)


def test_a_program_cuts_on_lines_and_arcs_and_a_rapid_move_is_no_way() -> None:
    blocks = [
        Rapid({"X": 0.0, "Y": 0.0, "Z": 0.0}),
        Line({"X": 10.0}, 5.0),
        Rapid({"X": 50.0}),
        Arc("XY", {"X": 40.0, "Y": 10.0}, (40.0, 0.0), 1, 5.0),
    ]
    path = path_of_program(Program("slots", blocks), THREE, 0.5, zero={"Y": 100.0})
    assert path.travelled[-1] == pytest.approx(10.0 - 0.5 + (5 * np.pi - 0.5), abs=0.05)
    assert sorted(set(path.block.tolist())) == [1, 3]
    assert path.points[-1] == pytest.approx([40, 110, 0])
    arc = path.block == 3
    outward = (path.points[arc] - np.array([40, 100, 0])) / 10
    assert path.left[arc] == pytest.approx(-outward, abs=1e-6)
    assert path.speed == pytest.approx(5.0)


def test_forces_count_along_what_they_say() -> None:
    commands = circle(HERMLE)
    commands[:, HERMLE.index("C")] = np.pi / 2
    path = path_of_commands(HERMLE, commands)
    by_path = wrench(ConstantForce((1.0, 2.0, 3.0), "path"), path)
    expected = path.tangent + 2 * path.left + 3 * path.axis
    assert by_path[:, :3] == pytest.approx(expected)
    assert not by_path[:, 3:].any()
    frames = loop_frames(HERMLE, path.commands, path.tool)
    by_machine = wrench(ConstantForce((1.0, 2.0, 3.0), "machine"), path)
    assert frames.workpiece.vector(by_machine[:, :3]) == pytest.approx(np.tile([1.0, 2.0, 3.0], (len(path), 1)))


def test_measured_forces_are_found_by_way_time_and_point() -> None:
    path = path_of_commands(THREE, np.array([[0.0, 0, 0], [10, 0, 0], [30, 0, 0]]), feed=10.0)
    ramp = np.column_stack([np.array([0.0, 300.0]), np.zeros(2), np.zeros(2)])
    assert wrench(MeasuredForce(np.array([0.0, 30.0]), ramp, "way"), path)[:, 0] == pytest.approx([0, 100, 300])
    assert wrench(MeasuredForce(np.array([0.0, 3.0]), ramp, "time"), path)[:, 0] == pytest.approx([0, 100, 300])
    assert wrench(MeasuredForce(np.array([0.0, 2.0]), ramp), path)[:, 0] == pytest.approx([0, 150, 300])
    on_table = MeasuredForce(np.array([0.0, 30.0]), ramp, "way", on="workpiece")
    assert wrench(on_table, path)[:, 0] == pytest.approx([0, -100, -300])
    short = MeasuredForce(np.array([0.0, 20.0]), ramp, "way", source="dyno.csv")
    with pytest.raises(InputError, match=r"dyno\.csv: the forces cover 0 to 20 of the way, the path needs 0 to 30"):
        wrench(short, path)


def test_a_block_may_have_a_force_of_its_own_and_air_has_none() -> None:
    path = path_of_commands(
        THREE, np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), block=np.array([0, 1, 2]), cutting=np.array([1, 1, 0])
    )
    found = wrench(ConstantForce((5.0, 0, 0), blocks={1: (7.0, 0, 0)}), path)
    assert found[:, 0].tolist() == [5.0, 7.0, 0.0]


def test_what_is_no_path_is_refused() -> None:
    with pytest.raises(PathError, match="at least two points that differ; 3 arrived, all at one place"):
        path_of_commands(THREE, np.zeros((3, 3)))
    with pytest.raises(MachineError, match="the command of axis X at pose 1 is nan"):
        path_of_commands(THREE, np.array([[0.0, 0, 0], [np.nan, 0, 0]]))
    away = circle(HERMLE, radius=600.0)
    with pytest.raises(
        PathError, match=r"point 15 wants Y at 563.816 mm, its travel is -550 to 550 mm \(18 such points\); move"
    ):
        path_of_commands(HERMLE, away)
    with pytest.raises(PathError, match="moves nothing at a feed"):
        path_of_program(Program("air", [Rapid({"X": 5.0})]), THREE, 1.0)
