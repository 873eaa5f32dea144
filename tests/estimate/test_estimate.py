"""An estimate: its interval is Student's, its inverse follows the law of propagation, what is none is refused."""

import numpy as np
import pytest
from scipy.stats import t

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate, factor_blocks, solve


def test_the_interval_is_that_of_gum_h1() -> None:
    """JCGM 100, H.1.6: 50.000838 mm, u = 32 nm, 16 effective degrees of freedom, k = 2.92 at 99 %: U = 93 nm."""
    found = Estimate(50.000838e6, 32.0, 16)
    assert found.expanded(0.99) == pytest.approx(93, abs=0.5)
    low, high = found.interval(0.99)
    assert (high - low) / 2 == pytest.approx(found.expanded(0.99))


def test_a_known_uncertainty_has_the_normal_interval() -> None:
    assert Estimate(0.0, 1.0).expanded() == pytest.approx(1.959964, abs=1e-6)


def test_an_estimate_in_another_unit_keeps_its_relative_uncertainty() -> None:
    found = Estimate(-2.0, 0.1, 5).scaled(-1e6)
    assert (found.value, found.standard_uncertainty, found.degrees_of_freedom) == (2e6, 1e5, 5)


def test_the_inverse_has_the_same_relative_uncertainty() -> None:
    found = Estimate(-4.0, 0.2, 12).inverse()
    assert found.value == -0.25
    assert found.standard_uncertainty / abs(found.value) == pytest.approx(0.05)
    assert found.degrees_of_freedom == 12


def test_a_value_whose_uncertainty_nothing_shows_has_no_interval() -> None:
    found = Estimate(4.0, float("inf"))
    assert not found.known
    assert Estimate(4.0, 0.0).known
    assert found.interval() == (-float("inf"), float("inf"))
    assert found.inverse() == Estimate(0.25, float("inf"))
    assert found.scaled(-2.0) == Estimate(-8.0, float("inf"))


def test_the_inverse_of_what_may_be_zero_is_refused() -> None:
    with pytest.raises(UnsupportedError, match=r"interval -0.96 to 2.96, which holds zero: its inverse is unbounded"):
        Estimate(1.0, 1.0).inverse()


@pytest.mark.parametrize("wrong", [(float("nan"), 1.0), (1.0, float("nan")), (1.0, -1.0)])
def test_what_is_no_estimate_is_refused(wrong: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="is no estimate"):
        Estimate(*wrong)


def test_no_degrees_of_freedom_are_refused() -> None:
    with pytest.raises(InputError, match="has 0 degrees of freedom; it needs more than 0"):
        Estimate(1.0, 1.0, 0)


def test_a_solution_gives_its_estimates_by_label() -> None:
    """The mean of three readings: u = s / sqrt(3), two degrees of freedom (JCGM 100, 4.2)."""
    rows = np.asfortranarray(np.column_stack([np.ones(3), [1.0, 2.0, 3.0]]))
    found = solve(factor_blocks(["mean"], [rows]))
    assert found.estimates() == (found.estimate("mean"),)
    mean = found.estimate("mean")
    assert mean.value == pytest.approx(2.0)
    assert mean.standard_uncertainty == pytest.approx(1 / 3**0.5)
    assert mean.interval()[1] - mean.value == pytest.approx(t.ppf(0.975, 2) / 3**0.5)
