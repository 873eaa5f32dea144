"""The ball bar diagnosis: runs in both directions that carry every fault at once, found, ranked, and corrected on paper."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import SelectionError
from elastogeo.estimate import solve_by_run
from elastogeo.identification import (
    Diagnosis,
    Identification,
    confounding_of,
    diagnose,
    identify,
    systems_of,
    what_if,
    with_question,
)
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import Circle, Imperfection, LoadedBallBar, MachineTest, Question, Run
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
READINGS, RADIUS = 500, 150.0
GEOMETRY = {"E_XX1": -1.3e-4, "E_YX2": 4.3e-7, "E_XY2": -7.3e-7, "E_YY1": -9.9e-5, "E_C(0Y)X": 2.6e-5}
SETUP = {"E_Xt0": 0.0039, "E_Yt0": -0.0006}
MOTION = {
    "B_XX": 0.004,
    "B_YX": 0.001,
    "B_XY": -0.0015,
    "B_YY": 0.0025,
    "S_XX": 0.006,
    "S_YY": -0.004,
    "P_XXc1": 0.0008,
    "P_XXs1": -0.0006,
    "P_YYc1": 0.0005,
    "P_YYs1": 0.0012,
    "T_X1": 4.0e-4,
}
ELASTIC = {"C_XXX": 6.19e-5, "C_YYY": 4.61e-5, "C_XYX": 8e-7, "C_CXY": -2.7e-8, "C_CYY": -1.7e-8, "C_CCY": 2e-9}
TRUTH = {**GEOMETRY, **SETUP, **MOTION, **ELASTIC}
IMPERFECTION = Imperfection(noise=1e-4, eccentricity=2e-4)


@pytest.fixture(scope="module")
def blank() -> MachineTest:
    """Three forces, twice in each direction; screws of 20 mm."""
    topology = parse_topology("wFYXt")
    machine = Machine("with screws", topology, tuple(Joint(axis, pitch=20.0) for axis in topology.axes))
    angle = np.arange(READINGS) * 2 * np.pi / READINGS + 0.002
    runs = tuple(
        Run(
            f"{force:g} N {'ccw' if sense > 0 else 'cw'} {repeat}",
            {"angle": angle if sense > 0 else angle[::-1] - 0.0013, "radial": np.zeros(READINGS)},
            force=force,
            sense=sense,
            repeat=repeat,
        )
        for force in (36.0, 364.0, 742.0)
        for sense in (1, -1)
        for repeat in (1, 2)
    )
    question = Question(("elasto-geometric-xy", "ball-bar-xy"))
    return MachineTest("diagnosis", machine, LoadedBallBar(Circle(RADIUS), 2000 / 60), runs, question)


@pytest.fixture(scope="module")
def result(blank: MachineTest) -> Identification:
    """Simulated by exact products of transforms."""
    return identify(simulate(blank, TRUTH, IMPERFECTION, seed=2))


@pytest.fixture(scope="module")
def diagnosis(result: Identification) -> Diagnosis:
    return diagnose(result)


def test_every_fault_is_told_apart(result: Identification) -> None:
    """All but the lag that both axes share."""
    assert result.by_run
    assert set(result.confounding.retained) == set(TRUTH)
    assert result.confounding.stands_for("T_X1") == pytest.approx({"T_X1": 1.0, "T_Y1": -1.0})
    assert result.confounding.null == ()


@pytest.mark.parametrize("name", TRUTH)
def test_every_fault_is_found_within_its_interval(name: str, result: Identification) -> None:
    """At 99.9 % of all 24 together; and none is a tenth of the greatest part of the trace off."""
    (parameter,) = (p for p in result.parameters if p.name == name)
    k = result.solution.labels.index(name)
    low, high = result.solution.interval(1 - 0.001 / len(TRUTH))[k]
    assert low <= TRUTH[name] <= high
    per_unit = abs(parameter.peak_to_peak / parameter.value)
    assert abs(parameter.value - TRUTH[name]) * per_unit < 6e-4


def test_the_intervals_of_all_faults_cover(blank: MachineTest) -> None:
    """Over 25 simulated tests: 95 % of the intervals on the average, and of each parameter more than chance allows."""
    inside = np.zeros(len(TRUTH))
    draws = 25
    retained = confounding_of(blank, systems_of(blank)).retained
    truth = np.array([TRUTH[name] for name in retained])
    for seed in range(draws):
        systems = systems_of(simulate(blank, TRUTH, IMPERFECTION, seed=100 + seed, exact=False))
        low, high = solve_by_run([run.factor for run in systems.runs], retained).interval().T
        inside += (low <= truth) & (truth <= high)
    rates = inside / draws
    print(f"all faults: {rates.min():.2f} to {rates.max():.2f}, mean {rates.mean():.4f}")
    assert 0.92 < rates.mean() < 0.985
    assert rates.min() >= 0.72  # fewer than 18 of 25 is rarer than 1 in 10 000 at 95 %


def test_the_ranking_is_by_size(diagnosis: Diagnosis) -> None:
    machine = [fault for fault in diagnosis.faults if fault.axis]
    setup = [fault for fault in diagnosis.faults if not fault.axis]
    sizes = [abs(fault.distortion) for fault in machine]
    assert sizes == sorted(sizes, reverse=True)
    assert diagnosis.faults == (*machine, *setup)
    assert {fault.names for fault in setup} == {("E_Xt0",), ("E_Yt0",)}
    assert sum(fault.share for fault in machine) == pytest.approx(1.0)
    assert all(fault.share == 0 for fault in setup)
    assert [fault.names[0] for fault in machine[:4]] == ["C_XXX", "C_YYY", "E_XX1", "E_YY1"]


def test_faults_are_signed_and_in_their_unit(diagnosis: Diagnosis) -> None:
    """Distortions by hand: a backlash of 4 um along X makes the trace jump by 4 um, a gain of -1.3e-4 by -19.5 um."""
    by_name = {fault.names[0]: fault for fault in diagnosis.faults}
    expected = {
        "B_XX": (0.004, "mm", 0.004),
        "E_XX1": (-1.3e-4, "mm/mm", -1.3e-4 * RADIUS),
        "E_C(0Y)X": (2.6e-5, "rad", 2.6e-5 * RADIUS),
        "T_X1": (4.0e-4, "s", 4.0e-4 * 2000 / 60),
        "C_XXX": (6.19e-5, "mm/N", 6.19e-5 * 742),
    }
    for name, (value, unit, distortion) in expected.items():
        fault = by_name[name]
        assert fault.value == pytest.approx(value, rel=0.02)
        assert fault.unit == unit
        assert fault.distortion == pytest.approx(distortion, rel=0.03)
        assert np.sign(fault.distortion) == np.sign(value)
        assert fault.significant
        assert 0 < fault.distortion_estimate.standard_uncertainty < 0.1 * abs(fault.distortion)
    assert by_name["T_X1"].also == ("T_Y1",)
    assert by_name["B_XX"].axis == "X"
    assert "backlash" in by_name["B_XX"].meaning


def test_cosine_and_sine_of_a_cyclic_error_are_one_fault(diagnosis: Diagnosis) -> None:
    pairs = [fault for fault in diagnosis.faults if len(fault.names) == 2]
    assert {fault.names for fault in pairs} == {("P_XXc1", "P_XXs1"), ("P_YYc1", "P_YYs1")}
    x = next(fault for fault in pairs if fault.axis == "X")
    assert x.value == pytest.approx(np.hypot(0.0008, 0.0006), abs=5 * x.estimate.standard_uncertainty)
    assert x.distortion == pytest.approx(0.002, rel=0.02)
    assert "cosine" not in x.meaning


def test_what_is_not_there_is_not_significant(blank: MachineTest) -> None:
    """With the faults of motion absent, at most what 5 % of false alarms allow of them is called significant."""
    alarms = 0
    for seed in range(8):
        calm = simulate(with_question(blank, ["ball-bar-xy", "C_XXX", "C_YYY"]), {**GEOMETRY, **SETUP}, IMPERFECTION, seed)
        faults = diagnose(identify(calm)).faults
        alarms += sum(fault.significant for fault in faults if fault.names[0][0] in "BSPT")
    assert alarms <= 10  # of 72, 3.6 expected; more is rarer than 1 in 1000


def test_without_a_second_direction_the_mismatch_is_not_named(blank: MachineTest) -> None:
    ccw = replace(blank, runs=tuple(run for run in blank.runs if run.sense > 0))
    found = diagnose(identify(simulate(ccw, TRUTH, IMPERFECTION, seed=3)))
    (squareness,) = (fault for fault in found.faults if "E_C(0Y)X" in fault.names)
    assert set(squareness.also) == {"T_X1", "T_Y1"}


def test_what_a_test_cannot_see_is_said(blank: MachineTest) -> None:
    asked = with_question(blank, ["ball-bar-xy", "E_ZX1", "B_CX"])
    found = diagnose(identify(simulate(asked, {**GEOMETRY, **SETUP, **MOTION}, IMPERFECTION)))
    assert set(found.untold) == {"E_ZX1", "B_CX"}


CORRECTIONS = {
    "backlash": (["B_XX", "B_YY"], ["B_XX", "B_YY"]),
    "every fault of motion": (["[BSPT]_*"], list(MOTION)),
    "the gains": (["E_XX1", "E_YY1"], ["E_XX1", "E_YY1"]),
    "all compliance": (["C_*"], list(ELASTIC)),
}


@pytest.mark.parametrize("correction", CORRECTIONS)
def test_what_if_is_the_test_without_the_fault(correction: str, blank: MachineTest) -> None:
    """The corrected traces, and their circular deviations, are those of a simulation in which the fault never was."""
    patterns, names = CORRECTIONS[correction]
    quiet = Imperfection(noise=1e-5)
    result = identify(simulate(blank, TRUTH, quiet, seed=4, exact=False))
    healthy = simulate(blank, {n: 0.0 if n in names else v for n, v in TRUTH.items()}, quiet, seed=4, exact=False)
    corrected = what_if(result, patterns)
    assert set(corrected.corrected) == set(names)
    for run, trace in zip(healthy.runs, corrected.traces, strict=True):
        assert_allclose(trace.measured, run.columns["radial"], rtol=0, atol=1e-5)
    expected = diagnose(identify(healthy)).circularity
    before = diagnose(result).circularity
    assert set(corrected.after) == set(expected) == {36.0, 364.0, 742.0}
    for level, circularity in expected.items():
        after = corrected.after[level]
        for figure in ("g_cw", "g_ccw", "g_bidirectional"):
            assert getattr(after, figure) == pytest.approx(getattr(circularity, figure), abs=4e-5), figure
            assert getattr(corrected.before[level], figure) == getattr(before[level], figure)
    for run in healthy.runs:
        was, would_be = corrected.peak_to_peak[run.name]
        assert would_be == pytest.approx(np.ptp(run.columns["radial"]), abs=4e-5)
        assert was == pytest.approx(np.ptp(next(t.measured for t in result.traces if t.run == run.name)))


def test_correcting_what_is_not_there_is_refused(result: Identification) -> None:
    with pytest.raises(SelectionError, match="'B_ZZ' is none of the identified parameters: C_XXX, "):
        what_if(result, ["B_XX", "B_ZZ"])


def test_correcting_everything_leaves_the_noise(result: Identification) -> None:
    corrected = what_if(result, ["*"])
    for trace in corrected.traces:
        assert_allclose(trace.predicted, 0.0, atol=1e-12)
        assert np.ptp(trace.measured) < 2e-3
