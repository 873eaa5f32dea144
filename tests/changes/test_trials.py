"""The rule tried out: its false alarms against the design, its delays against run lengths, what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from elastogeo.changes import DRIFT, KINDS, STEP, Baseline, Rule, RuleTest, Series, try_rule
from elastogeo.errors import InputError, UnsupportedError
from studies.rates import wilson


def series(scatter: tuple[float, float], tests: int = 30, last: float = 0.0) -> Series:
    random = np.random.default_rng(11)
    value = np.array([20e3, 4e-3]) + random.standard_normal((tests, 2)) * scatter
    value[-1, 0] += last
    return Series(
        "Mill 3, XY",
        ("stiffness X", "backlash X"),
        (KINDS["stiffness"], KINDS["backlash"]),
        tuple(f"t{k}" for k in range(tests)),
        14.0 * np.arange(tests),
        value,
        np.full(value.shape, np.nan),
        np.full(tests, np.nan),
        np.full(tests, -1),
        np.zeros(tests, dtype=bool),
        ("",) * tests,
    )


def base(tests: int = 10) -> Baseline:
    return Baseline(tuple(f"t{k}" for k in range(tests)), 14.0 * tests - 1)


def found(result: RuleTest, indicator: str, shape: str) -> list[tuple[float, float]]:
    return [(one.deviations, one.soon) for one in result.faults if (one.indicator, one.shape) == (indicator, shape)]


def test_machines_as_expected_alarm_as_designed_and_greater_faults_are_found_sooner() -> None:
    """At most 0.12 in 36 tests (promises.md); a step of four deviations within five tests in 90 %."""
    result = try_rule(machines=1000)
    assert result.alarmed <= stats.binom.ppf(0.999, 1000, 0.12)
    assert result.alarmed >= stats.binom.ppf(0.001, 1000, 0.03)
    for name in result.indicators:
        steps = found(result, name, STEP)
        assert steps == sorted(steps)
        assert all(soon >= 0.85 for deviations, soon in steps if deviations >= 4)
        assert len(found(result, name, DRIFT)) == 1
    assert "expected" in result.simulated


def test_a_shewhart_chart_of_known_scatter_finds_a_step_as_textbooks_say() -> None:
    """A long baseline and a smoothing of one: tests until the alarm are geometric, with the tail beyond the limit."""
    many = series((1.0, 0.5e-3), tests=2000)
    result = try_rule(
        many, base(1990), rule=Rule(smoothing=1.0), relevance={"stiffness X": 1e-9}, machines=4000, tests=5, seed=4
    )
    limit = stats.norm.isf(0.005 / 8)
    for one in result.faults:
        if one.indicator == "backlash X" and one.shape == STEP:
            tail = stats.norm.sf(limit - one.deviations)
            low, high = stats.binom.ppf([1e-3, 1 - 1e-3], 1000, 1 - (1 - tail) ** 5)
            assert low * 0.97 <= 1000 * one.soon <= high * 1.03


def test_a_recorded_series_gives_its_scatter_its_interval_and_what_it_would_have_said() -> None:
    result = try_rule(series((200.0, 0.2e-3), last=-5000.0), base(), machines=400, tests=12)
    assert result.name == "Mill 3, XY"
    assert result.interval == 14.0
    assert result.baseline == 10
    assert result.judged == 20
    assert result.over == ("t29",)
    assert result.relevance == pytest.approx([0.03, 1e-3], rel=0.01)
    wide = try_rule(series((2000.0, 0.2e-3)), base(), machines=400, tests=12)
    assert found(wide, "stiffness X", STEP)[0][0] < found(result, "stiffness X", STEP)[0][0] / 3


def test_blunders_cost_repeats_and_likeness_costs_false_alarms() -> None:
    plain, blunders, alike = (
        try_rule(machines=400, tests=24, **more) for more in ({}, {"blunders": 0.03}, {"correlation": 0.7})
    )
    assert blunders.repeats > plain.repeats + 0.25
    assert blunders.false_alarms < plain.false_alarms + 0.08
    assert alike.false_alarms > 2 * plain.false_alarms


def test_a_seed_repeats_and_the_interval_of_the_share_is_that_of_wilson() -> None:
    one, same, other = (try_rule(machines=300, tests=6, seed=seed) for seed in (1, 1, 2))
    assert one == same
    assert one != other
    assert one.interval95 == pytest.approx(wilson(one.alarmed, 300), abs=1e-12)


def test_an_indicator_that_the_baseline_does_not_determine_is_left_out() -> None:
    made = series((200.0, 0.2e-3))
    made.value[:, 1] = np.nan
    assert try_rule(made, base(), machines=50, tests=3).indicators == ("stiffness X",)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"machines": 0}, "0 machines with 36 tests each"),
        ({"interval": -1.0}, "the interval between tests is -1.0 days"),
        ({"blunders": 1.5}, "share of tests with a blunder is 1.5"),
        ({"correlation": 1.0}, "correlation of one test with the next is 1.0"),
        ({"series": series((1.0, 1.0))}, "Mill 3, XY has no baseline"),
    ],
)
def test_what_makes_no_sense_is_refused(given: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        try_rule(**given)  # type: ignore[arg-type]


def test_a_baseline_that_is_too_short_is_refused_for_nothing_would_alarm() -> None:
    with pytest.raises(UnsupportedError, match="the baseline has 4 tests; below 6 nothing is ever suspect"):
        try_rule(series((200.0, 0.2e-3)), base(4))
    with pytest.raises(UnsupportedError, match="the baseline has 0 tests"):
        try_rule(series((200.0, 0.2e-3)), Baseline((), 0.0))
