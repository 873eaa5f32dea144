"""The solver and its refinement against certified results: NIST StRD, Wampler by formula, rational arithmetic."""

from __future__ import annotations

import importlib.util
import re
import sys
from fractions import Fraction
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import DegreesOfFreedomError, InputError, RankError
from elastogeo.estimate import Noise, factor_blocks, solve
from elastogeo.estimate.factor import BLOCK_ROWS, SMALL_BLOCK, Array
from elastogeo.estimate.refinement import refine
from elastogeo.estimate.solution import SOLVABLE

ROOT = Path(__file__).resolve().parents[2]


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    return module


make_solver = load(ROOT / "docs" / "make_solver.py")
FOLDER = make_solver.FOLDER

BY_FORMULA = [pytest.param(make_solver.wampler(number), id=f"Wampler{number}-by-formula") for number in range(1, 6)]
FROM_FILES = (
    [pytest.param(reference, id=f"{reference.name}-read-from-NIST") for reference in make_solver.references()[0]]
    if FOLDER.is_dir()
    else []
)

PROMISED = {"Filip": 7.5, "Wampler4": 7.5, "Wampler5": 5.5}
"""Digits of `solve`; 8.5 for all others."""

PROMISED_REFINED = {"Filip": 7.5}
"""Digits of `refine`; 9.5 for all others. Rational arithmetic on Filip's float64 data reaches 7.9 (values), 8.6."""


def assert_digits(solution, reference, wanted: float) -> None:
    digits = make_solver.digits
    assert digits(solution.values, reference.values) >= wanted
    assert digits(solution.standard_uncertainty, reference.deviations) >= wanted
    assert digits(np.array([solution.residual_std]), np.array([reference.residual_deviation])) >= wanted
    assert set(solution.degrees_of_freedom) == {len(reference.readings) - len(reference.values)}


def test_every_set_of_nist_is_read_or_wampler_alone_by_formula() -> None:
    read = [param.values[0].name for param in FROM_FILES]
    message = f"read from {FOLDER}: {', '.join(read) or 'nothing, only the sets of Wampler are tested, by formula'}"
    print(message)
    assert read in ([], list(make_solver.NAMES)), message


@pytest.mark.parametrize("reference", [*BY_FORMULA, *FROM_FILES])
def test_the_solver_has_the_promised_digits(reference) -> None:
    assert_digits(solve(reference.factor), reference, PROMISED.get(reference.name, 8.5))


@pytest.mark.parametrize("reference", [*BY_FORMULA, *FROM_FILES])
def test_refined_it_has_the_promised_digits(reference) -> None:
    assert_digits(refine(reference.factor, [reference.rows]), reference, PROMISED_REFINED.get(reference.name, 9.5))


@pytest.mark.parametrize("reference", [param for param in FROM_FILES if param.values[0].name == "Filip"])
def test_filip_in_any_order_of_its_rows(reference) -> None:
    """The promise in most orders (measured: 91 to 100 %, by processor), never far below it (7.2 in the worst of 300).

    Half a unit in the last place of the design takes as much: decision 10. A panel of four columns gives 53 to 64 %.
    """
    random = np.random.default_rng(0)
    worst = []
    for _ in range(100):
        rows = random.permutation(reference.rows)
        solution = solve(factor_blocks([f"B{k}" for k in range(11)], [rows]))
        values = make_solver.digits(solution.values, reference.values)
        worst.append(min(values, make_solver.digits(solution.standard_uncertainty, reference.deviations)))
    print(f"7.5 digits in {np.mean(np.array(worst) >= 7.5):.0%} of the orders; {min(worst):.2f} in the worst")
    assert np.mean(np.array(worst) >= 7.5) >= 0.8
    assert min(worst) >= 7.0


@pytest.mark.parametrize("seed", range(4))
def test_a_small_block_is_pushed_a_column_at_a_time(seed: int) -> None:
    """Nearly parallel columns, as Longley's: a panel takes its products from the rows as they came, which costs a digit."""
    random = np.random.default_rng(seed)
    step = np.arange(16.0)
    product = np.round(2.34e5 + 2e4 * step + 8e3 * random.standard_normal(16))
    people = np.round(1e5 + 1e3 * step + 5e2 * random.standard_normal(16))
    rows = np.column_stack([np.ones(16), product, people, 1947 + step, np.round(6e4 + 3e2 * random.standard_normal(16))])
    assert rows.size <= SMALL_BLOCK
    factor = factor_blocks("abcd", [rows.copy()])
    refined = refine(factor, [rows])
    assert make_solver.digits(solve(factor).standard_uncertainty, refined.standard_uncertainty) >= 14.5


def test_the_formulas_of_wampler_are_those_of_nist() -> None:
    read = [reference for reference in make_solver.references()[0] if reference.name.startswith("Wampler")]
    assert len(read) == 5
    for number, reference in enumerate(read, start=1):
        generated = make_solver.wampler(number)
        assert_allclose(generated.rows, reference.rows, rtol=1e-15)
        assert_allclose(generated.values, reference.values, rtol=1e-15)
        assert_allclose(generated.deviations, reference.deviations, rtol=1e-14)
        assert_allclose(generated.residual_deviation, reference.residual_deviation, rtol=1e-14)


def weak_rows(seed: int = 0) -> Array:
    """A design like Filip's (scaled condition 5e9), which needs no file."""
    random = np.random.default_rng(seed)
    x = np.linspace(-8.8, -3.1, 60)
    return np.column_stack([np.vander(x, 11, increasing=True), 0.8 + 0.01 * random.standard_normal(60)])


def exact(rows: Array) -> tuple[Array, Array]:
    """Least squares in rational arithmetic: values and their standard deviations, rounded once."""
    fractions = np.array([[Fraction(value) for value in row] for row in rows.tolist()], dtype=object)
    A, y = fractions[:, :-1], fractions[:, -1]
    inverse = make_solver.exact_inverse(rows[:, :-1])
    values = inverse @ (A.T @ y)
    residual = y - A @ values
    variance = residual @ residual / (len(y) - len(values))
    return values.astype(float), np.sqrt((variance * np.diag(inverse)).astype(float))


@pytest.mark.parametrize("seed", range(3))
def test_refinement_reaches_rational_arithmetic_in_any_order_of_the_rows(seed: int) -> None:
    rows = weak_rows(seed)
    labels = [f"B{k}" for k in range(11)]
    values, deviations = exact(rows)
    plain = solve(factor_blocks(labels, [rows.copy()]))
    assert make_solver.digits(plain.values, values) < 10, "this design is not weak enough to need refinement"
    shuffled = np.random.default_rng(seed).permutation(rows)
    factor = factor_blocks(labels, [shuffled.copy()])
    for blocks in ([rows], [rows[:7], rows[7:8], rows[8:8], rows[8:]], [np.asfortranarray(shuffled)]):
        refined = refine(factor, blocks)
        assert make_solver.digits(refined.values, values) >= 12
        assert make_solver.digits(refined.standard_uncertainty, deviations) >= 12


def test_a_stream_longer_than_a_block_is_refined_as_one() -> None:
    random = np.random.default_rng(5)
    rows = random.standard_normal((2 * BLOCK_ROWS + 5, 4)) * [1.0, 1e4, 1e-4, 1.0]
    factor = factor_blocks("abc", [rows.copy()])
    one, other = refine(factor, [rows]), refine(factor, iter(np.array_split(rows, 3)))
    assert_allclose(one.values, other.values, rtol=1e-14)
    assert_allclose(one.values, solve(factor).values, rtol=1e-10)
    assert_allclose(one.covariance, solve(factor).covariance, rtol=1e-10)


def test_refinement_leaves_parameters_out_and_keeps_the_noise_as_solve_does() -> None:
    random = np.random.default_rng(1)
    rows = random.standard_normal((40, 5)) * [1.0, 1e3, 1e-3, 1.0, 1.0]
    before = rows.copy()
    factor = factor_blocks("abcd", [rows.copy()])
    L = np.tril(random.standard_normal((40, 40))) / 5 + np.eye(40)
    noise = Noise(L.T @ rows[:, :-1], float(np.trace(L @ L.T)), float(np.sum((L @ L.T) ** 2)))
    for labels in (None, ["d", "b"]):
        for assumed in (None, noise):
            plain, refined = solve(factor, labels, assumed), refine(factor, [rows], labels, assumed)
            assert refined.labels == plain.labels
            assert_allclose(refined.values, plain.values, rtol=1e-11)
            assert_allclose(refined.standard_uncertainty, plain.standard_uncertainty, rtol=1e-11)
            scale = np.outer(plain.standard_uncertainty, plain.standard_uncertainty)
            assert_allclose(refined.covariance / scale, plain.covariance / scale, atol=1e-11)
            assert_allclose(refined.degrees_of_freedom, plain.degrees_of_freedom)
            assert_allclose(refined.residual_std, plain.residual_std, rtol=1e-12)
    np.testing.assert_array_equal(rows, before)


def test_exact_data_leave_no_residual() -> None:
    """Integers that fit exactly: solving leaves rounding error where the residuals should be, refining hardly any."""
    rows = np.column_stack([np.vander(np.arange(21.0), 6), np.vander(np.arange(21.0), 6) @ np.arange(1.0, 7.0)])
    factor = factor_blocks("abcdef", [rows.copy()])
    refined = refine(factor, [rows])
    assert_allclose(refined.values, np.arange(1.0, 7.0), rtol=1e-15)
    assert refined.residual_std < 1e-2 * solve(factor).residual_std


def test_a_tolerance_of_the_caller_decides_what_is_too_weak() -> None:
    rows = weak_rows()
    factor = factor_blocks([f"B{k}" for k in range(11)], [rows.copy()])
    singular_values = np.linalg.svd(factor.R / factor.column_norms, compute_uv=False)
    assert SOLVABLE < singular_values[-1] / singular_values[0] < 1e-8
    assert len(solve(factor).values) == 11
    with pytest.raises(RankError, match=r"the 11 parameters B0, B1, .* are not independent in this test"):
        solve(factor, tolerance=1e-8)
    with pytest.raises(RankError, match="are not independent in this test"):
        refine(factor, [rows], tolerance=1e-8)


def test_other_rows_than_those_of_the_factor_are_refused() -> None:
    rows = np.random.default_rng(2).standard_normal((30, 4))
    factor = factor_blocks("abc", [rows.copy()])
    with pytest.raises(InputError, match="these 29 rows are not the 30 rows of the factor; pass the same rows"):
        refine(factor, [rows[1:]])
    with pytest.raises(InputError, match="these 30 rows are not the 30 rows of the factor"):
        refine(factor, [rows * [1.0, 1.0, 1.0, 1.000001]])
    overwritten = np.asfortranarray(rows.copy())
    factor_blocks("abc", [overwritten])
    assert not np.array_equal(overwritten, rows), "factor_blocks no longer overwrites: say so in refine"
    with pytest.raises(InputError, match="which overwrites arrays in Fortran order"):
        refine(factor, [overwritten])
    with pytest.raises(InputError, match=r"must have 4 columns \[A \| y\], got the shape \(30, 3\)"):
        refine(factor, [rows[:, 1:]])
    for wrong in (np.nan, np.inf):
        broken = rows.copy()
        broken[3, 2] = wrong
        with pytest.raises(InputError, match="is NaN or infinite; every reading must be a finite number"):
            refine(factor, [broken])


def test_without_more_readings_than_parameters_there_is_nothing_to_refine() -> None:
    rows = np.random.default_rng(3).standard_normal((3, 4))
    with pytest.raises(DegreesOfFreedomError, match="3 readings cannot give 3 parameters an uncertainty"):
        refine(factor_blocks("abc", [rows.copy()]), [rows])


def numbers(text: str) -> dict[str, Array]:
    """Figures by set of the first table in a text, values and standard deviations by turns; a dash is not a number."""
    rows = re.findall(r"^\| (\w+) \| (.*) \|$", text, flags=re.MULTILINE)
    cells = {name: re.split(r" [|/] ", cells) for name, cells in rows if name != "set"}
    return {name: np.array([float("nan") if cell == "–" else float(cell) for cell in row]) for name, row in cells.items()}


OWN, REFINED = slice(0, 2), slice(2, 4)
"""Columns of the page: `solve`, `refine`; then the libraries."""


def test_the_page_is_that_of_its_script() -> None:
    """Its words exactly; the refined figures, which no processor changes, to 0.3 digit below NIST's own rounding.

    The others are the least of six processors: here they may be a digit lower, or two and a half higher.
    """
    shown = make_solver.PAGE.read_text(encoding="utf-8")
    sets, origin = make_solver.references()
    here = make_solver.measure_all(sets)
    written, measured = numbers(shown), numbers(make_solver.table(here))
    assert list(written) == list(make_solver.NAMES)
    for name, row in measured.items():
        message = f"{name}, from {origin}: run docs/make_solver.py"
        one, other = np.minimum(row, 14.0), np.minimum(written[name], 14.0)
        assert_allclose(one[REFINED], other[REFINED], rtol=0, atol=0.3, err_msg=message)
        known = ~np.isnan(one)
        assert (np.isnan(one) == np.isnan(other)).all(), message
        if FROM_FILES:  # by formula, other readings are rounded
            assert (one >= other - 1.0)[known].all(), message
            assert (one <= other + 2.5)[known].all(), message
    words = [line for line in shown.splitlines() if not line.startswith("|")]
    assert words == [line for line in make_solver.page(here).splitlines() if not line.startswith("|")]


@pytest.mark.parametrize("name", make_solver.NAMES)
def test_the_page_keeps_every_promise(name: str) -> None:
    """On the worst of six processors, and in the figures as they are printed."""
    row = numbers(make_solver.PAGE.read_text(encoding="utf-8"))[name]
    assert row[OWN].min() >= PROMISED.get(name, 8.5)
    assert row[REFINED].min() >= PROMISED_REFINED.get(name, 9.5)


def test_the_page_takes_the_least_and_never_rounds_up() -> None:
    one, other = ({"Norris": {"way": make_solver.Digits(*pair)}} for pair in ((9.99, 12.0), (10.5, 11.98)))
    (row,) = numbers(make_solver.table(make_solver.least([one, other]))).values()
    assert_allclose(row, [9.9, 11.9])
    assert "9.0 / –" in make_solver.table({"Norris": {"way": make_solver.Digits(9.0, None)}})
