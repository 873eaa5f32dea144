"""Rounding that repeats share is in the budget; what scatter dithers, or no run repeats, is not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.identification import effects_of, identify, systems_of
from elastogeo.identification.readings.rounding import ROUNDING, found_step, rounding_effects
from studies import coverage
from studies.bar_tests import make_test
from studies.noise import NOISES, Noise

STEP = 5e-4


def sizes(layout: str, noise: Noise, resolution: float | None = None, readings: int = 72) -> list[float]:
    """Standard deviation of each run's rounding by itself, as it enters the budget."""
    systems = systems_of(make_test(layout, noise=noise, seed=3, resolution=resolution, readings=readings))
    effects = list(rounding_effects(systems, resolution))
    if not effects:
        return []
    variance = sum(
        e.influence.standard_uncertainty**2 * np.array([np.mean(e.shift(run) ** 2) for run in systems.runs]) for e in effects
    )
    return [float(size) for size in np.sqrt(variance)]


@pytest.mark.parametrize("scatter", [0.02, 0.1, 0.2, 0.25])
def test_the_shared_part_is_that_of_rounded_repeats(scatter: float) -> None:
    """Against the covariance of two repeats, drawn and rounded here."""
    random = np.random.default_rng(11)
    true = 40 * random.random(200_000)
    pair = [np.round(true + scatter * random.standard_normal(len(true))) - true for _ in range(2)]
    shared = np.sqrt(np.mean(pair[0] * pair[1]))
    assert_allclose(sizes("three pairs", Noise(white=scatter * STEP, step=STEP), readings=9000), shared * STEP, rtol=0.15)


def test_without_scatter_it_is_the_step_over_root_12() -> None:
    assert_allclose(sizes("three pairs", Noise(white=0.0, step=STEP)), STEP / np.sqrt(12), rtol=0.1)


@pytest.mark.parametrize("noise", [Noise(white=STEP, step=STEP), Noise(eccentricity=2 * STEP, step=STEP), Noise()])
def test_what_scatter_dithers_is_none(noise: Noise) -> None:
    assert sizes("three pairs", noise) == []


def test_runs_that_repeat_none_share_none() -> None:
    assert sizes("7 runs", Noise(white=1e-6, step=STEP)) == []
    found = sizes("15 runs", Noise(white=1e-6, step=STEP))
    assert [size > 0 for size in found] == [*(False,) * 3, *(True,) * 10, *(False,) * 2]


def test_a_stated_resolution_counts_where_it_is_the_coarser() -> None:
    noise = Noise(white=5e-5)
    assert sizes("three pairs", noise) == []
    assert sizes("three pairs", noise, resolution=STEP) != []
    stepped = Noise(white=5e-5, step=STEP)
    assert sizes("three pairs", stepped, resolution=STEP / 5) == sizes("three pairs", stepped)


def test_the_step_is_found_from_the_readings() -> None:
    def step(noise: Noise) -> float | None:
        return found_step(systems_of(make_test("three pairs", noise=noise)).runs)

    assert step(Noise(step=STEP)) == pytest.approx(STEP, rel=1e-9)
    assert step(Noise(step=2.4e-4)) == pytest.approx(2.4e-4, rel=1e-9)
    assert step(Noise()) is None
    assert step(Noise(step=1.0)) is None  # all readings alike: any step would do


def test_it_is_a_line_of_the_budget_and_no_influence_that_was_stated() -> None:
    result = identify(make_test("three pairs", noise=Noise(white=1e-5, step=STEP)))
    assert all(ROUNDING in {line.label for line in lines} for lines in result.budget.lines)
    (stated,) = [check for check in result.verdict if check.name == "systematic influences stated"]
    assert stated.passed is not True
    plain = identify(make_test("three pairs", noise=Noise(white=STEP, step=STEP)))
    assert all(ROUNDING not in {line.label for line in lines} for lines in plain.budget.lines)


def test_a_reference_that_is_taken_off_has_none() -> None:
    test = make_test("15 runs", noise=Noise(white=1e-6, step=STEP))
    taken = replace(test, question=replace(test.question, reference_force=36.0))
    assert effects_of(test, systems_of(test))
    assert effects_of(taken, systems_of(taken)) == ()


def test_intervals_of_coarse_readings_cover(monkeypatch: pytest.MonkeyPatch) -> None:
    """A step of twenty times the noise: the scatter of the runs alone holds the truth in too few."""
    monkeypatch.setitem(NOISES, "coarse", Noise(step=2e-3))
    with_it = coverage.covered("three pairs", "coarse", range(25)).pooled
    monkeypatch.setattr(coverage, "effects_of", lambda *of: effects_of(*of)[:2])  # the bar's
    without = coverage.covered("three pairs", "coarse", range(25)).pooled
    print(f"{with_it:.3f}, without {without:.3f}")
    assert without < 0.88
    assert 0.90 < with_it < 0.99
