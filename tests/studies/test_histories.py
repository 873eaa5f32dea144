"""Simulated histories have the stated sizes, and know nothing of the charts that watch them."""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from studies import histories
from studies.histories import Fault, Ways
from studies.histories import histories as drawn
from studies.watched import BEFORE, NEVER, OTHER, RIGHT, Named, Outcome, Watched, Within

KNOWN = Ways(degrees_of_freedom=np.inf)
N = 4000


def test_they_import_nothing_of_elastogeo() -> None:
    tree = ast.parse(Path(str(histories.__file__)).read_text(encoding="utf-8"))
    imported = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    imported += [name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names]
    assert not [name for name in imported if name.startswith("elastogeo")]


@pytest.mark.parametrize(
    ("ways", "scatter"), [(KNOWN, 1.0), (replace(KNOWN, size=2.0), 2.0), (replace(KNOWN, tails=6.0), 1.0)]
)
def test_the_scatter_is_as_stated(ways: Ways, scatter: float) -> None:
    assert drawn(ways, N, (1,)).value[:, 3].std() == pytest.approx(scatter, rel=0.03)


def test_variances_are_drawn_from_the_inverse_chi_square_and_deviations_from_the_log_normal() -> None:
    """1 / s^2 has mean 1 and variance 2 / nu; log s the spread asked for: both over 46 tests, whose own scatter is small."""
    s2 = drawn(replace(KNOWN, degrees_of_freedom=6.0, tests=400), 300, (2,)).value.var(axis=1).ravel()
    assert np.mean(1 / s2) == pytest.approx(1, rel=0.05)
    assert np.var(1 / s2) == pytest.approx(2 / 6, rel=0.2)
    s = drawn(replace(KNOWN, spread=0.5, tests=400), 300, (2,)).value.std(axis=1).ravel()
    assert np.std(np.log(s)) == pytest.approx(0.5, rel=0.06)


def test_tests_resemble_the_one_before_by_the_stated_correlation() -> None:
    x = drawn(replace(KNOWN, correlation=0.6), N, (3,)).value[..., 0]
    assert np.mean(x[:, 8] * x[:, 9]) == pytest.approx(0.6, abs=5 / np.sqrt(N))
    assert np.mean(x[:, 8] * x[:, 10]) == pytest.approx(0.36, abs=5 / np.sqrt(N))


def test_a_repeat_shares_the_scatter_and_draws_its_blunder_anew() -> None:
    found = drawn(replace(KNOWN, blunders=0.03), N, (4,))
    off = found.value - found.repeated
    assert np.mean(np.any(off != 0, axis=2)) == pytest.approx(2 * 0.03 * 0.97 + 0.03**2 * 15 / 16, rel=0.1)
    assert set(np.round(np.unique(np.abs(off)), 9)) <= {0.0, 6.0, 12.0}
    assert np.max(np.sum(off != 0, axis=2)) == 2


def test_the_season_goes_round_in_a_year_and_the_temperature_says_it() -> None:
    x = drawn(replace(KNOWN, season=2.0, tests=26), N, (5,))
    quiet = drawn(KNOWN, N, (5,))
    assert x.value[:, 20].var() == pytest.approx(1 + 2.0, rel=0.06)
    slope = np.abs(np.mean(x.value[..., 0] * (x.temperature - 20), axis=1)) / 12.5
    assert np.mean(slope) == pytest.approx(0.4, rel=0.1)
    assert np.ptp(x.temperature, axis=1) == pytest.approx(10, abs=0.6)
    assert quiet.value[:, 20].var() == pytest.approx(1, rel=0.06)


@pytest.mark.parametrize(
    ("fault", "last"), [(Fault(3.0, after=4), (0.0, 3.0, 3.0)), (Fault(0.5, "ramp", after=4), (0.0, 0.5, 1.0))]
)
def test_a_fault_begins_when_stated_in_the_first_indicator(fault: Fault, last: tuple[float, ...]) -> None:
    plain, faulty = drawn(KNOWN, 5, (6,)).value, drawn(replace(KNOWN, fault=fault), 5, (6,)).value
    assert np.allclose((faulty - plain)[:, 13:16, 0], last)
    assert not np.any((faulty - plain)[..., 1:])


def test_outcomes_are_put_into_words() -> None:
    assert [Within(5)(Outcome(at, 0, 0)) for at in (0, 5, 6, NEVER)] == [BEFORE, "alarm", "silent", "silent"]
    assert [Named()(Outcome(1, first, 0)) for first in (0, 3)] == [RIGHT, OTHER]


def test_a_machine_is_the_same_in_whatever_block_it_is_drawn() -> None:
    sample = Watched(Ways(tests=3))
    assert sample.draw((7, 501)) == sample.draw((7, 501))
    assert [sample.draw((7, k)) for k in range(500)] != [sample.draw((8, k)) for k in range(500)]
