"""The worked examples of JCGM 100, 101 and 102 come out to their published digits.

Each published figure was seen in a public secondary source, named beside it; the data are facts of the guides. What has a
closed form is held against that too, derived here. Sources, by the names used below:

- GTC: repository MSLNZ/GTC, docs/API/GUM_H1.rst, GUM_H2.rst, GUM_H3.rst, and docstrings of GTC/type_a.py (GTC 1.5.1).
- suncal: repository sandialabs/suncal, test/test_examples.py, test/test_curvefit.py (`test_anovameans`) and
  test/ex_magphase.yaml; its example file of magnitude and phase names the clause, JCGM 102, 9.3.
- DB48X: help of the calculator firmware DB48X (repository c3d/db48x and forks, doc/calc-help/uncertainty.md), section GUMS1,
  "The four worked examples of Supplement 1 to the GUM": data, and the figures that the Supplement gives.
- gum5: the file gum5_full_benchmarks.py of a public set of regression gates for JCGM GUM-5:2026, which lists what that guide
  prints; its examples 7 and 16 are those of JCGM 101, 9.3 and 9.4.
- gumH1: a public TypeScript budget program, example "GUM H.1 - End-gauge calibration (worked example)" and its unit test,
  which list the published intermediate figures; the same final figures stand in the Python test
  `test_jcgm_100_annex_h1_end_gauge` of a package `propbench`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import product
from math import atan2, factorial, floor, inf, log, prod, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.optimize import brentq

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import factor_blocks, merge, solve
from elastogeo.estimate.distributions import Influence, coverage_factor
from elastogeo.estimate.factor import Array
from elastogeo.estimate.propagation import (
    BLOCK_TRIALS,
    MonteCarlo,
    effective_degrees_of_freedom,
    first_order,
    monte_carlo,
)

SIGMAS = 5.0
"""A Monte Carlo figure may be off by so many of its own standard errors."""


def rounded(value: float, published: str) -> bool:
    """Whether a value rounds to the published digits."""
    digits = len(published.partition(".")[2])
    return abs(value - float(published)) <= 0.5 * 10.0**-digits * (1 + 1e-9)


def assert_published(drawn: MonteCarlo, mean: str, uncertainty: str, output: int = 0) -> None:
    """Half a unit of what is printed, and the numerical tolerance to which the draws were asked to settle."""
    for value, printed in ((drawn.mean[output], mean), (drawn.standard_uncertainty[output], uncertainty)):
        unit = 10.0 ** -len(printed.partition(".")[2])
        assert abs(value - float(printed)) <= 0.5 * unit + drawn.tolerance[output]


def draw(inputs: Mapping[str, tuple[float, Influence]], model: Callable[..., Array]) -> Callable[..., Array]:
    """Draws of a model of independent inputs, each an estimate and what is known of its error."""

    def outputs(random: np.random.Generator, count: int) -> Array:
        values = {name: estimate + influence.draws(random, count) for name, (estimate, influence) in inputs.items()}
        return np.column_stack([model(**values)])

    return outputs


def assert_mean(drawn: MonteCarlo, expected: float, output: int = 0) -> None:
    error = drawn.standard_uncertainty[output] / sqrt(drawn.trials)
    assert abs(drawn.mean[output] - expected) <= SIGMAS * error


def assert_uncertainty(drawn: MonteCarlo, expected: float, kurtosis: float = 3.0, output: int = 0) -> None:
    """Standard error of a standard deviation: `u sqrt((kurtosis - 1) / (4 M))`."""
    error = expected * sqrt((kurtosis - 1) / (4 * drawn.trials))
    assert abs(drawn.standard_uncertainty[output] - expected) <= SIGMAS * error


def assert_end(value: float, expected: float, tail: float, density: float, trials: int) -> None:
    """Standard error of a quantile: `sqrt(q (1 - q) / M) / density`."""
    assert abs(value - expected) <= SIGMAS * sqrt(tail * (1 - tail) / trials) / density


# --- JCGM 100, H.1: calibration of an end gauge -------------------------------------------------------------------------

STANDARD = 50_000_623.0
"""Length of the standard [nm] (gumH1; GTC)."""

H1 = {
    "standard": (STANDARD, Influence("standard", 75 / 3, degrees_of_freedom=18)),
    "repeated": (215.0, Influence("repeated observations", 13 / sqrt(5), degrees_of_freedom=24)),
    "random": (0.0, Influence("comparator, random", 10 / float(coverage_factor(np.array(5.0))), degrees_of_freedom=5)),
    "systematic": (0.0, Influence("comparator, systematic", 20 / 3, degrees_of_freedom=8)),
    "expansion": (11.5e-6, Influence("expansion", 2e-6, "rectangular")),
    "mean": (-0.1, Influence("mean temperature", 0.2)),
    "cycle": (0.0, Influence("cycle of temperature", 0.5, "arcsine")),
    "unequal": (0.0, Influence("difference of expansion", 1e-6, "rectangular", 50)),
    "warmer": (0.0, Influence("difference of temperature", 0.05, "rectangular", 2)),
}
"""Estimate and knowledge of each input: nm, 1/K, K; from the raw statements of the certificates (gumH1)."""


def end_gauge(**v: Array) -> Array:
    """Length [nm] less 50 mm (JCGM 100, H.3)."""
    length = v["standard"] + v["repeated"] + v["random"] + v["systematic"]
    thermal = v["unequal"] * (v["mean"] + v["cycle"]) + v["expansion"] * v["warmer"]
    return length - v["standard"] * thermal - 50e6


def h1_sensitivities() -> Array:
    zero = {"expansion": 0.0, "mean": 0.0, "cycle": 0.0}
    by_name = {"unequal": STANDARD * 0.1, "warmer": -STANDARD * 11.5e-6, **zero}
    return np.array([[by_name.get(name, 1.0) for name in H1]])


def test_h1_end_gauge() -> None:
    u = np.array([influence.standard_uncertainty for _, influence in H1.values()])
    degrees = np.array([influence.degrees_of_freedom for _, influence in H1.values()])
    contributions = h1_sensitivities() * u
    named = dict(zip(H1, np.abs(contributions[0]), strict=True))
    # gumH1: 25; 5.8, 3.9, 6.7 and 9.7 together; 2.9; 16.6 nm; no first-order contribution of the others
    published = {
        "standard": "25",
        "repeated": "5.8",
        "random": "3.9",
        "systematic": "6.7",
        "unequal": "2.9",
        "warmer": "16.6",
    }
    assert {name: digits for name, digits in published.items() if not rounded(named[name], digits)} == {}
    assert named["expansion"] == named["mean"] == named["cycle"] == 0
    assert rounded(float(np.linalg.norm([named[n] for n in ("repeated", "random", "systematic")])), "9.7")
    # gumH1, propbench: l = 50.000 838 mm, uc^2 = 1002 nm^2, uc = 32 nm
    assert end_gauge(**{name: np.array(estimate) for name, (estimate, _) in H1.items()}) == pytest.approx(838, abs=1e-6)
    variance = first_order(h1_sensitivities(), np.diag(u**2))
    assert rounded(variance.item(), "1002")
    assert rounded(sqrt(variance.item()), "32")
    # gumH1: effective degrees of freedom 16.7, taken as 16 (JCGM 100, G.4.1 truncates), k99 = 2.92, U99 = 2.92 x 32 = 93 nm
    effective = effective_degrees_of_freedom(contributions, degrees)
    assert rounded(effective.item(), "16.7")
    k = coverage_factor(np.floor(effective), 0.99).item()
    assert rounded(k, "2.92")
    assert rounded(2.92 * 32, "93")
    assert rounded(round(k, 2) * round(sqrt(variance.item())), "93")


def test_h1_difference_of_the_gauges() -> None:
    """gumH1, suncal: u(d) = 9.7 nm with 25.6 degrees of freedom, from the rounded 5.8, 3.9, 6.7 nm and their rounded sum."""
    contributions = np.array([[5.8, 3.9, 6.7]])
    combined = float(np.linalg.norm(contributions))
    assert rounded(combined, "9.7")
    effective = effective_degrees_of_freedom(contributions, np.array([24.0, 5.0, 8.0])).item()
    assert rounded(effective * (9.7 / combined) ** 4, "25.6")


def test_h1_with_second_order_terms() -> None:
    """GTC: with the terms of second order the uncertainty is 34 nm, as the GUM says in H.1.7; draws see them at once."""
    known = {
        name: (estimate, Influence(influence.label, influence.scale, influence.distribution))
        for name, (estimate, influence) in H1.items()
    }
    drawn = monte_carlo(draw(known, end_gauge), seed=1)
    u = {name: influence.standard_uncertainty for name, (_, influence) in known.items()}
    first = float(first_order(h1_sensitivities(), np.diag(np.square(list(u.values())))).item())
    second = u["unequal"] ** 2 * (u["mean"] ** 2 + u["cycle"] ** 2) + u["expansion"] ** 2 * u["warmer"] ** 2
    exact = sqrt(first + (STANDARD**2 + u["standard"] ** 2) * second + u["standard"] ** 2 * (u["unequal"] * 0.1) ** 2)
    assert rounded(exact, "34")
    assert_mean(drawn, 838.0)
    assert_uncertainty(drawn, exact)
    assert_published(drawn, "838", "34")


# --- JCGM 100, H.2, and JCGM 102: simultaneous resistance and reactance -------------------------------------------------

VOLTAGE = [5.007, 4.994, 5.005, 4.990, 4.999]
CURRENT = [19.663e-3, 19.639e-3, 19.640e-3, 19.685e-3, 19.678e-3]
PHASE = [1.0456, 1.0438, 1.0468, 1.0428, 1.0433]
"""Five simultaneous observations [V, A, rad] (GTC, docstring of `multi_estimate_real`)."""


def impedance() -> tuple[Array, Array, Array]:
    """Estimates of R, X, Z, their sensitivities to V, I, phi, and the covariance of the means of V, I, phi."""
    observed = np.array([VOLTAGE, CURRENT, PHASE])
    V, current, phase = observed.mean(axis=1)
    Z, c, s = V / current, np.cos(phase), np.sin(phase)
    estimates = np.array([Z * c, Z * s, Z])
    sensitivities = np.array(
        [[c / current, -Z * c / current, -Z * s], [s / current, -Z * s / current, Z * c], [1 / current, -Z / current, 0]]
    )
    return estimates, sensitivities, np.cov(observed, ddof=1) / observed.shape[1]


def test_h2_resistance_reactance_impedance() -> None:
    estimates, sensitivities, covariance = impedance()
    # GTC: u(V) = 3.2 mV, u(I) = 9.5 uA, u(phi) = 0.75 mrad, correlations -0.36, 0.86, -0.65
    u = np.sqrt(np.diag(covariance))
    assert_allclose(u, [0.0032093613071761, 9.471008394041335e-06, 0.0007520638270785], rtol=1e-9)
    correlation = covariance / np.outer(u, u)
    for (i, j), published in {(0, 1): "-0.36", (0, 2): "0.86", (1, 2): "-0.65"}.items():
        assert rounded(correlation[i, j], published)
    result = first_order(sensitivities, covariance)
    uncertainty = np.sqrt(np.diag(result))
    # suncal (table H.4, printed from the second approach): 127.732, 219.847, 254.260 ohm; u = 0.071, 0.295, 0.236 ohm
    for value, published in zip(estimates, ("127.732", "219.847", "254.260"), strict=True):
        assert rounded(value, published)
    assert_allclose(uncertainty, [0.071, 0.295, 0.236], rtol=0, atol=0.001)
    # GTC: R = 127.732169928102..., u(R) = 0.071071407396995..., r(R, X) = -0.588429784423515...
    assert_allclose(estimates[0], 127.732169928102, rtol=1e-14)
    assert_allclose(uncertainty[0], 0.071071407396995, rtol=1e-12)
    correlation = result / np.outer(uncertainty, uncertainty)
    assert_allclose(correlation[0, 1], -0.588429784423515, rtol=1e-12)
    assert rounded(correlation[0, 2], "-0.49")
    assert rounded(correlation[1, 2], "0.99")


def test_h2_as_five_results_of_one_measurement() -> None:
    """The second approach of H.2: evaluate each set of observations, then the mean and its scatter (suncal's figures)."""
    V, current, phase = np.array(VOLTAGE), np.array(CURRENT), np.array(PHASE)
    Z = V / current
    results = ((Z * np.cos(phase), "127.732", "0.071"), (Z * np.sin(phase), "219.847", "0.295"), (Z, "254.260", "0.236"))
    for values, published, u in results:
        solution = solve(factor_blocks(["mean"], [np.column_stack([np.ones(5), values])]))
        assert rounded(solution.values.item(), published)
        assert rounded(solution.standard_uncertainty.item(), u)
        assert solution.degrees_of_freedom.item() == 4


def test_resistance_and_reactance_together_by_draws() -> None:
    """JCGM 102: the covariance of two outputs, by the law of propagation and by normal draws of the correlated inputs."""
    estimates, sensitivities, covariance = impedance()
    means = np.mean([VOLTAGE, CURRENT, PHASE], axis=1)
    root = np.linalg.cholesky(covariance)

    def outputs(random: np.random.Generator, count: int) -> Array:
        V, current, phase = means[:, np.newaxis] + root @ random.standard_normal((3, count))
        R, X = V / current * np.cos(phase), V / current * np.sin(phase)
        return np.column_stack([R, X, R + X])

    drawn = monte_carlo(outputs, seed=2)
    both = np.vstack([sensitivities[:2], sensitivities[:2].sum(axis=0)])
    linear = np.sqrt(np.diag(first_order(both, covariance)))
    for k, expected in enumerate((*estimates[:2], estimates[:2].sum())):
        assert_mean(drawn, expected, k)
        assert_uncertainty(drawn, linear[k], output=k)
    assert_published(drawn, "127.732", "0.071")
    u = drawn.standard_uncertainty
    assert (u[2] ** 2 - u[0] ** 2 - u[1] ** 2) / (2 * u[0] * u[1]) == pytest.approx(-0.588, abs=0.01)


# --- JCGM 100, H.3: calibration of a thermometer ------------------------------------------------------------------------

READINGS = [21.521, 22.012, 22.512, 23.003, 23.507, 23.999, 24.513, 25.002, 25.503, 26.010, 26.511]
CORRECTIONS = [-0.171, -0.169, -0.166, -0.159, -0.164, -0.165, -0.156, -0.157, -0.159, -0.161, -0.160]
"""Readings and observed corrections [degC] (GTC, GUM_H3.rst)."""


def test_h3_thermometer() -> None:
    t = np.array(READINGS)
    rows = np.column_stack([np.ones_like(t), t - 20, CORRECTIONS])
    solution = solve(factor_blocks(["y1", "y2"], [rows]))
    # GTC: -0.1712(29), 0.00218(67), correlation -0.93; correction at 30 degC -0.1494(41); 9 degrees of freedom
    assert rounded(solution.values[0], "-0.1712")
    assert rounded(solution.values[1], "0.00218")
    assert rounded(solution.standard_uncertainty[0], "0.0029")
    assert rounded(solution.standard_uncertainty[1], "0.00067")
    correlation = solution.covariance[0, 1] / prod(solution.standard_uncertainty)
    assert rounded(correlation, "-0.93")
    at_30 = np.array([[1.0, 10.0]])
    assert rounded((at_30 @ solution.values).item(), "-0.1494")
    assert rounded(sqrt(first_order(at_30, solution.covariance).item()), "0.0041")
    assert set(solution.degrees_of_freedom) == {9}
    # GTC, all digits of its output
    assert_allclose(solution.values, [-0.17120379013135004, 0.0021826977398872894], rtol=1e-12)
    assert_allclose(solution.standard_uncertainty[1], 0.0006679387732278323, rtol=1e-12)
    assert_allclose(9 * solution.residual_std**2, 0.000110096583109, rtol=1e-11)


# --- JCGM 100, H.5: analysis of variance --------------------------------------------------------------------------------

DAY_MEANS = 10 + 1e-6 * np.array([172.0, 116.0, 13.0, 144.0, 106.0, 31.0, 60.0, 125.0, 163.0, 41.0])
DAY_DEVIATIONS = 1e-6 * np.array([60.0, 77.0, 111.0, 101.0, 67.0, 93.0, 80.0, 73.0, 88.0, 86.0])
"""Means of five observations on each of ten days, and their standard deviations [V] (suncal, `test_anovameans`)."""


def day_observations() -> Array:
    """Five observations a day with those means and standard deviations, shape (10, 5): the analysis sees no more of them."""
    pattern = np.array([-2.0, -1.0, 0.0, 1.0, 2.0]) / sqrt(2.5)
    return DAY_MEANS[:, np.newaxis] + DAY_DEVIATIONS[:, np.newaxis] * pattern


def test_h5_analysis_of_variance() -> None:
    days = [f"day {k}" for k in range(1, 11)]
    rows = np.zeros((10, 5, 12))
    rows[:, :, 0] = 1.0
    rows[np.arange(10), :, np.arange(10) + 1] = 1.0
    rows[:, :, -1] = day_observations() - 10
    factor = merge(*(factor_blocks(["mean", *days], [day]) for day in rows))
    within, total = solve(factor, days), solve(factor, ["mean"])
    between = 49 * total.residual_std**2 - 40 * within.residual_std**2
    # suncal: 10.000 097 V; s of the day means 57 uV; s within a day 85 uV; F = 2.25, given as the square of 128/85 in H.27
    assert rounded(10 + total.values.item(), "10.000097")
    assert rounded(1e6 * within.residual_std, "85")
    assert set(within.degrees_of_freedom) == {40}
    assert rounded(1e6 * sqrt(between / 9 / 5), "57")
    assert between / 9 / within.residual_std**2 == pytest.approx(2.25, abs=0.02)
    # The day effect counts: the mean of the ten day means, with 9 degrees of freedom. 57/sqrt(10) in closed form.
    means = solve(factor_blocks(["mean"], [np.column_stack([np.ones(10), DAY_MEANS - 10])]))
    assert rounded(1e6 * means.residual_std, "57")
    assert_allclose(means.standard_uncertainty, means.residual_std / sqrt(10))
    assert means.degrees_of_freedom.item() == 9


# --- JCGM 101, 9.2: sums of four inputs ---------------------------------------------------------------------------------


def sum_of_rectangles(widths: list[float]) -> Callable[[float], float]:
    """Distribution function of a sum of independent rectangular errors of these half-widths (truncated powers, exact)."""
    n = len(widths)

    def cdf(x: float) -> float:
        signs = product((1, -1), repeat=n)
        powers = (prod(s) * max(x + float(np.dot(s, widths)), 0.0) ** n for s in signs)
        return sum(powers) / (factorial(n) * prod(2 * w for w in widths))

    return cdf


SUMS = {
    # DB48X: u, ends of the 95 % interval, and the ends by the law of propagation
    "9.2.2": (["normal"] * 4, [1.0] * 4, "2.00", "3.92", "3.92"),
    "9.2.3": (["rectangular"] * 4, [sqrt(3)] * 4, "2.00", "3.88", "3.92"),
    "9.2.4": (["rectangular"] * 4, [sqrt(3)] * 3 + [10 * sqrt(3)], "10.1", "17.0", "19.9"),
}


@pytest.mark.parametrize("clause", SUMS)
def test_s1_sum(clause: str) -> None:
    kinds, scales, published_u, published_end, published_linear = SUMS[clause]
    names = ["a", "b", "c", "d"]
    inputs = {n: (0.0, Influence(n, s, kind)) for n, s, kind in zip(names, scales, kinds, strict=True)}
    u = np.array([influence.standard_uncertainty for _, influence in inputs.values()])
    exact = sqrt(first_order(np.ones((1, 4)), np.diag(u**2)).item())
    assert_allclose(exact, 2.0 if clause != "9.2.4" else sqrt(103), rtol=1e-15)
    assert rounded(exact, published_u)
    assert rounded(exact * coverage_factor(np.array(inf)).item(), published_linear)
    if kinds[0] == "normal":
        end, density, kurtosis = 1.959963984540054 * 2, 0.05844507 / 2, 3.0
    else:
        cdf = sum_of_rectangles(scales)
        end = brentq(lambda x: cdf(x) - 0.975, 0, sum(scales))
        density = (cdf(end + 1e-4) - cdf(end - 1e-4)) / 2e-4
        kurtosis = 3 - 1.2 * float(np.sum(u**4)) / exact**4
    assert rounded(end, published_end)
    drawn = monte_carlo(draw(inputs, lambda a, b, c, d: a + b + c + d), digits=3, seed=3)
    assert_mean(drawn, 0.0)
    assert_uncertainty(drawn, exact, kurtosis)
    for value, expected in zip(drawn.interval[0], (-end, end), strict=True):
        assert_end(value, expected, 0.025, density, drawn.trials)


def test_s1_sum_of_rectangles_has_the_end_of_the_closed_form() -> None:
    """In the last cell of Irwin and Hall the tail is a fourth power: the end is `2 sqrt(3) (2 - 0.6^(1/4))`."""
    cdf = sum_of_rectangles([sqrt(3)] * 4)
    assert_allclose(brentq(lambda x: cdf(x) - 0.975, 0, 6), 2 * sqrt(3) * (2 - 0.6**0.25), rtol=1e-12)


# --- JCGM 101, 9.3: mass calibration ------------------------------------------------------------------------------------

MASS = {
    "reference": (100_000.0, Influence("reference mass", 0.050)),
    "added": (1.234, Influence("added mass", 0.020)),
    "air": (1.2, Influence("density of air", 0.1, "rectangular")),
    "weight": (8000.0, Influence("density of the weight", 1000.0, "rectangular")),
    "standard": (8000.0, Influence("density of the reference", 50.0, "rectangular")),
}
"""Inputs [mg, kg/m^3] (DB48X, S1Mass)."""


def mass_deviation(**v: Array) -> Array:
    """Deviation from 100 g [mg]."""
    return (v["reference"] + v["added"]) * (1 + (v["air"] - 1.2) * (1 / v["weight"] - 1 / v["standard"])) - 100_000


def test_s1_mass() -> None:
    u = np.array([influence.standard_uncertainty for _, influence in MASS.values()])
    # DB48X: the law of propagation gives 0.0539 mg, draws 0.0754 mg, both about 1.234 mg
    sensitivities = np.array([[1.0, 1.0, 0.0, 0.0, 0.0]])
    assert rounded(sqrt(first_order(sensitivities, np.diag(u**2)).item()), "0.0539")
    # Exact: the two factors of the buoyancy are independent and the first has mean zero.
    reciprocal = {a: (log((d + a) / (d - a)) / (2 * a), 1 / (d * d - a * a)) for d, a in ((8000.0, 1000.0), (8000.0, 50.0))}
    (mean_w, square_w), (mean_r, square_r) = reciprocal[1000.0], reciprocal[50.0]
    buoyancy = u[2] ** 2 * (square_w - 2 * mean_w * mean_r + square_r)
    scatter = u[0] ** 2 + u[1] ** 2
    exact = sqrt(scatter + (scatter + 100_001.234**2) * buoyancy)
    # gum5: 0.0750 mg with the terms of second order, the mixed derivatives of the density of air and those of the weights
    mixed = 100_001.234 * u[2] / 8000.0**2 * np.array([u[3], u[4]])
    assert rounded(sqrt(scatter + float(mixed @ mixed)), "0.0750")
    # The Supplement's figure is one of draws, of up to 10^6 trials (DB48X): its own standard error is 0.5e-4 mg or more.
    assert abs(exact - 0.0754) <= 0.5e-4 + 2 * exact / sqrt(2e6)
    drawn = monte_carlo(draw(MASS, mass_deviation), seed=4)
    assert_mean(drawn, 1.234)
    assert_uncertainty(drawn, exact, kurtosis=4.0)
    assert_published(drawn, "1.234", "0.0754")


# --- JCGM 101, 9.4: comparison loss of a microwave power meter ----------------------------------------------------------


def comparison_loss(x1: float, correlation: float) -> Callable[..., Array]:
    """Draws of `X1^2 + X2^2` [10^-6], u = 0.005 for both, x2 = 0 (DB48X, S1Power)."""
    influence = Influence("reflection", 0.005)

    def outputs(random: np.random.Generator, count: int) -> Array:
        one, other = influence.draws(random, count), influence.draws(random, count)
        first, second = x1 + one, correlation * one + sqrt(1 - correlation**2) * other
        return 1e6 * (first**2 + second**2)[:, np.newaxis]

    return outputs


LOSSES = {(0.0, 0.0): ("50", "0"), (0.0, 0.9): ("67", "0"), (0.010, 0.0): ("112", "100"), (0.010, 0.9): ("121", "100")}
"""Standard uncertainty [10^-6] by draws and by the law of propagation, by x1 and correlation (DB48X, S1Power; 67: gum5)."""


@pytest.mark.parametrize(("x1", "correlation"), LOSSES)
def test_s1_comparison_loss(x1: float, correlation: float) -> None:
    by_draws, linear = LOSSES[x1, correlation]
    covariance = 0.005**2 * np.array([[1.0, correlation], [correlation, 1.0]])
    gradient = np.array([[2 * x1, 0.0]])
    assert rounded(1e6 * sqrt(first_order(gradient, covariance).item()), linear)
    # Exact moments of a quadratic form of normal errors: cumulants k_n = 2^(n-1) (n-1)! (tr S^n + n x^T S^(n-1) x)
    powers = [np.linalg.matrix_power(covariance, n) for n in range(5)]
    cumulants = [0.0] + [
        2.0 ** (n - 1) * factorial(n - 1) * (np.trace(powers[n]) + n * x1 * x1 * powers[n - 1][0, 0]) for n in range(1, 5)
    ]
    exact = 1e6 * sqrt(cumulants[2])
    assert rounded(exact, by_draws)
    drawn = monte_carlo(comparison_loss(x1, correlation), seed=5)
    assert_mean(drawn, 1e6 * (x1**2 + 2 * 0.005**2))
    assert_uncertainty(drawn, exact, kurtosis=3 + cumulants[4] / cumulants[2] ** 2)
    assert_published(drawn, f"{1e6 * (x1**2 + 2 * 0.005**2):.0f}", by_draws)


def test_s1_comparison_loss_has_a_one_sided_shortest_interval() -> None:
    """DB48X: [0, 150] 10^-6, and [1.3, 184] 10^-6 probabilistically symmetric: chi-square of two degrees is exponential."""
    drawn = monte_carlo(comparison_loss(0.0, 0.0), seed=6)
    quantile = {q: -50 * log(1 - q) for q in (0.025, 0.95, 0.975)}
    assert rounded(quantile[0.95], "150")
    assert rounded(quantile[0.025], "1.3")
    assert rounded(quantile[0.975], "184")
    assert_end(drawn.interval[0, 0], quantile[0.025], 0.025, 0.975 / 50, drawn.trials)
    assert_end(drawn.interval[0, 1], quantile[0.975], 0.025, 0.025 / 50, drawn.trials)
    low, high = drawn.shortest[0]
    assert 0 <= low < 0.5
    assert_end(high - low, quantile[0.95], 0.05, 0.05 / 50, drawn.trials)


# --- JCGM 101, 9.5: gauge block calibration -----------------------------------------------------------------------------

S1_GAUGE = {
    **H1,
    "repeated": (215.0, Influence("repeated observations", 6.0, degrees_of_freedom=24)),
    "random": (0.0, Influence("comparator, random", 4.0, degrees_of_freedom=5)),
    "systematic": (0.0, Influence("comparator, systematic", 7.0, degrees_of_freedom=8)),
}
"""As H.1 with rounded scales; limits of 1e-6 and 0.05 K, themselves known to 0.1e-6 and 0.025 K (DB48X, S1Gauge)."""


def student(influence: Influence) -> float:
    """Variance of Student's draws."""
    return influence.scale**2 * influence.degrees_of_freedom / (influence.degrees_of_freedom - 2)


def uncertain_limits(influence: Influence) -> float:
    """Variance of rectangular draws whose limits are rectangular themselves: `a^2/3 + d^2/9` (JCGM 101, 6.4.3.3)."""
    d = influence.scale / sqrt(2 * influence.degrees_of_freedom)
    return influence.scale**2 / 3 + d**2 / 9


def test_s1_gauge_block() -> None:
    known = {name: influence for name, (_, influence) in S1_GAUGE.items()}
    u = np.array([influence.standard_uncertainty for influence in known.values()])
    # DB48X: 838 nm; 32 nm by the law of propagation, 36 nm by draws
    assert rounded(sqrt(first_order(h1_sensitivities(), np.diag(u**2)).item()), "32")
    # Exact: both differences have mean zero and are independent of what they multiply.
    lengths = sum(student(known[name]) for name in ("standard", "repeated", "random", "systematic"))
    temperature = 0.1**2 + 0.2**2 + 0.5**2 / 2
    expansion = 11.5e-6**2 + (2e-6) ** 2 / 3
    thermal = uncertain_limits(known["unequal"]) * temperature + uncertain_limits(known["warmer"]) * expansion
    exact = sqrt(lengths + (STANDARD**2 + student(known["standard"])) * thermal)
    assert rounded(exact, "36")
    drawn = monte_carlo(draw(S1_GAUGE, end_gauge), coverage=0.99, digits=2, seed=7)
    assert_mean(drawn, 838.0)
    assert_uncertainty(drawn, exact, kurtosis=4.0)
    assert_published(drawn, "838", "36")


# --- JCGM 102, 9.3: magnitude and phase of a complex quantity -----------------------------------------------------------

POLAR = {
    # suncal, `test_GUMSUP2` (tables 6 and 7 of the Supplement): mean and u of the magnitude, of the phase [rad], by draws
    (0.001, 0.0): ("0.013", "0.007", "0.000", "1.744"),
    (0.001, 0.9): ("0.012", "0.008", "-0.556", "1.599"),
    (0.010, 0.9): ("0.015", "0.008", "-0.343", "0.903"),
}


def polar_moments(x1: float, correlation: float) -> tuple[float, float, float, float]:
    """Mean and standard deviation of magnitude and phase, by quadrature over the angle: the radius has closed forms.

    The density along a ray at angle t is `r exp(-(a r^2 - 2 b r + c) / 2) / (2 pi u^2 sqrt(1 - correlation^2))`.
    """
    u, root = 0.01, sqrt(1 - correlation**2)
    weight = np.linalg.inv(u**2 * np.array([[1.0, correlation], [correlation, 1.0]]))
    centre = np.array([x1, 0.0])
    c = float(centre @ weight @ centre)
    radii = np.linspace(0.0, 0.12, 4001)

    def along(angle: float, power: int) -> float:
        ray = np.array([np.cos(angle), np.sin(angle)])
        a, b = float(ray @ weight @ ray), float(ray @ weight @ centre)
        density = radii ** (power + 1) * np.exp(-(a * radii**2 - 2 * b * radii + c) / 2) / (2 * np.pi * u**2 * root)
        return float(np.trapezoid(density, radii))

    def moment(power: int, function: Callable[[float], float]) -> float:
        return quad(lambda t: function(t) * along(t, power), -np.pi, np.pi, limit=400, epsabs=1e-10)[0]

    magnitude, phase = moment(1, lambda _: 1.0), moment(0, lambda t: t)
    spread = moment(2, lambda _: 1.0) - magnitude**2, moment(0, lambda t: t * t) - phase**2
    return magnitude, sqrt(spread[0]), phase, sqrt(spread[1])


@pytest.mark.parametrize(("x1", "correlation"), POLAR)
def test_s2_magnitude_and_phase(x1: float, correlation: float) -> None:
    influence = Influence("component", 0.01)

    def outputs(random: np.random.Generator, count: int) -> Array:
        one, other = influence.draws(random, count), influence.draws(random, count)
        real, imaginary = x1 + one, correlation * one + sqrt(1 - correlation**2) * other
        return np.column_stack([np.hypot(real, imaginary), np.arctan2(imaginary, real)])

    # suncal: by the law of propagation u = 0.010 and 10.000 rad at 0.001, 1.000 rad at 0.010
    covariance = 1e-4 * np.array([[1.0, correlation], [correlation, 1.0]])
    linear = np.sqrt(np.diag(first_order(np.array([[1.0, 0.0], [0.0, 1 / x1]]), covariance)))
    assert rounded(linear[0], "0.010")
    assert rounded(linear[1], {0.001: "10.000", 0.010: "1.000"}[x1])
    assert atan2(0.0, x1) == 0
    exact = polar_moments(x1, correlation)
    for value, published in zip(exact, POLAR[x1, correlation], strict=True):
        assert rounded(value, published)
    drawn = monte_carlo(outputs, seed=8)
    for output in (0, 1):
        assert_published(drawn, *POLAR[x1, correlation][2 * output : 2 * output + 2], output)
        assert_mean(drawn, exact[2 * output], output)
        assert_uncertainty(drawn, exact[2 * output + 1], kurtosis=4.0, output=output)


# --- What these examples need of the tools ------------------------------------------------------------------------------


@pytest.mark.parametrize("degrees", [0.5, 2.0, 50.0])
def test_uncertain_limits_spread_as_jcgm_101_says(degrees: float) -> None:
    influence = Influence("limits", 3.0, "rectangular", degrees)
    draws = influence.draws(np.random.default_rng(9), 1_000_000)
    exact = uncertain_limits(influence)
    assert influence.standard_uncertainty == pytest.approx(3.0 / sqrt(3), rel=1e-15)
    assert np.var(draws) == pytest.approx(exact, rel=SIGMAS * sqrt(3 / len(draws)))
    widest = 3.0 * (1 + 1 / sqrt(2 * degrees))
    assert 0.97 * widest < np.abs(draws).max() <= widest
    certain = Influence("limits", 3.0, "rectangular").draws(np.random.default_rng(9), 1000)
    assert np.abs(certain).max() <= 3.0


@pytest.mark.parametrize("distribution", ["triangular", "arcsine"])
def test_other_limits_must_be_known(distribution: str) -> None:
    with pytest.raises(InputError, match=f"a {distribution} distribution cannot have finite degrees of freedom"):
        Influence("limits", 1.0, distribution, 5)


def test_limits_less_certain_than_wide_are_refused() -> None:
    with pytest.raises(InputError, match=r"a rectangular distribution needs at least 0\.5"):
        Influence("limits", 1.0, "rectangular", 0.4)


def test_high_coverage_draws_enough_at_once() -> None:
    sizes = []

    def outputs(random: np.random.Generator, count: int) -> Array:
        sizes.append(count)
        return random.standard_normal((count, 1))

    monte_carlo(outputs, coverage=0.999, digits=1)
    assert set(sizes) == {100_000}
    sizes.clear()
    monte_carlo(outputs, coverage=0.99, digits=1)
    assert set(sizes) == {BLOCK_TRIALS}
    with pytest.raises(UnsupportedError, match="are not stable to 1 digits"):
        monte_carlo(outputs, coverage=0.9999999, digits=1)


@pytest.mark.parametrize("coverage", [0.0, 1.0, 95.0, float("nan")])
def test_a_coverage_that_is_no_probability_is_refused(coverage: float) -> None:
    with pytest.raises(InputError, match="a coverage probability lies between 0 and 1, got"):
        monte_carlo(lambda random, count: random.standard_normal((count, 1)), coverage=coverage)


def test_outputs_that_are_no_numbers_are_refused() -> None:
    def outputs(random: np.random.Generator, count: int) -> Array:
        draws = random.standard_normal((count, 2))
        draws[: floor(count / 4), 1] = np.nan
        return draws

    with pytest.raises(InputError, match="2500 of 10000 Monte Carlo trials gave an output that is NaN or infinite"):
        monte_carlo(outputs)
