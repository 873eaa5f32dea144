"""Simulated histories of machines that are tested again and again: what their indicators are, test by test.

Imports nothing of elastogeo, and knows nothing of its charts: indicators scatter from test to test, machine by machine, and
what else befalls a test is added. One unit is the scatter between tests that is expected before anything was measured.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray[tuple[int, ...], np.dtype[np.float64]]

YEAR = 365.25


@dataclass(frozen=True)
class Fault:
    """What happens to the first indicator.

    Attributes
    ----------
    size : float
        Of the step, or of what each test adds, in standard deviations of the machine's own scatter; of expected scatter
        if `expected`.
    kind : str
        `step` or `ramp`.
    after : int
        Tests after the baseline before it begins.
    expected : bool
    """

    size: float = 0.0
    kind: str = "step"
    after: int = 0
    expected: bool = False


@dataclass(frozen=True)
class Ways:
    """How the histories are made.

    Attributes
    ----------
    indicators, baseline, tests : int
        How many; tests are those after the baseline.
    degrees_of_freedom : float
        Of the inverse chi-square from which the variance of each indicator is drawn; infinite: all as expected.
    spread : float
        Standard deviation of the logarithm of the scatter, drawn normal, on top.
    size : float
        Of the scatter, in units of what is expected.
    correlation : float
        Of one test with the next (AR 1).
    tails : float
        Degrees of freedom of Student's t from which tests are drawn, at unit variance; infinite: normal.
    blunders : float
        Share of tests, of the baseline too, in which one indicator is off by six standard deviations; a repeat redraws it.
    season : float
        Amplitude of what the seasons do, in standard deviations; up or down by chance from indicator to indicator.
    interval : float [d]
    weather : float [K]
        What the temperature does beside the season, from test to test; the machine follows it too.
    thermometer : float [K]
        Standard deviation of the reading of the temperature, which the machine does not follow. The season is 5 K.
    fault : Fault
    """

    indicators: int = 8
    baseline: int = 10
    tests: int = 36
    degrees_of_freedom: float = 6.0
    spread: float = 0.0
    size: float = 1.0
    correlation: float = 0.0
    tails: float = np.inf
    blunders: float = 0.0
    season: float = 0.0
    interval: float = YEAR / 12
    weather: float = 0.0
    thermometer: float = 0.0
    fault: Fault = Fault()


@dataclass(frozen=True)
class Histories:
    """Of n machines.

    Attributes
    ----------
    value : array, shape (n, baseline + tests, q)
    repeated : array, shape (n, baseline + tests, q)
        What a repeat on the same day would say.
    temperature : array, shape (n, baseline + tests) [degC]
        As it was read.
    """

    value: Array
    repeated: Array
    temperature: Array


SEASON = 5.0
"""Amplitude of the temperature over the year [K]."""


def histories(ways: Ways, machines: int, seed: tuple[int, ...]) -> Histories:
    """Draw them."""
    random = np.random.default_rng(seed)
    tests, q = ways.baseline + ways.tests, ways.indicators
    sigma = np.full((machines, 1, q), ways.size)
    if np.isfinite(ways.degrees_of_freedom):
        sigma *= np.sqrt(ways.degrees_of_freedom / random.chisquare(ways.degrees_of_freedom, (machines, 1, q)))
    sigma *= np.exp(ways.spread * random.standard_normal((machines, 1, q)))
    between = _between(ways, (machines, tests, q), random)
    day = ways.interval * np.arange(tests) + YEAR * random.random((machines, 1))
    warmth = SEASON * np.sin(2 * np.pi * day / YEAR) + ways.weather * random.standard_normal((machines, tests))
    response = ways.season / SEASON * random.choice((-1.0, 1.0), (machines, 1, q))
    between += response * warmth[..., np.newaxis]
    between[..., 0] += _fault(ways) / (sigma[..., 0] if ways.fault.expected else 1.0)
    value, repeated = (sigma * (between + _blunders(ways, between.shape, random)) for _ in range(2))
    read = 20 + warmth + ways.thermometer * random.standard_normal(warmth.shape)
    return Histories(value, repeated, read)


def _between(ways: Ways, shape: tuple[int, ...], random: np.random.Generator) -> Array:
    """Scatter between tests, unit variance."""
    if np.isfinite(ways.tails):
        drawn = random.standard_t(ways.tails, shape) * np.sqrt((ways.tails - 2) / ways.tails)
    else:
        drawn = random.standard_normal(shape)
    for k in range(1, shape[1] if ways.correlation else 1):
        drawn[:, k] = ways.correlation * drawn[:, k - 1] + np.sqrt(1 - ways.correlation**2) * drawn[:, k]
    return drawn


def _blunders(ways: Ways, shape: tuple[int, ...], random: np.random.Generator) -> Array:
    hit = random.random(shape[:2]) < ways.blunders
    which = random.integers(shape[2], size=shape[:2])
    off = 6.0 * random.choice((-1.0, 1.0), shape[:2])
    return np.where((which[..., np.newaxis] == np.arange(shape[2])) & hit[..., np.newaxis], off[..., np.newaxis], 0.0)


def _fault(ways: Ways) -> Array:
    gone = np.arange(ways.baseline + ways.tests) - ways.baseline - ways.fault.after
    course = np.where(gone >= 0, 1.0, 0.0) if ways.fault.kind == "step" else np.maximum(gone + 1.0, 0.0)
    return np.asarray(ways.fault.size * course)
