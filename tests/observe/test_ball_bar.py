"""The loaded ball bar: from runs to observations, from pressure to force, and the set-up's own deflection."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, PathError
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import (
    PLANES,
    THESIS_CALIBRATION,
    Calibration,
    Circle,
    LoadedBallBar,
    MachineTest,
    Run,
    check_observations,
    force_from_pressure,
    instrument_named,
    plane_directions,
)
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
ANGLE = np.linspace(0, 2 * np.pi, 24, endpoint=False)
POST = 2.33e-3
"""Deflection of the workpiece ball's post [mm/bar] (Eq. 5.38)."""


def run_at(**settings: float | None) -> Run:
    columns = {"angle": ANGLE, "radial": np.zeros(len(ANGLE))}
    return Run("r1", columns, **settings)  # type: ignore[arg-type]


def with_setup(test: MachineTest, **changes: object) -> MachineTest:
    return replace(test, setup=replace(test.setup, **changes))  # type: ignore[type-var]


def calibrated(test: MachineTest) -> MachineTest:
    return with_setup(test, calibration=THESIS_CALIBRATION)


def test_the_bar_reads_and_pushes_along_itself(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [364.0], angle=ANGLE)
    (observed,) = test.observations()
    expected = np.column_stack([np.cos(ANGLE), np.sin(ANGLE), *np.zeros((4, len(ANGLE)))])
    assert_allclose(observed.direction, expected, atol=1e-12)
    assert_allclose(observed.wrench, 364 * expected, atol=1e-9)
    assert observed.length == 150.0
    assert observed.force == 364.0
    assert len(observed) == len(ANGLE)
    assert_allclose(np.linalg.norm(observed.velocity, axis=1), 2000 / 60)


def test_clockwise_turns_the_velocity_alone(make_test: MakeTest) -> None:
    one, other = (make_test("wFYXt", [364.0], sense=sense).observations()[0] for sense in (1, -1))
    assert_allclose(one.velocity, -other.velocity)
    for attribute in ("commands", "direction", "wrench"):
        assert_allclose(getattr(one, attribute), getattr(other, attribute))


def test_force_is_that_of_the_run_or_of_its_pressure(make_test: MakeTest) -> None:
    bare = make_test("wFYXt").setup
    assert isinstance(bare, LoadedBallBar)
    assert bare.force(run_at(force=99.0)) == 99.0
    bar = replace(bare, calibration=THESIS_CALIBRATION)
    assert bar.force(run_at(pressure=3.0)) == pytest.approx(364.0)
    assert bar.force(run_at(force=360.0, pressure=3.0)) == 360.0
    with pytest.raises(InputError, match=r"run 'r1' gives 99 N and 3 bar, which is 364 N by the force calibration; correct"):
        bar.force(run_at(force=99.0, pressure=3.0))
    with pytest.raises(InputError, match=r"run 'r1' gives a pressure of 3 bar, and the test no force calibration; add"):
        bare.force(run_at(pressure=3.0))
    with pytest.raises(InputError, match=r"a pressure of 0\.1 bar gives a force of -1\.4 N by the force calibration"):
        bar.force(run_at(pressure=0.1))
    other = replace(bar, calibration=Calibration((0.0, 10.0), (5.0, 1005.0)))
    assert other.force(run_at(pressure=3.0)) == pytest.approx(305.0)
    with pytest.raises(InputError, match="run 'r1' has neither a force nor a pressure; give force_N or pressure_bar"):
        bar.force(run_at())


def test_a_bar_that_cannot_pull_has_no_negative_force(make_test: MakeTest) -> None:
    bar = make_test("wFYXt").setup
    assert isinstance(bar, LoadedBallBar)
    with pytest.raises(InputError, match=r"run 'r1' has a force of -36 N, and a bar pushes its balls apart; give the size"):
        bar.force(run_at(force=-36.0))
    assert replace(bar, pulls=True).force(run_at(force=-36.0)) == -36.0


def test_two_points_are_a_line_and_more_a_table() -> None:
    line = Calibration((1.0, 6.0), (112.0, 742.0))
    assert force_from_pressure(0.4, line) == pytest.approx(36.4)
    assert force_from_pressure(8.0, line) == pytest.approx(994.0)
    table = Calibration((1.0, 2.0, 6.0), (112.0, 200.0, 742.0))
    assert force_from_pressure(1.5, table) == pytest.approx(156.0)
    assert force_from_pressure(4.0, table) == pytest.approx(471.0)
    assert force_from_pressure(6.0, table) == pytest.approx(742.0)
    for outside in (0.9, 6.1):
        with pytest.raises(InputError, match=f"{outside:g} bar lies outside the force calibration, 1 to 6 bar"):
            force_from_pressure(outside, table)


@pytest.mark.parametrize(
    ("pressure", "force", "message"),
    [
        ((1.0,), (112.0,), "at least two pressures with a force each, got 1 pressures"),
        ((1.0, 2.0), (112.0,), "got 2 pressures and 1 forces"),
        ((1.0, 1.0), (1.0, 2.0), "must increase"),
        ((2.0, 1.0), (1.0, 2.0), "must increase"),
    ],
)
def test_a_table_that_is_no_calibration_is_refused(pressure: tuple, force: tuple, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Calibration(pressure, force)


def test_the_posts_deflection_is_taken_off_as_in_eq_5_38(make_test: MakeTest) -> None:
    plain = calibrated(replace(make_test("wFXYZt", angle=ANGLE), runs=(run_at(pressure=4.0),)))
    (raw,) = plain.observations()
    (corrected,) = with_setup(plain, setup_deflection=POST).observations()
    # in a horizontal plane the elevation is zero: 2.33 um/bar at every angle
    assert_allclose(raw.reading - corrected.reading, 4 * POST, rtol=1e-12)
    upright = with_setup(plain, circle=Circle(150.0, "YZ"), setup_deflection=POST)
    (corrected,) = upright.observations()
    elevation = np.arcsin(np.clip(corrected.direction[:, 2], -1, 1))
    assert np.ptp(elevation) > 3
    assert_allclose(raw.reading - corrected.reading, 4 * POST * np.cos(elevation) ** 2, atol=1e-15)


@pytest.mark.parametrize("plane", ["XY", "YZ", ((1.0, 0.0, 1.0), (0.0, 1.0, 0.0))])
@pytest.mark.parametrize("exact", [False, True])
def test_simulation_puts_on_what_the_correction_takes_off(plane: object, exact: bool, make_test: MakeTest) -> None:
    circle = Circle(150.0, plane)  # type: ignore[arg-type]
    plain = calibrated(replace(make_test("wFXYZt", angle=ANGLE, circle=circle), runs=(run_at(pressure=4.0),)))
    corrected = with_setup(plain, setup_deflection=POST)
    truth = {"C_XXX": 5e-5, "C_YYY": 4e-5, "C_ZZZ": 3e-5}
    without, with_post = (simulate(test, truth, exact=exact) for test in (plain, corrected))
    raw = with_post.runs[0].columns["radial"] - without.runs[0].columns["radial"]
    assert raw.max() == pytest.approx(4 * POST)
    assert_allclose(with_post.observations()[0].reading, without.observations()[0].reading, atol=1e-14)


def test_the_correction_needs_a_pressure(make_test: MakeTest) -> None:
    test = with_setup(make_test("wFYXt", [364.0]), setup_deflection=POST)
    with pytest.raises(InputError, match=r"has no pressure, which the set-up deflection correction \(Eq. 5.38\) needs"):
        test.observations()


def test_another_tool_ball_may_be_named(make_test: MakeTest, make_machine: Callable[..., Machine]) -> None:
    test = make_test(make_machine("wFYXt", tool=(1.0, 2.0, 3.0)), [100.0])
    assert_allclose(test.observations()[0].tool, [1.0, 2.0, 3.0])
    assert_allclose(with_setup(test, tool=(7.0, 8.0, 9.0)).observations()[0].tool, [7.0, 8.0, 9.0])


@pytest.mark.parametrize("column", ["angle", "radial"])
def test_a_run_without_a_column_is_refused(column: str, make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0])
    (run,) = test.runs
    kept = {name: values for name, values in run.columns.items() if name != column}
    with pytest.raises(InputError, match=f"run '100 N, 1' lacks the column {column}; a ball bar needs"):
        replace(test, runs=(replace(run, columns=kept),)).observations()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_reading_that_is_no_number_is_refused(value: float, make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0], angle=ANGLE)
    radial = np.zeros(len(ANGLE))
    radial[6] = value
    run = replace(test.runs[0], columns={"angle": ANGLE, "radial": radial})
    with pytest.raises(InputError, match="run '100 N, 1': the reading of reading 7 is no finite number"):
        replace(test, runs=(run,)).observations()


def test_an_angle_or_force_that_is_no_number_is_refused(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0], angle=ANGLE)
    angle = ANGLE.copy()
    angle[3] = np.nan
    run = replace(test.runs[0], columns={"angle": angle, "radial": np.zeros(len(ANGLE))})
    with pytest.raises(InputError, match="run '100 N, 1': the commands of reading 4 is no finite number"):
        replace(test, runs=(run,)).observations()
    with pytest.raises(InputError, match="the force is nan, it must be a finite number of newtons"):
        make_test("wFYXt", [float("nan")]).observations()


def test_a_run_without_readings_is_refused(make_test: MakeTest) -> None:
    with pytest.raises(InputError, match="run '100 N, 1' has no reading"):
        make_test("wFYXt", [100.0], angle=np.zeros(0)).observations()
    (observed,) = make_test("wFYXt", [100.0]).observations()
    with pytest.raises(InputError, match="run '100 N, 1' has no reading"):
        check_observations(observed.rows(0, 0))


def test_a_reading_without_an_angle_is_refused(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0], angle=ANGLE)
    run = replace(test.runs[0], columns={"angle": ANGLE, "radial": np.zeros(23)})
    with pytest.raises(InputError, match="has 24 angles and 23 readings; every reading needs its angle"):
        replace(test, runs=(run,)).observations()


def test_observations_can_be_cut_into_blocks(make_test: MakeTest) -> None:
    (observed,) = make_test("wFYXt", [100.0], angle=ANGLE).observations()
    block = observed.rows(5, 9)
    assert len(block) == 4
    assert_allclose(block.commands, observed.commands[5:9])
    assert_allclose(block.wrench, observed.wrench[5:9])
    assert_allclose(observed.with_reading(ANGLE).reading, ANGLE)


@pytest.mark.parametrize("radius", [0.0, -150.0, float("nan")])
def test_a_circle_without_radius_is_refused(radius: float) -> None:
    with pytest.raises(InputError, match=f"the radius of the circle is {radius:g} mm, it must be positive"):
        Circle(radius)


def test_a_plane_is_named_or_two_orthogonal_directions() -> None:
    for first, second in (plane_directions(plane) for plane in (*PLANES, ((3.0, 0.0, 4.0), (0.0, 9.0, 0.0)))):
        assert_allclose([first @ first, second @ second, first @ second], [1, 1, 0], atol=1e-15)
    assert_allclose(plane_directions(((3.0, 0.0, 4.0), (0.0, 9.0, 0.0)))[0], [0.6, 0.0, 0.8])
    with pytest.raises(InputError, match="there is no plane 'XZ'; there are XY, YZ, ZX, or two directions"):
        Circle(150.0, "XZ")
    for directions in (((1.0, 0.0, 0.0), (1.0, 1.0, 0.0)), ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))):
        with pytest.raises(InputError, match="the two directions of a plane must be orthogonal"):
            Circle(150.0, directions)


def test_a_plane_off_the_machine_is_refused(make_test: MakeTest) -> None:
    with pytest.raises(PathError, match="along Z it would be off by up to 150 mm"):
        make_test("wFYXt", [100.0], circle=Circle(150.0, "YZ")).observations()


def test_an_unknown_instrument_is_refused() -> None:
    assert instrument_named("loaded-ball-bar") is LoadedBallBar
    with pytest.raises(InputError, match=r"there is no instrument 'ruler'; there are: .*loaded-ball-bar"):
        instrument_named("ruler")


@pytest.mark.parametrize(
    ("quantity", "factor", "message"),
    [
        ("angle", 180 / np.pi, r"the angles span 57\.\d turns; are they degrees given as radians\?"),
        ("radial", 1000.0, r"a reading of 20 mm on a radius of 150 mm; look at the units of both"),
    ],
)
def test_a_size_that_only_a_wrong_unit_gives_is_refused(quantity: str, factor: float, message: str) -> None:
    angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    columns = {"angle": angle, "radial": np.full(720, 0.02)}
    columns[quantity] = columns[quantity] * factor
    machine = Machine("plane", parse_topology("wFYXt"))
    with pytest.raises(InputError, match=message):
        LoadedBallBar(Circle(150.0), 30.0).observe(machine, Run("r", columns, force=100.0))
