"""The nearest point of a polar cone: closed forms, the bracket, and what it does where rounding stops it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import nnls

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import interior_point
from elastogeo.estimate.interior_point import nearest_polar_point


def test_the_polar_of_the_semidefinite_matrices_is_the_negative_ones() -> None:
    """In the metric of Frobenius the parts of a symmetric matrix are its positive and its negative eigenvalues."""
    basis = np.array([[[1, 0], [0, 0]], [[0, 0.5**0.5], [0.5**0.5, 0]], [[0, 0], [0, 1]]])
    matrix = np.array([[2.0, 3.0], [3.0, -1.0]])
    values, vectors = np.linalg.eigh(matrix)
    w = np.tensordot(basis, matrix, 2)
    found = nearest_polar_point(w, [basis], np.array([-1.0, 0.0, -1.0]))
    negative = (vectors * np.minimum(values, 0)) @ vectors.T
    assert_allclose(np.tensordot(found.point, basis, 1), negative, atol=1e-6)
    assert_allclose(found.multipliers[0], (vectors * np.maximum(values, 0)) @ vectors.T, atol=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_blocks_of_one_are_non_negative_least_squares(seed: int) -> None:
    random = np.random.default_rng(seed)
    columns, w = np.abs(random.standard_normal((4, 6))), 3 * random.standard_normal(4)
    found = nearest_polar_point(w, [column[:, np.newaxis, np.newaxis] for column in columns.T], -np.ones(4))
    multipliers, distance = nnls(columns, w)
    assert_allclose(columns @ np.array([Z[0, 0] for Z in found.multipliers]), columns @ multipliers, atol=1e-6)
    assert found.least <= distance * (1 + 1e-9)
    assert found.most == pytest.approx(distance, abs=1e-6)


def test_the_bracket_holds_the_answer_also_where_the_search_ends_early() -> None:
    random = np.random.default_rng(1)
    basis = np.array([[[1, 0], [0, 0]], [[0, 1], [1, 0]], [[0, 0], [0, 1]]], dtype=float)
    w = random.standard_normal(3) * [1, 5, 1]
    exact = nearest_polar_point(w, [basis], np.array([-1.0, 0.0, -1.0]))
    for enough in (1e-3, 0.1, 1.0):
        early = nearest_polar_point(w, [basis], np.array([-1.0, 0.0, -1.0]), enough=enough)
        assert early.least >= enough
        assert early.least <= exact.most <= early.most * (1 + 1e-9)


def test_nothing_restricted_is_its_own_answer() -> None:
    found = nearest_polar_point(np.array([3.0, 4.0]), [np.zeros((2, 0, 0))], np.zeros(2))
    assert (found.most, found.least) == (5.0, 5.0)


def test_a_search_that_stops_early_says_between_what_the_answer_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interior_point, "_STEPS", 2)
    with pytest.raises(UnsupportedError, match=r"stopped the search with its distance between 0 and \d"):
        nearest_polar_point(np.array([1.0, 2.0]), [np.eye(2)[:, :, np.newaxis] * np.eye(2)], np.array([-1.0, -1.0]))
