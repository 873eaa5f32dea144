"""The values of ISO 230-2: real readings to their digits, the formulas by hand, what they are worth, the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError
from elastogeo.formats import read_test
from elastogeo.identification import PositioningResults, by_target, evaluate_positioning, standard_values
from elastogeo.identification.positioning.uncertainty import with_uncertainty
from elastogeo.identification.positioning.verdict import standard_checks
from elastogeo.machine import Array, Machine, parse_topology
from elastogeo.observe import Imperfection, KnownInfluence, MachineTest, Positioning, Question, Run
from elastogeo.report import sentence_of
from elastogeo.sources import simulate
from tests.conftest import SHARED_DATA

EXAMPLE = Path(__file__).parents[2] / "examples" / "iso230-2-positioning"
TARGETS = (-190.0, -120.0, -35.0, 42.0, 117.0, 180.0)
PUBLISHED = """
x 33.58 -25.37 93.65  98.03 90.65 122.85 19.36 28.31 55.16 111.49 108.42 135.26
y 20.02 -12.77 84.26  80.03 88.50 100.05 38.08 32.54 46.87 104.00 111.39 125.71
z  2.36  -1.61 33.36  33.81 32.91  35.28  3.38  6.41  6.41  35.07  36.85  36.85
"""
"""Of the README beside the data, computed independently: B, mean B, M, E+, E-, E, R+, R-, R, A+, A-, A in um."""


@pytest.mark.parametrize("line", PUBLISHED.split("\n")[1:-1], ids=lambda line: line[0])
def test_real_readings_give_the_published_values_to_their_digits(line: str) -> None:
    if not (SHARED_DATA / "iso230-2-positioning").is_dir():
        pytest.skip(
            f"the readings are not at {SHARED_DATA}; examples/iso230-2-positioning/README.md says where they come from"
        )
    axis, *written = line.split()
    values = evaluate_positioning(read_test(EXAMPLE / f"{axis}.toml")).values
    assert [f"{1000 * value.value:.2f}" for value in values.values()] == written


def simulated(
    values: Mapping[str, float],
    setup: Positioning | None = None,
    topology: str = "wFXYZt",
    noise: float = 0.0,
    seed: int = 0,
    influences: tuple[KnownInfluence, ...] = (),
) -> MachineTest:
    setup = setup or Positioning("X", targets=TARGETS)
    machine = Machine(topology, parse_topology(topology))
    blank = MachineTest("test", machine, setup, (Run("run", {}),), Question(), influences=influences)
    return simulate(blank, values, Imperfection(noise=noise, angle_noise=noise), seed, exact=False)


def of_readings(target: Array, sense: Array, deviation: Array, setup: Positioning | None = None) -> PositioningResults:
    run = Run("run", {"target": target, "direction": sense, "deviation": deviation})
    return evaluate_positioning(
        MachineTest("test", Machine("m", parse_topology("wFXYZt")), setup or Positioning("X"), (run,))
    )


def kept(found: PositioningResults, name: str) -> bool | None:
    return {check.name: check.passed for check in found.verdict}[name]


def said(found: PositioningResults, name: str) -> str:
    return next(sentence_of(check) for check in found.verdict if check.name == name)


BY_HAND = {
    0.0: ([1.0, 3.0], [5.0, 7.0]),
    10.0: ([4.0, 4.0], [10.0, 16.0]),
}
"""Deviations by target in + and in -: means 2 and 6, 4 and 13; standard deviations sqrt 2, sqrt 2, 0, sqrt 18."""


def test_the_formulas_by_hand() -> None:
    rows = [(t, side, x) for t, sides in BY_HAND.items() for side, xs in zip((1.0, -1.0), sides, strict=True) for x in xs]
    found = by_target(*np.array(rows).T)
    root = np.sqrt(2.0)
    assert_allclose(found.mean, [[2, 6], [4, 13]])
    assert_allclose(found.deviation, [[root, root], [0, 3 * root]])
    assert_allclose(found.reversal, [-4, -9])
    assert_allclose(found.middle, [4, 8.5])
    assert_allclose(found.repeatability, [4 * root + 4, 6 * root + 9])
    values = standard_values(found)
    expected = {
        "B": 9.0,
        "mean B": -6.5,
        "M": 4.5,
        "E+": 2.0,
        "E-": 7.0,
        "E": 11.0,
        "R+": 4 * root,
        "R-": 12 * root,
        "R": 6 * root + 9,
        "A+": (2 + 2 * root) - (2 - 2 * root),
        "A-": (13 + 6 * root) - (6 - 2 * root),
        "A": (13 + 6 * root) - (2 - 2 * root),
    }
    assert list(values) == list(expected)
    assert_allclose(list(values.values()), list(expected.values()))


def test_four_sigma_of_one_direction_may_be_the_greater_repeatability() -> None:
    """2 s + 2 s + B is 5.7 s and a little; 4 s of one direction is not: R is the greatest of the three."""
    target, sense = np.zeros(4), np.array([1.0, 1.0, -1.0, -1.0])
    found = by_target(target, sense, np.array([-1.0, 1.0, 0.0, 0.0]))
    assert_allclose(found.repeatability, [4 * np.sqrt(2)])


def test_one_direction_gives_no_value_of_both_and_says_so() -> None:
    target = np.tile(TARGETS, 3)
    random = np.random.default_rng(1)
    found = of_readings(target, np.ones(18), 1e-3 * random.standard_normal(18))
    assert list(found.values) == ["E+", "R+", "A+"]
    assert kept(found, "approached from both sides") is False
    assert "no reversal, and no value of both directions" in said(found, "approached from both sides")


def test_one_approach_gives_no_scatter_and_no_uncertainty() -> None:
    """As the standard has it for long axes: one approach in each direction."""
    found = evaluate_positioning(simulated({"E_XX1": 1e-5, "B_XX": 0.002}, Positioning("X", targets=TARGETS, cycles=1)))
    assert list(found.values) == ["B", "mean B", "M", "E+", "E-", "E"]
    assert found.values["E"].value == pytest.approx(370e-5 + 0.002)
    assert all(value.estimate is None for value in found.values.values())
    assert kept(found, "cycles enough") is False
    assert "no repeatability and no accuracy" in said(found, "cycles enough")


def test_missing_readings_count_where_they_are() -> None:
    test = simulated({"B_XX": 0.004}, noise=1e-4)
    some = [k for k in range(60) if k not in (3, 20, 21, 59)]
    fewer = {name: values[some] for name, values in test.runs[0].columns.items()}
    found = evaluate_positioning(replace(test, runs=(replace(test.runs[0], columns=fewer),)))
    assert found.targets.count.sum() == 56
    assert found.values["B"].value == pytest.approx(0.004, abs=3e-4)
    assert kept(found, "readings complete") is False
    assert "4 to 5 readings" in said(found, "readings complete")


@pytest.mark.parametrize(
    ("setup", "topology"),
    [
        (Positioning("X", direction=(-1.0, 0.0, 0.0), targets=TARGETS), "wFXYZt"),
        (Positioning("X", targets=TARGETS), "wXFYZt"),
        (Positioning("X", direction=(-1.0, 0.0, 0.0), targets=TARGETS), "wXFYZt"),
    ],
    ids=["sensor counts the other way", "axis carries the workpiece", "both"],
)
def test_values_count_along_the_command_whatever_carries_what(setup: Positioning, topology: str) -> None:
    carriage = -1.0 if topology.startswith("wX") else 1.0
    plain = evaluate_positioning(simulated({"E_XX1": 1e-5, "E_XX2": 3e-7, "B_XX": 0.004}))
    turned = evaluate_positioning(
        simulated({"E_XX1": carriage * 1e-5, "E_XX2": carriage * 3e-7, "B_XX": 0.004}, setup, topology)
    )
    assert_allclose(turned.targets.mean, plain.targets.mean, atol=1e-14)
    assert {name: value.value for name, value in turned.values.items()} == pytest.approx(
        {name: value.value for name, value in plain.values.items()}
    )
    assert plain.values["mean B"].value == pytest.approx(-0.004)  # falls short: it has gone less far coming in +


def test_the_zero_of_the_sensor_is_in_no_value() -> None:
    test = simulated({"E_XX1": 1e-5, "B_XX": 0.004}, noise=1e-4)
    columns = {**test.runs[0].columns, "position": test.runs[0].columns["position"] + 123.4}
    moved = evaluate_positioning(replace(test, runs=(replace(test.runs[0], columns=columns),)))
    plain = evaluate_positioning(test)
    for name, value in plain.values.items():
        assert moved.values[name].value == pytest.approx(value.value, abs=1e-12)


SCALE = KnownInfluence("sensor-scale", "laser", relative=2e-6)


def test_a_relative_influence_counts_for_the_way_between_the_farthest_means() -> None:
    """E goes from the first target to the last: 370 mm of 2e-6; a reversal has no way in it."""
    found = evaluate_positioning(simulated({"E_XX1": 1e-4, "B_XX": 0.001}, noise=1e-5, influences=(SCALE,)))
    assert found.values["E"].measurement == pytest.approx(370 * 2e-6, rel=1e-3)
    assert found.values["E+"].measurement == pytest.approx(370 * 2e-6, rel=1e-3)
    assert found.values["B"].measurement == pytest.approx(0.0, abs=1e-8)
    part = found.values["E"].contributions[0]
    assert (part.label, part.degrees_of_freedom) == ("laser", np.inf)


def test_influences_of_one_name_count_together_and_distributions_count() -> None:
    two = (SCALE, replace(SCALE, distribution="rectangular"))
    found = evaluate_positioning(simulated({"E_XX1": 1e-4}, noise=1e-5, influences=two))
    labels = [part.label for part in found.values["E"].contributions]
    assert labels == ["laser", "scatter of the cycles"]
    assert found.values["E"].measurement == pytest.approx(370 * 2e-6 * np.sqrt(1 + 1 / 3), rel=1e-3)


def test_the_scatter_of_cycles_is_that_of_two_means() -> None:
    """E- goes between two means of five readings each: sqrt(s1^2/5 + s2^2/5), eight degrees of freedom if they are alike."""
    found = evaluate_positioning(simulated({"E_XX1": 1e-3}, noise=1e-3, seed=2))
    value, targets = found.values["E-"], found.targets
    ends = targets.deviation[[0, -1], 1]
    assert value.estimate is not None
    assert value.estimate.standard_uncertainty == pytest.approx(np.sqrt(np.sum(ends**2) / 5), rel=1e-6)
    freedom = 4 * np.sum(ends**2) ** 2 / np.sum(ends**4)
    assert value.estimate.degrees_of_freedom == pytest.approx(freedom, rel=1e-6)


def test_the_scatter_of_a_repeatability_is_that_of_a_standard_deviation() -> None:
    found = evaluate_positioning(simulated({"E_XX1": 1e-3}, noise=1e-3, seed=2))
    value = found.values["R+"]
    assert value.estimate is not None
    assert value.estimate.standard_uncertainty == pytest.approx(value.value / np.sqrt(8), rel=1e-6)
    assert value.estimate.degrees_of_freedom == pytest.approx(4.0)


def test_the_interval_of_a_systematic_deviation_holds_the_truth() -> None:
    """Ends that stand out, so that the farthest targets are known: 95 % to within what 150 draws say (99.9 %)."""
    target, sense = np.tile([0.0, 60.0, 130.0], 5), np.ones(15)
    held = 0
    for seed in range(150):
        reading = 1e-3 * target + 1e-3 * np.random.default_rng(seed).standard_normal(15)
        estimate = with_uncertainty(target, sense, reading, ())["E+"].estimate
        assert estimate is not None
        low, high = estimate.interval()
        held += low <= 0.130 <= high
    assert 131 <= held <= 150


def test_straightness_leaves_its_straight_line_out() -> None:
    """A parabola of 2e-7 over +-185 mm less its line: its range is that of the parabola, and its tilt is not in it."""
    across = Positioning("X", direction=(0.0, 1.0, 0.0), targets=(-185.0, -100.0, 0.0, 100.0, 185.0))
    found = evaluate_positioning(simulated({"E_YX1": 1e-4, "E_YX2": 2e-7}, across))
    assert not found.along
    assert found.values["E"].value == pytest.approx(2e-7 * 185**2, rel=1e-9)


def test_a_rotary_axis_and_an_angular_sensor_have_values_too() -> None:
    degrees = np.deg2rad([0.0, 40.0, 95.0, 130.0, 190.0, 240.0, 300.0, 350.0])
    table = evaluate_positioning(simulated({"B_CC": 2e-5}, Positioning("C", targets=tuple(degrees)), "wCFXYZt"))
    assert table.angular
    assert table.rotary
    assert table.values["B"].value == pytest.approx(2e-5)
    assert kept(table, "targets enough") is True
    pitch = evaluate_positioning(simulated({"E_BX1": 1e-7}, Positioning("X", about=(0.0, 1.0, 0.0), targets=TARGETS)))
    assert pitch.values["E"].value == pytest.approx(370e-7)
    assert not pitch.levers


def test_the_lever_of_the_sensor_is_told() -> None:
    below = Positioning("X", targets=TARGETS, tool=(0.0, 25.0, -80.0))
    found = evaluate_positioning(simulated({"E_XX1": 1e-5}, below))
    assert found.levers == pytest.approx({"E_AX": 0.0, "E_BX": -80.0, "E_CX": -25.0})


def test_evenly_spaced_targets_are_seen() -> None:
    even = Positioning("X", targets=(0.0, 50.0, 100.0, 150.0, 200.0))
    assert kept(evaluate_positioning(simulated({"E_XX1": 1e-5}, even)), "targets unevenly spaced") is False
    assert kept(evaluate_positioning(simulated({"E_XX1": 1e-5})), "targets unevenly spaced") is True


@pytest.mark.parametrize(
    ("span", "rotary", "wanted"),
    [
        (40.0, False, 5),
        (1000.0, False, 5),
        (1900.0, False, 10),
        (3000.0, False, 13),
        (1.5, True, 3),
        (3.0, True, 5),
        (6.2, True, 8),
    ],
)
def test_how_many_targets_the_standard_asks_for(span: float, rotary: bool, wanted: int) -> None:
    target = np.linspace(0, span, 4)
    place, none = np.arange(4), np.zeros(4)
    checks = standard_checks(by_target(target, np.ones(4), none), np.ones(4), none, np.ones(4, int), place, rotary, rotary)
    facts = next(check.facts for check in checks if check.name == "targets enough")
    assert facts["wanted"] == wanted


def wandering(step: float, draws: int) -> int:
    """How often of so many draws a drift of `step` a cycle, in standard deviations of a cycle's zero, is found."""
    found = 0
    place, sense = np.tile(np.arange(6), 5), np.ones(30)
    cycle = np.repeat(np.arange(1, 6), 6)
    for seed in range(draws):
        random = np.random.default_rng(seed)
        zero = random.standard_normal(5) + step * np.arange(5)
        reading = zero[cycle - 1] + 0.2 * random.standard_normal(30)
        checks = standard_checks(by_target(place * 1.0, sense, reading), sense, reading, cycle, place, False, False)
        found += {check.name: check.passed for check in checks}["free of drift"] is False
    return found


def test_cycles_that_wander_to_and_fro_are_no_drift_and_those_that_go_one_way_are() -> None:
    """One alarm in a hundred at most (99.9 % of 400 draws); 8 standard deviations of a cycle in each cycle are found."""
    assert wandering(0.0, 400) <= 12
    assert wandering(8.0, 40) >= 38


def test_a_period_that_no_polynomial_follows_is_told() -> None:
    targets = tuple(np.linspace(-180, 180, 13) + np.random.default_rng(4).uniform(-8, 8, 13))
    test = simulated({"E_XX1": 1e-5, "E_XX7": 3e-18}, Positioning("X", targets=targets), noise=2e-4)
    found = evaluate_positioning(test)
    assert kept(found, "error motion followed") is False
    assert "For a correction take the table by target" in said(found, "error motion followed")
    smooth = [
        kept(evaluate_positioning(simulated({"E_XX2": 1e-8}, noise=2e-4, seed=seed)), "error motion followed")
        for seed in range(20)
    ]
    assert smooth.count(False) <= 3  # of 1 %, at 99.9 %


def test_another_instrument_is_refused() -> None:
    other = read_test(EXAMPLE.parent / "static-rig")
    with pytest.raises(InputError, match="made with static-force; values of ISO 230-2 take the instrument positioning"):
        evaluate_positioning(other)
