"""How many directions rows see, and which: one decomposition, and one tolerance where no other is stated."""

from __future__ import annotations

import numpy as np

from elastogeo.machine import Array

RANK = 1e-9
"""Singular values smaller than this part of the greatest are rounding error: nothing was found within four orders of it."""


def decomposed(rows: Array) -> tuple[Array, Array]:
    """Singular values, shape (k,), greatest first, and right singular vectors, shape (k, p), of rows, shape (m, p).

    LAPACK's `gesdd` once did not converge on finite rows; `gesvd` does where it does not.
    """
    triangle = np.linalg.qr(rows, mode="r") if len(rows) > rows.shape[1] else rows
    try:
        _, values, turns = np.linalg.svd(triangle, full_matrices=False)
    except np.linalg.LinAlgError:
        from scipy.linalg import svd  # here: hardly ever needed

        _, values, turns = svd(triangle, full_matrices=False, lapack_driver="gesvd")
    return np.asarray(values), np.asarray(turns)


def counted(values: Array, tolerance: float = RANK) -> int:
    """How many singular values are more than rounding error: none where all are zero."""
    return int(np.sum(values > tolerance * values.max(initial=0.0)))


def rank_of(rows: Array, tolerance: float = RANK) -> int:
    """How many independent directions rows see, shape (m, p)."""
    return counted(decomposed(rows)[0], tolerance)


def row_space(rows: Array) -> Array:
    """Orthonormal basis of what rows see, shape (p, r)."""
    values, turns = decomposed(rows)
    return np.asarray(turns[: counted(values)].T)


def unit_rows(rows: Array) -> Array:
    """Rows scaled to unit length; rows of zeros stay."""
    return np.asarray(rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), np.finfo(float).tiny))
