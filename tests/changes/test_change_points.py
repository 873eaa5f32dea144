"""Since when and how fast: against another library, against the sums written out, and by counting what intervals hold."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import numpy as np
import pytest
import ruptures
from numpy.testing import assert_allclose

from elastogeo.changes import ALARM, DRIFT, STEADY, STEP, WATCH, IndicatorState, Tolerance, judge
from elastogeo.changes.change_points import squares_of_step
from elastogeo.changes.drifts import YEAR, drift_of, line_of
from tests.changes.simulated_series import FIRST, MEANS, baseline_of, deviations, series_of

BASELINE = 10


def watched(off: np.ndarray[tuple[int], np.dtype[np.float64]], seed: int, tolerance: float | None = None) -> IndicatorState:
    """Stiffness X of a series that is off by so many standard deviations after its baseline."""
    rows = np.zeros((BASELINE + len(off), 4))
    rows[BASELINE:, 0] = off
    series = series_of(rows, seed)
    wanted = {} if tolerance is None else {"stiffness X": Tolerance(lower=tolerance)}
    return judge(series, baseline_of(series, BASELINE), tolerances=wanted)["stiffness X"]


@pytest.mark.parametrize("seed", range(5))
def test_the_squares_of_a_step_are_those_of_two_segments(seed: int) -> None:
    """ruptures (Truong, Oudre and Vayatis 2020): the cost of two constant pieces of baseline and tests together."""
    values = np.random.default_rng(seed).standard_normal(BASELINE + 14)
    values[BASELINE + 6 :] += 2
    ours, _ = squares_of_step(values[BASELINE:] - values[:BASELINE].mean(), BASELINE)
    cost = ruptures.costs.CostL2().fit(values)
    theirs = np.array([cost.error(0, k) + cost.error(k, len(values)) for k in range(BASELINE, len(values) - 1)])
    of_baseline = float(np.sum((values[:BASELINE] - values[:BASELINE].mean()) ** 2))
    assert_allclose(ours[:-1] + of_baseline, theirs, rtol=1e-10)


def test_values_that_are_missing_count_for_nothing() -> None:
    values = np.random.default_rng(3).standard_normal(12)
    gaps = np.insert(values, [3, 7], np.nan)
    ours, after = squares_of_step(gaps, BASELINE)
    alone, alone_after = squares_of_step(values, BASELINE)
    kept = np.isfinite(gaps)
    assert_allclose(ours[kept], alone)
    assert_allclose(after[kept], alone_after)


def test_the_interval_of_a_change_point_holds_the_step() -> None:
    """95 % wanted; of 60 draws fewer than 52 have a probability of 1 %. Dates are those between which it happened."""
    held, first, width = 0, 0, []
    for seed in range(60):
        found = watched(np.repeat([0.0, -4.0], [4, 8]), seed)
        if found.state == ALARM and found.change_point is not None:
            point = found.change_point
            held += point.interval[0] <= FIRST + 30 * (BASELINE + 3.5) <= point.interval[1]
            first += point.test == f"test {BASELINE + 4}"
            width.append(len(point.tests))
    assert held >= 52
    assert first >= 48
    assert np.mean(width) < 2.5


def test_the_change_point_of_a_drift_is_where_it_began() -> None:
    held = 0
    for seed in range(40):
        point = watched(-1.0 * np.maximum(np.arange(12) - 3, 0), seed).change_point
        assert point is not None
        held += point.interval[0] <= FIRST + 30 * (BASELINE + 3) <= point.interval[1]
    assert held >= 32, "of 40; 92 % of 300 draws in studies"


def test_a_step_is_told_from_a_drift_where_the_tests_can() -> None:
    steps = [watched(np.repeat([0.0, -6.0], [4, 8]), seed).shape for seed in range(20)]
    drifts = [watched(-1.0 * np.arange(12), seed).shape for seed in range(20)]
    assert steps.count(STEP) >= 18
    assert drifts.count(DRIFT) >= 17
    assert DRIFT not in steps
    assert STEP not in drifts
    assert watched(np.array([0.0, -9.0, -9.0]), 1).shape in ("", STEP), "two tests are no drift"


def test_a_step_has_no_drift_and_a_ramp_has_its_slope() -> None:
    truth = -deviations()[0] / 30 * YEAR
    assert sum(watched(np.repeat([0.0, -6.0], [4, 10]), seed).drift is not None for seed in range(30)) <= 5
    held = 0
    for seed in range(40):
        drift = watched(-1.0 * np.maximum(np.arange(14) - 3, 0), seed).drift
        held += drift is not None and drift.interval[0] <= truth <= drift.interval[1]
    assert held >= 34, "95 % wanted; fewer than 34 of 40 have a probability of 1 %"


def test_the_date_at_which_a_tolerance_is_reached_is_held_by_its_interval() -> None:
    """A ramp of one standard deviation a month reaches 30 of them in 30 months."""
    tolerance = float(MEANS[0] - 30 * deviations()[0])
    truth, held, told = FIRST + 30 * (BASELINE - 1 + 30), 0, 0
    for seed in range(40):
        drift = watched(-1.0 * np.arange(1, 15), seed, tolerance).drift
        if drift is not None and drift.limit_at is not None:
            told += 1
            held += drift.limit_at_interval[0] <= truth <= drift.limit_at_interval[1]
            assert (drift.limit_is, drift.limit) == ("tolerance", pytest.approx(tolerance))
    assert told == 40
    assert held >= 34


def test_a_limit_is_where_the_line_meets_it() -> None:
    """By hand: from 100 down 1 a day; the tolerance of 80 is met on the 20th day, from above."""
    date = np.arange(10.0)
    line = line_of(date, -date, deviation=1e-9, freedom=20.0)
    assert line is not None
    drift = drift_of(line, 100.0, 0.0, 3.0, 80.0, inf)
    assert drift.limit_at == pytest.approx(20.0)
    assert_allclose(drift.limit_at_interval, (20.0, 20.0), atol=1e-6)
    assert drift.at_end == pytest.approx(91.0)
    assert drift.per_year == pytest.approx(-YEAR)
    passed = drift_of(line, 100.0, 0.0, 3.0, -inf, inf)
    assert (passed.limit_is, passed.limit, passed.limit_at) == ("relevance", 97.0, None)


def test_a_slope_that_could_be_nothing_leaves_the_date_open() -> None:
    date = np.arange(10.0)
    line = line_of(date, 0.01 * date, deviation=1.0, freedom=20.0)
    assert line is not None
    assert drift_of(line, 0.0, 0.1, 5.0, -inf, inf).limit_at_interval[1] == inf


def test_an_interval_of_fieller_is_that_of_the_ratio() -> None:
    """Against 20 000 draws of middle and slope: 95 % of the dates at which drawn lines meet the limit lie within."""
    random = np.random.default_rng(1)
    date = 30.0 * np.arange(12)
    line = line_of(date, 0.02 * date, deviation=1.0, freedom=1e9)
    assert line is not None
    low, high = drift_of(line, 0.0, 0.0, 20.0, -inf, inf).limit_at_interval
    height = line.height + line.height_deviation * random.standard_normal(20000)
    slope = line.slope + line.slope_deviation * random.standard_normal(20000)
    met = line.date + (20.0 - height) / slope
    assert np.mean((met > low) & (met < high)) == pytest.approx(0.95, abs=0.01)


def test_fewer_than_four_tests_or_one_date_have_no_line() -> None:
    assert line_of(np.arange(3.0), np.arange(3.0), 1.0, 10.0) is None
    assert line_of(np.zeros(6), np.arange(6.0), 1.0, 10.0) is None
    assert line_of(np.arange(6.0), np.full(6, np.nan), 1.0, 10.0) is None


def test_a_drift_below_the_limit_is_watched_and_says_when() -> None:
    """A relevance that nobody wants as an alarm yet: 40 % of stiffness; the slope reaches it within the year."""
    rows = np.zeros((BASELINE + 14, 4))
    rows[BASELINE:, 0] = -1.3 * np.arange(1, 15)
    series = series_of(rows, 2)
    wide = {"stiffness X": Tolerance(relevance=0.4)}
    verdict = judge(series, baseline_of(series, BASELINE), tolerances=wide)
    found = verdict["stiffness X"]
    assert (verdict.state, found.state) == (WATCH, WATCH)
    assert found.drift is not None
    assert found.drift.limit_at is not None
    assert found.drift.end < found.drift.limit_at < found.drift.end + YEAR


def test_what_only_scatters_is_not_watched() -> None:
    states = [watched(np.zeros(20), seed).state for seed in range(60)]
    assert states.count(STEADY) >= 58


def test_dates_may_be_shifted_and_nothing_else_changes() -> None:
    rows = np.zeros((BASELINE + 12, 4))
    rows[BASELINE + 3 :, 0] = -6
    series = series_of(rows, 4)
    later = replace(series, date=series.date + 1000.0)
    one, other = (judge(given, baseline_of(given, BASELINE)) for given in (series, later))
    assert one.change_point is not None
    assert other.change_point is not None
    assert one.change_point.test == other.change_point.test
    assert other.change_point.date - one.change_point.date == pytest.approx(1000.0)


def test_a_drift_that_has_passed_its_limit_is_still_watched() -> None:
    """No alarm, for 40 % are wanted for one; the tolerance is reached within the year, or was 8 months ago."""
    rows = np.zeros((BASELINE + 14, 4))
    rows[BASELINE:, 0] = -1.3 * np.arange(1, 15)
    series = series_of(rows, 2)
    for far, passed in ((25.0, False), (8.0, True)):
        wanted = {"stiffness X": Tolerance(lower=float(MEANS[0] - far * deviations()[0]), relevance=0.4)}
        found = judge(series, baseline_of(series, BASELINE), tolerances=wanted)["stiffness X"]
        assert found.state == WATCH
        assert found.drift is not None
        assert (found.drift.limit_at is None) is passed


def test_a_change_after_a_false_alarm_lies_after_that_was_closed() -> None:
    rows = np.zeros((BASELINE + 6, 4))
    rows[BASELINE + 2 :, 0] = -10
    series = series_of(rows, 4)
    closed = float(series.date[BASELINE + 1]) + 3
    point = judge(series, replace(baseline_of(series, BASELINE), cleared=(closed,))).change_point
    assert point is not None
    assert (point.test, point.last_before, point.interval[0]) == (f"test {BASELINE + 2}", closed, closed)


def test_a_test_that_does_not_determine_an_indicator_is_not_its_first_changed_one() -> None:
    rows = np.zeros((BASELINE + 8, 4))
    rows[BASELINE + 4 :, 0] = -12
    series = series_of(rows, 5)
    value = series.value.copy()
    value[BASELINE + 3, 0] = np.nan
    point = judge(replace(series, value=value), baseline_of(series, BASELINE))["stiffness X"].change_point
    assert point is not None
    assert point.test == f"test {BASELINE + 4}"
    assert point.last_before == series.date[BASELINE + 2], "the last test that shows it unchanged"


def test_an_indicator_that_a_test_lacks_does_not_rule_it_out_for_the_others() -> None:
    rows = np.zeros((BASELINE + 8, 4))
    rows[BASELINE + 4 :, :2] = -12
    series = series_of(rows, 5)
    value = series.value.copy()
    value[BASELINE + 4, 0] = np.nan
    point = judge(replace(series, value=value), baseline_of(series, BASELINE)).change_point
    assert point is not None
    assert point.test == f"test {BASELINE + 4}"
