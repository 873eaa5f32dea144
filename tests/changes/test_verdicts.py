"""Judging a series: states, repeats, what a person closed, what has nothing to judge."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.changes import (
    ALARM,
    NO_BASELINE,
    STEADY,
    STEP,
    SUSPECT,
    WATCH,
    Baseline,
    ChangeVerdict,
    Rule,
    Series,
    Tolerance,
    judge,
    reference_of,
    start,
    step,
)
from elastogeo.changes.drifts import YEAR
from elastogeo.changes.references import PER_KELVIN
from elastogeo.changes.replay import replay
from elastogeo.errors import InputError
from tests.changes.simulated_series import MEANS, NAMES, baseline_of, deviations, judged, series_of, stepped

BASE = np.random.default_rng(7).standard_normal((10, 4))
"""A baseline with the scatter of its kinds; what comes after it is put in by hand."""


def after_baseline(*off: float, **other: Any) -> Series:
    """The baseline, then tests whose stiffness X is off by so many standard deviations, and nothing else."""
    rows = np.zeros((len(off), 4))
    rows[:, 0] = off
    return series_of(np.vstack([BASE - BASE.mean(axis=0), rows]), **other)


def states(verdict: ChangeVerdict) -> list[str]:
    return [step.state for step in verdict.steps]


def test_what_has_not_changed_is_steady_since_the_baseline() -> None:
    series = after_baseline(0.5, -0.5, 0.3)
    verdict = judge(series, baseline_of(series), now=20400.0)
    assert (verdict.state, verdict.since, verdict.waiting) == (STEADY, baseline_of(series).since, "")
    assert states(verdict) == [STEADY] * 3
    assert verdict.change_point is None
    assert verdict.changed == ()
    assert [one.state for one in verdict.indicators] == [STEADY] * 4


def test_a_suspect_test_waits_for_its_repeat_and_then_is_an_alarm_that_nothing_confirmed() -> None:
    series = after_baseline(0.0, -8.0)
    date = float(series.date[-1])
    waits = judge(series, baseline_of(series), now=date + 7)
    assert (waits.state, waits.waiting, waits.repeat_by, waits.since) == (SUSPECT, "test 11", date + 7, date)
    assert waits["stiffness X"].state == SUSPECT
    assert waits["stiffness Y"].state == STEADY
    late = judge(series, baseline_of(series), now=date + 7.01)
    assert (late.state, late.waiting, late.since) == (ALARM, "", date + 7)
    assert late.steps[-1].confirmed is None
    assert [one.name for one in late.changed] == ["stiffness X"]


def repeated(first: float, second: float, days: float = 0.1, *later: float) -> Series:
    """A suspect test, its repeat so many days after it, and later tests."""
    series = after_baseline(0.0, first, second, *later)
    date, repeats = series.date.copy(), series.repeats.copy()
    date[12], repeats[12] = date[11] + days, 11
    return replace(series, date=date, repeats=repeats)


def test_a_repeat_on_the_same_side_confirms_it_at_once() -> None:
    series = repeated(-8.0, -7.0)
    verdict = judge(series, baseline_of(series), now=float(series.date[-1]))
    assert states(verdict) == [STEADY, SUSPECT, ALARM]
    assert verdict.since == series.date[-1]
    assert verdict.steps[1].confirmed is True
    assert verdict.steps[1].replaced == ""
    assert verdict.steps[2].repeats == "test 11"
    assert_allclose(verdict["stiffness X"].change, -7.0 * deviations()[0])


@pytest.mark.parametrize("second", [0.2, 8.0])
def test_a_repeat_that_does_not_confirm_takes_the_place_of_the_test(second: float) -> None:
    """Within the limits it is quiet again; as far off on the other side it is suspect itself."""
    series = repeated(-8.0, second)
    verdict = judge(series, baseline_of(series), now=float(series.date[-1]))
    assert states(verdict) == [STEADY, SUSPECT, SUSPECT if second > 5 else STEADY]
    assert verdict.steps[1].confirmed is False
    assert verdict.steps[1].replaced == "test 12"
    alone = after_baseline(0.0, second)
    assert_allclose(
        verdict["stiffness X"].running[12], judge(alone, baseline_of(alone), now=0.0)["stiffness X"].running[11], atol=1e-12
    )


def test_an_alarm_stays_until_a_person_closes_it() -> None:
    series = repeated(-8.0, -8.0, 0.1, 0.0, 0.0, 0.0)
    verdict = judge(series, baseline_of(series), now=21000.0)
    assert states(verdict)[2:] == [ALARM] * 4
    closed = judge(series, replace(baseline_of(series), cleared=(float(series.date[12]) + 1,)), now=21000.0)
    assert closed.state == STEADY
    assert closed.since == series.date[12] + 1
    assert states(closed)[2:] == [ALARM, STEADY, STEADY, STEADY]
    assert abs(closed["stiffness X"].running[13]) < 0.1, "the running mean starts anew"
    assert abs(verdict["stiffness X"].running[13]) > 4


def test_a_further_indicator_joins_the_alarm_when_a_second_test_shows_it() -> None:
    series = repeated(-8.0, -8.0, 0.1, -8.0, -8.0, -8.0)
    value = series.value.copy()
    value[14:, 1] -= 8 * deviations()[1]
    series = replace(series, value=value)
    assert {one.name for one in judge(series, baseline_of(series), now=21000.0).changed} == {"stiffness X", "stiffness Y"}
    once = value.copy()
    once[15:, 1] = MEANS[1]
    only_once = judge(replace(series, value=once), baseline_of(series), now=21000.0)
    assert only_once["stiffness X"].change_point is not None
    assert next(one.name for one in only_once.changed) == "stiffness X"


def test_without_a_baseline_nothing_is_judged_and_the_last_values_are_shown() -> None:
    series = after_baseline(1.0)
    verdict = judge(series, None)
    assert (verdict.state, verdict.since, verdict.steps) == (NO_BASELINE, None, ())
    assert verdict["stiffness X"].now == series.value[-1, 0]
    assert np.isnan(verdict["stiffness X"].mean)


def test_an_empty_series_has_no_baseline() -> None:
    empty = series_of(np.zeros((0, 4)))
    assert judge(empty, None).state == NO_BASELINE
    assert judge(empty, Baseline((), 20000.0)).state == NO_BASELINE
    assert np.isnan(judge(empty, None)["backlash X"].now)


def test_a_series_that_determines_nothing_has_nothing_to_judge() -> None:
    series = replace(
        after_baseline(0.0), indicators=(), kinds=(), value=np.zeros((11, 0)), standard_uncertainty=np.zeros((11, 0))
    )
    verdict = judge(series, baseline_of(series))
    assert (verdict.state, verdict.indicators) == (NO_BASELINE, ())
    assert verdict.not_judged == {"test 10": "nothing determined"}


def test_a_baseline_of_five_tests_is_only_watched() -> None:
    series = series_of(np.vstack([BASE[:5], stepped(0, 3, -20.0)]))
    verdict = judge(series, baseline_of(series, 5), now=21000.0)
    assert verdict.state == WATCH
    assert states(verdict) == [WATCH] * 3
    assert verdict.steps[-1].ratio > 1, "what it would be is shown all the same"


def test_tests_before_the_baseline_and_set_aside_count_as_not_judged_and_say_why() -> None:
    series = after_baseline(0.0, -8.0, 0.0)
    aside = series.aside.copy()
    aside[11] = True
    baseline = Baseline(series.tests[2:10], float(series.date[9]) + 0.5)
    verdict = judge(replace(series, aside=aside), baseline, now=21000.0)
    assert verdict.state == STEADY
    assert verdict.not_judged == {"test 0": "before the baseline", "test 1": "before the baseline", "test 11": "set aside"}
    assert [step.test for step in verdict.steps] == ["test 10", "test 12"]


def test_two_tests_of_one_date_are_two_tests() -> None:
    series = after_baseline(-8.0, -8.0)
    date = series.date.copy()
    date[11] = date[10]
    verdict = judge(replace(series, date=date), baseline_of(series), now=float(date[11]))
    assert states(verdict) == [SUSPECT, ALARM], "a second test over the limit on the same side confirms as a repeat does"


def test_a_column_that_is_not_determined_is_not_judged_and_holds_nothing_up() -> None:
    series = after_baseline(-8.0, -8.0)
    value = series.value.copy()
    value[:, 1], value[11, 2] = np.nan, np.nan
    verdict = judge(replace(series, value=value), baseline_of(series), now=21000.0)
    assert verdict.state == ALARM
    assert verdict["stiffness Y"].state == NO_BASELINE
    assert np.isnan(verdict["squareness XY"].single[11])
    assert np.isfinite(verdict["squareness XY"].single[10])


def test_one_indicator_and_one_test() -> None:
    series = after_baseline(-8.0)
    one = replace(
        series,
        indicators=series.indicators[:1],
        kinds=series.kinds[:1],
        value=series.value[:, :1],
        standard_uncertainty=series.standard_uncertainty[:, :1],
    )
    verdict = judge(one, baseline_of(one), now=float(one.date[-1]))
    assert verdict.state == SUSPECT
    assert verdict.steps[0].first == "stiffness X"
    assert verdict["stiffness X"].limit < judge(series, baseline_of(series))["stiffness X"].limit


def test_the_order_of_the_indicators_does_not_matter() -> None:
    series = series_of(np.vstack([BASE, stepped(2, 4, -6.0)]), seed=3)
    order = [2, 0, 3, 1]
    turned = replace(
        series,
        indicators=tuple(series.indicators[k] for k in order),
        kinds=tuple(series.kinds[k] for k in order),
        value=series.value[:, order],
        standard_uncertainty=series.standard_uncertainty[:, order],
    )
    one, other = (judge(given, baseline_of(given), now=21000.0) for given in (series, turned))
    assert one.state == other.state == ALARM
    assert one.steps == other.steps
    assert one.change_point == other.change_point
    assert [other[name].change for name in NAMES] == [one[name].change for name in NAMES]


def test_an_unknown_test_or_indicator_is_refused_by_name() -> None:
    series = after_baseline(0.0)
    with pytest.raises(InputError, match="names tests that the series does not have: test 99"):
        judge(series, Baseline(("test 0", "test 99"), 0.0))
    with pytest.raises(InputError, match="has no indicator stiffness Q"):
        judge(series, baseline_of(series), tolerances={"stiffness Q": Tolerance(relevance=1.0)})


def test_a_relevance_of_a_person_s_own_is_counted() -> None:
    """8 sigma of stiffness are 12 %: no alarm where 20 % are wanted."""
    series = after_baseline(-8.0, -8.0)
    assert judge(series, baseline_of(series)).state == ALARM
    assert judge(series, baseline_of(series), tolerances={"stiffness X": Tolerance(relevance=0.2)}).state == STEADY


def test_the_band_of_one_test_is_where_it_is_no_signal() -> None:
    series = after_baseline(0.0)
    verdict = judge(series, baseline_of(series))["stiffness X"]
    low, high = verdict.expected[10]
    for value, over in ((low * 0.999, True), (low * 1.001, False), (high * 0.999, False), (high * 1.001, True)):
        changed = series.value.copy()
        changed[10, 0] = value
        step = judge(replace(series, value=changed), baseline_of(series)).steps[0]
        assert (step.ratio > 1) is over


def test_the_verdict_does_not_depend_on_the_unit_of_time_since_when() -> None:
    """A change at test 16: the change point says so, with the month before it."""
    verdict = judged(np.vstack([BASE, stepped(6, 4, -8.0)]))
    assert verdict.change_point is not None
    assert verdict.change_point.test == "test 16"
    assert verdict.change_point.last_before == verdict.steps[5].date


def test_the_replay_is_the_step_of_the_charts_one_test_after_the_other() -> None:
    """All arrays at once against `step`, which the studies of false alarms count: with gaps, repeats and temperatures."""
    random = np.random.default_rng(11)
    series = series_of(np.vstack([np.zeros((10, 4)), random.normal(0, 2.5, (40, 4))]), seed=12)
    value, date, repeats = series.value.copy(), series.date.copy(), series.repeats.copy()
    value[random.random(value.shape) < 0.1] = np.nan
    value[:10] = series.value[:10]
    for i in range(14, 50, 5):
        repeats[i], date[i] = i - 1, date[i - 1] + 0.1
    warm = 20 + 3 * np.sin(date / 50)
    series = replace(series, value=value, date=date, repeats=repeats, temperature=warm)
    baseline = baseline_of(series)
    verdict = judge(series, baseline)
    reference = reference_of(series, baseline)
    charts = start(reference)
    for i in range(10, 50):
        answers = bool(repeats[i] == i - 1)
        charts, seen = step(charts, reference, Rule(), value[i], warm[i], np.full(4, np.nan), answers)
        assert_allclose([one.single[i] for one in verdict.indicators], seen.single, rtol=1e-12)
        assert_allclose([one.running[i] for one in verdict.indicators], seen.running, rtol=1e-12)
        over = {name for name, side in zip(NAMES, seen.over, strict=True) if side}
        assert set(verdict.steps[i - 10].over) == over


@pytest.mark.parametrize(("factor", "shift"), [(-1.0, 0.0), (1e3, 0.0), (1e-3, 5.0)])
def test_unit_sign_and_zero_of_an_indicator_do_not_matter(factor: float, shift: float) -> None:
    """Micrometres for millimetres, the other sense, another zero: the same states, dates and ratios."""
    series = series_of(np.vstack([BASE, stepped(3, 5, -7.0, indicator=2)]), seed=5)
    scaled = tuple(
        replace(kind, reproducibility=abs(factor) * kind.reproducibility, relevance=abs(factor) * kind.relevance)
        if not kind.relative
        else kind
        for kind in series.kinds
    )
    value = series.value.copy()
    value[:, 2:] = factor * value[:, 2:] + shift
    one = judge(series, baseline_of(series), now=21000.0)
    other = judge(replace(series, value=value, kinds=scaled), baseline_of(series), now=21000.0)
    assert one.state == other.state == ALARM
    assert one.change_point == other.change_point
    for a, b in zip(one.steps, other.steps, strict=True):
        assert (a.test, a.state, a.over, a.first) == (b.test, b.state, b.over, b.first)
        assert_allclose(a.ratio, b.ratio, rtol=1e-6)
    assert_allclose(other["squareness XY"].change, factor * one["squareness XY"].change, rtol=1e-6)


def test_what_is_no_number_is_not_judged() -> None:
    series = after_baseline(0.0, 0.0)
    value = series.value.copy()
    value[11, 0], value[11, 1] = np.inf, -np.inf
    verdict = judge(replace(series, value=value), baseline_of(series), now=21000.0)
    assert verdict.state == STEADY
    assert np.isnan(verdict["stiffness X"].single[11])
    value[11] = np.inf
    none = judge(replace(series, value=value), baseline_of(series), now=21000.0)
    assert none.not_judged == {"test 11": "nothing determined"}


def test_a_clock_that_went_back_makes_no_alarm() -> None:
    """A suspect test dated after now: its week has not begun."""
    series = after_baseline(0.0, -8.0)
    assert judge(series, baseline_of(series), now=float(series.date[-1]) - 100).state == SUSPECT


def answered_in_part(first: float, *second: float) -> Series:
    """A suspect stiffness X, a repeat that determines all but it, then repeats of that repeat so far off."""
    series = after_baseline(first, 0.0, *second)
    value, date, repeats = series.value.copy(), series.date.copy(), series.repeats.copy()
    value[11, 0] = np.nan
    date[11:] = date[10] + 0.1 * np.arange(1, len(second) + 2)
    repeats[11:] = np.arange(10, 11 + len(second))
    return replace(series, value=value, date=date, repeats=repeats)


def test_a_repeat_that_does_not_determine_what_was_suspect_leaves_it_standing() -> None:
    series = answered_in_part(-20.0)
    date = float(series.date[10])
    waits = judge(series, baseline_of(series), now=date + 5)
    assert (waits.state, waits.waiting, waits.repeat_by) == (SUSPECT, "test 10", date + 7)
    assert (waits.steps[0].replaced, waits.steps[0].confirmed) == ("", None)
    late = judge(series, baseline_of(series), now=date + 8)
    assert (late.state, late.since) == (ALARM, date + 7)
    assert late.change_point is not None
    assert late.change_point.test == "test 10"
    assert_allclose(late["stiffness X"].change, -20 * deviations()[0])


@pytest.mark.parametrize(("second", "state"), [(0.0, STEADY), (-20.0, ALARM)])
def test_a_further_repeat_takes_the_place_of_both_tests_before_it(second: float, state: str) -> None:
    series = answered_in_part(-20.0, second)
    verdict = judge(series, baseline_of(series), now=21000.0)
    assert verdict.state == state
    assert [step.replaced for step in verdict.steps] == (["test 12"] * 2 + [""] if state == STEADY else [""] * 3)
    assert verdict.steps[0].confirmed is (state == ALARM)
    assert verdict["stiffness X"].now == series.value[12, 0]


def test_a_second_test_that_shows_nothing_confirms_nothing() -> None:
    """Within the week, not as a repeat: its running mean still holds the suspect test."""
    series = after_baseline(-20.0, -0.1)
    date = series.date.copy()
    date[11] = date[10] + 5
    series = replace(series, date=date)
    within = judge(series, baseline_of(series), now=float(date[11]))
    assert abs(within["stiffness X"].running[11]) > within["stiffness X"].limit
    assert (within.state, within.waiting) == (SUSPECT, "test 10")
    late = judge(series, baseline_of(series), now=21000.0)
    assert late.state == ALARM
    assert [step.confirmed for step in late.steps] == [None, None]
    shown = after_baseline(-20.0, -6.0)
    both = judge(replace(shown, date=date), baseline_of(shown), now=float(date[11]))
    assert both.state == ALARM


def test_a_month_later_an_alarm_is_not_confirmed_by_a_test_that_shows_nothing() -> None:
    series = after_baseline(-20.0, -0.1)
    baseline = baseline_of(series)
    found = replay(series, baseline, reference_of(series, baseline), Rule(), 21000.0)
    assert (found.state, found.confirmed) == (ALARM, False)


def test_an_alarm_for_softer_is_not_told_as_stiffer_nor_with_a_drift_of_the_other_sense() -> None:
    """Found by search: a blow that fades; a line through it ends above the mean."""
    series = after_baseline(-12.3, -11.5, -7.7, -3.8, 0.0, 3.9, 7.7)
    found = judge(series, baseline_of(series), now=21000.0)["stiffness X"]
    assert found.state == ALARM
    assert found.single[10] < -found.limit
    assert found.change_interval[0] < 0
    assert found.drift is None


def test_a_step_that_is_sure_has_no_drift() -> None:
    """Softer by a step, then a little back each month: it is not getting stiffer by so much a year."""
    series = after_baseline(0.0, 0.0, 0.0, *np.linspace(-14.0, -10.0, 8))
    found = judge(series, baseline_of(series), now=22000.0)["stiffness X"]
    assert (found.state, found.shape, found.drift) == (ALARM, STEP, None)


def in_warmth(warm: np.ndarray[Any, Any], off: np.ndarray[Any, Any], seed: int) -> Series:
    """What a kelvin changes drawn as it is expected, the baseline within 1 K, later tests at so many kelvin above it."""
    random = np.random.default_rng(seed)
    temperature = np.concatenate([random.standard_normal(10), warm])
    rows = np.zeros((10 + len(off), 4))
    rows[10:, 0] = off
    rows[:, 0] += PER_KELVIN * random.standard_normal() * temperature
    return series_of(rows, 10000 + seed, temperature=20 + temperature)


def test_the_interval_of_a_change_holds_it_also_when_the_tests_are_warmer_than_the_baseline() -> None:
    """95 % wanted; of 200 draws fewer than 181 have a probability of 0.3 % (three standard deviations)."""
    held = 0
    for seed in range(200):
        series = in_warmth(np.full(6, 5.0), np.full(6, -16.0), seed)
        low, high = judge(series, baseline_of(series), now=22000.0)["stiffness X"].change_interval
        held += low <= -16 * deviations()[0] <= high
    assert held >= 181


def test_the_interval_of_a_drift_holds_it_also_when_it_grows_warmer_meanwhile() -> None:
    """The same for a slope: 1 K a month."""
    held = drifts = 0
    for seed in range(100):
        series = in_warmth(np.arange(12.0), -2.0 * np.arange(1, 13), seed)
        drift = judge(series, baseline_of(series), now=22000.0)["stiffness X"].drift
        if drift is not None:
            drifts += 1
            held += drift.interval[0] <= -2 * deviations()[0] / 30 * YEAR <= drift.interval[1]
    assert drifts >= 60
    assert held >= 0.95 * drifts - 3 * np.sqrt(0.05 * 0.95 * drifts)
