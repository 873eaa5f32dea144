"""What a run of a sphere nest becomes: poses, directions, what linear axes miss, what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification import ball_deviations, identify
from elastogeo.machine import Array, Machine, loop_frames
from elastogeo.observe import BallMotion, Imperfection, MachineTest, Observations, Question, Run, SphereNest
from elastogeo.report import view_of
from elastogeo.sources import simulate

MakeMachine = Callable[..., Machine]
SENSORS = ((1.0, 0.0, 1.0), (-0.5, 0.9, 1.0), (-0.4, -0.8, 1.2))
CENTRE = {"X": 120.0, "Y": 40.0, "Z": -30.0}
C_TURNS = BallMotion({"C": 0.0}, {"C": 2 * np.pi}, name="C")
A_SWINGS = BallMotion({"A": -0.8}, {"A": 0.6}, there_and_back=True, name="A")
READ = {f"displacement_{k}": np.zeros(24) for k in (1, 2, 3)}
ANGLE = np.arange(24) * 2 * np.pi / 24


def table_table(make_machine: MakeMachine) -> Machine:
    return make_machine("wCAFYXZt", tool=(10.0, -5.0, -180.0), seed=8)


def observed(machine: Machine, setup: SphereNest, **columns: Array) -> Observations:
    return setup.observe(machine, Run("one", {**READ, **columns}))


def test_the_ball_stays_in_the_nest_and_the_sensors_turn_with_the_table(make_machine: MakeMachine) -> None:
    machine = table_table(make_machine)
    seen = observed(machine, SphereNest(SENSORS, CENTRE, motions=(C_TURNS, A_SWINGS)), angle=ANGLE)
    frames = loop_frames(machine, seen.commands, seen.tool)
    assert_allclose(frames.point, frames.workpiece.point(seen.workpiece), atol=1e-9)
    assert np.ptp(seen.commands[:, machine.index("C")]) > 5
    directions = frames.workpiece.components(seen.direction[:, :3])
    for k, sensor in enumerate(SENSORS):
        n = np.array(sensor) / np.linalg.norm(sensor)
        assert_allclose(directions[24 * k : 24 * (k + 1)], np.broadcast_to(n, (24, 3)), atol=1e-12)


def test_motions_come_one_after_the_other_over_one_turn(make_machine: MakeMachine) -> None:
    machine = table_table(make_machine)
    seen = observed(machine, SphereNest(SENSORS, {**CENTRE, "A": 0.1}, motions=(C_TURNS, A_SWINGS)), angle=ANGLE)
    c, a = (seen.commands[:24, machine.index(axis)] for axis in "CA")
    assert_allclose(c[:12], 2 * np.pi * np.arange(12) / 12, atol=1e-12)
    assert_allclose(a[:12], 0.1)
    assert_allclose(c[12:], 0.0)
    assert_allclose(a[[12, 18]], [-0.8, 0.6], atol=1e-12)  # at its start, and half way at its other end


def test_a_nest_on_the_tool_reads_the_other_way(make_machine: MakeMachine) -> None:
    """Nothing turns: the same sensor on the other end sees the ball go the other way."""
    machine = table_table(make_machine)
    still = {"c": np.zeros(24)}
    on_table, on_tool = (observed(machine, SphereNest(SENSORS, CENTRE, end), **still) for end in ("workpiece", "tool"))
    frames = loop_frames(machine, on_table.commands, on_table.tool)
    assert_allclose(
        frames.workpiece.components(on_table.direction[:, :3]), -frames.tool.components(on_tool.direction[:, :3]), atol=1e-12
    )


@pytest.mark.parametrize("nest", ["workpiece", "tool"])
def test_an_offset_of_the_tool_is_the_same_deviation_whatever_the_sensors(make_machine: MakeMachine, nest: str) -> None:
    """The three deviations are those of the tool in the foundation, on whichever end the nest sits."""
    machine = make_machine("wCAFYXZt")
    runs = tuple(Run(str(k), {"angle": ANGLE}) for k in range(3))
    test = MachineTest("nest", machine, SphereNest(SENSORS, CENTRE, nest, ("workpiece",), (C_TURNS, A_SWINGS)), runs)
    found = ball_deviations(identify(simulate(test, {"E_Xt0": 0.01, "E_Zt0": -0.02}, Imperfection(noise=1e-6))))
    assert len(found) == 3
    for run in found:
        assert set(run.rotary) == {"A", "C"}
        assert_allclose(run.measured, np.tile([0.01, 0.0, -0.02], (24, 1)), atol=1e-5)
        assert_allclose(run.predicted, run.measured, atol=1e-5)


@pytest.mark.parametrize("sensors", [SENSORS[:2], ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.0)), SENSORS])
@pytest.mark.parametrize("poses", [1, 2, 24])
def test_the_page_has_a_picture_whatever_the_sensors_and_the_poses(make_machine, sensors, poses) -> None:
    """Sensors in one plane show no three deviations: their readings are drawn as they are."""
    runs = tuple(Run(str(k), {"angle": ANGLE[:poses]}) for k in range(2))
    setup = SphereNest(sensors, CENTRE, motions=(C_TURNS, A_SWINGS))
    test = MachineTest("nest", make_machine("wCAFYXZt"), setup, runs, Question(("E_X(0A)C",)))
    result = identify(simulate(test, {"E_X(0A)C": 0.01}, Imperfection(noise=1e-6)))
    picture = view_of(result).picture
    assert picture is not None
    assert len(picture.draw().axes) == (4 if sensors is SENSORS else 1)
    if sensors is not SENSORS:
        with pytest.raises(UnsupportedError, match="does not show the three deviations of a ball"):
            ball_deviations(result)


def test_what_recorded_linear_axes_miss_is_taken_off(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAFYXZt")
    setup = SphereNest(((1, 0, 0), (0, 1, 0), (0, 0, 1)), CENTRE)
    still = {axis.lower(): np.full(24, value) for axis, value in {**CENTRE, "A": 0.0, "C": 0.0}.items()}
    seen = observed(machine, setup, **{**still, "x": still["x"] + 0.003})
    assert_allclose(seen.correction, np.repeat([0.003, 0.0, 0.0], 24), atol=1e-12)
    assert_allclose(seen.reading, -seen.correction)


def test_a_simulated_run_records_its_rotary_axes_and_reads_back_the_same(make_machine: MakeMachine) -> None:
    machine = table_table(make_machine)
    setup = SphereNest(SENSORS, CENTRE, motions=(C_TURNS, A_SWINGS))
    test = simulate(MachineTest("nest", machine, setup, (Run("1", {"angle": ANGLE}),)), {"E_X(0A)C": 0.01})
    (run,) = test.runs
    assert set(run.columns) == {"a", "c", *READ}
    (first,), (again,) = test.observations(), replace(test, setup=replace(setup, motions=())).observations()
    assert_allclose(again.commands, first.commands)
    assert_allclose(again.reading, first.reading)


def test_a_preload_presses_along_its_direction_in_the_nest(make_machine: MakeMachine) -> None:
    machine = table_table(make_machine)
    setup = SphereNest(SENSORS, CENTRE, motions=(A_SWINGS,), preload=(0.0, 0.0, 1.0))
    seen = setup.observe(machine, Run("one", {**READ, "angle": ANGLE}, force=40.0))
    frames = loop_frames(machine, seen.commands, seen.tool)
    assert_allclose(frames.workpiece.components(seen.wrench[:, :3]), np.tile([0.0, 0.0, 40.0], (72, 1)), atol=1e-12)
    with pytest.raises(InputError, match="run 'one' has a force of 40 N and the set-up no direction of it"):
        replace(setup, preload=None).observe(machine, Run("one", {**READ, "angle": ANGLE}, force=40.0))


def test_each_axis_has_the_sense_in_which_it_came_to_the_pose(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAFYXZt")
    angle = np.deg2rad([0, 0, 10, 20, 20, 10, 0, 0])
    setup = SphereNest(SENSORS, CENTRE)
    read = {f"displacement_{k}": np.zeros(8) for k in (1, 2, 3)}
    seen = setup.observe(machine, Run("one", {**read, "c": angle}))
    assert seen.sense is not None
    for sensor in range(3):
        assert_allclose(seen.sense[8 * sensor : 8 * sensor + 8, machine.index("C")], [0, 0, 1, 1, 1, -1, -1, -1])
    assert_allclose(seen.sense[:, machine.index("A")], 0.0)


def test_backlash_of_a_rotary_axis_comes_back_from_poses_taken_both_ways(make_machine: MakeMachine) -> None:
    """A table that falls short of its turn moves a ball by the backlash times its distance from the axis, half each way."""
    machine = make_machine("wCAFYXZt")
    motions = (BallMotion({"C": 0.0}, {"C": 3.0}, there_and_back=True), A_SWINGS)
    question = Question(("rotary-axes", "E_[XYZ]w0", "B_CC", "B_AA"))
    runs = tuple(Run(str(k), {"angle": ANGLE}) for k in range(3))
    test = MachineTest("nest", machine, SphereNest(SENSORS, CENTRE, motions=motions), runs, question)
    truth = {"B_CC": 4e-5, "B_AA": -2e-5, "E_X(0A)C": 0.01}
    result = identify(simulate(test, truth, Imperfection(noise=1e-5), seed=1))
    for name, value in truth.items():
        assert result[name].value == pytest.approx(value, abs=5 * result[name].standard_uncertainty)
        assert result[name].standard_uncertainty < 0.02 * abs(value)


def test_lag_of_a_rotary_axis_comes_back_from_a_motion_with_time(make_machine: MakeMachine) -> None:
    """There and back, so that the lag changes its sign; at an even rate it would look like a ball off its place."""
    machine = make_machine("wCAFYXZt")
    time = np.linspace(0.0, 20.0, 200)
    columns = {"time": time, "c": 1.5 - 1.5 * np.cos(2 * np.pi * time / 20), "a": 0.5 * np.sin(2 * np.pi * time / 20)}
    columns |= {name: np.zeros(200) for name in READ}
    question = Question(("rotary-axes", "E_[XYZ]w0", "T_[AC]1"))
    runs = tuple(Run(str(k), columns) for k in range(3))
    test = MachineTest("nest", machine, SphereNest(SENSORS, CENTRE), runs, question)
    velocity = test.observations()[0].velocity[:200, machine.index("C")]
    assert_allclose(velocity[1:-1], (1.5 * np.pi / 10 * np.sin(2 * np.pi * time / 20))[1:-1], atol=1e-3)
    truth = {"T_C1": 4e-4, "T_A1": -2e-4, "E_X(0A)C": 0.01}
    result = identify(simulate(test, truth, Imperfection(noise=1e-5), seed=1))
    for name, value in truth.items():
        assert result[name].value == pytest.approx(value, abs=5 * result[name].standard_uncertainty)
        assert result[name].standard_uncertainty < 0.02 * abs(value)


def test_bad_runs_and_set_ups_are_refused(make_machine: MakeMachine) -> None:
    machine = table_table(make_machine)
    setup = SphereNest(SENSORS, CENTRE, motions=(C_TURNS,))
    with pytest.raises(InputError, match="run 'one' lacks the column displacement_3"):
        setup.observe(machine, Run("one", {"c": ANGLE, "displacement_1": ANGLE, "displacement_2": ANGLE}))
    with pytest.raises(InputError, match="run 'one' lacks the column angle"):
        observed(machine, setup)
    with pytest.raises(InputError, match="run 'one' does not say where its rotary axes are"):
        observed(machine, replace(setup, motions=()))
    with pytest.raises(InputError, match="the position of C at reading 4 is no finite number"):
        observed(machine, setup, c=np.where(np.arange(24) == 3, np.nan, ANGLE))
    with pytest.raises(InputError, match="run 'one' has 24 readings and 5 positions of C"):
        observed(machine, setup, c=np.zeros(5))
    with pytest.raises(InputError, match=r"C spans 54\.9 turns; are they degrees given as radians"):
        observed(machine, setup, c=np.rad2deg(ANGLE))
    with pytest.raises(InputError, match="displacement_2 reaches 12 mm; are they micrometres given as millimetres"):
        observed(machine, setup, angle=ANGLE, displacement_2=np.full(24, 12.0))
    with pytest.raises(InputError, match="has 24 readings and 24 times; it does not grow after reading 3; a motion takes 3"):
        observed(machine, setup, c=ANGLE, time=np.where(np.arange(24) == 3, 0.0, np.arange(24.0)))
    with pytest.raises(InputError, match=r"the linear axes miss the ball by 28\.26 mm at reading 1; correct"):
        observed(machine, setup, c=np.zeros(24), z=np.full(24, -60.0))
    with pytest.raises(InputError, match="'table' is no end of the structural loop; write tool or workpiece"):
        SphereNest(SENSORS, nest="table")
    with pytest.raises(InputError, match="there is no sensor; give each its direction"):
        SphereNest(())
    with pytest.raises(InputError, match="the motion 'K1' starts with A and ends with C; name the same rotary axes"):
        BallMotion({"A": 0.0}, {"C": 1.0}, name="K1")
