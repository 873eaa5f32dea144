"""Least-squares solutions: against certified values, another library, and the formulas written out."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import statsmodels.api as sm
from numpy.testing import assert_allclose

from elastogeo.errors import DegreesOfFreedomError, RankError, SelectionError
from elastogeo.estimate import Factor, Noise, factor_blocks, merge, minimum_norm, solve
from elastogeo.estimate.factor import Array

_SETS = ["Norris", "Pontius", "NoInt1", "NoInt2", "Longley", "Wampler1", "Wampler2", "Wampler3", "Wampler4", "Wampler5"]
MEASURED_DIGITS = dict(zip(_SETS, (12.1, 12.7, 14.8, 15.0, 10.9, 9.4, 13.0, 9.1, 7.8, 5.8), strict=True))
"""Correct digits of scaled columns and Householder QR on this kind of machine (shared/data/README.md)."""

PROMISED_DIGITS = {"Wampler4": 7.5, "Wampler5": 5.5}
"""Least correct digits (promises); 8.5 for all others."""

SPARE = 0.5
"""Digits that another processor's rounding may cost."""


@dataclass(frozen=True)
class Certified:
    """A NIST StRD set: design, readings, certified values and standard deviations."""

    name: str
    design: Array
    y: Array
    values: Array
    standard_deviations: Array
    residual_std: float


def labelled(design: Array, y: Array) -> Factor:
    return factor_blocks([f"p{k}" for k in range(design.shape[1])], [np.column_stack([design, y])])


def read_certified(path: Path) -> Certified:
    """Read a set verbatim, as NIST publishes it."""
    text = path.read_text(encoding="ascii")
    certified = re.findall(r"^\s+B\d+\s+(\S+)\s+(\S+)\s*$", text, flags=re.MULTILINE)
    residual = re.search(r"Residual\s+Standard Deviation\s+(\S+)", text)
    assert certified
    first, last = map(int, re.search(r"Data\s+\(lines (\d+) to (\d+)\)", text).groups())
    data = np.array([line.split() for line in text.splitlines()[first - 1 : last]], dtype=float)
    y, x = data[:, 0], data[:, 1:]
    values, deviations = np.array(certified, dtype=float).T
    if path.stem == "Longley":
        design = np.column_stack([np.ones(len(y)), x])
    elif path.stem.startswith("NoInt"):
        design = x
    else:
        design = np.vander(x[:, 0], len(values), increasing=True)
    assert design.shape[1] == len(values)
    return Certified(path.stem, design, y, values, deviations, float(residual[1]))


def wampler(number: int) -> Certified:
    """The sets of Wampler by their formulas (NIST StRD): quintics on 0 to 20, with a given disturbance."""
    x = np.arange(21.0)
    design = np.vander(x, 6, increasing=True)
    values = np.array([0.1**k for k in range(6)]) if number == 2 else np.ones(6)
    disturbance = [759, -2048, 2048, -2048, 2523, -2048, 2048, -2048, 1838, -2048, 2048, -2048, 1838, -2048, 2048, -2048]
    disturbance += [2523, -2048, 2048, -2048, 759]
    size = {1: 0, 2: 0, 3: 1, 4: 100, 5: 10000}[number]
    y = np.array([sum(0.1**k * t**k for k in range(6)) for t in x]) if number == 2 else design.sum(axis=1)
    residual = size * np.array(disturbance, float)
    return Certified(
        f"Wampler{number}", design, y + residual, values,
        residual_sd(residual) * np.sqrt(np.diag(exact_inverse(design))), residual_sd(residual),
    )  # fmt: skip


def residual_sd(residual: Array) -> float:
    """The disturbance is orthogonal to all quintics: it is the residual."""
    return float(np.sqrt(residual @ residual / 15))


def exact_inverse(design: Array) -> Array:
    """Inverse of the integer matrix X^T X, in rational arithmetic."""
    p = design.shape[1]
    X = [[int(v) for v in row] for row in design]
    M = [
        [Fraction(sum(r[i] * r[j] for r in X)) for j in range(p)] + [Fraction(int(i == j)) for j in range(p)]
        for i in range(p)
    ]
    for i in range(p):
        M[i] = [v / M[i][i] for v in M[i]]
        for k in range(p):
            if k != i:
                M[k] = [a - M[k][i] * b for a, b in zip(M[k], M[i], strict=True)]
    return np.array([[float(v) for v in row[p:]] for row in M])


def digits(estimated: Array, certified: Array) -> float:
    """Correct digits of the worst: log relative error, of 15 at most, as NIST counts them."""
    error = np.abs(np.asarray(estimated) - certified) / np.where(certified == 0, 1.0, np.abs(certified))
    return float(np.min(-np.log10(np.maximum(error, 1e-15))))


def check_digits(certified: Certified) -> None:
    solution = solve(labelled(certified.design, certified.y))
    wanted = max(MEASURED_DIGITS[certified.name] - SPARE, PROMISED_DIGITS.get(certified.name, 8.5))
    assert digits(solution.values, certified.values) >= wanted
    if certified.residual_std:
        assert digits(solution.standard_uncertainty, certified.standard_deviations) >= min(wanted, 8.5)
        assert digits(solution.residual_std, certified.residual_std) >= min(wanted, 8.5)
    assert set(solution.degrees_of_freedom) == {len(certified.y) - len(certified.values)}


def test_nist_strd_sets_have_their_certified_digits(shared_data: Path) -> None:
    folder = shared_data / "nist-strd"
    paths = sorted(p for p in folder.glob("*.dat") if p.stem != "Filip")
    if paths:
        assert {p.stem for p in paths} == set(MEASURED_DIGITS)
    else:
        print(f"{folder} is not here: only the sets of Wampler are tested, from their formulas")
    for path in paths:
        check_digits(read_certified(path))


def test_a_weak_design_is_solved_and_a_dependent_one_refused(shared_data: Path) -> None:
    """NIST's Filip, a tenth-degree polynomial on -9 to -3: scaled condition 5e9, numpy's default has no correct digit."""
    path = shared_data / "nist-strd" / "Filip.dat"
    if path.exists():
        filip = read_certified(path)
        x = filip.design[:, 1]
        assert digits(solve(labelled(filip.design, filip.y)).values, filip.values) >= 7.5 - SPARE
    else:
        print(f"{path} is not here: only its kind of design is tested")
        x = np.linspace(-8.78149463, -3.13200256, 82)
    design = np.vander(x, 11, increasing=True)
    fitted = design @ solve(labelled(design, design @ np.ones(11))).values
    assert_allclose(fitted, design @ np.ones(11), rtol=1e-9)
    dependent = np.column_stack([design[:, :5], design[:, :5].sum(axis=1)])
    with pytest.raises(RankError, match=r"the 6 parameters p0, p1, .* are not independent in this test"):
        solve(labelled(dependent, x))


@pytest.mark.parametrize("number", [1, 2, 3, 4, 5])
def test_wampler_sets_have_their_certified_digits(number: int, shared_data: Path) -> None:
    generated = wampler(number)
    check_digits(generated)
    path = shared_data / "nist-strd" / f"Wampler{number}.dat"
    if path.exists():  # the formulas are those of NIST
        verbatim = read_certified(path)
        assert_allclose(generated.y, verbatim.y, rtol=1e-15)
        assert_allclose(generated.values, verbatim.values, rtol=1e-15)
        assert_allclose(generated.standard_deviations, verbatim.standard_deviations, rtol=1e-13)


@pytest.fixture(params=range(5))
def regression(request: pytest.FixtureRequest) -> tuple[Array, Array]:
    random = np.random.default_rng(request.param)
    m, p = int(random.integers(8, 60)), int(random.integers(1, 6))
    A = random.standard_normal((m, p)) * 10.0 ** random.integers(-3, 4, p)
    return A, A @ random.standard_normal(p) + 0.1 * random.standard_normal(m)


def test_covariance_and_intervals_agree_with_statsmodels(regression: tuple[Array, Array]) -> None:
    A, y = regression
    solution, other = solve(labelled(A, y)), sm.OLS(y, A).fit()
    assert_allclose(solution.values, other.params, rtol=1e-9)
    assert_allclose(solution.covariance, other.cov_params(), rtol=1e-8, atol=1e-12 * np.abs(other.cov_params()).max())
    assert_allclose(solution.standard_uncertainty, other.bse, rtol=1e-9)
    assert_allclose(solution.degrees_of_freedom, other.df_resid)
    assert_allclose(solution.residual_std, np.sqrt(other.mse_resid), rtol=1e-10)
    for coverage in (0.68, 0.95, 0.99):
        assert_allclose(solution.interval(coverage), other.conf_int(1 - coverage), rtol=1e-8)


def test_leaving_parameters_out_is_a_model_without_them(regression: tuple[Array, Array]) -> None:
    A, y = regression
    some = [f"p{k}" for k in range(0, A.shape[1], 2)]
    solution, other = solve(labelled(A, y), some), sm.OLS(y, A[:, ::2]).fit()
    assert solution.labels == tuple(some)
    assert_allclose(solution.values, other.params, rtol=1e-9)
    assert_allclose(solution.standard_uncertainty, other.bse, rtol=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_correlated_noise_is_the_sandwich_written_out(seed: int) -> None:
    random = np.random.default_rng(seed)
    m, p = 25, 3
    A, y = random.standard_normal((m, p)) * [1.0, 1e3, 1e-3], random.standard_normal(m)
    L = np.tril(random.standard_normal((m, m))) / 3 + np.eye(m)
    omega = L @ L.T
    noise = Noise(root=L.T @ A, trace=np.trace(omega), square=np.trace(omega @ omega))
    solution = solve(labelled(A, y), noise=noise)
    bread = np.linalg.inv(A.T @ A)
    residual = y - A @ (bread @ A.T @ y)
    # E[e^T e] = sigma^2 tr(M Omega): the expected residual square under this noise
    variance = residual @ residual / np.trace((np.eye(m) - A @ bread @ A.T) @ omega)
    assert_allclose(solution.residual_std, np.sqrt(variance), rtol=1e-9)
    expected = variance * bread @ A.T @ omega @ A @ bread
    u = np.sqrt(np.diag(expected))
    assert_allclose(solution.covariance / np.outer(u, u), expected / np.outer(u, u), atol=1e-9)
    some = solve(labelled(A, y), ["p2", "p0"], noise)
    bread = np.linalg.inv(A[:, [2, 0]].T @ A[:, [2, 0]])
    core = bread @ A[:, [2, 0]].T @ omega @ A[:, [2, 0]] @ bread
    u = some.standard_uncertainty
    assert_allclose(some.covariance / np.outer(u, u), core / np.sqrt(np.outer(np.diag(core), np.diag(core))), atol=1e-9)


def test_white_noise_named_as_such_changes_nothing(regression: tuple[Array, Array]) -> None:
    A, y = regression
    factor = labelled(A, y)
    named = solve(factor, noise=Noise(A, float(len(y)), float(len(y))))
    assert_allclose(named.covariance, solve(factor).covariance, rtol=1e-8)
    assert_allclose(named.degrees_of_freedom, solve(factor).degrees_of_freedom)


@pytest.mark.parametrize("rows", [3, 4])
def test_without_more_readings_than_parameters_there_is_no_uncertainty(rows: int) -> None:
    random = np.random.default_rng(0)
    A, y = random.standard_normal((4, 4)), random.standard_normal(4)
    error = RankError if rows < 4 else DegreesOfFreedomError
    message = "are not independent" if rows < 4 else "4 readings cannot give 4 parameters an uncertainty"
    with pytest.raises(error, match=message):
        solve(labelled(A[:rows], y[:rows]))


def test_an_unknown_parameter_is_refused() -> None:
    with pytest.raises(SelectionError, match="no column is called q; there are p0"):
        solve(labelled(np.ones((5, 1)), np.arange(5.0)), ["q"])


def test_minimum_norm_is_that_of_the_scaled_columns() -> None:
    random = np.random.default_rng(1)
    A = random.standard_normal((20, 3)) @ random.standard_normal((3, 6)) * [1.0, 1e3, 1.0, 1e-3, 1.0, 1.0]
    A[:, 4] = 0.0
    y = random.standard_normal(20)
    norms = np.where(A.any(axis=0), np.linalg.norm(A, axis=0), 1.0)
    expected = np.linalg.pinv(A / norms, rcond=1e-10) @ y / norms
    values = minimum_norm(labelled(A, y))
    assert_allclose(values * norms, expected * norms, atol=1e-12)
    assert values[4] == 0


def test_proportional_columns_share_by_their_length_in_the_minimum_norm() -> None:
    a = np.arange(1.0, 9.0)
    assert_allclose(minimum_norm(labelled(np.column_stack([a, a]), 6 * a)), [3.0, 3.0])
    assert_allclose(minimum_norm(labelled(np.column_stack([a, 1000 * a]), 6 * a)), [3.0, 0.003])


def test_the_unit_of_the_readings_only_converts_the_answer(regression: tuple[Array, Array]) -> None:
    A, y = regression
    plain = solve(labelled(A, y))
    for unit in (1e3, 1e-3, 1e6):
        other = solve(labelled(A, y * unit))
        assert_allclose(other.values / unit, plain.values, rtol=1e-10)
        assert_allclose(other.interval() / unit, plain.interval(), rtol=1e-10)


def test_merging_keeps_the_digits() -> None:
    certified = wampler(3)
    halves = [labelled(certified.design[k::7], certified.y[k::7]) for k in range(7)]
    assert digits(solve(merge(*halves)).values, certified.values) >= MEASURED_DIGITS["Wampler3"] - SPARE
