"""The ball-roller test: currents and encoders become the readings of a loaded circle, on any topology."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import FeedDrive, KnownBalance, SetupCompliance
from elastogeo.errors import InputError, RankError, UnsupportedError
from elastogeo.identification import identify, uncertainty_budget
from elastogeo.identification.identification import effects_of, systems_of
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import BallRoller, Circle, Imperfection, MachineTest, Question, Rig, Run
from elastogeo.sources import simulate

RADIUS = 56.4
CONSTANTS = {"X": 1650.0, "Y": 1520.0, "Z": 2000.0}
BALANCES = {
    "X": KnownBalance("X", inertia=6.0, viscous=90.0, coulomb=1550.0, constant=0.0),
    "Y": KnownBalance("Y", inertia=4.0, viscous=70.0, coulomb=1600.0, constant=50.0),
    "Z": KnownBalance("Z", inertia=8.0, viscous=110.0, coulomb=2000.0, constant=-900.0),
}
NOISY = Imperfection(noise=1e-4, current_noise=0.03, eccentricity=2e-4, force_scatter=2e-3)

CASES = {
    "wCAYfXZt": ("XY", {"C_XXX": 6.2e-5, "C_YYY": 5.1e-5, "C_XYX": 4e-6, "E_XX1": -5e-5, "E_YY1": 3e-5, "E_Xt0": 2e-3}),
    "wFYXt": ("XY", {"C_XXX": 6.2e-5, "C_YYY": 5.1e-5, "E_XX1": -5e-5, "E_C(0Y)X": 2e-5, "E_Yt0": -1e-3}),
    "wFXYZBCt": ("XY", {"C_XXX": 7e-5, "C_YYY": 4e-5, "C_XYY": 3e-6, "E_YY1": 4e-5, "E_Xt0": 1e-3}),
    "wYXFZt": ("ZX", {"C_XXX": 5e-5, "C_ZZZ": 3e-5, "E_ZZ1": 4e-5, "E_Zt0": 1e-3}),
}
"""Both linear axes of the plane in the tool branch, one in each, both in the workpiece branch and the tool's."""


def machine_of(topology: str) -> Machine:
    parsed = parse_topology(topology)
    joints = tuple(Joint(axis, offset=(10.0 * k, -5.0 * k, 20.0 * k)) for k, axis in enumerate(parsed.axes, 1))
    return Machine(name=topology, topology=parsed, joints=joints, tool=(0.0, 0.0, -150.0))


def setup_of(plane: str = "XY", **settings: object) -> BallRoller:
    drives = tuple(FeedDrive(axis, torque_constant=CONSTANTS[axis], pitch=10.0, efficiency=0.9) for axis in sorted(plane))
    return BallRoller(Circle(RADIUS, plane), 1000 / 60, drives, SetupCompliance(constant=1 / 15e3), **settings)


def runs_of(engagements: tuple[float, ...], readings: int = 700, repeats: int = 1) -> tuple[Run, ...]:
    angle = np.linspace(0, 2.06 * np.pi, readings)
    return tuple(
        Run(f"{1000 * e:g}um-{s}-{r}", {"angle": angle}, engagement=e, sense=s, repeat=r)
        for e in engagements
        for r in range(1, repeats + 1)
        for s in (1, -1)
    )


def simulated(
    topology: str = "wCAYfXZt",
    imperfection: Imperfection | None = None,
    seed: int = 0,
    runs: tuple[Run, ...] = runs_of((0.0, 0.06, 0.13, 0.2)),
    **settings: object,
) -> MachineTest:
    """A test whose set-up does not know the friction that its currents hold."""
    plane, truth = CASES[topology]
    setup = setup_of(plane, **settings)
    test = MachineTest(topology, machine_of(topology), setup, runs, Question(tuple(truth)))
    known = replace(setup, balances=tuple(BALANCES[axis] for axis in sorted(plane)))
    return replace(simulate(replace(test, setup=known), truth, imperfection, seed), setup=setup)


@pytest.mark.parametrize("topology", CASES)
def test_without_noise_the_joints_come_back(topology: str) -> None:
    """To what the low-pass of the positions and the second order of the exact simulation leave: 1 part in 10 000."""
    result = identify(simulated(topology))
    truth = CASES[topology][1]
    assert [p.name for p in result.parameters] == list(truth)
    for parameter in result.parameters:
        size = max(abs(value) for name, value in truth.items() if name[:2] == parameter.name[:2])
        assert_allclose(parameter.value, truth[parameter.name], atol=1e-3 * size, err_msg=parameter.name)


@pytest.mark.parametrize("topology", ["wCAYfXZt", "wFXYZBCt"])
def test_joints_come_back_within_their_intervals(topology: str) -> None:
    """Currents and encoders with noise -> friction, force, joint compliances: their 95 % intervals hold the truth."""
    truth = CASES[topology][1]
    hits = []
    for seed in range(8):
        result = identify(simulated(topology, NOISY, seed, runs_of((0.0, 0.06, 0.13, 0.2), 400, 2)))
        hits += [p.interval[0] <= truth[p.name] <= p.interval[1] for p in result.parameters]
    share, deviation = np.mean(hits), np.sqrt(0.95 * 0.05 / len(hits))
    assert share >= 0.95 - 3 * deviation


def test_the_drives_give_their_friction_back() -> None:
    test = simulated()
    for axis, balance in test.setup.torque_balances(test.machine, test.runs).items():
        true, ratio = BALANCES[axis], 10 / (2 * np.pi)
        expected = [true.inertia / ratio, true.viscous / ratio, true.coulomb, true.constant]
        assert_allclose(balance.values, expected, rtol=2e-3, atol=0.05)


def test_runs_of_one_engagement_are_one_level() -> None:
    observations = simulated(imperfection=NOISY).observations()
    assert len(observations) == 6
    assert len({run.force for run in observations}) == 3
    for run in observations:
        assert_allclose(np.linalg.norm(run.wrench, axis=1).mean(), run.force, rtol=0.01)


def test_the_force_is_that_which_machine_and_setup_hold_against() -> None:
    """Eq. 6.4 by hand, in the direction of X, where the path is off by E_Xt0 and E_XX1 R."""
    test = simulated(runs=runs_of((0.0, 0.06, 0.2)))
    truth = CASES["wCAYfXZt"][1]
    for run, engagement in zip(test.observations()[-1:], (0.2,), strict=True):
        at = np.abs(np.angle(np.exp(1j * run.pose))) < 0.02
        path = truth["E_Xt0"] + truth["E_XX1"] * (RADIUS - engagement)
        force = (engagement - path) / (truth["C_XXX"] + 1 / 15e3)
        assert_allclose(np.linalg.norm(run.wrench[at], axis=1), force, rtol=2e-3)
        assert_allclose(run.reading[at], engagement - force / 15e3, rtol=2e-3)


def test_without_an_unloaded_run_inertia_and_load_are_one() -> None:
    """At constant feed on a circle both go with the cosine: rank 3 of 4 (design), named with what would separate them."""
    test = simulated(runs=runs_of((0.06, 0.2)))
    with pytest.raises(RankError, match="inertia") as refused:
        test.observations()
    assert "load at 200 um" in str(refused.value)
    assert "known inertia" in str(refused.value)
    assert "known friction" not in str(refused.value)


def test_a_known_inertia_separates_it_from_the_load() -> None:
    inertias = tuple(KnownBalance(axis, inertia=BALANCES[axis].inertia) for axis in "XY")
    test = simulated(runs=runs_of((0.06, 0.2)))
    known = replace(test, setup=replace(test.setup, balances=inertias))
    found = {p.name: p.value for p in identify(known).parameters}
    assert_allclose(found["C_XXX"], CASES["wCAYfXZt"][1]["C_XXX"], rtol=0.02)


def test_with_loads_beside_the_friction_the_intervals_hold_too() -> None:
    """The load goes with the turn: as one number times the cosine it would push what is eccentric into the drive."""
    truth = CASES["wCAYfXZt"][1]
    inertias = tuple(KnownBalance(axis, inertia=BALANCES[axis].inertia) for axis in "XY")
    hits = []
    for seed in range(6):
        test = simulated(imperfection=NOISY, seed=seed, runs=runs_of((0.06, 0.13, 0.2), 400, 2))
        result = identify(replace(test, setup=replace(test.setup, balances=inertias)))
        hits += [p.interval[0] <= truth[p.name] <= p.interval[1] for p in result.parameters]
    assert np.mean(hits) >= 0.95 - 3 * np.sqrt(0.95 * 0.05 / len(hits))


def test_a_loaded_run_does_not_pass_for_an_unloaded_one() -> None:
    test = simulated()
    forgotten = tuple(replace(run, engagement=None) if run.name == "200um--1-1" else run for run in test.runs)
    with pytest.raises(InputError, match="'200um--1-1' claims no engagement, but the encoders show one of 200 um"):
        replace(test, runs=forgotten).observations()


def test_known_balances_observe_a_single_run() -> None:
    test = simulated()
    known = replace(test.setup, balances=(BALANCES["X"], BALANCES["Y"]))
    one, together = known.observe(test.machine, test.runs[-1]), known.observe_all(test.machine, test.runs)[-1]
    assert_allclose(one.reading, together.reading)
    partly = replace(test.setup, balances=(BALANCES["X"], KnownBalance("Y", inertia=4.0)))
    for setup, axes in ((test.setup, "X, Y"), (partly, "Y")):
        with pytest.raises(InputError, match=f"torque balance of axis {axes} is not known; observe all runs"):
            setup.observe(test.machine, test.runs[-1])


def test_uncertain_drives_and_setup_move_the_estimate_as_stated() -> None:
    """First order against solving again with another motor constant, another friction, another set-up compliance."""
    uncertain = tuple(replace(drive, relative_uncertainty=0.002) for drive in setup_of().drives)
    own = SetupCompliance(constant=1 / 15e3, standard_uncertainty=2e-7)
    test = simulated(imperfection=NOISY, runs=runs_of((0.0, 0.06, 0.13, 0.2), 400))
    test = replace(test, setup=replace(test.setup, drives=uncertain, setup=own))
    result, systems = identify(test), systems_of(test)
    effects = {effect.influence.label: effect for effect in effects_of(test, systems)}

    def moved(setup: BallRoller) -> np.ndarray:
        return np.array([p.value for p in identify(replace(test, setup=setup)).parameters]) - result.solution.values

    stiffer = tuple(
        replace(drive, torque_constant=drive.torque_constant * (1.002 if drive.axis == "X" else 1)) for drive in uncertain
    )
    changes = {
        "force per current of X": moved(replace(test.setup, drives=stiffer)),
        "set-up compliance": moved(replace(test.setup, setup=SetupCompliance(constant=1 / 15e3 + 2e-7))),
    }
    for label, change in changes.items():
        stated = uncertainty_budget(systems, result.solution, [effects[label]])
        for k, name in enumerate(result.solution.labels):
            line = next(line for line in stated.lines[k] if line.label == label)
            assert_allclose(line.contribution, abs(change[k]), rtol=0.05, atol=0.02 * np.abs(change).max(), err_msg=name)


def test_friction_of_one_direction_moves_the_estimate_as_stated() -> None:
    """Clockwise and counter-clockwise it cancels; with one direction it does not, and the budget says so, to first order."""
    test = simulated(imperfection=NOISY, runs=tuple(run for run in runs_of((0.0, 0.06, 0.13, 0.2), 400, 2) if run.sense > 0))
    lines = {line.label: line for line in identify(test).budget.lines[0]}
    balances = test.setup.torque_balances(test.machine, test.runs)
    truth = np.array([p.value for p in identify(test).parameters])
    total, small = 0.0, 0.1
    values, vectors = np.linalg.eigh(balances["X"].covariance)
    ratio = 10 / (2 * np.pi)
    for value, vector in zip(values, vectors.T, strict=True):
        changed = balances["X"].values + small * np.sqrt(max(value, 0.0)) * vector
        x = KnownBalance("X", changed[0] * ratio, changed[1] * ratio, changed[2], changed[3])
        y = KnownBalance("Y", balances["Y"].values[0] * ratio, balances["Y"].values[1] * ratio, *balances["Y"].values[2:])
        again = identify(replace(test, setup=replace(test.setup, balances=(x, y))))
        total += ((again.parameters[0].value - truth[0]) / small) ** 2
    assert_allclose(lines["friction and inertia of X"].contribution, np.sqrt(total), rtol=0.05)


def test_a_rig_adds_its_compliance_where_it_gives_way() -> None:
    plain = simulated(runs=runs_of((0.0, 0.06, 0.2)))
    setup = replace(plain.setup, rig=(Rig(3.77e-4, angle=0.0),), balances=(BALANCES["X"], BALANCES["Y"]))
    with_rig = simulate(replace(plain, setup=setup, runs=runs_of((0.0, 0.06, 0.2))), CASES["wCAYfXZt"][1])
    found = {p.name: p.value for p in identify(with_rig).parameters}
    truth = CASES["wCAYfXZt"][1]
    assert_allclose(found["C_XXX"], truth["C_XXX"] + 3.77e-4, rtol=1e-3)
    assert_allclose(found["C_YYY"], truth["C_YYY"], rtol=1e-2)


@pytest.mark.parametrize("harmonics", [0, 6])
def test_single_samples_and_few_harmonics_say_the_same(harmonics: int) -> None:
    found = {p.name: p.value for p in identify(simulated(harmonics=harmonics)).parameters}
    assert_allclose(found["C_XXX"], CASES["wCAYfXZt"][1]["C_XXX"], rtol=1e-3)


def test_lost_contact_is_named() -> None:
    test = simulated()
    backwards = tuple(replace(drive, sense=-1) for drive in test.setup.drives)
    with pytest.raises(
        UnsupportedError, match=r"lost contact near .* degrees .* look at the drives' constants and their sense"
    ):
        replace(test, setup=replace(test.setup, drives=backwards)).observations()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda columns: {k: v for k, v in columns.items() if k != "current_y"},
            "lacks current_y; a ball-roller test needs",
        ),
        (lambda columns: {**columns, "position_x": columns["position_x"] * 1000}, "put the roller up to .* check units"),
        (lambda columns: {**columns, "position_x": columns["position_x"] + 30}, "put the roller up to .* the centre"),
        (lambda columns: {k: v[:20] for k, v in columns.items()}, "is too short for a cut-off of 2 Hz|no segment|samples"),
        (lambda columns: {k: v[:100] for k, v in columns.items()}, "do not determine 12 harmonics of a turn"),
        (lambda columns: {**columns, "time": columns["time"][::-1]}, "times that increase"),
        (lambda columns: {**columns, "time": columns["time"] ** 1.1}, "is not uniform"),
        (lambda columns: {**columns, "current_x": np.where(np.arange(700) == 99, np.nan, columns["current_x"])}, "sample"),
    ],
)
def test_a_bad_record_gets_one_clear_error(change, message: str) -> None:
    test = simulated()
    bad = tuple(replace(run, columns=change(run.columns)) for run in test.runs)
    with pytest.raises((InputError, UnsupportedError), match=message):
        replace(test, runs=bad).observations()


def test_a_dead_current_is_named() -> None:
    test = simulated()
    dead = tuple(replace(run, columns={**run.columns, "current_y": np.zeros(700)}) for run in test.runs)
    with pytest.raises(RankError, match=r"axis Y cannot be identified, because its effort is 0 N mm in all .* is dead"):
        replace(test, runs=dead).observations()


def test_runs_without_any_engagement_are_no_test() -> None:
    test = simulated(runs=runs_of((0.0, 0.06)))
    with pytest.raises(UnsupportedError, match="no run has an engagement; give engagement_um"):
        replace(test, runs=test.runs[:2]).observations()


def test_an_engagement_smaller_than_the_path_is_off_opens() -> None:
    with pytest.raises(InputError, match="an engagement of 1 um opens"):
        simulated("wFXYZBCt", runs=runs_of((0.0, 0.001)))


def test_two_drives_of_one_axis_are_refused() -> None:
    drive = setup_of().drives[0]
    with pytest.raises(InputError, match=r"one \[\[setup.drives\]\] for each axis that presses, got \['X', 'X'\]"):
        BallRoller(Circle(RADIUS), 10.0, (drive, drive))
