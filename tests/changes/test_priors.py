"""The scatter of a fleet by the moments of log s^2: against the distribution that it assumes, and published figures."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import optimize, special, stats

from elastogeo.changes import KINDS, default_prior, fleet_prior
from elastogeo.errors import InputError


def with_spread(spread: float, machines: int = 41) -> np.ndarray:
    """Deviations whose logarithms have exactly this standard deviation, about log 2."""
    z = np.linspace(-1.0, 1.0, machines)
    return np.exp(np.log(2.0) + spread * z / np.std(z, ddof=1))[:, np.newaxis]


@pytest.mark.parametrize(("spread", "worth"), [(0.3, 6.5), (0.5, 2.9)])
def test_machines_that_differ_by_so_much_are_worth_so_many_degrees_of_freedom(spread: float, worth: float) -> None:
    """Figures of monitoring.md, section 5; the equation solved by another method."""
    prior = fleet_prior(with_spread(spread), np.full((41, 1), 1e9))
    exact = 2 * optimize.brentq(lambda y: special.polygamma(1, y) - (2 * spread) ** 2, 0.05, 1e3, xtol=1e-13)
    assert_allclose(prior.degrees_of_freedom, exact, rtol=1e-7)
    assert prior.degrees_of_freedom[0] == pytest.approx(worth, abs=0.06)


@pytest.mark.parametrize(("worth", "own"), [(3.0, 9), (6.0, 5), (8.0, 19)])
def test_the_truth_is_found_where_variances_are_drawn_as_assumed(worth: float, own: int) -> None:
    """s^2 / s0^2 is F(d, nu0): 40 000 machines, drawn by scipy; the same by greatest likelihood."""
    s2 = 0.25 * stats.f.rvs(own, worth, size=40000, random_state=3)
    prior = fleet_prior(np.sqrt(s2)[:, np.newaxis], own)
    assert prior.degrees_of_freedom[0] == pytest.approx(worth, rel=0.06)
    assert prior.deviation[0] == pytest.approx(0.5, rel=0.01)

    def unlikely(at: np.ndarray) -> float:
        return -float(np.sum(stats.f.logpdf(s2[:8000] / np.exp(at[1]), own, np.exp(at[0])) - at[1]))

    found = optimize.minimize(unlikely, [1.0, 0.0], method="Nelder-Mead").x
    assert prior.degrees_of_freedom[0] == pytest.approx(np.exp(found[0]), rel=0.15)
    assert prior.deviation[0] ** 2 == pytest.approx(np.exp(found[1]), rel=0.05)


def test_twenty_machines_that_differ_by_half_give_about_three() -> None:
    """monitoring.md: 2.4 to 3.6 from 20 machines of ten tests. Here the middle half of 400 fleets."""
    random = np.random.default_rng(8)
    fleets = 2.0 * np.exp(0.5 * random.standard_normal((20, 400)))
    prior = fleet_prior(fleets * np.sqrt(random.chisquare(9, fleets.shape) / 9), 9.0)
    low, high = np.quantile(prior.degrees_of_freedom, [0.25, 0.75])
    assert 2.1 < low < 2.8
    assert 3.2 < high < 4.4


def test_machines_alike_are_worth_ten_and_their_scatter_is_the_common_one() -> None:
    random = np.random.default_rng(9)
    s = 3.0 * np.sqrt(random.chisquare(9, (4000, 1)) / 9)
    prior = fleet_prior(s, 9.0)
    assert prior.degrees_of_freedom[0] == 10
    assert prior.deviation[0] == pytest.approx(3.0, rel=0.02)
    same = fleet_prior(np.full((5, 1), 3.0), 9.0)
    assert same.degrees_of_freedom[0] == 10
    assert same.deviation[0] == pytest.approx(3.0 * np.exp((np.log(4.5) - special.digamma(4.5)) / 2))


def test_units_change_nothing_but_the_unit() -> None:
    random = np.random.default_rng(10)
    s, d = np.exp(random.standard_normal((12, 3))), random.integers(4, 20, (12, 3)).astype(float)
    one, thousand = fleet_prior(s, d), fleet_prior(1000 * s, d)
    assert_allclose(thousand.degrees_of_freedom, one.degrees_of_freedom, rtol=1e-9)
    assert_allclose(thousand.deviation, 1000 * one.deviation, rtol=1e-9)


def test_what_too_few_machines_have_is_not_known_and_a_stated_uncertainty_is_a_floor() -> None:
    s = np.array([[1.0, 1.0, np.nan], [1.4, 2.0, np.nan], [0.7, np.nan, np.nan], [1.1, np.nan, 1.0]])
    prior = fleet_prior(s, 9.0, floor=np.array([5.0, 0.0, 0.0]))
    assert prior.deviation[0] == 5.0
    assert np.all(np.isnan(prior.deviation[1:]))
    assert np.all(np.isnan(prior.degrees_of_freedom[1:]))
    alone = fleet_prior(s[:, :1], 9.0)
    assert 0.7 < alone.deviation[0] < 1.4
    nothing = fleet_prior(np.zeros((0, 2)), 9.0)
    assert np.all(np.isnan(nothing.deviation))


def test_without_a_fleet_it_is_the_stated_reproducibility_with_six_degrees_of_freedom() -> None:
    prior = default_prior([KINDS["stiffness"], KINDS["backlash"]], np.array([-20e3, 0.004]))
    assert_allclose(prior.deviation, [300.0, 0.5e-3])
    assert_allclose(prior.degrees_of_freedom, 6)


def test_one_machine_too_few_axes_is_refused() -> None:
    with pytest.raises(InputError, match=r"has shape \(4,\); give a row a machine"):
        fleet_prior(np.ones(4), np.ones(4))
