"""Rank and row space: against a basis that is known, and where LAPACK's fast algorithm does not converge."""

import numpy as np
import pytest

from elastogeo.planning.rank import decomposed, rank_of, row_space, unit_rows


@pytest.fixture(params=[(5, 9, 3), (30, 8, 6), (4, 4, 4)], ids=["wide", "tall", "full"])
def made(request):
    """Rows of a known rank, shape (m, p), and an orthonormal basis of their space, shape (p, r)."""
    m, p, r = request.param
    random = np.random.default_rng(m)
    basis = np.linalg.qr(random.standard_normal((p, r)))[0]
    return random.standard_normal((m, r)) @ basis.T, basis


@pytest.mark.parametrize("slow", [False, True], ids=["gesdd", "gesvd"])
def test_rank_and_row_space_are_those_of_the_basis(made, slow, monkeypatch):
    rows, basis = made

    def stuck(*_, **__):
        raise np.linalg.LinAlgError("SVD did not converge")

    if slow:
        monkeypatch.setattr(np.linalg, "svd", stuck)
    found = row_space(rows)
    assert found @ found.T == pytest.approx(basis @ basis.T, abs=1e-12)
    assert rank_of(rows) == basis.shape[1]
    values, turns = decomposed(rows)
    assert (values**2 * turns.T) @ turns == pytest.approx(rows.T @ rows, abs=1e-12)


def test_a_direction_below_the_tolerance_is_rounding_error():
    rows = np.diag([1.0, 1e-8, 1e-10])
    assert rank_of(rows) == 2
    assert rank_of(rows, 1e-11) == 3
    assert rank_of(unit_rows(rows)) == 3


@pytest.mark.parametrize("rows", [np.zeros((0, 4)), np.zeros((3, 4)), np.zeros((9, 4))])
def test_rows_that_see_nothing_have_no_space(rows):
    assert rank_of(unit_rows(rows)) == 0
    assert row_space(rows).shape == (4, 0)
