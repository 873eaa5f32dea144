"""What runs share and no parameter explains is found, whatever else they scatter; what each has for itself is no alarm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from elastogeo.identification import identify, shared_harmonic, systems_of
from elastogeo.report import sentence_of
from studies.bar_tests import make_test
from studies.truth import FOUR_LOBE, Truth

DRAWS = 40


def found(noise: str, truth: Truth, draws: int, layout: str = "7 runs") -> list[tuple[int, bool]]:
    harmonics = []
    for seed in range(draws):
        systems = systems_of(make_test(layout, truth, noise, seed))
        harmonic = shared_harmonic(systems.runs, systems.runs[0].factor.labels)
        assert harmonic is not None
        harmonics.append((harmonic.order, harmonic.significant))
    return harmonics


@pytest.mark.parametrize("noise", ["white", "autocorrelated", "of the run", "eccentricity"])
def test_what_differs_from_run_to_run_is_no_structure(noise: str) -> None:
    """1 % of alarms over all orders together; an eccentricity ten times the noise does not leak into order 3."""
    alarms = sum(significant for _, significant in found(noise, Truth(), DRAWS))
    assert alarms <= stats.binom.ppf(0.999, DRAWS, 0.01)


@pytest.mark.parametrize("noise", ["white", "autocorrelated", "of the run", "eccentricity"])
def test_a_four_lobe_in_every_run_is_order_four(noise: str) -> None:
    assert found(noise, Truth(four_lobe=FOUR_LOBE), 8) == [(4, True)] * 8


def test_a_harmonic_of_one_run_alone_is_scatter() -> None:
    """3 um in the readings at 490 N: not what the runs share."""
    alarms = sum(significant for _, significant in found("white", Truth(off_level=((490.0, 3e-3, 6),)), 8))
    assert alarms == 0


def test_two_runs_cannot_tell_and_structure_of_any_run_counts_then() -> None:
    systems = systems_of(make_test("two runs"))
    assert shared_harmonic(systems.runs, systems.runs[0].factor.labels) is None
    result = identify(make_test("two runs", Truth(harmonics=((7, 1e-3, 0.0),))))
    (check,) = [check for check in result.verdict if check.name == "residuals without structure"]
    assert check.passed is False
    assert "A harmonic of order 7, amplitude 1" in sentence_of(check)
    assert "assume independent readings" in sentence_of(check)


def test_arcs_are_no_whole_turns() -> None:
    """A third of a turn shows no twelve harmonics: the runs are not compared."""
    angle = np.linspace(0.2, 2.2, 60)
    whole = make_test("7 runs")
    test = replace(whole, runs=tuple(replace(r, columns={"angle": angle, "radial": 0 * angle}) for r in whole.runs))
    systems = systems_of(test)
    assert shared_harmonic(systems.runs, ["C_XXX", "E_XX1"]) is None


def test_the_sentences_tell_shared_from_own() -> None:
    (own,) = [
        c for c in identify(make_test("7 runs", noise="of the run")).verdict if c.name == "residuals without structure"
    ]
    assert own.passed
    assert "have a structure of their own, which the uncertainty by run covers" in sentence_of(own)
    lobed = identify(make_test("7 runs", Truth(four_lobe=FOUR_LOBE)))
    (shared,) = [check for check in lobed.verdict if check.name == "residuals without structure"]
    assert "is left that the 7 runs share or that grows with the force" in sentence_of(shared)
    assert shared.facts["order"] == 4
    assert 0.8 * 13.5e-3 / 8 < shared.facts["amplitude"] <= 13.5e-3 / 8  # cos^2 sin^2 = (1 - cos 4 theta) / 8
