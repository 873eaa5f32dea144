"""Whether the tests of a campaign agree: which is wrong is named, a level is, and nothing where all are sound."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from elastogeo.estimate import solve
from elastogeo.identification import Identification, confounding_of, identify, merged, moments_of, systems_of
from elastogeo.identification.campaigns import agreement
from elastogeo.identification.question import effects_of
from elastogeo.observe import KnownInfluence, MachineTest, Question, campaign_of
from studies.campaign_tests import EXCHANGED, FORCE, LEVEL, LEVEL_FAULT, SMALLER, agreement_of, campaign

SEED = (9, 3)


def said(result: Identification) -> str:
    return next(entry["sentence"] for entry in json.loads(result.to_json())["verdict"] if entry["name"] == "tests agree")


def test_sound_tests_agree() -> None:
    found = agreement_of(campaign("", "", SEED))
    assert found.named == ()
    assert found.disagreeing == ()
    assert 0.5 < found.scatter < 1.6  # runs scatter like readings: the wandering centre is that of the run
    for one in found.against.values():
        assert one.rmse < 1.5e-4


@pytest.mark.parametrize("fault", [FORCE, EXCHANGED, SMALLER])
@pytest.mark.parametrize("wrong", ["xy", "zx", "xy-tilted"])
def test_the_wrong_one_is_named_and_no_other(fault: str, wrong: str) -> None:
    found = agreement_of(campaign(fault, wrong, SEED))
    assert (found.named, found.rest_agrees, found.level, found.run) == ((wrong,), True, None, "")
    assert found.against[wrong].rmse == max(one.rmse for one in found.against.values())


def test_a_wrong_level_is_named_although_it_scatters_its_own_test() -> None:
    found = agreement_of(campaign(LEVEL, "yz", SEED))
    assert (found.named, found.rest_agrees, found.level, found.run) == (("yz",), True, LEVEL_FAULT, "yz/run 2")


def test_of_two_that_contradict_one_another_none_is_accused() -> None:
    tests = campaign(EXCHANGED, "xy", SEED)
    found = agreement_of({name: tests[name] for name in ("xy", "xy-repeated")})
    assert set(found.named) == {"xy", "xy-repeated"}
    assert found.rest_agrees


def test_two_that_are_wrong_are_not_one() -> None:
    tests = campaign(EXCHANGED, "xy", SEED) | {"yz": campaign(SMALLER, "yz", SEED)["yz"]}
    found = agreement_of(tests)
    assert not found.rest_agrees
    assert set(found.disagreeing) >= {"xy", "yz"}


def test_the_order_of_the_tests_does_not_matter() -> None:
    tests = campaign(FORCE, "zx", SEED)
    one, other = agreement_of(tests), agreement_of(dict(reversed(tests.items())))
    assert one.named == other.named
    for name in tests:
        assert one.against[name].statistic == pytest.approx(other.against[name].statistic, rel=1e-6)
        assert one.against[name].rmse == pytest.approx(other.against[name].rmse, rel=1e-9)


def test_statistic_and_prediction_of_the_others_by_dense_least_squares() -> None:
    """The F of Chow, from readings: the joint fit against that of one test and that of all others, each by itself."""
    tests = campaign(FORCE, "xy", SEED)
    found = agreement_of(tests)
    systems = systems_of(tests)
    labels = confounding_of(tests, systems).retained

    def rows(names: list[str]) -> tuple[Any, Any]:
        runs = [run for run in systems.runs if run.test in names]
        root = [np.sqrt(run.precision) for run in runs]
        design = np.vstack([r * run.design_of(labels) for r, run in zip(root, runs, strict=True)])
        return design, np.concatenate([r * run.reading for r, run in zip(root, runs, strict=True)])

    def left(names: list[str]) -> tuple[float, int]:
        A, y = rows(names)
        norms = np.linalg.norm(A, axis=0)
        A = A / np.where(norms > 0, norms, 1.0)
        values, _, rank, _ = np.linalg.lstsq(A, y, rcond=1e-9)
        return float(np.sum((y - A @ values) ** 2)), int(rank)

    every = list(tests)
    others = [name for name in every if name != "xy"]
    (joint, r), (own, a), (rest, b) = left(every), left(["xy"]), left(others)
    q = a + b - r
    run = systems.runs[0]
    reading = systems.scatter[run.test] ** 2 * run.precision
    assert found.against["xy"].directions == q
    assert found.against["xy"].square == pytest.approx((joint - own - rest) / reading, rel=1e-6)
    A, y = rows(others)
    values = np.linalg.lstsq(A / np.linalg.norm(A, axis=0), y, rcond=1e-9)[0] / np.linalg.norm(A, axis=0)
    own_design, own_reading = rows(["xy"])
    precision = next(run.precision for run in systems.runs if run.test == "xy")
    off = (own_reading - own_design @ values) / np.sqrt(precision)
    counted = sum(run.factor.rows for run in systems.runs if run.test == "xy")
    assert found.against["xy"].fitted == 0
    assert found.against["xy"].rmse == pytest.approx(np.linalg.norm(off) / np.sqrt(counted), rel=1e-6)


def with_gauges(tests: dict[str, MachineTest], serials: dict[str, str], relative: float) -> agreement.TestsAgreement:
    known = (KnownInfluence("force-scale", relative=relative),)
    asked = {
        name: replace(test, influences=known, about=replace(test.about, instrument_serial=serials[name]))
        for name, test in tests.items()
    }
    systems = systems_of(asked)
    solution = solve(merged(systems.runs), confounding_of(asked, systems).retained)
    found = agreement.tests_agreement(
        systems, solution, moments_of(systems, solution, effects_of(campaign_of(asked), systems))
    )
    assert found is not None
    return found


def test_a_force_within_the_uncertainty_of_its_own_gauge_is_no_contradiction() -> None:
    tests = campaign(FORCE, "xy", SEED)
    own = with_gauges(tests, {name: name for name in tests}, 0.04)
    shared = with_gauges(tests, dict.fromkeys(tests, "one gauge"), 0.04)
    assert own.named == ()
    assert shared.named == ("xy",)  # of one gauge all forces are off alike
    assert own.against["xy"].degrees_of_freedom > shared.against["xy"].degrees_of_freedom


def test_tests_that_share_nothing_are_not_compared() -> None:
    tests = campaign("", "", SEED)
    asked = Question(("C_XXX", "E_XX1", "C_ZZZ", "E_ZZ1"))
    result = identify({name: replace(tests[name], question=asked) for name in ("xy", "yz")})
    check = next(check for check in result.verdict if check.name == "tests agree")
    assert check.passed is None
    assert said(result) == "Not tested: no two tests determine the same."


def test_the_verdict_says_it_in_words() -> None:
    three = {name: test for name, test in campaign(FORCE, "xy", SEED).items() if name != "yz"}
    result = identify(three)
    assert said(result).startswith("xy contradicts the others, which agree without it.")
    answer = json.loads(result.to_json())
    assert answer["tests_agreement"]["named"] == ["xy"]
    left_out = {one["id"]: one["left_out_um"] for one in answer["tests"]}
    assert max(left_out, key=lambda name: left_out[name]) == "xy"
    assert "left out" in str(result)


def test_one_test_has_no_others() -> None:
    result = identify(campaign("", "", SEED)["xy"])
    assert result.tests_agreement is None
    assert "tests agree" not in [check.name for check in result.verdict]
    assert "left_out" not in str(result)
