"""The cone of semidefinite blocks: closed forms, feasible truths, units, unseen directions, and the level of its test."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import nnls
from scipy.special import chdtrc, stdtr

from elastogeo.errors import InputError
from elastogeo.estimate.chi_bar_square import p_value_bound
from elastogeo.estimate.cone import Block, PsdCone, is_never_negative, project, psd_cone
from elastogeo.estimate.factor import Array

SYMMETRIC = np.array([[0, 1], [1, 2]])
PAIRED = np.array([[0, 1], [2, 3]])


def random_covariance(random: np.random.Generator, size: int) -> Array:
    root = random.standard_normal((size, size + 3))
    return root @ root.T


def random_blocks(random: np.random.Generator) -> tuple[list[Block], Array]:
    """Blocks of 3 and of 2 components, every entry a parameter, with semidefinite values, some of low rank."""
    values, blocks, first = [], [], 0
    for size in (3, 2):
        root = random.standard_normal((size, random.integers(1, size + 1)))
        blocks.append(np.arange(first, first + size**2).reshape(size, size))
        values.append((root @ root.T).ravel())
        first += size**2
    return blocks, np.concatenate(values)


def frobenius() -> PsdCone:
    """One symmetric block of two, in the metric in which an off-diagonal counts twice."""
    return psd_cone(np.diag([1.0, 0.5, 1.0]), np.eye(3), [SYMMETRIC])


@pytest.mark.parametrize(("value", "nearest", "square"), [(-3.0, 0.0, 2.25), (3.0, 3.0, 0.0), (0.0, 0.0, 0.0)])
def test_a_single_compliance_is_cut_at_zero(value: float, nearest: float, square: float) -> None:
    found = project(psd_cone(np.array([[4.0]]), np.eye(1), [np.array([[0]])]), np.array([value]))
    assert found.values[0] == pytest.approx(nearest, abs=1e-8)
    assert found.distance_squared == pytest.approx(square, abs=1e-8)
    assert found.inside == (square == 0)


@pytest.mark.parametrize("seed", range(6))
def test_a_block_of_two_is_its_positive_part(seed: int) -> None:
    """In the Frobenius metric the nearest semidefinite matrix drops the negative eigenvalues (Higham 1988)."""
    a, b, c = np.random.default_rng(seed).standard_normal(3) * [1, 3, 1]
    eigenvalues, vectors = np.linalg.eigh([[a, b], [b, c]])
    part = (vectors * np.maximum(eigenvalues, 0)) @ vectors.T
    found = project(frobenius(), np.array([a, b, c]))
    assert_allclose(found.values, [part[0, 0], part[0, 1], part[1, 1]], atol=1e-6)
    assert found.distance_squared == pytest.approx(np.sum(np.minimum(eigenvalues, 0) ** 2), abs=1e-7)
    assert_allclose(found.parameters, found.values, atol=1e-6)


@pytest.mark.parametrize("seed", range(6))
def test_signs_alone_are_non_negative_least_squares(seed: int) -> None:
    random = np.random.default_rng(seed)
    size = int(random.integers(2, 7))
    covariance, values = random_covariance(random, size), 5 * random.standard_normal(size)
    found = project(psd_cone(covariance, np.eye(size), [np.array([[k]]) for k in range(size)]), values)
    whitening = np.linalg.inv(np.linalg.cholesky(covariance))
    nearest, distance = nnls(whitening, whitening @ values)
    assert_allclose(found.values, nearest, atol=1e-6)
    assert found.distance_squared == pytest.approx(distance**2, abs=1e-7)


def test_a_great_value_beside_a_small_one_costs_no_digits_that_matter() -> None:
    """A compliance known to a ten-millionth beside a negative one: the answer is the half-line's."""
    found = project(frobenius(), np.array([1e7, 0.0, -2.0]))
    assert found.distance_squared == pytest.approx(4, rel=1e-6)
    assert_allclose(found.outward, [0, 0, -2], atol=1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_what_obeys_the_law_stays_as_it_is(seed: int) -> None:
    random = np.random.default_rng(seed)
    blocks, truth = random_blocks(random)
    combinations = random.standard_normal((6, 13))
    found = project(psd_cone(random_covariance(random, 6), combinations, blocks), combinations @ truth)
    assert found.inside
    assert found.distance_squared == 0
    assert_allclose(found.values, combinations @ truth, rtol=0)
    assert not found.outward.any()


@pytest.mark.parametrize("size", [1e3, 3e7, 9.8e7, 1e10, 1e14])
def test_estimates_of_any_size_are_solved_and_known_to_obey_the_law(size: float) -> None:
    """From readings with hardly any noise. Solved at 1e8 standard uncertainties, 1 % of them are not solved at all."""
    random = np.random.default_rng(2)
    for _ in range(15):
        blocks, truth = random_blocks(random)
        combinations = random.standard_normal((int(random.integers(3, 13)), 13))
        covariance = random_covariance(random, len(combinations))
        white = np.linalg.solve(np.linalg.cholesky(covariance), combinations @ truth)
        found = project(psd_cone(covariance, combinations, blocks), combinations @ truth * size / np.linalg.norm(white))
        assert found.inside


@pytest.mark.parametrize("size", [1.0, 1e7, 1e12])
def test_a_violation_shows_at_any_size(size: float) -> None:
    """By a ten-millionth of the estimate, or by a thousandth of a standard uncertainty."""
    found = project(frobenius(), np.array([size, 0.0, -max(1e-3, 1e-7 * size)]))
    assert not found.inside
    assert found.distance_squared == pytest.approx(max(1e-3, 1e-7 * size) ** 2, rel=1e-3)


@pytest.mark.parametrize("seed", range(8))
def test_the_constrained_estimate_has_parameters_that_obey_the_law(seed: int) -> None:
    """And it is optimal: the outward direction is orthogonal to it and never positive on the cone."""
    random = np.random.default_rng(seed)
    blocks, _ = random_blocks(random)
    combinations, covariance = random.standard_normal((9, 13)), random_covariance(random, 9)
    values = 4 * random.standard_normal(9)
    cone = psd_cone(covariance, combinations, blocks)
    found = project(cone, values)
    assert not found.inside
    assert_allclose(combinations @ found.parameters, found.values, atol=1e-5)
    for block in blocks:
        matrix = found.parameters[block]
        assert_allclose(matrix, matrix.T, atol=1e-9)
        assert np.linalg.eigvalsh(matrix).min() > -1e-6
    apart = values - found.values
    assert apart @ np.linalg.solve(covariance, apart) == pytest.approx(found.distance_squared, rel=1e-6)
    assert found.outward @ found.values == pytest.approx(0, abs=1e-5)
    assert found.outward @ values == pytest.approx(found.distance_squared, rel=1e-6)
    for other in range(20):
        _, truth = random_blocks(np.random.default_rng(100 + other))
        assert found.outward @ combinations @ truth < 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_the_depth_under_signs_is_the_least_of_their_ratios(seed: int) -> None:
    """Uncorrelated: the nearest bound is that of the smallest value over its uncertainty."""
    random = np.random.default_rng(seed)
    deviations, values = 10.0 ** random.uniform(-9, -3, 5), 10.0 ** random.uniform(-9, -3, 5)
    found = project(psd_cone(np.diag(deviations**2), np.eye(5), [np.array([[k]]) for k in range(5)]), values)
    least = int(np.argmin(values / deviations))
    assert found.depth == pytest.approx(values[least] / deviations[least], rel=1e-6, abs=1e-8)
    assert_allclose(np.abs(found.shallow) * deviations, np.eye(5)[least], atol=1e-6)


@pytest.mark.parametrize("seed", range(12))
def test_the_depth_is_a_bound_that_holds(seed: int) -> None:
    """Of a block of two, in any metric, every outward combination of one load is at least so deep: 2000 loads around."""
    random = np.random.default_rng(seed)
    root, covariance = random.standard_normal((2, 2)), random_covariance(random, 3)
    matrix = 30 * root @ root.T
    values = matrix[[0, 0, 1], [0, 1, 1]]
    found = project(psd_cone(covariance, np.eye(3), [SYMMETRIC]), values)
    angle = np.linspace(0, np.pi, 2000)
    loads = np.array([np.cos(angle) ** 2, np.sin(2 * angle), np.sin(angle) ** 2]).T
    depths = loads @ values / np.sqrt(np.einsum("ki,ij,kj->k", loads, covariance, loads))
    assert found.inside
    assert 0 < found.depth <= depths.min() * (1 + 1e-6)


def test_there_is_no_depth_on_the_boundary_outside_or_under_equations() -> None:
    assert project(frobenius(), np.array([4.0, 2.0, 1.0])).depth == pytest.approx(0, abs=1e-3)
    assert project(frobenius(), np.array([4.0, 2.0, -1.0])).depth == pytest.approx(0, abs=1e-3)
    missing = project(psd_cone(np.eye(2), np.eye(2), [np.array([[-1, 0], [1, -1]])]), np.array([1.0, 1.0]))
    assert missing.depth == inf
    mirrors = project(psd_cone(np.eye(4), np.eye(4), [PAIRED]), np.array([10.0, 1.0, 3.0, 10.0]))
    assert mirrors.depth == pytest.approx(8)  # [10, 2; 2, 10]: its lowest eigenvalue; the equation has no depth


@pytest.mark.parametrize("unit", [1e-3, 1e3, 1e6])
@pytest.mark.parametrize("seed", range(4))
def test_units_decide_nothing(unit: float, seed: int) -> None:
    """Components in mm, um or m, rad beside them; values of 1e-5 to 1e-11."""
    random = np.random.default_rng(seed)
    blocks, truth = random_blocks(random)
    combinations, covariance = random.standard_normal((9, 13)), random_covariance(random, 9)
    values = -combinations @ truth
    component = np.array([unit, 1.0, 1e-3 * unit])
    of_parameters = np.concatenate([np.outer(component[:n], component[:n]).ravel() for n in (3, 2)])
    of_combinations = 10.0 ** random.uniform(-11, -5, 9)
    scaled = psd_cone(
        covariance * np.outer(of_combinations, of_combinations),
        combinations * of_combinations[:, np.newaxis] / of_parameters,
        blocks,
    )
    plain, other = project(psd_cone(covariance, combinations, blocks), values), project(scaled, values * of_combinations)
    assert plain.distance_squared > 0.1
    assert other.distance_squared == pytest.approx(plain.distance_squared, rel=1e-6)
    apart = (other.values / of_combinations - plain.values) / np.sqrt(np.diag(covariance))
    assert np.abs(apart).max() < 2e-5  # standard uncertainties; where a rank is nearly lost, the root of the solver's gap


def test_mirrors_that_are_both_seen_must_be_equal() -> None:
    cone = psd_cone(np.eye(4), np.eye(4), [PAIRED])
    found = project(cone, np.array([10.0, 1.0, 3.0, 10.0]))
    assert_allclose(found.values, [10, 2, 2, 10], atol=1e-6)
    assert found.distance_squared == pytest.approx(2)


def test_a_parameter_without_mirror_or_diagonal_is_free() -> None:
    one_sided = psd_cone(np.eye(3), np.eye(3), [np.array([[0, 1], [-1, 2]])])
    assert one_sided.dimension == 2
    assert project(one_sided, np.array([1.0, 50.0, 1.0])).inside
    no_diagonal = psd_cone(np.eye(2), np.eye(2), [np.array([[0, 1], [1, -1]])])
    assert no_diagonal.dimension == 1
    assert_allclose(project(no_diagonal, np.array([-2.0, 50.0])).values, [0, 50], atol=1e-7)
    no_block = psd_cone(np.eye(2), np.eye(2), [])
    assert no_block.dimension == 0
    assert project(no_block, np.array([-2.0, -50.0])).inside


def test_entries_that_were_not_asked_for_may_be_anything_that_completes_the_matrix() -> None:
    """Two diagonals without the entries between them: their signs are all that is restricted."""
    cone = psd_cone(np.eye(2), np.eye(2), [np.array([[0, -1], [-1, 1]])])
    assert_allclose(project(cone, np.array([-1.0, 5.0])).values, [0, 5], atol=1e-7)


@pytest.mark.parametrize("lever", [0.7, 150.0])
def test_an_unseen_direction_frees_what_is_seen_beside_it(lever: float) -> None:
    """Seen are l^T C l and b^T C l with l = (1, lever), b = (0, 1), not b^T C b: the cone is an open half-space."""
    combinations = np.array([[1, lever, lever, lever**2], [0, 0, 1, lever]])
    cone = psd_cone(np.array([[2, 0.3], [0.3, 1]]), combinations, [PAIRED])
    assert cone.dimension == 1
    found = project(cone, np.array([-2.0, 5.0]))
    assert_allclose(found.values, [0, 5.3], atol=1e-6)
    assert found.distance_squared == pytest.approx(2)
    assert_allclose(combinations @ found.parameters, found.values, atol=1e-6)


def test_unseen_directions_may_lie_across_blocks() -> None:
    """One block raises what the other lowers: their difference is free, and so is all beside it; the rest is not."""
    combinations = np.array([[1.0, 0, 0, -1, 0], [0, 1, 0, 0, 0], [0, 0, 1, 0, 0], [0, 0, 0, 0, 1]])
    cone = psd_cone(np.eye(4), combinations, [np.array([[0, 1], [1, 2]]), np.array([[3]]), np.array([[4]])])
    assert cone.dimension == 2
    assert_allclose(project(cone, np.array([-9.0, 7.0, -1.0, -2.0])).values, [-9, 7, 0, 0], atol=1e-6)


def test_changes_that_cancel_are_rounding_error_and_no_freedom() -> None:
    """Three components of which a force only ever sees two combinations, through sums that cancel in exact arithmetic."""
    loads = np.array([[1, 0, 1], [0.1, 1, 0.1], [0.3, -1, 0.3]])
    combinations = np.array([np.outer(load, load).ravel() for load in loads])
    cone = psd_cone(np.eye(3), combinations, [np.arange(9).reshape(3, 3)])
    assert cone.dimension == 3
    assert not project(cone, np.array([-1.0, -1.0, -1.0])).inside


def test_which_sums_are_never_negative() -> None:
    cone = psd_cone(np.diag([1.0, 2.0, 3.0, 1.0]), np.eye(4), [SYMMETRIC])
    assert is_never_negative(cone, np.array([1.0, 0, 0, 0]))
    assert is_never_negative(cone, np.array([1.0, 2, 1, 0]))  # (1, 1) C (1, 1)
    assert not is_never_negative(cone, np.array([1.0, 2.1, 1, 0]))
    assert not is_never_negative(cone, np.array([0.0, 1, 0, 0]))
    assert not is_never_negative(cone, np.array([1.0, 0, 0, 1]))  # the last is restricted by nothing
    assert not is_never_negative(cone, np.zeros(4))


def test_the_bound_of_a_sign_is_the_one_sided_test() -> None:
    assert p_value_bound(4.0, 1) == pytest.approx(0.5 * chdtrc(1, 4.0))
    assert p_value_bound(4.0, 1, 7.0) == pytest.approx(stdtr(7.0, -2.0))
    assert p_value_bound(4.0, 3) == pytest.approx(0.5 * (chdtrc(2, 4.0) + chdtrc(3, 4.0)))
    assert p_value_bound(4.0, 3, one_sided=False) == pytest.approx(chdtrc(3, 4.0))
    assert p_value_bound(4.0, 3, 1e9) == pytest.approx(p_value_bound(4.0, 3, inf), rel=1e-6)
    assert p_value_bound(4.0, 3, 5.0) > p_value_bound(4.0, 3)
    assert p_value_bound(0.0, 3) == p_value_bound(1.0, 0) == 1.0


@pytest.mark.parametrize("degrees", [inf, 6.0])
def test_no_physical_truth_is_rejected_more_often_than_stated(degrees: float) -> None:
    """At the apex and on the boundary; with a variance that is known or estimated. 80 draws: 3 sigma are 0.073."""
    random = np.random.default_rng(5)
    covariance = random_covariance(random, 4)
    cone = psd_cone(covariance, np.eye(4), [SYMMETRIC, np.array([[3]])])
    root = np.linalg.cholesky(covariance)
    for truth in (np.zeros(4), np.array([9.0, 9, 9, 0])):
        rejected = 0
        for _ in range(80):
            estimate = truth + root @ random.standard_normal(4)
            variance = 1.0 if degrees == inf else random.chisquare(degrees) / degrees
            square = project(cone, estimate).distance_squared / variance
            rejected += p_value_bound(square, cone.dimension, degrees) < 0.05
        assert rejected / 80 < 0.05 + 0.073


@pytest.mark.parametrize(
    ("covariance", "combinations", "blocks", "message"),
    [
        (np.zeros((2, 2)), np.eye(2), [], "a variance in it is not positive"),
        (np.ones((2, 2)) + np.diag([0, -1e-9]), np.eye(2), [], "positive definite"),
        (np.ones((2, 3)), np.eye(2), [], "square matrix"),
        (np.eye(2), np.eye(3), [], "combinations of 2 rows"),
        (np.eye(2), np.eye(2), [np.array([[0, 1]])], "must be square"),
        (np.eye(2), np.eye(2), [np.array([[2]])], "there are 2"),
        (np.eye(2), np.eye(2), [np.array([[0]]), np.array([[0]])], "parameter 0 stands in two places"),
    ],
)
def test_wrong_input_is_refused(covariance: Array, combinations: Array, blocks: list[Block], message: str) -> None:
    with pytest.raises(InputError, match=message):
        psd_cone(covariance, combinations, blocks)


def test_an_estimate_must_be_finite() -> None:
    with pytest.raises(InputError, match="3 finite numbers"):
        project(frobenius(), np.array([1.0, np.nan, 1.0]))


def test_an_ordinary_estimate_is_solved_whatever_its_size_beside_its_noise() -> None:
    """10 to 10^6 standard uncertainties long, one from the boundary: a tolerance relative to the data says nothing there."""
    random = np.random.default_rng(9)
    for size in (1e1, 1e3, 1e4, 1e5, 1e6):
        for _ in range(3):
            blocks, truth = random_blocks(random)
            combinations, covariance = random.standard_normal((9, 13)), random_covariance(random, 9)
            cone = psd_cone(covariance, combinations, blocks)
            values = size * combinations @ truth + cone.root @ random.standard_normal(9)
            found = project(cone, values)
            apart = np.linalg.solve(cone.root, values - found.values)
            assert apart @ apart == pytest.approx(found.distance_squared, abs=1e-3)
            assert found.outward @ found.values == pytest.approx(0, abs=1e-2)  # orthogonal: no nearer point in the cone
            assert found.distance_squared < 40  # the truth itself is in the cone, at chi-square of 9
