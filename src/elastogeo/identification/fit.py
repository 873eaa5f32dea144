"""How well predicted readings fit measured ones, and what structure the residuals have left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri

from elastogeo.machine import Array

HARMONICS = range(1, 13)
"""Orders, per turn, at which residuals are searched for structure."""

FALSE_ALARM = 0.01
"""Rate at which residuals without structure may be taken to have one."""


@dataclass(frozen=True, slots=True)
class Fit:
    """How well a model fits some readings.

    Attributes
    ----------
    rmse : float [mm]
        Eq. 5.40.
    fitness : float or None [%]
        Eq. 5.41; None if nothing was measured to vary.
    """

    rmse: float
    fitness: float | None


@dataclass(frozen=True, slots=True)
class Harmonic:
    """The strongest harmonic left in residuals.

    Attributes
    ----------
    order : int
        Per turn.
    amplitude : float [mm]
    significant : bool
        Whether noise would produce it once in a hundred tests at most: of one run, white noise of the size that
        neighbouring readings show; of several runs, what they scatter.
    """

    order: int
    amplitude: float
    significant: bool


def rmse(predicted: Array, measured: Array) -> float:
    """Root mean square error [unit of the readings] (Eq. 5.40)."""
    return float(np.sqrt(np.mean((predicted - measured) ** 2)))


def fitness(predicted: Array, measured: Array) -> float | None:
    """Fitness [%]: `100 (1 - RMSE / (max - min of the measured))` (Eq. 5.41); None if nothing was measured to vary."""
    span = float(np.ptp(measured))
    return 100.0 * (1.0 - rmse(predicted, measured) / span) if span > 0 else None


def fit_of(pairs: Sequence[tuple[Array, Array]]) -> Fit:
    """The fit of one or more (predicted, measured) traces together."""
    predicted, measured = (np.concatenate(values) for values in zip(*pairs, strict=True))
    return Fit(rmse(predicted, measured), fitness(predicted, measured))


def strongest_harmonic(residual: Array, angle: Array, looks: int = 1) -> Harmonic:
    """The strongest harmonic left in the residuals of one run.

    Parameters
    ----------
    residual : array, shape (m,) [mm]
    angle : array, shape (m,) [rad]
    looks : int
        How many runs are searched; the false alarms of all together are one in a hundred.

    Notes
    -----
    The amplitude of white noise at one order follows `4 sigma^2 / m` times chi-squared with two degrees of freedom halved;
    sigma comes from differences of neighbouring readings, which structure hardly touches.
    """
    fits = [_amplitude(residual, angle, order) for order in HARMONICS]
    best = int(np.argmax(fits))
    sigma2 = float(np.mean(np.diff(residual) ** 2) / 2)
    limit = 2 * sigma2 / len(residual) * float(chdtri(2, FALSE_ALARM / len(HARMONICS) / looks))
    return Harmonic(HARMONICS[best], fits[best], fits[best] ** 2 > limit)


def _amplitude(residual: Array, angle: Array, order: int) -> float:
    basis = np.column_stack([np.ones_like(angle), np.cos(order * angle), np.sin(order * angle)])
    coefficients = np.linalg.lstsq(basis, residual, rcond=None)[0]
    return float(np.hypot(coefficients[1], coefficients[2]))
