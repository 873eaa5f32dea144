"""The mergeable factor: the triangular square root of the information in labelled observations.

All that least squares needs of any number of rows `A p = y` is the triangle R of `[A | y] = Q R`. Rows are pushed in blocks,
two factors merge into one, columns are selected from it: streams of any length in constant memory, all pairs of repeats,
leave-one-run-out and a fleet's worth of machines are the same few lines. Householder throughout, so that the accuracy is
that of QR and not of the normal equations.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from elastogeo.errors import InputError, SelectionError

Array = NDArray[np.float64]

BLOCK_ROWS = 2048
"""Rows pushed at once: enough for the cost of a call not to count, few enough for the cache."""

_PANEL = 4
"""Columns that the QR takes at once in a large block. More rows times columns than `SMALL_BLOCK` and OpenBLAS would spread
matrix-vector products over threads, which keeps a second core busy and gains nothing."""

SMALL_BLOCK = 9216
"""Numbers in a block up to which the QR takes one column at a time: each then meets what the columns before it have left,
not the rows as they came, which rounds less where columns are nearly parallel (docs/decisions/0010-filip.md). In large
blocks it would take twice the time."""


@dataclass(frozen=True, slots=True)
class Factor:
    """Triangular factor of labelled observations.

    Attributes
    ----------
    labels : tuple of str
        Names of the p columns.
    triangle : array, shape (p + 1, p + 1)
        Upper triangular factor of `[A | y]`; signs of its diagonal are free.
    rows : int
        Number of readings in it.
    """

    labels: tuple[str, ...]
    triangle: Array
    rows: int

    @property
    def R(self) -> Array:
        """Factor of A, shape (p, p)."""
        return self.triangle[:-1, :-1]

    @property
    def z(self) -> Array:
        """Right-hand side, shape (p,): `R p = z` is the least-squares solution."""
        return self.triangle[:-1, -1]

    @property
    def residual_norm(self) -> float:
        """Root of the residual sum of squares when all independent columns are used."""
        return abs(float(self.triangle[-1, -1]))

    @property
    def column_norms(self) -> Array:
        """Length of each column of A, shape (p,)."""
        return np.asarray(np.linalg.norm(self.R, axis=0))


def empty_factor(labels: Sequence[str]) -> Factor:
    """The factor of no observations: the neutral element of `merge`."""
    size = len(labels) + 1
    return Factor(tuple(labels), np.zeros((size, size), order="F"), 0)


def factor_blocks(labels: Sequence[str], blocks: Iterable[Array]) -> Factor:
    """Factor of a stream of rows, in constant memory.

    Parameters
    ----------
    labels : sequence of str, length p
        Names of the columns.
    blocks : iterable of array, shape (rows, p + 1)
        Blocks of `[A | y]`. They may be overwritten; Fortran order saves a copy.

    Returns
    -------
    Factor

    Raises
    ------
    InputError
        If a block has another width or holds a value that is no finite number.
    """
    start = empty_factor(labels)
    triangle, rows = start.triangle, 0
    for block in blocks:
        if block.ndim != 2 or block.shape[1] != len(triangle):
            raise InputError(f"a block of rows must have {len(triangle)} columns [A | y], got the shape {block.shape}")
        for first in range(0, len(block), BLOCK_ROWS):
            triangle = _pushed(triangle, block[first : first + BLOCK_ROWS])
        rows += len(block)
    if not np.isfinite(triangle).all():
        raise InputError("a row of the design or a reading is NaN or infinite; every reading must be a finite number")
    return Factor(start.labels, triangle, rows)


def merge(*factors: Factor) -> Factor:
    """One factor of the observations of all.

    Raises
    ------
    InputError
        If there is none, or the labels differ.
    """
    if not factors:
        raise InputError("there is no factor to merge")
    return reduce(_merged, factors)


def select(factor: Factor, labels: Sequence[str]) -> Factor:
    """The factor of the same observations with these columns only, in this order.

    Raises
    ------
    SelectionError
        If a label is not among the factor's.
    """
    unknown = [label for label in labels if label not in factor.labels]
    if unknown:
        raise SelectionError(f"no column is called {', '.join(unknown)}; there are {', '.join(factor.labels)}")
    columns = [factor.labels.index(label) for label in labels] + [len(factor.labels)]
    chosen = np.asfortranarray(factor.triangle[:, columns])
    triangle = _pushed(np.zeros((len(columns), len(columns)), order="F"), chosen)
    return Factor(tuple(labels), triangle, factor.rows)


def _merged(one: Factor, other: Factor) -> Factor:
    if one.labels != other.labels:
        raise InputError(f"factors of different columns cannot merge: {one.labels} and {other.labels}")
    triangle = _pushed(one.triangle, other.triangle.copy(order="F"), trapezoid=len(one.triangle))
    return Factor(one.labels, triangle, one.rows + other.rows)


def _pushed(triangle: Array, rows: Array, trapezoid: int = 0) -> Array:
    """Triangle of the rows under a triangle (LAPACK dtpqrt); `trapezoid` says how many of the rows are triangular."""
    panel = 1 if rows.size <= SMALL_BLOCK else min(_PANEL, len(triangle))
    pushed, *_ = lapack.dtpqrt(trapezoid, panel, triangle, np.asfortranarray(rows), overwrite_a=0, overwrite_b=1)
    return np.asarray(pushed)
