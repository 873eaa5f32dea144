"""A static force with a displacement sensor: what a run becomes, and that joint compliances come out of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError
from elastogeo.identification import identify
from elastogeo.machine import Machine
from elastogeo.observe import Imperfection, MachineTest, Question, Run
from elastogeo.observe.static_loads.static_force import StaticForce
from elastogeo.sources import exact_response, linear_response, parameter_values, select_sources, simulate

MakeMachine = Callable[..., Machine]
RAMP = np.concatenate([np.linspace(0, 500, 11), np.linspace(450, 0, 10)])
OTHERS = {"C_XXX": 6e-5, "C_YYY": 4e-5, "C_ZZZ": 3e-5, "C_XXY": 1e-5, "C_CXY": 2e-8, "C_BXX": 3e-8, "C_BBX": 1e-10}


def ramp(**columns: float) -> Run:
    count = len(RAMP)
    positions = {axis: np.full(count, value) for axis, value in columns.items()}
    return Run(f"ramp {columns}", {"force": RAMP, "displacement": np.zeros(count), **positions})


def asked(machine: Machine, setup: StaticForce, runs: tuple[Run, ...], parameters: tuple[str, ...]) -> MachineTest:
    return MachineTest("static", machine, setup, runs, Question(parameters))


def test_a_force_along_an_axis_reads_the_compliances_along_it_in_series(make_machine: MakeMachine) -> None:
    """Frames that all coincide: d = F (C_XXX + C_XXY), the springs of both joints in series."""
    test = asked(make_machine("wFYXt"), StaticForce((1.0, 0.0, 0.0)), (ramp(),), ("C_XX*",))
    read = simulate(test, {"C_XXX": 6e-5, "C_XXY": 1e-5, "C_YYY": 9e-5, "C_YXX": 5e-5})
    assert_allclose(read.runs[0].columns["displacement"], 7e-5 * RAMP, rtol=0, atol=1e-15)


def test_a_sensor_across_the_force_reads_the_cross_compliance(make_machine: MakeMachine) -> None:
    setup = StaticForce((1.0, 0.0, 0.0), sensor=(0.0, 2.0, 0.0))
    test = asked(make_machine("wFYXt"), setup, (ramp(),), ("C_YX*",))
    read = simulate(test, {"C_XXX": 6e-5, "C_YXX": 5e-6})
    assert_allclose(read.runs[0].columns["displacement"], 5e-6 * RAMP, rtol=0, atol=1e-15)


def test_a_force_at_a_lever_turns_what_it_pushes(make_machine: MakeMachine) -> None:
    """Moment F l about z turns the joint; the tool point, at the joint, only sees its C_XC: d = C_XCX (-l F)."""
    setup = StaticForce((1.0, 0.0, 0.0), lever=(0.0, 80.0, 0.0))
    test = asked(make_machine("wFYXt"), setup, (ramp(),), ("C_XCX",))
    read = simulate(test, {"C_XCX": 1e-8})
    assert_allclose(read.runs[0].columns["displacement"], -80.0 * 1e-8 * RAMP, rtol=0, atol=1e-15)


def test_a_turned_workpiece_turns_force_and_sensor(make_machine: MakeMachine) -> None:
    """The table at 90 degrees: a command of C turns the workpiece by its negative, its x is then the machine's -y."""
    setup = StaticForce((1.0, 0.0, 0.0), in_workpiece=True, pose={"C": np.pi / 2})
    test = asked(make_machine("wCFYXt"), setup, (ramp(),), ("C_*Y",))
    (observed,) = test.observations()
    assert_allclose(observed.direction[0], [0, -1, 0, 0, 0, 0], atol=1e-15)
    assert_allclose(observed.wrench[:, 1], -RAMP, atol=1e-12)
    read = simulate(test, {"C_YYY": 4e-5, "C_XXX": 9e-5})
    assert_allclose(read.runs[0].columns["displacement"], 4e-5 * RAMP, rtol=0, atol=1e-9)


def test_joint_compliances_come_back_from_ramps_at_several_places(make_machine: MakeMachine) -> None:
    machine = make_machine("wFYXZt", tool=(30.0, -20.0, -150.0), seed=3)
    places = [(0, 0, 0), (200, 0, 50), (-150, 180, -80), (80, -220, 120), (-60, 90, 200), (250, 140, -160), (-210, -130, 30)]
    runs = tuple(ramp(x=x, y=y, z=z) for x, y, z in places)
    test = asked(machine, StaticForce((1.0, 2.0, -1.0), (2.0, -1.0, 1.0)), runs, ("C_*",))
    random = np.random.default_rng(1)
    sizes = {"mm/N": 1e-5, "rad/N": 3e-8, "mm/(N mm)": 3e-8, "rad/(N mm)": 1e-10}
    truth = {s.name: sizes[s.unit] * float(random.standard_normal()) for s in select_sources(machine, ["C_*"])}
    result = identify(simulate(test, truth, exact=False))
    assert 3 <= result.confounding.rank <= len(places)
    for parameter in result.parameters:
        stated = sum(c * truth[name] for name, c in parameter.stands_for.items())
        size = sum(abs(c * truth[name]) for name, c in parameter.stands_for.items())
        assert parameter.value == pytest.approx(stated, abs=1e-9 * size)


def test_exact_and_linear_responses_agree_to_second_order(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt", seed=5)
    setup = StaticForce(
        (1.0, 1.0, -1.0), (0.0, 1.0, 1.0), {"A": 0.4, "C": 1.0, "X": 50.0}, (10.0, 0.0, 40.0), in_workpiece=True
    )
    (observed,) = asked(machine, setup, (ramp(),), ("C_*",)).observations()
    apart = []
    for factor in (1.0, 0.1):
        values = parameter_values(machine, {name: factor * value for name, value in OTHERS.items()})
        difference = exact_response(values, machine, observed) - linear_response(values, machine, observed)
        apart.append(np.abs(difference).max() / factor**2)
    assert apart[1] == pytest.approx(apart[0], rel=0.05)
    assert apart[0] > 0


def test_a_weight_is_one_force_for_the_run_and_levels_are_signed(make_machine: MakeMachine) -> None:
    setup = StaticForce((0.0, 0.0, -1.0))
    weight = Run("weight", {"displacement": np.zeros(5)}, force=111.68)
    pull = Run("pull", {"force": np.array([0.0, -50.0, -120.0]), "displacement": np.zeros(3)})
    both = Run("named", {"force": np.array([0.0, 99.0, 101.0]), "displacement": np.zeros(3)}, force=100.0)
    test = asked(make_machine("wFYXZt"), setup, (weight, pull, both), ("C_ZZ*",))
    first, second, third = test.observations()
    assert_allclose(first.wrench, np.tile([0, 0, -111.68, 0, 0, 0], (5, 1)))
    assert (first.force, second.force, third.force) == (111.68, -120.0, 100.0)
    assert_allclose(second.pose, [0, -50, -120])
    read = simulate(test, {"C_ZZZ": 3e-5})
    assert_allclose(read.runs[0].columns["displacement"], 3e-5 * 111.68, rtol=1e-9)


def test_a_force_may_be_recorded_by_components(make_machine: MakeMachine) -> None:
    setup = StaticForce(sensor=(1.0, 0.0, 0.0))
    assert setup.quantities == ("force_x", "force_y", "force_z", "displacement")
    columns = {"force_x": np.array([3.0, 0.0]), "force_y": np.array([0.0, 5.0]), "force_z": np.array([4.0, 0.0])}
    test = asked(make_machine("wFYXt"), setup, (Run("vector", {**columns, "displacement": np.zeros(2)}),), ("C_XX*",))
    (observed,) = test.observations()
    assert_allclose(observed.wrench, [[3, 0, 4, 0, 0, 0], [0, 5, 0, 0, 0, 0]])
    assert_allclose(observed.pose, [5, 5])


def test_imperfections_are_noise_resolution_and_scatter_of_the_force(make_machine: MakeMachine) -> None:
    test = asked(
        make_machine("wFYXt"),
        StaticForce((1.0, 0.0, 0.0)),
        tuple(replace(ramp(), name=f"{k}") for k in range(200)),
        ("C_XXX",),
    )
    read = simulate(test, {"C_XXX": 1e-4}, Imperfection(noise=1e-4, resolution=1e-5, force_scatter=0.02), seed=3)
    values = np.array([run.columns["displacement"] for run in read.runs])
    assert_allclose(np.round(values / 1e-5) * 1e-5, values, atol=1e-15)
    slopes = values @ RAMP / (RAMP @ RAMP) / 1e-4 - 1
    expected = np.hypot(0.02, 1e-4 / np.linalg.norm(RAMP) / 1e-4)
    assert np.std(slopes) == pytest.approx(expected, rel=4 / np.sqrt(2 * 200))


BAD = {
    "no column": ({"force": RAMP}, "lacks the column displacement; its columns are: force"),
    "lengths": ({"force": RAMP, "displacement": np.zeros(4)}, "has 21 of force, 4 of displacement; every reading needs one"),
    "empty": ({"force": np.zeros(0), "displacement": np.zeros(0)}, "has no reading"),
    "no force": ({"displacement": np.zeros(4)}, "has no force: record a column force_N, or give force_N for the whole run"),
    "NaN force": (
        {"force": np.array([0, np.nan]), "displacement": np.zeros(2)},
        "the force of reading 2 is no finite number",
    ),
    "NaN": ({"force": np.zeros(2), "displacement": np.array([np.nan, 0])}, "the reading of reading 1 is no finite number"),
    "micrometres": (
        {"force": np.ones(2), "displacement": np.array([0, 35.0])},
        "displacement reaches 35 mm; are they micrometres",
    ),
    "moves": ({"force": RAMP, "displacement": RAMP * 0, "x": RAMP}, "axis X moves by 500 .* make a run of each place"),
    "NaN place": ({"force": RAMP, "displacement": RAMP * 0, "x": RAMP * np.nan}, "a position of axis X is no finite number"),
}


@pytest.mark.parametrize("wrong", BAD)
def test_a_bad_run_is_refused(make_machine: MakeMachine, wrong: str) -> None:
    columns, message = BAD[wrong]
    test = asked(make_machine("wFYXt"), StaticForce((1.0, 0.0, 0.0)), (Run("bad", columns),), ("C_XXX",))
    with pytest.raises(InputError, match=f"run 'bad'.*{message}"):
        test.observations()


def test_a_bad_setup_is_refused() -> None:
    with pytest.raises(InputError, match=r"the direction of the sensor is \(0.0, 0.0, 0.0\); a direction is three finite"):
        StaticForce()
    with pytest.raises(InputError, match="the direction of the force is"):
        StaticForce((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
