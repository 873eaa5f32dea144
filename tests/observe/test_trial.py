"""A test as a whole, and what an imperfect instrument makes of its readings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, SelectionError
from elastogeo.observe import Imperfection, MachineTest, Residue
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
READINGS = 5000
FORCE = 500.0
ANGLE = np.arange(READINGS) * 2 * np.pi / READINGS


def added(imperfection: Imperfection, seed: int = 0) -> np.ndarray:
    return imperfection.added_to(np.zeros(READINGS), ANGLE, FORCE, np.random.default_rng(seed))


def test_a_test_names_each_run_once(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 200.0])
    with pytest.raises(InputError, match="test 'test' names the run '100 N, 1' twice"):
        replace(test, runs=(*test.runs, test.runs[0]))
    with pytest.raises(InputError, match="test 'test' has no run"):
        replace(test, runs=())


def test_a_perfect_instrument_adds_nothing() -> None:
    reading = np.sin(ANGLE)
    np.testing.assert_array_equal(Imperfection().added_to(reading, ANGLE, FORCE, np.random.default_rng(0)), reading)


def test_noise_is_white_and_of_the_stated_size() -> None:
    noise = added(Imperfection(noise=2e-4))
    # 99.9 %: the relative error of a standard deviation from m readings is 1 / sqrt(2 m)
    assert noise.std() == pytest.approx(2e-4, rel=3.3 / np.sqrt(2 * READINGS))
    assert noise.mean() == pytest.approx(0, abs=3.3 * 2e-4 / np.sqrt(READINGS))
    assert abs(np.mean(noise[1:] * noise[:-1])) < 3.3 * 4e-8 / np.sqrt(READINGS)


def test_resolution_quantises_to_its_steps() -> None:
    step = 0.00024
    reading = 1e-3 * np.sin(ANGLE)
    seen = Imperfection(resolution=step).added_to(reading, ANGLE, FORCE, np.random.default_rng(0))
    assert_allclose(seen / step, np.round(seen / step), atol=1e-9)
    assert len(np.unique(np.round(seen / step))) == 9
    assert np.abs(seen - reading).max() <= step / 2 * (1 + 1e-9)
    assert np.abs(seen - reading).max() > 0.49 * step


def test_a_residue_is_the_harmonic_that_was_asked_for() -> None:
    seen = added(Imperfection(residue=(Residue(3, 4e-4, phase=0.5), Residue(7, 1e-4, amplitude_per_force=2e-7))))
    assert_allclose(seen, 4e-4 * np.cos(3 * ANGLE + 0.5) + 2e-4 * np.cos(7 * ANGLE), atol=1e-15)


def test_runs_scatter_in_their_centre_and_force() -> None:
    imperfection = Imperfection(eccentricity=3e-3, force_scatter=0.02)
    basis = np.column_stack([np.cos(ANGLE), np.sin(ANGLE)]) * 2 / READINGS
    seen = [added(imperfection, seed) for seed in range(400)]
    centres = np.array([reading @ basis for reading in seen])
    assert_allclose(centres.std(axis=0), 3e-3, rtol=3.3 / np.sqrt(2 * 400))
    assert_allclose(seen[0], READINGS / 2 * basis @ centres[0], atol=1e-12)
    random = np.random.default_rng(1)
    factors = np.array([imperfection.force_factor(random) for _ in range(400)])
    assert factors.mean() == pytest.approx(1.0, abs=3.3 * 0.02 / 20)
    assert factors.std() == pytest.approx(0.02, rel=3.3 / np.sqrt(2 * 400))
    assert Imperfection().force_factor(random) == 1.0


def test_a_seed_reproduces_a_simulation_bit_for_bit(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 200.0])
    values, imperfection = {"C_XXX": 1e-4}, Imperfection(noise=1e-4)
    one, same, other = (simulate(test, values, imperfection, seed=seed) for seed in (3, 3, 4))
    for a, b, c in zip(one.runs, same.runs, other.runs, strict=True):
        np.testing.assert_array_equal(a.columns["radial"], b.columns["radial"])
        assert np.abs(a.columns["radial"] - c.columns["radial"]).max() > 1e-5
    first, second = (run.columns["radial"] for run in one.runs)
    assert np.abs(np.corrcoef(first - 100 * second / 200, first)[0, 1]) < 0.99  # runs do not share their noise
    assert "seed 3" in one.simulated


def test_a_simulation_of_an_unknown_parameter_is_refused(make_test: MakeTest) -> None:
    with pytest.raises(SelectionError, match="'C_XXQ' selects no error source of wFYXt"):
        simulate(make_test("wFYXt"), {"C_XXQ": 1.0})
