"""Rank, null columns, groups, combinations: against exact rational arithmetic on designs of small integers."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, RankError
from elastogeo.estimate import Confounding, Factor, confounding, factor_blocks, solve
from elastogeo.estimate.factor import Array

MOST = 8


@st.composite
def deficient_designs(draw: st.DrawFn) -> Array:
    """Integer matrices, shape (rows, p), of low rank: null columns, multiples, sums, all mixed."""
    p, rank = draw(st.integers(2, MOST)), draw(st.integers(1, 4))
    rows = draw(st.integers(6, 12))
    random = np.random.default_rng(draw(st.integers(0, 10**6)))
    mixing = random.integers(-2, 3, (rank, p)) * random.integers(0, 2, (rank, p))
    design = random.integers(-4, 5, (rows, rank)) @ mixing
    if not design.any():
        design[0, 0] = 1
    return design.astype(float)


def names(p: int) -> tuple[str, ...]:
    return tuple("abcdefgh"[:p])


def factor_of(design: Array) -> Factor:
    y = np.arange(1.0, len(design) + 1)
    return factor_blocks(names(design.shape[1]), [np.column_stack([design, y])])


def independent_columns(design: Array, order: list[int]) -> list[int]:
    """Columns, taken in this order, that are independent of those before: by elimination in rational numbers."""
    reduced: list[tuple[int, list[Fraction]]] = []
    kept = []
    for k in order:
        column = [Fraction(int(x)) for x in design[:, k]]
        for pivot, row in reduced:
            factor = column[pivot] / row[pivot]
            column = [x - factor * y for x, y in zip(column, row, strict=True)]
        pivot = next((i for i, x in enumerate(column) if x), None)
        if pivot is not None:
            reduced.append((pivot, column))
            kept.append(k)
    return kept


def are_parallel(a: Array, b: Array) -> bool:
    return all(a[i] * b[j] == a[j] * b[i] for i, j in combinations(range(len(a)), 2))


def stands_for_everything(design: Array, found: Confounding) -> None:
    """The retained columns, combined as stated, are the whole design."""
    labels = names(design.shape[1])
    retained = design[:, [labels.index(name) for name in found.retained]]
    assert_allclose(retained @ found.combinations, design, rtol=0, atol=1e-9 * np.abs(design).max())


@given(design=deficient_designs())
def test_null_groups_rank_and_combinations_are_exact(design: Array) -> None:
    found = confounding(factor_of(design))
    p = design.shape[1]
    labels = names(p)
    expected = independent_columns(design, list(range(p)))
    assert found.rank == len(expected)
    assert found.retained == tuple(labels[k] for k in expected)
    assert found.null == tuple(labels[k] for k in range(p) if not design[:, k].any())
    for one, other in combinations([k for k in range(p) if design[:, k].any()], 2):
        together = any(labels[one] in group and labels[other] in group for group in found.groups)
        assert together == are_parallel(design[:, one], design[:, other])
    assert sorted(name for group in found.groups for name in group) == sorted(set(labels) - set(found.null))
    stands_for_everything(design, found)


@given(design=deficient_designs(), order=st.permutations(range(MOST)))
def test_what_is_preferred_is_retained_if_it_is_independent(design: Array, order: list[int]) -> None:
    p = design.shape[1]
    order = [k for k in order if k < p]
    found = confounding(factor_of(design), [names(p)[k] for k in order])
    assert set(found.retained) == {names(p)[k] for k in independent_columns(design, order)}
    stands_for_everything(design, found)


def test_preferring_some_leaves_the_others_in_their_order() -> None:
    design = np.array([[1.0, 2.0, 0.0, 1.0], [1.0, 2.0, 1.0, 2.0], [0.0, 0.0, 3.0, 3.0]])
    assert confounding(factor_of(design)).retained == ("a", "c")
    assert confounding(factor_of(design), ["b"]).retained == ("b", "c")
    assert confounding(factor_of(design), ["d", "b"]).retained == ("b", "d")


def test_a_retained_parameter_says_what_it_stands_for() -> None:
    design = np.array([[1.0, 2.0, 0.0, 1.0, 0.0], [1.0, 2.0, 1.0, 2.0, 0.0], [0.0, 0.0, 3.0, 3.0, 0.0]])
    found = confounding(factor_of(design))
    assert found.stands_for("a") == pytest.approx({"a": 1.0, "b": 2.0, "d": 1.0})
    assert list(found.stands_for("c")) == ["c", "d"]
    assert found.null == ("e",)
    assert found.groups == (("a", "b"), ("c",), ("d",))


@given(design=deficient_designs(), powers=st.lists(st.integers(-9, 9), min_size=MOST, max_size=MOST))
def test_no_unit_decides_anything(design: Array, powers: list[int]) -> None:
    """Columns in other units: same rank, names, groups, scaled condition; combinations and values convert."""
    p = design.shape[1]
    unit = 10.0 ** np.array(powers[:p])
    plain, other = confounding(factor_of(design)), confounding(factor_of(design * unit))
    for attribute in ("retained", "null", "groups", "rank"):
        assert getattr(plain, attribute) == getattr(other, attribute)
    assert_allclose(other.condition_scaled, plain.condition_scaled, rtol=1e-10)
    kept = [names(p).index(name) for name in plain.retained]
    back = other.combinations * unit[kept][:, np.newaxis] / unit
    assert_allclose(back, plain.combinations, atol=1e-10 * np.abs(plain.combinations).max())
    values, others = (solve(factor_of(d), plain.retained).values for d in (design, design * unit))
    assert_allclose(others * unit[kept], values, rtol=1e-10, atol=1e-10 * np.abs(values).max())


@given(design=deficient_designs(), seed=st.integers(0, 99))
def test_row_order_and_repeated_rows_decide_nothing(design: Array, seed: int) -> None:
    plain = confounding(factor_of(design))
    rows = np.random.default_rng(seed).permutation(len(design))
    for other in (design[rows], np.vstack([design, design])):
        found = confounding(factor_of(other))
        assert (found.retained, found.null, found.groups) == (plain.retained, plain.null, plain.groups)
        assert_allclose(found.combinations, plain.combinations, atol=1e-10)
        assert_allclose(found.condition_scaled, plain.condition_scaled, rtol=1e-10)


@given(design=deficient_designs())
def test_solving_for_a_deficient_design_is_refused(design: Array) -> None:
    found = confounding(factor_of(design))
    solve(factor_of(design), found.retained)
    if found.null:
        with pytest.raises(RankError, match=f"{', '.join(found.null)} changes no reading of this test"):
            solve(factor_of(design))
    elif found.rank < design.shape[1]:
        with pytest.raises(RankError, match=r"are not independent in this test; ask for the confounding"):
            solve(factor_of(design))
    else:
        assert solve(factor_of(design)).labels == found.retained


def test_conditions_and_weakest_direction_are_those_of_the_singular_values() -> None:
    design = np.array([[1.0, 1.0, 1e3], [0.0, 1e-3, 2e3], [0.0, 0.0, 3e3], [1.0, 1.0, -1e3]])
    found = confounding(factor_of(design))
    assert found.condition_raw == pytest.approx(np.linalg.cond(design), rel=1e-9)
    scaled = design / np.linalg.norm(design, axis=0)
    assert found.condition_scaled == pytest.approx(np.linalg.cond(scaled), rel=1e-9)
    assert_allclose(found.singular_values, np.linalg.svd(scaled, compute_uv=False), rtol=1e-9)
    assert np.linalg.norm(scaled @ found.weakest) == pytest.approx(found.singular_values[-1], rel=1e-6)


def test_the_tolerance_is_relative_and_stated() -> None:
    design = np.array([[1.0, 1.0], [0.0, 1e-6], [0.0, 0.0]])
    assert confounding(factor_of(design)).rank == 2
    coarse = confounding(factor_of(design), tolerance=1e-5)
    assert (coarse.retained, coarse.groups, coarse.tolerance) == (("a",), (("a", "b"),), 1e-5)
    assert confounding(factor_of(1e9 * design), tolerance=1e-5).rank == 1


def test_rounding_error_is_null_beside_what_the_column_could_be() -> None:
    design = np.array([[1.0, 1e-15, 2e-13], [2.0, 0.0, 1e-13], [3.0, 1e-15, 0.0]])
    assert confounding(factor_of(design), ceilings=np.array([4.0, 4.0, 1e-12])).null == ("b",)
    assert confounding(factor_of(design), ceilings=np.array([4.0, 1e-12, 1e-12])).null == ()
    assert confounding(factor_of(design)).null == ()


def test_a_design_that_moves_no_reading_is_refused() -> None:
    with pytest.raises(RankError, match="none of the parameters a, b changes any reading"):
        confounding(factor_of(np.zeros((5, 2))))


def test_an_unknown_preference_is_refused() -> None:
    with pytest.raises(InputError, match="preferred parameters x, y are not among those asked for: a, b"):
        confounding(factor_of(np.eye(2)), ["x", "a", "y"])
