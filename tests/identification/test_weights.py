"""A known mass on the table, in one test and not in the other: the joints that sag are identified."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.identification import confounding_of, identify, systems_of
from elastogeo.machine import Joint, Machine, Workpiece, parse_topology
from elastogeo.observe import BallBar, Circle, Imperfection, KnownInfluence, LoadedBallBar, MachineTest, Question, Run
from elastogeo.sources import exact_response, linear_response, parameter_values, simulate

KG = 1e-3
ANGLE = np.linspace(0.05, 6.3, 120)


def machine(topology: str) -> Machine:
    random, parsed = np.random.default_rng(5), parse_topology(topology)
    joints = tuple(
        Joint(axis, tuple(map(float, random.uniform(-150, 150, 3))), compliant=axis != "S") for axis in parsed.axes
    )
    return Machine(topology, parsed, joints, tool=(0.0, 0.0, -120.0))


def bars(one: Machine, circle: Circle, workpiece: Workpiece | None, asked: tuple[str, ...], runs: int = 3) -> MachineTest:
    """Runs in both directions of an ordinary ball bar."""
    made = tuple(
        Run(f"{k}", {"angle": ANGLE[::sense], "radial": np.zeros(len(ANGLE))}, sense=sense)
        for k, sense in enumerate([1, -1] * runs)
    )
    return MachineTest("bars", one, BallBar(circle, 1000 / 60), made, Question(asked), workpiece=workpiece)


TILTING = Circle(150.0, "XY", {"Z": 40.0}, in_workpiece=True, rotary_turn={"A": 0.3, "C": 0.6})
"""On a table that only stands, a sag is an offset of the ball: the axes that carry the weight are to move."""

CASES = {
    "wXYFZt": ("C_BBY", {"C_BBY": 2e-10, "E_B(0Y)X": 3e-5, "E_XX1": 2e-5, "E_ZZ1": -3e-5}, Circle(150.0, "ZX")),
    "wCAFYXZSt": ("C_AAA", {"C_AAA": 3e-10, "E_C(0Y)X": 2e-5, "E_XX1": 1e-5, "E_YY1": -2e-5}, TILTING),
}
HEAVY = Workpiece(400 * KG, (0.0, 250.0, 60.0))


@pytest.mark.parametrize("topology", CASES)
def test_a_mass_that_is_moved_between_two_tests_identifies_the_sag(topology: str) -> None:
    sagging, truth, circle = CASES[topology]
    one = machine(topology)
    asked = tuple(truth)
    tests = {
        "empty": simulate(bars(one, circle, None, asked), truth, Imperfection(noise=2e-4), seed=1),
        "front": simulate(bars(one, circle, HEAVY, asked), truth, Imperfection(noise=2e-4), seed=2),
        "back": simulate(
            bars(one, circle, replace(HEAVY, centre=(0.0, -250.0, 60.0)), asked), truth, Imperfection(noise=2e-4), seed=3
        ),
    }
    found = identify(tests)
    low, high = found[sagging].interval
    assert low < truth[sagging] < high
    assert 0 < high - low < 0.4 * truth[sagging]


def test_without_a_weight_no_compliance_shows() -> None:
    test = bars(machine("wXYFZt"), Circle(150.0, "ZX"), None, ("C_BBY", "E_XX1", "E_ZZ1"))
    assert "C_BBY" in confounding_of(test, systems_of(test)).null


def test_simulation_to_first_order_and_exact_agree_on_the_sag() -> None:
    one = machine("wCAFYXZSt")
    (seen, *_) = bars(one, TILTING, HEAVY, ("C_AAA",)).observations()
    values = parameter_values(one, {"C_AAA": 1e-11})
    assert_allclose(linear_response(values, one, seen), exact_response(values, one, seen), atol=1e-7)
    assert np.ptp(linear_response(values, one, seen)) > 1e-4


def test_a_force_scale_does_not_stretch_the_weights() -> None:
    """The budget's sensitivity against the test solved again with all forces 1 % greater, the weight as it was."""
    one = machine("wXYFZt")
    runs = tuple(
        Run(f"{force:g}", {"angle": ANGLE, "radial": np.zeros(len(ANGLE))}, force=force)
        for force in (100.0, 300.0, 500.0, 700.0)
    )
    asked = ("C_XXX", "C_YYY", "C_BBY", "E_XX1", "E_ZZ1")
    setup = LoadedBallBar(Circle(150.0, "ZX"), 1000 / 60)
    stated = (KnownInfluence("force-scale", "gauge", relative=0.01),)
    test = MachineTest("both", one, setup, runs, Question(asked), workpiece=HEAVY, influences=stated)
    test = simulate(test, {"C_XXX": 5e-5, "C_BBY": 2e-10, "E_XX1": 2e-5}, Imperfection(noise=1e-5), exact=False, seed=4)
    plain = identify(test)
    more = identify(replace(test, runs=tuple(replace(run, force=1.01 * (run.force or 0.0)) for run in test.runs)))
    for name, lines in zip(plain.budget.labels, plain.budget.lines, strict=True):
        contribution = next(line.contribution for line in lines if line.label == "gauge")
        moved = abs(more[name].value - plain[name].value)
        assert contribution == pytest.approx(moved, rel=0.03, abs=1e-3 * abs(plain[name].value)), name
