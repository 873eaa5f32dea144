"""A frame of twelve sensors: the twist, the sensor that lies, and joint compliances."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats
from scipy.spatial.transform import Rotation

from elastogeo.errors import InputError, RankError
from elastogeo.identification import identify
from elastogeo.machine import Machine
from elastogeo.observe import MachineTest, Question, Run
from elastogeo.observe.static_loads.sensor_frame import Sensor, SensorFrame, sensitivities
from elastogeo.observe.static_loads.sensor_twist import check_sees_twist, sensor_twist
from elastogeo.sources import exact_response, linear_response, parameter_values, select_sources, simulate

MakeMachine = Callable[..., Machine]
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
FRAME = (
    *(Sensor((60.0, y, z), X) for y, z in ((-40.0, 30.0), (40.0, 30.0), (0.0, -50.0), (10.0, 80.0))),
    *(Sensor((x, 60.0, z), Y) for x, z in ((-40.0, 20.0), (40.0, 30.0), (5.0, -50.0), (-15.0, 70.0))),
    *(Sensor((x, y, 90.0), Z) for x, y in ((-45.0, -30.0), (40.0, -35.0), (0.0, 50.0), (30.0, 30.0))),
)
"""Four sensors on each of three faces."""

TWIST = np.array([0.012, -0.007, 0.02, 3e-5, -5e-5, 8e-5])


def read_by_rigid_body(twist: np.ndarray) -> np.ndarray:
    """Readings from the moved points themselves: each point of the body turns about the tool point and shifts."""
    turned = Rotation.from_rotvec(twist[3:])
    return np.array([np.dot(turned.apply(s.point) + twist[:3] - s.point, s.direction) for s in FRAME])


def test_the_twist_of_a_rigid_body_comes_back() -> None:
    found = sensor_twist(FRAME, read_by_rigid_body(TWIST))
    left = np.sum(TWIST[3:] ** 2) * max(np.linalg.norm(s.point) for s in FRAME)  # second order of the rotation
    assert_allclose(found.twist[0, :3], TWIST[:3], atol=left)
    assert_allclose(found.twist[0, 3:], TWIST[3:], atol=np.sum(TWIST[3:] ** 2))
    small = sensor_twist(FRAME, read_by_rigid_body(1e-3 * TWIST)).twist[0] / 1e-3
    assert np.abs(small - TWIST).max() < 1e-8
    assert sensor_twist(FRAME, sensitivities(FRAME) @ TWIST).twist[0] == pytest.approx(TWIST, rel=1e-12)


def test_covariance_is_that_of_many_frames() -> None:
    random = np.random.default_rng(5)
    readings = 2e-4 * random.standard_normal((4000, 12))
    found = sensor_twist(FRAME, readings, 2e-4)
    assert_allclose(np.std(found.twist, axis=0), found.standard_uncertainty, rtol=4 / np.sqrt(2 * 4000))
    correlation = found.covariance / np.outer(found.standard_uncertainty, found.standard_uncertainty)
    assert_allclose(np.corrcoef(found.twist.T), correlation, atol=4 / np.sqrt(4000))
    from_residuals = sensor_twist(FRAME, readings)
    assert from_residuals.standard_deviation == pytest.approx(2e-4, rel=4 / np.sqrt(2 * 4000 * 6))
    assert from_residuals.degrees_of_freedom == 4000 * 6
    assert found.redundancy.sum() == pytest.approx(6.0)


@pytest.mark.parametrize("known", [1e-4, None], ids=["known scatter", "scatter from residuals"])
@pytest.mark.parametrize("bad", [1, 5, 12])
def test_a_bad_sensor_is_named(known: float | None, bad: int) -> None:
    random = np.random.default_rng(bad)
    readings = np.tile(sensitivities(FRAME) @ TWIST, (20, 1)) + 1e-4 * random.standard_normal((20, 12))
    assert sensor_twist(FRAME, readings, known).suspect is None
    readings[:, bad - 1] += 8e-4
    found = sensor_twist(FRAME, readings, known)
    assert found.suspect == bad
    assert found.outlying[bad - 1] < 1e-6
    assert found.consistent is None if known is None else found.consistent < 1e-6


@pytest.mark.parametrize("known", [1.0, None], ids=["known scatter", "scatter from residuals"])
def test_a_sound_frame_is_blamed_once_in_a_hundred(known: float | None) -> None:
    random = np.random.default_rng(8)
    draws = 1500
    blamed = sum(sensor_twist(FRAME, random.standard_normal((3, 12)), known).suspect is not None for _ in range(draws))
    low, high = stats.binom.ppf([0.0005, 0.9995], draws, 0.01)
    assert blamed <= high
    assert blamed >= 0.5 * low  # sensors of one face share their errors, so that twelve looks are fewer


def test_a_frame_that_cannot_see_a_twist_says_which() -> None:
    with pytest.raises(RankError, match=r"8 sensors does not see Z, A, B \(translations"):
        check_sees_twist(tuple(Sensor((s.point[0], s.point[1], 0.0), s.direction) for s in FRAME[:8]))
    with pytest.raises(RankError, match="of 12 sensors does not see A, B, C"):
        check_sees_twist(tuple(Sensor((0.0, 0.0, 0.0), s.direction) for s in FRAME))
    through_one_point = tuple(
        Sensor((30.0 * n[0], 20.0 + 30.0 * n[1], 30.0 * n[2]), n) for n in np.random.default_rng(2).standard_normal((12, 3))
    )
    # every line of sight meets (0, 20, 0): turns about it are not seen; those about x and z move the tool point
    with pytest.raises(RankError, match="does not see B and sees X, Z, A, C in sums only"):
        check_sees_twist(through_one_point)


def test_bad_readings_are_refused() -> None:
    with pytest.raises(InputError, match=r"12 sensors need readings of the shape \(m, 12\), got \(3, 7\)"):
        sensor_twist(FRAME, np.zeros((3, 7)))
    with pytest.raises(InputError, match="sensor 4, instant 2: the reading is nan"):
        sensor_twist(FRAME, np.where(np.arange(24).reshape(2, 12) == 15, np.nan, 0.0))
    with pytest.raises(InputError, match="standard deviation of a reading is 0 mm"):
        sensor_twist(FRAME, np.zeros(12), 0.0)
    six = [FRAME[k] for k in (0, 1, 4, 6, 8, 10)]
    with pytest.raises(InputError, match="six sensors leave no residual: give the standard deviation"):
        sensor_twist(six, np.zeros(6))
    alone = sensor_twist(six, sensitivities(six) @ TWIST, 1e-4)
    assert_allclose(alone.twist[0], TWIST, rtol=1e-9)
    assert np.isnan(alone.outlying).all()
    assert alone.suspect is None
    with pytest.raises(InputError, match="the frame has no sensor"):
        SensorFrame(())
    with pytest.raises(InputError, match="the point of a sensor is"):
        Sensor((np.nan, 0.0, 0.0), X)


def framed_test(machine: Machine, lever: tuple[float, float, float] = (15.0, -10.0, -40.0)) -> MachineTest:
    random = np.random.default_rng(6)
    places = [(0, 0, 0), (200, 0, 50), (-150, 180, -80), (80, -220, 120)]
    blank = {f"displacement_{k}": np.zeros(8) for k in range(1, 13)}
    runs = tuple(
        Run(
            f"place {k}",
            {name: random.uniform(-400, 400, 8) for name in ("force_x", "force_y", "force_z")}
            | {axis: np.full(8, float(value)) for axis, value in zip("xyz", place, strict=True)}
            | blank,
        )
        for k, place in enumerate(places, 1)
    )
    return MachineTest("frame", machine, SensorFrame(FRAME, lever=lever), runs, Question(("C_*",)))


def test_a_rotation_at_a_joint_reads_as_the_moved_points_do(make_machine: MakeMachine) -> None:
    """C_CXX at a joint at the tool point, force 100 N in x: the body turns by C_CXX F about z, each point follows."""
    machine = make_machine("wFYXt")
    columns = {"force": np.array([100.0]), **{f"displacement_{k}": np.zeros(1) for k in range(1, 13)}}
    test = MachineTest("", machine, SensorFrame(FRAME, X), (Run("one", columns),))
    read = simulate(test, {"C_CXX": 1e-9, "C_YXX": 1e-9})
    expected = [np.dot([-1e-7 * s.point[1], 1e-7 * s.point[0] + 1e-7, 0.0], s.direction) for s in FRAME]
    assert_allclose([read.runs[0].columns[f"displacement_{k}"][0] for k in range(1, 13)], expected, atol=1e-11)


def test_joint_compliances_come_back_in_their_combinations(make_machine: MakeMachine) -> None:
    machine = make_machine("wFYXZt", tool=(30.0, -20.0, -150.0), seed=3)
    test = framed_test(machine)
    random = np.random.default_rng(1)
    sizes = {"mm/N": 1e-5, "rad/N": 3e-8, "mm/(N mm)": 3e-8, "rad/(N mm)": 1e-10}
    truth = {s.name: sizes[s.unit] * float(random.standard_normal()) for s in select_sources(machine, ["C_*"])}
    result = identify(simulate(test, truth, exact=False))
    assert result.confounding.rank > 36
    for parameter in result.parameters:
        stated = sum(c * truth[name] for name, c in parameter.stands_for.items())
        size = sum(abs(c * truth[name]) for name, c in parameter.stands_for.items())
        tolerance = max(1e-9, 1e-15 * result.confounding.condition_scaled)
        assert parameter.value == pytest.approx(stated, abs=tolerance * size)


def test_twist_and_identification_tell_the_same_motion(make_machine: MakeMachine) -> None:
    """Of one joint at the tool point: the twist of the frame is its compliance times the load."""
    machine = make_machine("wFXt")
    columns = {f"force_{a}": np.array([f]) for a, f in zip("xyz", (100.0, -50.0, 80.0), strict=True)}
    columns |= {f"displacement_{k}": np.zeros(1) for k in range(1, 13)}
    random = np.random.default_rng(9)
    C = random.standard_normal((6, 6)) * np.array([[1e-5] * 3 + [1e-7] * 3] * 3 + [[1e-8] * 3 + [1e-10] * 3] * 3)
    truth = {f"C_{d}{f}X": C[i, j] for i, d in enumerate("XYZABC") for j, f in enumerate("XYZABC")}
    test = MachineTest("", machine, SensorFrame(FRAME, lever=(0.0, 30.0, 0.0)), (Run("one", columns),))
    read = simulate(test, truth, exact=False).runs[0].columns
    force = np.array([100.0, -50.0, 80.0])
    expected = C @ np.concatenate([force, np.cross([0, 30.0, 0], force)])
    found = sensor_twist(FRAME, np.array([read[f"displacement_{k}"][0] for k in range(1, 13)]))
    assert_allclose(found.twist[0], expected, rtol=1e-9)


def test_exact_and_linear_responses_agree_to_second_order(make_machine: MakeMachine) -> None:
    machine = make_machine("wFYXZt", seed=5)
    observed = framed_test(machine).observations()[1]
    truth = {"C_XXX": 6e-5, "C_CXY": 2e-8, "C_BZX": 3e-8, "C_AAZ": 1e-10, "C_BBY": 1e-10}
    apart = []
    for factor in (1.0, 0.1):
        values = parameter_values(machine, {name: factor * value for name, value in truth.items()})
        difference = exact_response(values, machine, observed) - linear_response(values, machine, observed)
        apart.append(np.abs(difference).max() / factor**2)
    assert apart[0] > 0
    assert apart[1] == pytest.approx(apart[0], rel=0.05)


def test_runs_are_refused_like_those_of_a_static_force(make_machine: MakeMachine) -> None:
    machine = make_machine("wFYXt")
    setup = SensorFrame(FRAME[:2], X)
    with pytest.raises(InputError, match="run 'bad' lacks the column displacement_2"):
        setup.observe(machine, Run("bad", {"force": np.ones(1), "displacement_1": np.zeros(1)}))
    with pytest.raises(InputError, match="run 'bad' has no force"):
        setup.observe(machine, Run("bad", {"displacement_1": np.zeros(1), "displacement_2": np.zeros(1)}))
    (observed,) = setup.observe_all(machine, [Run("all", {f"displacement_{k}": np.zeros(3) for k in (1, 2)}, force=7.0)])
    assert observed.force == 7.0
    assert_allclose(observed.wrench[:, 0], 7.0)
