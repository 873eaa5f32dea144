"""What tests are held against: the baseline's mean, shrunk scatter and slope, against regression written out."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.changes import KINDS, Baseline, Prior, Series, reference_from, reference_of
from elastogeo.changes.references import PER_KELVIN
from elastogeo.errors import InputError

PRIOR = Prior(np.array([6.0, 6.0]), np.array([1.0, 0.5]))


def series(value: np.ndarray, **other: object) -> Series:
    n = len(value)
    plain = {
        "name": "a machine, a recipe",
        "indicators": ("stiffness X", "backlash X"),
        "kinds": (KINDS["stiffness"], KINDS["backlash"]),
        "tests": tuple(f"t{k}" for k in range(n)),
        "date": np.arange(n, dtype=float),
        "value": value,
        "standard_uncertainty": np.full(value.shape, np.nan),
        "temperature": np.full(n, np.nan),
        "repeats": np.full(n, -1),
        "aside": np.zeros(n, dtype=bool),
        "instruments": ("",) * n,
    }
    return Series(**(plain | other))  # type: ignore[arg-type]


def test_the_variance_is_shrunk_by_degrees_of_freedom() -> None:
    value = np.random.default_rng(1).normal(5.0, 2.0, (10, 2))
    found = reference_from(value, PRIOR)
    own = np.var(value, axis=0, ddof=1)
    assert_allclose(found.mean, np.mean(value, axis=0))
    assert_allclose(found.deviation**2, (6 * PRIOR.deviation**2 + 9 * own) / 15)
    assert_allclose(found.degrees_of_freedom, 15)
    assert_allclose(found.slope, 0)
    assert np.all(np.isinf(found.spread))


def test_the_slope_is_a_regression_with_one_observation_more() -> None:
    """A row that says `slope = 0` with the weight of its scatter, solved by least squares."""
    random = np.random.default_rng(2)
    warm = 20 + 6 * random.standard_normal(10)
    value = 5 + 0.7 * warm[:, np.newaxis] + random.standard_normal((10, 2))
    found = reference_from(value, PRIOR, temperature=warm)
    design = np.vstack([np.column_stack([np.ones(10), warm - warm.mean()]), [0, 1 / PER_KELVIN]])
    expected, left, *_ = np.linalg.lstsq(design, np.vstack([value, np.zeros((1, 2))]), rcond=None)
    assert_allclose(found.mean, expected[0])
    assert_allclose(found.slope, expected[1])
    hat = design @ np.linalg.pinv(design)
    assert_allclose(found.degrees_of_freedom, 6 + np.sum(1 - np.diag(hat)[:10]))
    assert_allclose(found.deviation**2, (6 * PRIOR.deviation**2 + left) / found.degrees_of_freedom)
    inverse = np.linalg.inv(design.T @ design)
    assert_allclose(1 / found.spread, inverse[1, 1])


def test_a_baseline_that_saw_much_tells_the_slope_and_one_in_an_even_room_does_not() -> None:
    exact = np.linspace(-10, 10, 12)
    told = reference_from(np.column_stack([2 * exact, -exact]), PRIOR, temperature=20 + exact)
    assert_allclose(told.slope, [2, -1], rtol=0.02)
    even = reference_from(np.column_stack([2 * exact, -exact]), PRIOR, temperature=20 + exact / 1000)
    assert np.all(np.abs(even.slope) < 1e-4 * np.array([2000, 1000]))


def test_many_machines_at_once_are_each_by_itself() -> None:
    random = np.random.default_rng(3)
    value, warm = random.standard_normal((4, 8, 2)), 20 + 5 * random.standard_normal((4, 8))
    value[1, 3, 0] = warm[2, 5] = np.nan
    together = reference_from(value, PRIOR, temperature=warm)
    for k in range(4):
        alone = reference_from(value[k], PRIOR, temperature=warm[k])
        for name in ("mean", "deviation", "degrees_of_freedom", "slope", "spread", "temperature", "unknown", "count"):
            assert_allclose(getattr(together, name)[k], getattr(alone, name), err_msg=name)


def test_a_stated_uncertainty_is_a_floor() -> None:
    value = np.random.default_rng(4).normal(0, 0.1, (10, 2))
    u = np.column_stack([np.full(10, 3.0), np.full(10, np.nan)])
    found = reference_from(value, PRIOR, standard_uncertainty=u)
    assert found.deviation[0] == pytest.approx(3.0)
    assert found.deviation[1] < 0.5


def test_what_is_set_aside_or_not_determined_does_not_count() -> None:
    value = np.tile([20e3, 4e-3], (8, 1))
    value[0], value[1, 1] = (99e3, 1.0), np.nan
    aside = np.arange(8) == 0
    found = reference_of(series(value, aside=aside), Baseline(tuple(f"t{k}" for k in range(8)), 8.0))
    assert_allclose(found.mean, [20e3, 4e-3])
    assert_allclose(found.count, [7, 6])
    assert_allclose(found.relevance, [0.03 * 20e3, 1e-3])
    assert_allclose(found.deviation, np.array([0.015 * 20e3, 0.5e-3]) * np.sqrt(6 / (6 + np.array([6, 5]))))


def test_one_test_or_none_has_the_expected_scatter_or_nothing() -> None:
    value = np.tile([20e3, np.nan], (3, 1))
    one = reference_of(series(value), Baseline(("t1",), 2.0))
    assert_allclose(one.deviation[0], 300.0)
    assert_allclose(one.degrees_of_freedom, 6)
    assert np.isnan(one.mean[1])
    none = reference_of(series(value), Baseline((), 0.0))
    assert np.all(np.isnan(none.mean))
    assert_allclose(none.count, 0)


def test_a_fleet_counts_where_it_knows_and_a_person_decides_what_matters() -> None:
    value = np.tile([20e3, 4e-3], (8, 1))
    fleet = Prior(np.array([3.0, np.nan]), np.array([500.0, np.nan]))
    found = reference_of(series(value), Baseline(tuple(f"t{k}" for k in range(8)), 8.0), fleet, {"stiffness X": 0.1})
    assert_allclose(found.degrees_of_freedom, [3 + 7, 6 + 7])
    assert_allclose(found.deviation, [500 * np.sqrt(3 / 10), 0.5e-3 * np.sqrt(6 / 13)])
    assert_allclose(found.relevance, [0.1 * 20e3, 1e-3])


def test_names_that_the_series_does_not_have_are_refused() -> None:
    made = series(np.ones((2, 2)))
    with pytest.raises(InputError, match="names tests that the series does not have: t7"):
        reference_of(made, Baseline(("t0", "t7"), 1.0))
    with pytest.raises(InputError, match="has no indicator stiffness Y; it has stiffness X, backlash X"):
        reference_of(made, Baseline(("t0",), 1.0), relevance={"stiffness Y": 0.1})
