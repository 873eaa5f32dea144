"""The examples of static tests: their runs are what their simulation files say, and the analyses find the truth in them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError
from elastogeo.formats import poses_of, read_simulation, read_test
from elastogeo.identification import identify
from elastogeo.identification.static_tests.cartesian import cartesian_of
from elastogeo.identification.static_tests.hysteresis import hysteresis
from elastogeo.identification.static_tests.straight_line import static_line
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import MachineTest, Run
from elastogeo.observe.static_loads.sensor_frame import SensorFrame
from elastogeo.observe.static_loads.sensor_twist import sensor_twist
from elastogeo.observe.static_loads.static_force import StaticForce
from elastogeo.sources import simulate

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
NAMES = ("static-force", "static-frame", "static-probes", "static-rig")


@pytest.mark.parametrize("name", NAMES)
def test_the_runs_are_those_of_the_simulation_file(name: str) -> None:
    test, truth = read_test(EXAMPLES / name), read_simulation(EXAMPLES / name / "simulation.toml")
    again = simulate(read_test(EXAMPLES / name, poses_of(truth)), truth.values, truth.imperfection, truth.seed, truth.exact)
    assert test.simulated.startswith("Not measured: simulated")
    for run, same in zip(test.runs, again.runs, strict=True):
        assert set(run.columns) == set(same.columns)
        for column, values in same.columns.items():
            assert_allclose(run.columns[column], values, rtol=0, atol=1e-9, err_msg=f"{run.name}, {column}")


@pytest.mark.parametrize("name", NAMES)
def test_every_estimate_is_near_the_truth(name: str) -> None:
    truth = read_simulation(EXAMPLES / name / "simulation.toml").values
    result = identify(read_test(EXAMPLES / name))
    asked = set(result.confounding.labels)
    # of a reciprocal pair one stands for both
    assert all(f"C_{one[3]}{one[2]}{one[4]}" in asked for one in truth.keys() - asked)
    # three runs may agree by chance: the scatter of the readings is a floor
    floor = result.naive.standard_uncertainty
    for parameter, least in zip(result.parameters, floor, strict=True):
        stated = sum(c * truth.get(name, 0.0) for name, c in parameter.stands_for.items())
        assert abs(parameter.value - stated) < 4 * max(parameter.standard_uncertainty or 0.0, least), parameter.name


def test_the_ramps_have_no_hysteresis_but_a_compliance() -> None:
    test = read_test(EXAMPLES / "static-force")
    for run in test.runs:
        found = hysteresis(run.columns["force"], run.columns["displacement"])
        assert len(found.cycles) == 3
        low, high = found.static_compliance.interval(0.999)
        assert low < 7.8e-5 < high
        assert abs(found.mean_hysteresis.value) < 5e-5


def test_the_rig_is_a_straight_line_through_all_weights() -> None:
    runs = read_test(EXAMPLES / "static-rig").runs
    columns = [np.concatenate([run.columns[name] for run in runs]) for name in ("force", "displacement")]
    found = static_line(*columns, [run.name for run in runs for _ in run.columns["force"]])
    low, high = found.stiffness().interval()
    assert low < 2650 < high
    assert high - low < 150


def test_the_probes_give_the_cartesian_compliance() -> None:
    test = read_test(EXAMPLES / "static-probes")
    found = cartesian_of(test.machine, test.observations(), sensors=3)
    expected = np.array([[6.8e-5, 0, 0.5e-5], [0, 5e-5, 0], [0.5e-5, 0, 3e-5]])
    assert not found.undetermined
    assert_allclose(found.compliance, expected, atol=1e-7)
    assert found.counted.needed is not None


def test_the_frame_gives_the_twist() -> None:
    test = read_test(EXAMPLES / "static-frame")
    assert isinstance(test.setup, SensorFrame)
    readings = np.column_stack([test.runs[1].columns[name] for name in test.setup.readings])
    found = sensor_twist(test.setup.sensors, readings)
    assert found.suspect is None
    force = test.runs[1].columns["force"] / 3
    # C_CXX turns about z by 2e-8 per newton in x, C_AYY about x by 1e-8 per newton in y; the lever lies in the tool
    assert_allclose(found.twist[:, 5], 2e-8 * force, atol=5 * found.standard_uncertainty[5])
    assert_allclose(found.twist[:, 3], 2e-8 * force, atol=5 * found.standard_uncertainty[3])


def test_a_turn_of_the_simulation_is_one_loading_cycle() -> None:
    machine = Machine("m", parse_topology("wFYXt"))
    run = Run("r", {"angle": np.linspace(0, 2 * np.pi, 5), "radial": np.zeros(5)}, force=100.0)
    ramp = simulate(MachineTest("", machine, StaticForce((1.0, 0.0, 0.0)), (run,)), {"C_XXX": 1e-5})
    assert set(ramp.runs[0].columns) == {"force", "displacement"}
    assert_allclose(ramp.runs[0].columns["force"], [0, 50, 100, 50, 0], atol=1e-12)
    held = simulate(MachineTest("", machine, StaticForce((1.0, 0.0, 0.0), ramp=False), (run,)), {"C_XXX": 1e-5})
    assert_allclose(held.runs[0].columns["displacement"], 1e-3)
    with pytest.raises(InputError, match="run 'r' cannot be simulated: it has no force; give force_N"):
        simulate(MachineTest("", machine, StaticForce((1.0, 0.0, 0.0)), (Run("r", run.columns),)), {"C_XXX": 1e-5})
