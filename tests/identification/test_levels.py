"""One definition of a force level, and what follows from levels that are none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from elastogeo.errors import InputError
from elastogeo.identification import Check, ForceSpread, force_levels, identify
from elastogeo.observe import Imperfection, KnownInfluence, MachineTest
from elastogeo.report import sentence_of
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
TRUTH = {"C_XXX": 6e-5, "C_YYY": 5e-5, "E_XX1": -1e-4, "E_YY1": 5e-5, "E_Xt0": 4e-3}


def identified(make_test: MakeTest, forces: list[float], **asked: object) -> tuple[dict[str, Check], object]:
    blank = make_test("wFYXt", forces, parameters=["loaded-xy"], set_up_per_run=True, **asked)
    result = identify(simulate(blank, TRUTH, Imperfection(noise=1e-4, eccentricity=5e-4), exact=False))
    return {check.name: check for check in result.verdict}, result


def test_repeats_with_measured_forces_are_one_level() -> None:
    """A fifth of a newton about 490 N is within what a force is set again to."""
    found = force_levels([490.2, 112.0, 489.8, 490.0])
    assert found.forces == (112.0, pytest.approx(490.0, abs=1e-9))
    assert found.members == ((112.0,), (489.8, 490.0, 490.2))


def test_a_chain_counts_every_run_once() -> None:
    chain = [490.0 + 0.4 * k for k in range(40)]
    found = force_levels(chain)
    assert [force for level in found.members for force in level] == chain
    assert max(level[-1] - level[0] for level in found.members) < 2.0 * 2**0.5 * found.spread.of(506.0)
    assert 1 < len(found.forces) < 10


@given(st.lists(st.floats(-2000, 2000), min_size=1, max_size=30), st.floats(1e-4, 0.05))
def test_every_force_is_in_one_level_and_finds_it_again(forces: list[float], relative: float) -> None:
    found = force_levels(forces, ForceSpread(relative))
    assert sorted(force for level in found.members for force in level) == sorted(forces)
    assert list(found.forces) == sorted(found.forces)
    for level, members in zip(found.forces, found.members, strict=True):
        assert all(found.level(force) == level for force in members)


def test_a_force_that_no_run_has_is_named() -> None:
    with pytest.raises(InputError, match=r"no run has the force 300 N; there are 112, 490 N"):
        force_levels([112.0, 490.0]).level(300.0)


@pytest.mark.parametrize("forces", [[490.0, 490.4], [490.0, 492.0], [490.0, 490.4, 490.8, 491.2]])
def test_forces_that_their_uncertainty_does_not_distinguish_are_refused(make_test: MakeTest, forces: list[float]) -> None:
    """The columns are independent and the estimate has a value: what counts as compliance is the error of the forces."""
    checks, result = identified(make_test, forces, repeats=3)
    check = checks["forces distinct"]
    assert check.passed is False
    assert check.decisive
    assert len(result.levels) == 1
    assert "All runs are at 49" in sentence_of(check)
    assert "Measure at two clearly different forces" in sentence_of(check)
    assert checks["separated"].passed is False  # no verdict says that they cannot be distinguished, and that they are
    assert checks["separated"].decisive
    low, high = checks["separated"].facts["within"]
    assert f"Only forces of one level, {low:g} to {high:g} N, separate" in sentence_of(checks["separated"])


def test_levels_that_are_distinct_but_close_are_refused_by_their_separation(make_test: MakeTest) -> None:
    """3.5 standard uncertainties: two levels, whose difference is known to 30 %."""
    checks, result = identified(make_test, [490.0, 495.0], repeats=3)
    assert [level.force for level in result.levels] == [490.0, 495.0]
    assert checks["forces distinct"].passed is False
    assert checks["forces distinct"].facts["separation"] == pytest.approx(5 / 2**0.5 / 1.0, rel=0.03)
    checks, _ = identified(make_test, [36.0, 742.0], repeats=3)
    assert checks["forces distinct"].passed


def test_a_stated_uncertainty_of_the_levels_decides(make_test: MakeTest) -> None:
    """400 and 450 N are distinct, unless each is known to 3 % only."""
    blank = make_test("wFYXt", [400.0, 450.0], parameters=["loaded-xy"], set_up_per_run=True, repeats=3)
    noisy = simulate(blank, TRUTH, Imperfection(noise=1e-4), exact=False)
    vague = replace(noisy, influences=(KnownInfluence("force-level", relative=0.03),))
    for test, passed in ((noisy, True), (vague, False)):
        check = next(check for check in identify(test).verdict if check.name == "forces distinct")
        assert check.passed is passed


def test_no_force_at_all_says_nothing_of_compliance(make_test: MakeTest) -> None:
    checks, _ = identified(make_test, [0.0], repeats=3)
    assert checks["forces distinct"].passed is False
    assert checks["forces distinct"].decisive
    assert "No run has a force" in sentence_of(checks["forces distinct"])


def test_repeats_at_measured_forces_count_as_repeats(make_test: MakeTest) -> None:
    _, result = identified(make_test, [112.0, 112.1, 489.8, 490.0, 490.2])
    assert [level.force for level in result.levels] == [pytest.approx(112.05), pytest.approx(490.0)]
    assert [level.readings for level in result.levels] == [72, 108]
    assert list(result.repeats.runs.values()) == [2, 3]


def test_compliance_alone_without_a_reference_is_refused(make_test: MakeTest) -> None:
    """The geometry of the machine would be taken for compliance: with three forces the bias is that of E / F."""
    blank = make_test("wFYXt", [36.0, 364.0, 742.0], parameters=["planar-xy"], set_up_per_run=True)
    noisy = simulate(blank, TRUTH, Imperfection(noise=1e-5), exact=False)
    result = identify(noisy)
    check = next(check for check in result.verdict if check.name == "geometry in the model")
    assert check.passed is False
    assert check.decisive
    assert "the machine's geometry is taken for compliance" in sentence_of(check)
    assert abs(result["C_XXX"].value - TRUTH["C_XXX"]) > 0.2 * TRUTH["C_XXX"]
    for asked in ({"parameters": ["loaded-xy"]}, {"reference": 36.0}):
        found = identify(noisy, **asked)
        assert next(check for check in found.verdict if check.name == "geometry in the model").passed
        assert found["C_XXX"].value == pytest.approx(TRUTH["C_XXX"], rel=1e-3)


def test_no_stated_influence_is_said(make_test: MakeTest) -> None:
    checks, _ = identified(make_test, [36.0, 364.0, 742.0], repeats=2)
    assert checks["systematic influences stated"].passed is False
    assert "states no systematic influence" in sentence_of(checks["systematic influences stated"])


def test_a_set_up_has_no_share_and_a_constant_error_its_full_size(make_test: MakeTest) -> None:
    """A bar that is 0.1 mm too long shifts all readings alike: 0.1 mm, and no share of the machine's faults."""
    blank = make_test("wFYXt", [0.0], parameters=["E_R0", "E_XX1", "E_Xt0"], repeats=3)
    truth = {"E_R0": 0.1, "E_XX1": 1e-4, "E_Xt0": 0.05}
    result = identify(replace(simulate(blank, truth, Imperfection(noise=1e-6), exact=False), resolution=1e-4))
    assert result["E_R0"].peak_to_peak == pytest.approx(0.1, rel=1e-3)
    assert (result["E_R0"].share, result["E_Xt0"].share, result["E_XX1"].share) == (0.0, 0.0, 1.0)
    assert next(check for check in result.verdict if check.name == "above resolution").passed
