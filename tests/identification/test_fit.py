"""RMSE, fitness, and the harmonic that is left: by hand, by injection, by rate of false alarms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from elastogeo.identification import fitness, rmse, strongest_harmonic

READINGS = 240
ANGLE = np.arange(READINGS) * 2 * np.pi / READINGS


def test_rmse_is_eq_5_40() -> None:
    predicted, measured = np.array([1.0, 2.0, 3.0, 4.0]), np.array([1.0, 4.0, 3.0, 0.0])
    assert rmse(predicted, measured) == pytest.approx(np.sqrt(20 / 4))
    assert rmse(predicted, predicted) == 0


def test_fitness_is_eq_5_41() -> None:
    predicted, measured = np.array([1.0, 2.0, 3.0, 4.0]), np.array([1.0, 4.0, 3.0, 0.0])
    assert fitness(predicted, measured) == pytest.approx(100 * (1 - np.sqrt(5) / 4))
    assert fitness(measured, measured) == 100
    assert fitness(predicted, np.ones(4)) is None


@pytest.mark.parametrize("order", [1, 2, 5, 12])
@pytest.mark.parametrize("phase", [0.0, 2.0])
def test_an_injected_harmonic_is_found(order: int, phase: float) -> None:
    random = np.random.default_rng(order)
    noise, amplitude = 1e-4, 1.2e-4
    residual = amplitude * np.cos(order * ANGLE + phase) + noise * random.standard_normal(READINGS) + 5e-4
    found = strongest_harmonic(residual, ANGLE)
    assert found.order == order
    # the standard deviation of an amplitude is sigma sqrt(2 / m); 99.9 %
    assert found.amplitude == pytest.approx(amplitude, abs=3.3 * noise * np.sqrt(2 / READINGS))
    assert found.significant


def test_the_strongest_of_two_is_named() -> None:
    residual = 2e-4 * np.cos(3 * ANGLE) + 3e-4 * np.sin(8 * ANGLE)
    found = strongest_harmonic(residual, ANGLE)
    assert (found.order, found.significant) == (8, True)
    assert found.amplitude == pytest.approx(3e-4)


def test_part_of_a_turn_or_another_start_will_do() -> None:
    angle = np.linspace(0.4, 5.0, 200)
    found = strongest_harmonic(1e-3 * np.cos(3 * angle + 1.0), angle)
    assert found.order == 3
    assert found.amplitude == pytest.approx(1e-3)


def test_white_noise_raises_a_false_alarm_once_in_a_hundred_runs() -> None:
    """At the thousand readings of a run of the thesis; sigma is estimated, so with fewer it is a little more often."""
    angle = np.arange(1000) * 2 * np.pi / 1000
    random = np.random.default_rng(12)
    runs = 2500
    alarms = sum(strongest_harmonic(random.standard_normal(1000), angle).significant for _ in range(runs))
    low, high = stats.binom.ppf([0.0005, 0.9995], runs, 0.01)
    assert low <= alarms <= high
