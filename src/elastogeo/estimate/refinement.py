"""One step of iterative refinement: the digits that rounding took from a solution, from the rows and their triangle.

Residuals, their products with the columns, and the products of the columns are formed in pairs of float64 numbers, without
error (Dekker, doi:10.1007/BF01397083; Ogita, Rump and Oishi, doi:10.1137/030601818), never in long double: the digits do
not depend on the platform. The correction solves the seminormal equations `R^T R d = A^T r` (Björck,
doi:10.1016/0024-3795(87)90101-7) with columns of unit length, so that neither Q nor the rows have to be kept.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import solve_triangular

from elastogeo.errors import InputError
from elastogeo.estimate.factor import BLOCK_ROWS, Array, Factor, select
from elastogeo.estimate.solution import SOLVABLE, Noise, Solution, solve

Pair = tuple[Array, Array]
"""Numbers as unevaluated sums of two: the second at most half a unit in the last place of the first."""

_SPLIT = 2.0**27 + 1.0
"""Multiplying by it splits a float64 number into two halves of 26 bits (Veltkamp)."""

_ALIKE = 1e-8
"""Relative difference of two sums of squares beyond which rows are not those of the factor: far above rounding error."""


def refine(
    factor: Factor,
    blocks: Iterable[Array],
    labels: Sequence[str] | None = None,
    noise: Noise | None = None,
    tolerance: float = SOLVABLE,
) -> Solution:
    """Least-squares solution with one step of refinement in doubled precision.

    Parameters
    ----------
    factor : Factor
    blocks : iterable of array, shape (rows, p + 1)
        The rows `[A | y]` of the factor once more, in any order and blocking; they stay as they are. **Not** the arrays
        that `factor_blocks` was given in Fortran order: it overwrites those.
    labels, noise, tolerance
        As in `solve`.

    Returns
    -------
    Solution
        That of `solve`, with refined values, and with standard deviations from the refined residuals and the refined
        inverse of `A^T A`. It undoes the rounding of the solution, **not** that of the rows: what the design matrix lost
        when it was written down stays lost.

    Raises
    ------
    InputError
        If the blocks are not the rows of the factor.
    RankError, DegreesOfFreedomError
        As in `solve`.
    """
    labels = factor.labels if labels is None else tuple(labels)
    chosen = select(factor, labels)
    columns = [factor.labels.index(label) for label in labels]
    restricted = None if noise is None else replace(noise, root=noise.root[:, columns])
    start = solve(chosen, noise=restricted, tolerance=tolerance)
    sums = _sums(_parts(blocks, len(factor.labels) + 1), [*columns, -1], start.values)
    _check_rows(chosen, sums)

    norms = chosen.column_norms
    R = chosen.R / norms
    half = solve_triangular(R, _value(sums.gradient) / norms, trans="T")
    # |r - A d|^2 = |r|^2 - 2 d^T A^T r + |A d|^2, and A^T A d = A^T r
    square = max(float(_value(sums.square)[0]) - float(half @ half), 0.0)
    residuals = chosen.triangle.copy(order="F")
    residuals[:-1, -1], residuals[-1, -1] = 0.0, np.sqrt(square)
    refined = solve(replace(chosen, triangle=residuals), noise=restricted, tolerance=tolerance)

    inverse = _inverse(R, norms, sums.gram)
    spread = inverse if restricted is None else inverse @ restricted.root.T @ restricted.root @ inverse.T
    return replace(
        refined,
        values=start.values + solve_triangular(R, half) / norms,
        covariance=refined.residual_std**2 * (spread + spread.T) / 2,
    )


@dataclass(frozen=True, slots=True)
class _Sums:
    """Sums over the rows: `A^T r`, shape (p,); `r^T r`, (1,); `A^T A`, (p, p); the squares of `[A | y]`, (p + 1,); rows."""

    gradient: Pair
    square: Pair
    gram: Pair
    squares: Array
    rows: int


def _parts(blocks: Iterable[Array], width: int) -> Iterator[Array]:
    """The rows in parts that fit the cache, checked."""
    for block in blocks:
        if block.ndim != 2 or block.shape[1] != width:
            raise InputError(f"a block of rows must have {width} columns [A | y], got the shape {block.shape}")
        if not np.isfinite(block).all():
            raise InputError("a row of the design or a reading is NaN or infinite; every reading must be a finite number")
        yield from (block[first : first + BLOCK_ROWS] for first in range(0, len(block), BLOCK_ROWS))


def _sums(parts: Iterable[Array], columns: Sequence[int], values: Array) -> _Sums:
    size = len(values)
    gradient, square, gram = _zeros(size), _zeros(1), _zeros(size, size)
    squares, rows = np.zeros(size + 1), 0
    for part in parts:
        chosen = part[:, columns]
        A = chosen[:, :-1]
        r, rest = (half[:, np.newaxis] for half in _residual(A, chosen[:, -1], values))
        gradient = _plus(gradient, _summed(_scaled((r, rest), A)))
        square = _plus(square, _summed(_plus(_scaled((r, rest), r), (r * rest, np.zeros_like(r)))))
        products = [_summed(_product(A, A[:, [k]])) for k in range(size)]
        gram = _plus(gram, (np.array([upper for upper, _ in products]), np.array([lower for _, lower in products])))
        squares += np.sum(chosen**2, axis=0)
        rows += len(chosen)
    return _Sums(gradient, square, gram, squares, rows)


def _check_rows(factor: Factor, sums: _Sums) -> None:
    """Refuse rows that cannot be those of the factor: another number of them, or columns of another length."""
    expected = np.sum(factor.triangle**2, axis=0)
    if sums.rows != factor.rows or not np.allclose(sums.squares, expected, rtol=_ALIKE, atol=0):
        raise InputError(
            f"these {sums.rows} rows are not the {factor.rows} rows of the factor; pass the same rows [A | y], as they were "
            f"before `factor_blocks` (which overwrites arrays in Fortran order)"
        )


def _inverse(R: Array, norms: Array, gram: Pair) -> Array:
    """Inverse of `A^T A`, shape (p, p): that of the scaled triangle, and one step of Newton, `X + X (I - A^T A X)`."""
    root = solve_triangular(R, np.eye(len(R)))
    start = root @ root.T / np.outer(norms, norms)
    error = (np.eye(len(R)), np.zeros_like(R))
    for k, row in enumerate(start):
        error = _plus(error, _scaled((gram[0][:, [k]], gram[1][:, [k]]), -row[np.newaxis, :]))
    return np.asarray(start + start @ _value(error))


def _residual(A: Array, y: Array, values: Array) -> Pair:
    """`y - A x`, shape (rows,), as a pair."""
    residual = (y, np.zeros_like(y))
    for column, value in zip(A.T, values, strict=True):
        residual = _plus(residual, _product(column, -value))
    return residual


def _zeros(*shape: int) -> Pair:
    return np.zeros(shape), np.zeros(shape)


def _value(pair: Pair) -> Array:
    return np.asarray(pair[0] + pair[1])


def _two_sum(a: Array, b: Array) -> Pair:
    """`a + b` and its rounding error (Knuth)."""
    total = a + b
    rest = total - a
    return total, (a - (total - rest)) + (b - rest)


def _product(a: Array, b: Array) -> Pair:
    """`a b` and its rounding error (Dekker, Veltkamp)."""
    product = a * b
    (a1, a2), (b1, b2) = _halves(a), _halves(b)
    return product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2)


def _halves(a: Array) -> Pair:
    """A number as a sum of two of 26 bits, whose products are exact."""
    shifted = _SPLIT * a
    upper = shifted - (shifted - a)
    return upper, a - upper


def _plus(a: Pair, b: Pair) -> Pair:
    total, rest = _two_sum(a[0], b[0])
    return _two_sum(total, rest + (a[1] + b[1]))


def _scaled(a: Pair, factor: Array) -> Pair:
    product, rest = _product(a[0], factor)
    return _two_sum(product, rest + a[1] * factor)


def _summed(terms: Pair) -> Pair:
    """Sum over the rows, by halves."""
    upper, lower = terms
    while len(upper) > 1:
        middle = len(upper) // 2
        pair = _plus((upper[:middle], lower[:middle]), (upper[middle : 2 * middle], lower[middle : 2 * middle]))
        upper, lower = (np.concatenate([part, odd[2 * middle :]]) for part, odd in zip(pair, (upper, lower), strict=True))
    return upper[0], lower[0]
