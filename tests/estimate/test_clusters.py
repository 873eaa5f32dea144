"""Uncertainty by run: against the sandwich written out with dense matrices, against closed forms, and its coverage."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats
from scipy.linalg import block_diag, solve_triangular

from elastogeo.errors import DegreesOfFreedomError, InputError, RankError
from elastogeo.estimate import Factor, draw_estimates, factor_blocks, merge, solve, solve_as_runs_show, solve_by_run
from elastogeo.machine import Array

LABELS = ("a", "b", "c")


def factors(designs: Sequence[Array], readings: Sequence[Array], labels: Sequence[str] = LABELS) -> list[Factor]:
    pairs = zip(designs, readings, strict=True)
    return [factor_blocks(labels, [np.asfortranarray(np.column_stack([A, y]))]) for A, y in pairs]


@pytest.fixture(scope="module")
def problem() -> tuple[list[Array], list[Array]]:
    """Eight runs of unequal length, columns of very unequal size."""
    random = np.random.default_rng(1)
    designs = [random.standard_normal((n, 3)) * [1.0, 1e3, 1e-4] for n in (5, 9, 7, 12, 6, 8, 10, 5)]
    readings = [A @ [1.0, 2e-3, 3e4] + random.standard_normal() + random.standard_normal(len(A)) for A in designs]
    return designs, readings


def dense(designs: Sequence[Array], readings: Sequence[Array]) -> tuple[Array, Array]:
    """CR2 with its degrees of freedom (Bell and McCaffrey), with the whole m x m hat matrix."""
    A, y = np.vstack(designs), np.concatenate(readings)
    scale = np.linalg.norm(A, axis=0)
    A = A / scale
    bread = np.linalg.inv(A.T @ A)
    residual = y - A @ (bread @ A.T @ y)
    maker = np.eye(len(y)) - A @ bread @ A.T
    ends = np.cumsum([0, *map(len, designs)])
    parts = [slice(first, last) for first, last in pairwise(ends)]
    shares = []
    for part in parts:
        values, vectors = np.linalg.eigh(maker[part, part])
        shares.append(bread @ A[part].T @ (vectors / np.sqrt(values)) @ vectors.T)
    scores = [share @ residual[part] for share, part in zip(shares, parts, strict=True)]
    covariance = sum(np.outer(score, score) for score in scores)
    degrees = []
    for k in range(A.shape[1]):
        columns = np.column_stack([maker[:, part] @ share[k] for part, share in zip(parts, shares, strict=True)])
        eigenvalues = np.linalg.eigvalsh(columns.T @ columns)
        degrees.append(eigenvalues.sum() ** 2 / np.sum(eigenvalues**2))
    return covariance / np.outer(scale, scale), np.array(degrees)


def test_covariance_and_degrees_of_freedom_are_those_of_the_dense_formulas(
    problem: tuple[list[Array], list[Array]],
) -> None:
    designs, readings = problem
    solution = solve_by_run(factors(designs, readings), LABELS)
    covariance, degrees = dense(designs, readings)
    assert_allclose(solution.covariance, covariance, rtol=1e-9)
    assert_allclose(solution.degrees_of_freedom, degrees, rtol=1e-9)


def test_the_values_are_those_of_least_squares(problem: tuple[list[Array], list[Array]]) -> None:
    designs, readings = problem
    runs = factors(designs, readings)
    by_run, plain = solve_by_run(runs, LABELS), solve(merge(*runs))
    assert_allclose(by_run.values, plain.values, rtol=1e-12)
    assert by_run.residual_std == pytest.approx(plain.residual_std, rel=1e-12)
    assert_allclose(by_run.values, np.linalg.lstsq(np.vstack(designs), np.concatenate(readings), rcond=None)[0], rtol=1e-9)


def test_neither_order_of_runs_nor_units_matter(problem: tuple[list[Array], list[Array]]) -> None:
    designs, readings = problem
    plain = solve_by_run(factors(designs, readings), LABELS)
    back = solve_by_run(factors(designs, readings)[::-1], LABELS)
    assert_allclose(back.covariance, plain.covariance, rtol=1e-9)
    assert_allclose(back.degrees_of_freedom, plain.degrees_of_freedom, rtol=1e-9)
    unit = np.array([1e-3, 25.4, 1e6])
    other = solve_by_run(factors([A * unit for A in designs], [1e3 * y for y in readings]), LABELS)
    assert_allclose(other.values * unit, 1e3 * plain.values, rtol=1e-9)
    assert_allclose(other.standard_uncertainty * unit, 1e3 * plain.standard_uncertainty, rtol=1e-9)
    assert_allclose(other.degrees_of_freedom, plain.degrees_of_freedom, rtol=1e-9)


def test_fewer_parameters_are_solved_for_by_name(problem: tuple[list[Array], list[Array]]) -> None:
    designs, readings = problem
    chosen = solve_by_run(factors(designs, readings), ("c", "a"))
    alone = solve_by_run(factors([A[:, [2, 0]] for A in designs], readings, ("c", "a")), ("c", "a"))
    assert chosen.labels == ("c", "a")
    assert_allclose(chosen.covariance, alone.covariance, rtol=1e-9)


def test_the_mean_of_run_means() -> None:
    """Runs of equal length, one constant: the uncertainty of the mean of G run means, with G - 1 degrees of freedom."""
    random = np.random.default_rng(2)
    means = random.standard_normal(6)
    readings = [m + 1e-3 * random.standard_normal(20) for m in means]
    solution = solve_by_run(factors([np.ones((20, 1))] * 6, readings, ("mean",)), ("mean",))
    run_means = np.array([y.mean() for y in readings])
    assert solution.values[0] == pytest.approx(run_means.mean(), rel=1e-12)
    assert solution.standard_uncertainty[0] == pytest.approx(run_means.std(ddof=1) / np.sqrt(6), rel=1e-9)
    assert solution.degrees_of_freedom[0] == pytest.approx(5.0, rel=1e-9)


def test_runs_of_one_reading_are_white_noise() -> None:
    """Then CR2 is HC2, unbiased for readings of equal variance."""
    random = np.random.default_rng(3)
    x = np.linspace(-1, 1, 25)
    designs = [np.array([[1.0, v]]) for v in x]
    ratios = []
    for _ in range(400):
        y = [random.standard_normal(1) for _ in x]
        runs = factors(designs, y, ("a", "b"))
        ratios.append(np.diag(solve_by_run(runs, ("a", "b")).covariance))
    expected = np.diag(np.linalg.inv(np.vstack(designs).T @ np.vstack(designs)))
    deviation = np.std(ratios, axis=0) / np.sqrt(len(ratios))
    assert np.all(np.abs(np.mean(ratios, axis=0) - expected) < 4 * deviation)


def test_it_covers_where_runs_have_an_offset_of_their_own() -> None:
    """95 % over 1500 draws, within the Monte Carlo error; counting readings covers two thirds of the time."""
    random = np.random.default_rng(4)
    x = np.linspace(-1, 1, 15)
    designs = [np.column_stack([np.ones(15), x, x**2]) for _ in range(10)]
    draws, inside, naive = 1500, np.zeros(3), np.zeros(3)
    for _ in range(draws):
        runs = factors(designs, [A @ random.standard_normal(3) + 0.3 * random.standard_normal(15) for A in designs])
        low, high = solve_by_run(runs, LABELS).interval().T
        inside += (low <= 0) & (high >= 0)
        low, high = solve(merge(*runs)).interval().T
        naive += (low <= 0) & (high >= 0)
    low, high = (stats.binom.ppf(q, draws, 0.95) / draws for q in (0.0002, 0.9998))
    print(inside / draws, naive / draws)
    assert np.all((low <= inside / draws) & (inside / draws <= high))
    assert np.all(naive[:2] / draws < 0.7)


def test_a_parameter_that_one_run_alone_determines_is_refused() -> None:
    random = np.random.default_rng(5)
    designs = [np.column_stack([np.ones(9), np.arange(9.0) if k == 0 else np.zeros(9)]) for k in range(6)]
    with pytest.raises(DegreesOfFreedomError, match="6 runs are too few for an uncertainty of b by run: it rests on hardly"):
        solve_by_run(factors(designs, [random.standard_normal(9) for _ in range(6)], ("a", "b")), ("a", "b"))


def test_one_run_is_refused() -> None:
    random = np.random.default_rng(6)
    with pytest.raises(DegreesOfFreedomError, match="1 runs are too few for an uncertainty of a, b, c by run"):
        solve_by_run(factors([random.standard_normal((20, 3))], [random.standard_normal(20)]), LABELS)


def test_dependent_columns_are_refused() -> None:
    random = np.random.default_rng(7)
    designs = [np.column_stack([A[:, 0], A[:, 1], A[:, 0] + A[:, 1]]) for A in random.standard_normal((5, 9, 3))]
    with pytest.raises(RankError, match="are not independent"):
        solve_by_run(factors(designs, list(random.standard_normal((5, 9)))), LABELS)


def test_drawn_estimates_are_those_of_drawn_readings(problem: tuple[list[Array], list[Array]]) -> None:
    """Through the triangle: the same covariance as `sigma^2 (A^T A)^-1`, and the same mean as the estimate."""
    designs, readings = problem
    factor = merge(*factors(designs, readings))
    trials, sigma = 200_000, 0.3
    draws = draw_estimates(factor, sigma, trials, np.random.default_rng(8))
    assert draws.shape == (trials, 3)
    A = np.vstack(designs)
    norms = np.linalg.norm(A, axis=0)
    covariance = sigma**2 * np.linalg.inv((A / norms).T @ (A / norms)) / np.outer(norms, norms)
    deviation = np.sqrt(np.diag(covariance))
    assert_allclose((draws.mean(axis=0) - solve(factor).values) / deviation, 0.0, atol=5 / np.sqrt(trials))
    sample = np.cov(draws, rowvar=False) / np.outer(deviation, deviation)
    assert_allclose(sample, covariance / np.outer(deviation, deviation), atol=5 * np.sqrt(2 / trials))
    assert np.all(stats.kstest((draws - solve(factor).values) / deviation, "norm").pvalue > 1e-3)


def test_drawn_estimates_are_exactly_the_solutions_of_their_triangle(problem: tuple[list[Array], list[Array]]) -> None:
    designs, readings = problem
    factor = merge(*factors(designs, readings))
    draws = draw_estimates(factor, 0.1, 5, np.random.default_rng(9))
    normal = np.random.default_rng(9).standard_normal((5, 3))
    for draw, xi in zip(draws, normal, strict=True):
        assert_allclose(draw, solve_triangular(factor.R, factor.z + 0.1 * xi), rtol=1e-9)
    assert_allclose(draw_estimates(factor, 0.0, 2, np.random.default_rng(9)), [solve(factor).values] * 2)


@pytest.mark.parametrize("sigma", [-1.0, float("nan"), float("inf")])
def test_draws_with_a_deviation_that_is_none_are_refused(sigma: float, problem: tuple[list[Array], list[Array]]) -> None:
    factor = merge(*factors(*problem))
    with pytest.raises(InputError, match="the standard deviation of a reading is"):
        draw_estimates(factor, sigma, 3, np.random.default_rng(0))


def test_draws_of_dependent_columns_are_refused() -> None:
    A = np.random.default_rng(10).standard_normal((20, 2)) @ np.array([[1.0, 0.0, 1.0], [0.0, 1.0, 1.0]])
    (factor,) = factors([A], [A[:, 0]])
    with pytest.raises(RankError, match="are not independent"):
        draw_estimates(factor, 1.0, 3, np.random.default_rng(0))


def test_blocks_of_runs_need_not_be_of_full_rank() -> None:
    """A run that cannot tell two parameters counts, as long as all together can: two forces, one in each run."""
    random = np.random.default_rng(11)
    x = np.cos(np.linspace(0, 6, 30))
    designs = [np.column_stack([force * x, x]) for force in (1.0, 1.0, 2.0, 2.0, 3.0, 3.0)]
    readings = [A @ [0.5, 0.2] + 0.1 * random.standard_normal(30) for A in designs]
    solution = solve_by_run(factors(designs, readings, ("c", "e")), ("c", "e"))
    covariance, degrees = dense(designs, readings)
    assert np.linalg.matrix_rank(block_diag(*designs)) == 6
    assert_allclose(solution.covariance, covariance, rtol=1e-8)
    assert_allclose(solution.degrees_of_freedom, degrees, rtol=1e-8)


def test_a_combination_is_worth_what_it_is_as_a_parameter_of_its_own(problem: tuple[list[Array], list[Array]]) -> None:
    """The model is written in other parameters, of which the combination is one: its variance and freedom do not change."""
    designs, readings = problem
    scatter = solve_by_run(factors(designs, readings), LABELS).scatter
    assert scatter is not None
    weights = np.array([[1.0, 2e3, -3e-4], [0.0, 1.0, 0.0], [0.5, 0.0, 1e-4]])
    for w in weights:
        others = np.linalg.svd(w[np.newaxis])[2][1:]
        turned = np.linalg.inv(np.vstack([w, others]))
        own = solve_by_run(factors([A @ turned for A in designs], readings), LABELS)
        assert scatter.variance(w[np.newaxis])[0] == pytest.approx(own.covariance[0, 0], rel=1e-7)
        assert scatter.degrees_of_freedom(w[np.newaxis])[0] == pytest.approx(own.degrees_of_freedom[0], rel=1e-7)
    assert_allclose(scatter.degrees_of_freedom(weights), [scatter.degrees_of_freedom(w[np.newaxis])[0] for w in weights])
    assert_allclose(np.diag(scatter.covariance(weights)), scatter.variance(weights), rtol=1e-12)


def test_a_combination_that_hangs_on_one_run_has_no_degree_of_freedom() -> None:
    random = np.random.default_rng(6)
    designs = [np.column_stack([np.ones(9), np.arange(9.0) if k == 0 else np.zeros(9)]) for k in range(6)]
    runs = factors(designs, [random.standard_normal(9) for _ in range(6)], ("a", "b"))
    solution, unshown = solve_as_runs_show(runs, ("a", "b"))
    assert unshown == ("b",)
    assert solution.scatter is not None
    degrees = solution.scatter.degrees_of_freedom(np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]))
    assert degrees[0] > 1
    assert_allclose(degrees[1:], 0.0)
