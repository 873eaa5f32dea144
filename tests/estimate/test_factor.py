"""The mergeable factor: the same numbers however the rows arrive, and nothing that is no number."""

from __future__ import annotations

import tracemalloc
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, SelectionError
from elastogeo.estimate import BLOCK_ROWS, Factor, empty_factor, factor_blocks, merge, select, solve
from elastogeo.estimate.factor import Array

LABELS = ("a", "b", "c", "d")


def random_rows(rows: int, seed: int = 0, columns: int = len(LABELS)) -> Array:
    """Rows [A | y] whose columns differ in size by up to 10^6."""
    random = np.random.default_rng(seed)
    return random.standard_normal((rows, columns + 1)) * 10.0 ** random.integers(-3, 4, columns + 1)


def factor_of(*blocks: Array) -> Factor:
    return factor_blocks(LABELS, [block.copy(order="F") for block in blocks])


def information(factor: Factor) -> Array:
    """`[A | y]^T [A | y]`, which does not depend on the signs of the factor's rows."""
    return factor.triangle.T @ factor.triangle


def assert_same(one: Factor, other: Factor, tolerance: float = 1e-12) -> None:
    assert one.labels == other.labels
    assert one.rows == other.rows
    scale = np.linalg.norm(one.triangle, axis=0)
    scale[scale == 0] = 1.0
    assert_allclose(information(one) / np.outer(scale, scale), information(other) / np.outer(scale, scale), atol=tolerance)
    if one.rows > len(LABELS):
        unit = scale[:-1] / scale[-1]
        condition = np.linalg.cond(one.R / scale[:-1])
        assert_allclose(solve(one).values * unit, solve(other).values * unit, rtol=0, atol=tolerance * condition)


def test_a_factor_holds_what_least_squares_needs() -> None:
    rows = random_rows(50)
    A, y = rows[:, :-1], rows[:, -1]
    factor = factor_of(rows)
    values, residual_square, *_ = np.linalg.lstsq(A / np.linalg.norm(A, axis=0), y, rcond=None)
    assert_allclose(np.linalg.solve(factor.R, factor.z), values / np.linalg.norm(A, axis=0), rtol=1e-12)
    assert_allclose(factor.residual_norm**2, residual_square, rtol=1e-12)
    assert_allclose(factor.column_norms, np.linalg.norm(A, axis=0), rtol=1e-13)
    assert_allclose(np.tril(factor.triangle, -1), 0)
    assert factor.rows == 50


@given(cuts=st.lists(st.integers(0, 3000), max_size=5), seed=st.integers(0, 999))
def test_blocking_changes_nothing(cuts: list[int], seed: int) -> None:
    rows = random_rows(3000, seed)
    edges = [0, *sorted(cuts), 3000]
    assert_same(factor_of(*(rows[a:b] for a, b in pairwise(edges))), factor_of(rows))


def test_blocks_agree_with_one_shot_qr() -> None:
    rows = random_rows(5 * BLOCK_ROWS + 17, 3)
    one_shot = Factor(LABELS, np.linalg.qr(rows, mode="r"), len(rows))
    assert_same(factor_of(rows), one_shot)


@given(sizes=st.lists(st.integers(0, 40), min_size=3, max_size=3), seed=st.integers(0, 999))
def test_merging_is_associative_and_commutative(sizes: list[int], seed: int) -> None:
    a, b, c = (factor_of(random_rows(size, seed + k)) for k, size in enumerate(sizes))
    assert_same(merge(merge(a, b), c), merge(a, merge(b, c)))
    assert_same(merge(a, b, c), merge(c, a, b))
    assert_same(merge(a, empty_factor(LABELS)), a)
    assert_same(merge(empty_factor(LABELS), a), a)


def test_merging_is_having_observed_everything_at_once() -> None:
    rows = random_rows(90, 5)
    assert_same(merge(*(factor_of(rows[k::3]) for k in range(3))), factor_of(rows))


def test_merging_leaves_its_arguments_alone() -> None:
    one, other = factor_of(random_rows(9, 1)), factor_of(random_rows(9, 2))
    before = one.triangle.copy(), other.triangle.copy()
    merge(one, other)
    np.testing.assert_array_equal(one.triangle, before[0])
    np.testing.assert_array_equal(other.triangle, before[1])


@given(seed=st.integers(0, 999))
def test_row_order_changes_nothing(seed: int) -> None:
    rows = random_rows(200, seed)
    shuffled = np.random.default_rng(seed).permutation(rows)
    assert_same(factor_of(rows), factor_of(shuffled))


@given(seed=st.integers(0, 999))
def test_a_row_read_twice_is_a_row_of_weight_root_two(seed: int) -> None:
    rows = random_rows(60, seed)
    twice = factor_of(rows, rows[:20])
    weighted = factor_of(np.vstack([rows[:20] * np.sqrt(2), rows[20:]]))
    assert_allclose(information(twice), information(weighted), rtol=1e-12, atol=1e-12 * np.abs(information(twice)).max())
    assert_allclose(solve(twice).values, solve(weighted).values, rtol=1e-10)


@given(columns=st.permutations(LABELS).flatmap(lambda p: st.integers(1, 4).map(lambda n: p[:n])), seed=st.integers(0, 99))
def test_selecting_is_having_observed_those_columns_only(columns: list[str], seed: int) -> None:
    rows = random_rows(30, seed)
    chosen = rows[:, [*(LABELS.index(c) for c in columns), len(LABELS)]]
    direct = factor_blocks(columns, [chosen.copy(order="F")])
    selected = select(factor_of(rows), columns)
    scale = np.linalg.norm(chosen, axis=0)
    assert selected.labels == tuple(columns)
    assert_allclose(information(selected) / np.outer(scale, scale), information(direct) / np.outer(scale, scale), atol=1e-13)


def test_selecting_an_unknown_column_is_refused() -> None:
    with pytest.raises(SelectionError, match="no column is called e, f; there are a, b, c, d"):
        select(factor_of(random_rows(9)), ["a", "e", "f"])


@given(
    value=st.sampled_from([np.nan, np.inf, -np.inf]),
    row=st.integers(0, 2 * BLOCK_ROWS),
    column=st.integers(0, len(LABELS)),
    empty_columns=st.sets(st.integers(0, len(LABELS)), max_size=3),
)
def test_what_is_no_number_is_refused_wherever_it_stands(
    value: float, row: int, column: int, empty_columns: set[int]
) -> None:
    rows = random_rows(2 * BLOCK_ROWS + 1)
    rows[:, sorted(empty_columns)] = 0.0
    rows[row, column] = value
    with pytest.raises(InputError, match="is NaN or infinite; every reading must be a finite number"):
        factor_of(rows)


@pytest.mark.parametrize("shape", [(5, 4), (5, 6), (5,)])
def test_a_block_of_another_width_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match=r"must have 5 columns \[A \| y\], got the shape"):
        factor_blocks(LABELS, [np.zeros(shape)])


def test_factors_of_different_columns_do_not_merge() -> None:
    with pytest.raises(InputError, match="factors of different columns cannot merge"):
        merge(empty_factor("ab"), empty_factor("ba"))
    with pytest.raises(InputError, match="there is no factor to merge"):
        merge()


def test_memory_does_not_grow_with_the_rows() -> None:
    def stream(blocks: int) -> Iterator[Array]:
        return (np.asfortranarray(random_rows(BLOCK_ROWS, k)) for k in range(blocks))

    peaks = []
    for blocks in (10, 100):
        tracemalloc.start()
        assert factor_blocks(LABELS, stream(blocks)).rows == blocks * BLOCK_ROWS
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.2 * peaks[0]
