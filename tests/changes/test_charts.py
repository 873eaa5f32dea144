"""The rule of the charts: its numbers against their definition, its steps against what should happen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats

from elastogeo.changes import Prior, Reference, Rule, reference_from, start, step
from elastogeo.changes.references import PER_KELVIN
from elastogeo.errors import InputError

RULE = Rule()


def known(q: int = 8, deviation: float = 1.0, **other: object) -> Reference:
    """Ten tests of mean 100 and the deviation given, with 15 degrees of freedom."""
    ones = np.ones(q)
    plain = Reference(
        100 * ones, deviation * ones, 15 * ones, 10 * ones, 0 * ones, 0 * ones, 0 * ones, np.inf * ones, 0 * ones
    )
    return replace(plain, **other)  # type: ignore[arg-type]


def test_the_limit_is_students_t_shared_by_two_charts_of_each_indicator() -> None:
    charts = start(known())
    _, judged = step(charts, known(), RULE, np.full(8, 101.0))
    assert_allclose(judged.limit, stats.t.isf(0.005 / 32, 15))
    assert_allclose(judged.single, 1 / np.sqrt(1 + 1 / 10))


def test_the_running_mean_is_the_weighted_sum_and_its_variance_that_of_the_sum() -> None:
    """Against the sum written out: weights 0.4 x 0.6^k, and the closed form of monitoring.md."""
    random = np.random.default_rng(1)
    reference, values = known(), 100 + random.standard_normal((9, 8))
    charts = start(reference)
    for t, value in enumerate(values, 1):
        charts, judged = step(charts, reference, RULE, value)
        weights = 0.4 * 0.6 ** np.arange(t)[::-1]
        closed = np.sqrt(0.4 / 1.6 * (1 - 0.6 ** (2 * t)) + (1 - 0.6**t) ** 2 / 10)
        assert_allclose(judged.running, weights @ (values[:t] - 100) / closed)
        assert_allclose(closed**2, np.sum(weights**2) + np.sum(weights) ** 2 / 10)


def test_both_charts_have_the_variance_one_that_they_claim_also_with_temperatures() -> None:
    """T with the true deviation is standard normal at any temperature, if slopes are as expected: 5 standard errors."""
    random = np.random.default_rng(2)
    n, m, tests = 40000, 10, 5
    warm = 20 + np.concatenate([2 * random.standard_normal(m), 8 + random.standard_normal(tests)])
    slopes = PER_KELVIN * random.standard_normal((n, 1, 1))
    values = 100 + slopes * warm[:, np.newaxis] + random.standard_normal((n, m + tests, 1))
    prior = Prior(np.array([6.0]), np.array([1.0]))
    reference = reference_from(values[:, :m], prior, temperature=np.broadcast_to(warm[:m], (n, m)))
    reference = replace(reference, deviation=np.ones((n, 1)))
    charts = start(reference)
    for t in range(m, m + tests):
        charts, judged = step(charts, reference, RULE, values[:, t], warm[t])
        for found in (judged.single, judged.running):
            assert np.var(found) == pytest.approx(1, abs=5 * np.sqrt(2 / n))
            assert np.mean(found) == pytest.approx(0, abs=5 / np.sqrt(n))


def test_a_repeat_takes_the_place_of_the_suspect_test() -> None:
    reference = known()
    charts, _ = step(start(reference), reference, RULE, np.full(8, 100.5))
    plain, _ = step(charts, reference, RULE, np.full(8, 99.7))
    blunder = np.full(8, 99.7)
    blunder[3] = 106.0
    doubtful, judged = step(charts, reference, RULE, blunder)
    assert_array_equal(np.flatnonzero(judged.over), [3])
    assert_array_equal(doubtful.suspect, judged.over)
    answered, judged = step(doubtful, reference, RULE, np.full(8, 99.7), answers=True)
    assert not np.any(judged.confirmed)
    assert not np.any(answered.suspect)
    assert_allclose(answered.running.mean, plain.running.mean)
    assert_allclose(answered.running.scatter, plain.running.scatter)


@pytest.mark.parametrize(
    ("share", "side", "confirmed"),
    [(1.0, 1, True), (0.81, 1, True), (0.79, 1, False), (1.0, -1, False)],
)
def test_a_repeat_confirms_at_four_fifths_of_the_limit_on_the_same_side(share: float, side: int, confirmed: bool) -> None:
    reference = known()
    limit = stats.t.isf(0.005 / 32, 15) * np.sqrt(1.1)
    value = np.full(8, 100.0)
    value[0] += 1.01 * limit
    charts, judged = step(start(reference), reference, RULE, value)
    assert judged.over[0] == 1
    value[0] = 100 + side * share * limit
    charts, judged = step(charts, reference, RULE, value, answers=True)
    assert judged.confirmed[0] == confirmed
    assert not np.any(judged.confirmed[1:])


def test_what_a_repeat_does_not_determine_stays_suspect_and_a_second_repeat_takes_the_same_place() -> None:
    reference = known()
    value = np.full(8, 100.0)
    suspect, _ = step(start(reference), reference, RULE, np.where(np.arange(8) < 2, 110.0, value))
    half, judged = step(suspect, reference, RULE, np.where(np.arange(8) == 0, np.nan, value), answers=True)
    assert_array_equal(half.suspect, [1, 0, 0, 0, 0, 0, 0, 0])
    assert not np.any(judged.confirmed)
    assert half.running.mean[0] == suspect.running.mean[0]
    whole, judged = step(half, reference, RULE, np.full(8, 110.0), answers=True)
    assert judged.confirmed[0]
    assert_allclose(whole.running.weight, 0.4)


def test_an_indicator_that_a_test_does_not_determine_is_skipped_and_the_others_share_its_false_alarms() -> None:
    reference = known()
    charts, _ = step(start(reference), reference, RULE, np.full(8, 101.0))
    value = np.full(8, 101.0)
    value[2:] = np.nan
    after, judged = step(charts, reference, RULE, value)
    assert_allclose(judged.limit[:2], stats.t.isf(0.005 / 8, 15))
    assert np.all(np.isnan([judged.limit[2:], judged.single[2:], judged.running[2:]]))
    assert np.all(judged.ratio[2:] == 0)
    assert_array_equal(after.running.mean[2:], charts.running.mean[2:])
    assert np.all(after.running.weight[:2] > charts.running.weight[:2])
    nothing, judged = step(charts, reference, RULE, np.full(8, np.nan))
    assert nothing.running == charts.running
    assert not np.any(judged.over)


def test_significant_is_not_enough_it_must_matter() -> None:
    value = np.full(8, 108.0)
    for relevance, over in ((7.9, True), (8.1, False)):
        reference = known(relevance=np.full(8, relevance))
        _, judged = step(start(reference), reference, RULE, value)
        assert np.all(judged.over == over)
        assert np.all(np.abs(judged.single) > judged.limit)


def test_below_six_tests_of_the_baseline_nothing_is_suspect() -> None:
    for count, over in ((5.0, 0), (6.0, -1)):
        reference = known(count=np.full(8, count))
        _, judged = step(start(reference), reference, RULE, np.full(8, 90.0))
        assert np.all(judged.ratio > 1)
        assert np.all(judged.over == over)


def test_a_test_less_certain_than_the_scatter_is_judged_by_its_own_uncertainty() -> None:
    reference = known()
    _, judged = step(start(reference), reference, RULE, np.full(8, 105.0), standard_uncertainty=np.full(8, 3.0))
    assert_allclose(judged.single, 5 / np.sqrt(9.1))
    for small in (0.1, np.nan, np.inf):
        _, judged = step(start(reference), reference, RULE, np.full(8, 105.0), standard_uncertainty=np.full(8, small))
        assert_allclose(judged.single, 5 / np.sqrt(1.1))


def test_a_test_without_temperature_may_be_off_by_what_the_baselines_did() -> None:
    warm = known(slope=np.full(8, 0.5), temperature=np.full(8, 20.0), spread=np.full(8, 90.0), unknown=np.full(8, 1.6))
    _, at_mean = step(start(warm), warm, RULE, np.full(8, 104.0), 20.0)
    _, hot = step(start(warm), warm, RULE, np.full(8, 104.0), 28.0)
    _, blind = step(start(warm), warm, RULE, np.full(8, 104.0))
    assert_allclose(at_mean.single, 4 / np.sqrt(1.1))
    assert_allclose(hot.expected, 104.0)
    assert_allclose(hot.deviation, np.sqrt(1.1 + 64 / 90))
    assert_allclose(blind.single, 4 / np.sqrt(1.1 + 1.6**2))


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ({"alpha": 0.0}, "alpha of a rule is 0.0; give a share above 0 and up to 1"),
        ({"smoothing": 1.5}, "smoothing of a rule is 1.5"),
        ({"confirm": float("nan")}, "confirm of a rule is nan"),
        ({"least_baseline": 1}, "a baseline of 1 tests shows no scatter"),
        ({"wait": -1.0}, "waited for -1.0 days"),
    ],
)
def test_a_rule_out_of_range_is_refused(setting: dict[str, float], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Rule(**setting)  # type: ignore[arg-type]
