"""The verdict, the reference level and local estimates: what triggers, and what is refused."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from elastogeo.errors import InputError, RankError, SelectionError, UnsupportedError
from elastogeo.estimate import solve
from elastogeo.identification import (
    CONDITION_LIMIT,
    Check,
    confounding_of,
    identify,
    local_estimates,
    merged,
    moving_axes,
    noise_of,
    systems_of,
)
from elastogeo.machine import Array
from elastogeo.observe import Circle, Imperfection, MachineTest, Question, Residue
from elastogeo.report import sentence_of
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
TRUTH = {"C_XXX": 6e-5, "C_YYY": 5e-5, "C_CCY": 2e-9}
RESOLUTION = 0.00024


def verdict_of(test: MachineTest) -> dict[str, Check]:
    return {check.name: check for check in identify(test).verdict}


def test_a_sound_test_passes_every_check(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 700.0], parameters=["C_XXX", "C_YYY", "C_CCY"])
    verdict = verdict_of(replace(simulate(test, TRUTH, Imperfection(noise=1e-5), exact=False), resolution=RESOLUTION))
    for name in ("identifiable", "forces distinct", "conditioned", "residuals without structure", "above resolution"):
        assert verdict[name].passed, sentence_of(verdict[name])


def test_confounded_parameters_are_not_called_identifiable(make_test: MakeTest) -> None:
    check = verdict_of(simulate(make_test("wFYXt", [100.0]), TRUTH, exact=False))["identifiable"]
    assert not check.passed
    assert sentence_of(check).startswith("Of 18 parameters the test determines 6 combinations: 5 change no reading")


def test_one_force_level_is_called_so(make_test: MakeTest) -> None:
    check = verdict_of(simulate(make_test("wFYXt", [100.0]), TRUTH, exact=False))["forces distinct"]
    assert not check.passed
    assert "All runs are at 100 N" in sentence_of(check)


def test_close_force_levels_are_ill_conditioned(make_test: MakeTest) -> None:
    asked = ["elasto-geometric-xy"]
    far, near = (
        verdict_of(simulate(make_test("wFYXt", forces, parameters=asked), TRUTH, exact=False))["conditioned"]
        for forces in ([36.0, 742.0], [616.0, 742.0])
    )
    assert far.passed
    assert not near.passed
    assert f"above the limit of {CONDITION_LIMIT:g}; add force levels further apart" in sentence_of(near)


def test_structure_in_the_residuals_is_named_with_its_order_and_size(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 700.0], readings=120)
    noise = Imperfection(noise=1e-5, residue=(Residue(5, 3e-4, phase=0.3),))
    check = verdict_of(simulate(test, TRUTH, noise, exact=False))["residuals without structure"]
    assert not check.passed
    assert re.match(r"A harmonic of order 5, amplitude 0\.30?\d? µm, is left in run 100 N, 1", sentence_of(check))
    assert "2 of 2 runs" in sentence_of(check)


def test_a_parameter_below_the_resolution_is_named(make_test: MakeTest) -> None:
    test = simulate(make_test("wFYXt", [100.0, 700.0], readings=72), TRUTH | {"C_CCY": 2e-11}, exact=False)
    check = verdict_of(replace(test, resolution=RESOLUTION))["above resolution"]
    assert not check.passed
    assert "C_CCY (0.079 µm)" in sentence_of(check)
    assert "does not state the resolution" in sentence_of(verdict_of(test)["above resolution"])


def test_the_users_preference_is_retained_instead(make_test: MakeTest) -> None:
    test = simulate(make_test("wFYXt", [100.0], prefer=["C_XXY", "C_YCY"]), TRUTH, exact=False)
    result = identify(test)
    assert {"C_XXY", "C_YCY"} <= set(result.confounding.retained)
    assert {"C_XXX", "C_CYY"}.isdisjoint(result.confounding.retained)
    (parameter,) = (p for p in result.parameters if p.name == "C_XXY")
    assert parameter.value == pytest.approx(TRUTH["C_XXX"])
    assert parameter.stands_for == pytest.approx({"C_XXY": 1.0, "C_XXX": 1.0})


def test_axes_that_stand_still_are_retained_last(make_test: MakeTest) -> None:
    test = make_test("wCAFYXZSt", [100.0], parameters=["C_*"], circle=Circle(150.0, "YZ"))
    observations = test.observations()
    assert moving_axes(test.machine, [np.ptp(run.commands, axis=0) for run in observations]) == {"Y", "Z"}
    found = confounding_of(test, systems_of(test))
    assert {"C_YYY", "C_ZZZ"} <= set(found.retained)
    assert {name[-1] for name in found.retained} <= {"Y", "Z"}


@pytest.mark.parametrize("asked", ["C_XXQ", "D_*"])
def test_a_question_that_selects_nothing_is_refused(asked: str, make_test: MakeTest) -> None:
    with pytest.raises(SelectionError, match="selects no error source of wFYXt"):
        identify(make_test("wFYXt", parameters=[asked]))


def test_a_question_that_moves_no_reading_is_refused(make_test: MakeTest) -> None:
    with pytest.raises(RankError, match="none of the parameters C_ZZX, C_CCX changes any reading"):
        identify(make_test("wFYXt", parameters=["C_ZZX", "C_CCX"]))


def test_too_few_readings_are_refused(make_test: MakeTest) -> None:
    with pytest.raises(UnsupportedError, match="3 readings cannot give"):
        identify(make_test("wFYXt", readings=3))


def test_a_reference_that_was_not_measured_is_refused(make_test: MakeTest) -> None:
    with pytest.raises(UnsupportedError, match="the reference level 50 N cannot be subtracted: the runs are at 100, 200 N"):
        identify(make_test("wFYXt", [100.0, 200.0], reference=50.0))
    with pytest.raises(UnsupportedError, match="the reference level 100 N cannot be subtracted"):
        identify(make_test("wFYXt", [100.0], repeats=2, reference=100.0))


def test_a_reference_at_other_poses_is_refused(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [36.0, 100.0], reference=36.0)
    shifted = replace(test.runs[1], columns={**test.runs[1].columns, "angle": test.runs[1].columns["angle"] + 1e-3})
    with pytest.raises(InputError, match="run '100 N, 1' and the reference '36 N, 1' are at different poses"):
        identify(replace(test, runs=(test.runs[0], shifted)))
    shorter = {name: column[:-1] for name, column in test.runs[1].columns.items()}
    with pytest.raises(InputError, match="has 35 readings, the reference '36 N, 1' has 36"):
        identify(replace(test, runs=(test.runs[0], replace(test.runs[1], columns=shorter))))


def test_several_reference_runs_are_averaged(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [36.0, 100.0], repeats=3, reference=36.0)
    noisy = simulate(test, TRUTH, Imperfection(noise=1e-4), exact=False)
    systems = systems_of(noisy)
    assert systems.references == 3
    assert systems.levels == (64.0,)
    assert systems.applied.forces == (36.0, 100.0)
    mean = np.mean([run.columns["radial"] for run in noisy.runs[:3]], axis=0)
    for run, raw in zip(systems.runs, noisy.runs[3:], strict=True):
        np.testing.assert_allclose(run.reading, raw.columns["radial"] - mean, atol=1e-15)


def test_the_noise_of_differences_is_i_plus_one_over_n(make_test: MakeTest) -> None:
    """`noise_of` against the covariance of the stacked differences, written out."""
    test = make_test("wFYXt", [36.0, 100.0, 200.0], repeats=2, reference=36.0, readings=9)
    systems = systems_of(test)
    count, m = len(systems.runs), 9
    omega = np.kron(np.eye(count) + np.ones((count, count)) / 2, np.eye(m))
    A = np.vstack([run.design for run in systems.runs])
    noise = noise_of(systems.runs, systems.references)
    assert noise is not None
    expected = A.T @ omega @ A
    np.testing.assert_allclose(noise.root.T @ noise.root, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    assert noise.trace == pytest.approx(np.trace(omega))
    assert noise.square == pytest.approx(np.trace(omega @ omega))
    assert noise_of(systems.runs, 0) is None


def test_local_estimates_at_a_level_that_was_not_measured_are_refused(make_test: MakeTest) -> None:
    systems = systems_of(make_test("wFYXt", [100.0, 200.0]))
    with pytest.raises(InputError, match="no run has the force 300 N; there are 100, 200 N"):
        local_estimates(systems, ["C_XXX"], [(100.0, 300.0)])


def test_local_estimates_without_enough_levels_are_refused(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 200.0, 300.0], parameters=["elasto-geometric-xy"])
    systems = systems_of(test)
    labels = [source.name for source in systems.sources]
    assert solve(merged(systems.at(100.0, 300.0)), labels).labels == tuple(labels)
    with pytest.raises(RankError, match="are not independent in this test"):
        local_estimates(systems, labels, [(100.0,)])


def test_levels_have_their_own_fit(make_test: MakeTest) -> None:
    test = simulate(make_test("wFYXt", [100.0, 400.0], repeats=2), TRUTH, Imperfection(noise=1e-4), exact=False)
    result = identify(test)
    assert [level.readings for level in result.levels] == [72, 72]
    for level in result.levels:
        traces = [trace for trace in result.traces if trace.force == level.force]
        errors: Array = np.concatenate([trace.predicted - trace.measured for trace in traces])
        measured: Array = np.concatenate([trace.measured for trace in traces])
        assert level.rmse == pytest.approx(np.sqrt(np.mean(errors**2)))
        assert level.fitness == pytest.approx(100 * (1 - level.rmse / np.ptp(measured)))
    total = np.sqrt(np.mean([level.rmse**2 for level in result.levels]))
    assert result.rmse == pytest.approx(total)


def test_peak_to_peak_is_at_the_strongest_force_with_the_sign_of_the_value(make_test: MakeTest) -> None:
    truth = {"C_XXX": 6e-5, "C_YYY": -3e-5}
    result = identify(simulate(make_test("wFYXt", [100.0, 400.0], parameters=list(truth)), truth, exact=False))
    spans = {parameter.name: parameter.peak_to_peak for parameter in result.parameters}
    assert spans == pytest.approx({"C_XXX": 0.024, "C_YYY": -0.012})
    assert {p.name: p.share for p in result.parameters} == pytest.approx({"C_XXX": 2 / 3, "C_YYY": 1 / 3})


def test_sums_are_no_fault_of_a_default_question(make_test: MakeTest) -> None:
    test = simulate(make_test("wFYXt", [100.0, 400.0, 700.0]), TRUTH, exact=False)
    check = verdict_of(replace(test, question=Question()))["identifiable"]
    assert check.passed
    assert check.facts["rank"] < check.facts["asked"]
    assert f"determines {check.facts['rank']} combinations" in sentence_of(check)
