"""The default question's intervals, in short: `python -m studies.coverage` draws 300 of each."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.identification import evaluate_static, identify
from elastogeo.observe import Question
from studies.bar_tests import SET_ANEW, make_test
from studies.coverage import CASES, TOO_FEW, Coverage, covered, drawn, noises_of, page_of, row_of, rows_of
from studies.noise import NOISES
from studies.roller_coverage import ROLLER
from studies.static_coverage import STATIC, made, shown, static_covered


@pytest.mark.parametrize("layout", CASES)
def test_every_determined_parameter_of_these_layouts_has_an_interval(layout: str) -> None:
    test, truth = drawn(layout, "harmonic", 0)
    result = identify(test)
    assert test.question == Question()
    assert result.by_run
    assert len(result.parameters) == result.confounding.rank >= 11
    assert all(parameter.interval is not None for parameter in result.parameters)
    assert next(check for check in result.verdict if check.name == "systematic influences stated").passed
    true = dict(truth.parameters)
    inside = sum(
        parameter.interval[0] <= sum(c * true.get(n, 0.0) for n, c in parameter.stands_for.items()) <= parameter.interval[1]
        for parameter in result.parameters
    )
    assert inside >= len(result.parameters) - 3


@pytest.mark.parametrize(("layout", "needed"), [("one run", 3), ("two runs", 4)])
def test_one_run_and_two_give_none_and_say_how_many_it_takes(layout: str, needed: int) -> None:
    assert layout in TOO_FEW
    result = identify(make_test(layout, question=Question()))
    assert all(parameter.interval is None for parameter in result.parameters)
    check = next(check for check in result.verdict if check.name == "uncertainty by run")
    assert check.facts["needed"] == needed


@pytest.mark.parametrize("layout", ["7 runs", "three pairs"])
def test_the_path_is_that_of_identify(layout: str) -> None:
    """One trial, all of it: the study counts the intervals that a user sees, its drawn ones apart."""
    for trial in range(3):
        test, truth = drawn(layout, "of the run", trial)
        result, true = identify(test), dict(truth.parameters)
        assert result.agreement is not None
        assert result.agreement.agrees.all()
        found = covered(layout, "of the run", range(trial, trial + 1))
        for parameter in result.parameters:
            value = sum(c * true.get(name, 0.0) for name, c in parameter.stands_for.items())
            assert found.held[parameter.name] == (parameter.interval[0] <= value <= parameter.interval[1])
        assert_allclose(
            found.freedom, [np.min(result.solution.degrees_of_freedom), np.max(result.solution.degrees_of_freedom)]
        )


@pytest.mark.parametrize(("layout", "noise"), [("7 runs", "autocorrelated"), ("three pairs", "harmonic")])
def test_intervals_cover(layout: str, noise: str) -> None:
    """Of 25 trials of eleven parameters or more; the limits are those of as many single ones, at 99.9 %."""
    found = covered(layout, noise, range(25))
    print(f"{found.pooled:.3f}", found.held)
    low = stats.binom.ppf(5e-4, 25, 0.95) / 25
    assert found.pooled > low
    assert found.pooled > 0.85
    assert min(found.held.values()) >= 15


def test_the_page_marks_what_does_not_hold() -> None:
    good = Coverage("7 runs", "white", 300, {"C_XXX": 285, "C_YYY": 287}, (2.5, 3.2))
    bad = Coverage("7 runs", "quantised", 300, {"C_XXX": 200, "C_YYY": 287}, (2.5, 3.2))
    assert good.holds
    assert not bad.holds
    page = page_of({(one.layout, one.noise): row_of(one) for one in (good, bad)})
    assert rows_of(page)["7 runs", "quantised"].endswith("| **no** |")
    assert "| 95.3% | C_XXX 95.0% | C_YYY 95.7% | 2.5 to 3.2 | yes |" in page
    assert "C_XXX 66.7%" in page
    assert "**no**" in page
    assert set(NOISES) >= {"white", "autocorrelated", "of the run", "harmonic", "quantised", "eccentricity"}


@pytest.mark.parametrize("layout", STATIC)
def test_static_templates_give_every_result_an_interval_and_the_study_counts_it(layout: str) -> None:
    """One trial, all of it: what the study counts is what `evaluate_static` prints, its drawn intervals apart."""
    one = made(layout, "of the run", 4)
    found = evaluate_static(one.test)
    assert found.joints.by_run
    assert all(parameter.interval is not None for parameter in found.joints.parameters)
    counted, _ = static_covered(layout, "of the run", range(4, 5))
    own = {}
    for name, estimate in shown(found):
        assert estimate.known
        low, high = estimate.interval()
        own[name] = low <= one.shown[name] <= high
    assert set(own) == set(one.shown)
    assert {name: bool(counted[name]) for name in own} == own
    assert set(counted) - set(own) == {parameter.name for parameter in found.joints.parameters}


@pytest.mark.parametrize(
    ("layout", "noise", "trials"), [("static force, new", "harmonic", 12), ("sensor frame, new", "of the run", 8)]
)
def test_intervals_of_static_templates_cover(layout: str, noise: str, trials: int) -> None:
    found = covered(layout, noise, range(trials))
    print(f"{found.pooled:.3f}", found.held)
    assert found.pooled > stats.binom.ppf(5e-4, trials, 0.95) / trials


def test_a_force_that_each_run_sets_anew_is_covered() -> None:
    """0.2 % from run to run, in the scatter that the runs show: most of what C_XXX scatters by."""
    assert all(SET_ANEW in noises_of(layout) for layout in CASES if layout != "three pairs")
    assert SET_ANEW not in noises_of("three pairs")
    one, truth = drawn("loaded bar, new", SET_ANEW, 1)
    assert np.std(truth.force_scatter) == pytest.approx(0.002, rel=0.6)
    assert one.runs[0].force == 36.0
    found = covered("loaded bar, new", SET_ANEW, range(25))
    assert found.held["C_XXX"] >= stats.binom.ppf(5e-4, 25, 0.95)
    assert found.pooled > 0.85


def test_intervals_of_the_ball_roller_template_hold() -> None:
    found = covered(ROLLER, "white", range(2))
    assert {"C_XXX", "C_YYY", "stiffness 0°", "stiffness 345°"} <= set(found.held)
    assert found.pooled > 0.7
