"""Type A uncertainty from repeated runs (thesis 4.7): what the 25 combinations say, and what they do not.

Two levels, five runs each, one parameter. A run's error is a constant factor of its own (the machine was a little softer
that day), so that a run is one piece of evidence however many readings it has.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import integrate, stats

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate import Factor, Repeatability, factor_blocks, repeatability
from elastogeo.estimate.factor import Array

FORCES = (328.0, 454.0)
RUNS = 5
DRAWS = 600
T25 = 2.0638985616280205
"""Student's factor for 95 % with the 24 degrees of freedom that 25 independent values would have."""

PATTERN = np.cos(np.linspace(0, 2 * np.pi, 12, endpoint=False)) ** 2
"""Response of the readings to the compliance, per newton."""

WEIGHTS = np.array(FORCES) ** 2 / np.sum(np.square(FORCES))
"""Weight of each level's mean in the least-squares estimate."""


def run_of(force: float, compliance: float, bias: float = 0.0) -> Factor:
    """One run: a design column, a second one that is not asked for, the readings."""
    column = force * PATTERN
    return factor_blocks(["C", "other"], [np.column_stack([column, PATTERN[::-1], compliance * column + bias])])


def repeated(errors: Array) -> Repeatability:
    """Of runs whose compliance is 1 plus these errors, shape (levels, runs)."""
    levels = {f"{f:g} N": [run_of(f, 1 + e) for e in level] for f, level in zip(FORCES, errors, strict=True)}
    return repeatability(levels, ["C"])


@cache
def draws() -> list[Repeatability]:
    random = np.random.default_rng(47)
    return [repeated(errors) for errors in 0.01 * random.standard_normal((DRAWS, len(FORCES), RUNS))]


def covered(half_widths: Array) -> float:
    """How often the mean lies within a half-width of the truth."""
    means = np.array([r.solution.values[0] for r in draws()])
    return float(np.mean(np.abs(means - 1) <= half_widths))


def binomial_tolerance(rate: float) -> float:
    """What a rate seen in the draws may differ from the true one, at 99.9 %."""
    return 3.29 * float(np.sqrt(rate * (1 - rate) / DRAWS))


def exact_coverage(factor: float) -> float:
    """How often `mean +- factor * standard deviation of the combinations` covers the truth: by integration.

    The square of that standard deviation is 20/24 of `w1^2 s1^2 + w2^2 s2^2`, each s^2 over chi-squared of 4 degrees of
    freedom; given them, the mean is normal with `(w1^2 + w2^2) / 5`.
    """
    a, b = WEIGHTS**2
    spread = np.sqrt((a + b) / RUNS)

    def inside(u: float, v: float) -> float:
        half = factor * np.sqrt(20 / 24 * (a * u + b * v) / (RUNS - 1))
        density = stats.chi2.pdf(u, RUNS - 1) * stats.chi2.pdf(v, RUNS - 1)
        return float((2 * stats.norm.cdf(half / spread) - 1) * density)

    return float(integrate.dblquad(inside, 0, 40, 0, 40, epsabs=1e-5)[0])


def test_the_mean_of_all_combinations_is_the_estimate_of_all_runs() -> None:
    result = draws()[0]
    assert result.combinations.shape == (25, 1)
    assert result.runs == {"328 N": 5, "454 N": 5}
    assert_allclose(result.combination_mean, result.solution.values, rtol=1e-12)


def test_the_spread_of_all_combinations_is_that_of_one_pair() -> None:
    """Its square is 20/24 of the unbiased variance of a pair: algebra, not chance; so is the factor 2.04 to the mean's."""
    random = np.random.default_rng(1)
    for errors in 0.01 * random.standard_normal((5, 2, RUNS)):
        result = repeated(errors)
        one_pair = np.sqrt(np.sum(WEIGHTS**2 * errors.var(axis=1, ddof=1)))
        assert_allclose(result.combination_std[0], np.sqrt(20 / 24) * one_pair, rtol=1e-9)
        assert_allclose(result.solution.standard_uncertainty[0], one_pair / np.sqrt(RUNS), rtol=1e-9)
        ratio = result.combination_std[0] / result.solution.standard_uncertainty[0]
        assert ratio == pytest.approx(2.04, abs=0.005)
        assert ratio == pytest.approx(np.sqrt(20 / 24 * RUNS), rel=1e-9)


def test_degrees_of_freedom_are_those_of_welch_and_satterthwaite() -> None:
    errors = np.array([[0.01, -0.02, 0.03, 0.0, 0.005], [0.002, -0.001, 0.004, 0.0, -0.003]])
    a, b = WEIGHTS**2 * errors.var(axis=1, ddof=1)
    assert_allclose(repeated(errors).solution.degrees_of_freedom, (a + b) ** 2 / (a**2 / 4 + b**2 / 4), rtol=1e-9)
    degrees = np.array([r.solution.degrees_of_freedom[0] for r in draws()])
    assert degrees.min() >= 4 - 1e-9
    assert degrees.max() <= 8 + 1e-9
    assert np.ptp(degrees) > 3


def test_the_run_level_interval_covers_95_percent() -> None:
    intervals = np.array([r.solution.interval()[0] for r in draws()])
    rate = covered(np.diff(intervals, axis=1)[:, 0] / 2)
    # Welch-Satterthwaite is an approximation: with 4 + 4 degrees of freedom it is right to about a percent.
    assert rate == pytest.approx(0.95, abs=binomial_tolerance(0.95) + 0.01)


def test_dividing_the_spread_by_the_root_of_25_covers_57_percent() -> None:
    spread = np.array([r.combination_std[0] for r in draws()])
    exact = exact_coverage(T25 / 5)
    assert exact == pytest.approx(0.57, abs=0.01)
    assert covered(T25 * spread / 5) == pytest.approx(exact, abs=binomial_tolerance(exact))


def test_the_spread_of_the_combinations_itself_covers_far_too_much() -> None:
    spread = np.array([r.combination_std[0] for r in draws()])
    exact = exact_coverage(T25)
    assert exact > 0.99
    assert covered(T25 * spread) == pytest.approx(exact, abs=binomial_tolerance(exact) + 1e-3)


@pytest.mark.parametrize("counts", [(2, 3), (3, 2, 4)])
def test_levels_may_have_different_numbers_of_runs(counts: tuple[int, ...]) -> None:
    random = np.random.default_rng(3)
    forces = (100.0, 200.0, 400.0)[: len(counts)]
    errors = [random.standard_normal(n) for n in counts]
    levels = {f"{f}": [run_of(f, e) for e in level] for f, level in zip(forces, errors, strict=True)}
    result = repeatability(levels, ["C"])
    information = np.array([n * f**2 for n, f in zip(counts, forces, strict=True)])
    weights = information / information.sum()
    variance = [w**2 * e.var(ddof=1) / len(e) for w, e in zip(weights, errors, strict=True)]
    assert_allclose(result.solution.values, np.sum(weights * [e.mean() for e in errors]), rtol=1e-9)
    assert_allclose(result.solution.standard_uncertainty**2, np.sum(variance), rtol=1e-9)
    freedoms = np.sum(variance) ** 2 / np.sum([v**2 / (n - 1) for v, n in zip(variance, counts, strict=True)])
    assert_allclose(result.solution.degrees_of_freedom, freedoms, rtol=1e-9)
    assert len(result.combinations) == np.prod(counts)


def test_two_parameters_have_a_run_level_covariance() -> None:
    """Against the covariance of the means of runs that each give an estimate of their own: equal designs, one level."""
    random = np.random.default_rng(5)
    A = random.standard_normal((30, 2)) * [1.0, 1e6]
    runs = [A @ (np.array([3.0, 4e-6]) + 0.1 * random.standard_normal(2) * [1.0, 1e-6]) for _ in range(6)]
    factors = [factor_blocks(["a", "b"], [np.column_stack([A, y])]) for y in runs]
    each = np.array([np.linalg.lstsq(A / [1.0, 1e6], y, rcond=None)[0] / [1.0, 1e6] for y in runs])
    result = repeatability({"level": factors}, ["a", "b"])
    assert_allclose(result.solution.values, each.mean(axis=0), rtol=1e-9)
    expected = np.cov(each, rowvar=False) / 6
    u = np.sqrt(np.diag(expected))
    assert_allclose(result.solution.covariance / np.outer(u, u), expected / np.outer(u, u), atol=1e-8)
    assert_allclose(result.solution.degrees_of_freedom, 5)


@pytest.mark.parametrize(
    ("levels", "message"),
    [({}, "no level has fewer"), ({"100 N": 1, "200 N": 3}, "at every level; 100 N has fewer")],
)
def test_a_single_run_has_no_scatter(levels: dict[str, int], message: str) -> None:
    runs = {name: [run_of(100.0, 1.0)] * count for name, count in levels.items()}
    with pytest.raises(DegreesOfFreedomError, match=f"needs at least two runs .*{message}"):
        repeatability(runs, ["C"])
