"""What is expected of the scatter between tests before a machine has shown its own.

A baseline of ten tests knows its scatter to a quarter. What other machines show of the same indicator says more, and how
much more follows from how alike they are (G. K. Smyth, 2004, Statistical Applications in Genetics and Molecular Biology
3(1), 3: moments of log s^2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import digamma, polygamma

from elastogeo.changes.kinds import Kind
from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import Array

ASSUMED = 6.0
"""Degrees of freedom of the stated reproducibility: machines whose scatter differs by about 30 %."""

MOST = 10.0
"""Degrees of freedom of a fleet's scatter at most: machines that seem alike in few tests may not be."""

LEAST_MACHINES = 3
"""Machines below which a fleet says nothing of how alike they are."""


@dataclass(frozen=True, slots=True, eq=False)
class Prior(ByValue):
    """The expected scatter between tests, and how many degrees of freedom it is worth.

    Attributes
    ----------
    degrees_of_freedom : array, shape (q,)
    deviation : array, shape (q,)
        Standard deviation, in the units of the kinds.
    """

    degrees_of_freedom: Array
    deviation: Array


def default_prior(kinds: Sequence[Kind], mean: Array) -> Prior:
    """The reproducibility that is stated for each kind, worth six degrees of freedom.

    Parameters
    ----------
    kinds : sequence of Kind, length q
    mean : array, shape (..., q)
        Of the baseline; a relative reproducibility is a share of it.
    """
    stated = np.array([kind.reproducibility for kind in kinds])
    relative = np.array([kind.relative for kind in kinds], dtype=bool)
    deviation = stated * np.where(relative, np.abs(mean), 1.0)
    return Prior(np.full(len(kinds), ASSUMED), deviation)


def fleet_prior(deviation: Array, degrees_of_freedom: Array, floor: Array | float = 0.0) -> Prior:
    """The scatter of a fleet, by the moments of log s^2.

    Parameters
    ----------
    deviation : array, shape (machines, q)
        Standard deviation between tests of each machine's baseline, all in one unit (relative kinds: as a share of the
        mean); NaN where a machine does not have the indicator.
    degrees_of_freedom : array, shape (machines, q)
        Of each.
    floor : float or array, shape (q,)
        Uncertainty that is stated: the prior is never below it.

    Returns
    -------
    Prior
        In the unit of `deviation`; NaN where fewer than three machines have an indicator.

    Notes
    -----
    With z = log s^2 and d its degrees of freedom, e = z - psi(d/2) + log(d/2) has the mean log s0^2 - psi(nu0/2) +
    log(nu0/2) and the variance psi'(nu0/2) + psi'(d/2). Machines that differ no more than their baselines explain are
    alike, and worth the most that a prior may be.
    """
    s, d = np.broadcast_arrays(np.asarray(deviation, dtype=float), np.asarray(degrees_of_freedom, dtype=float))
    if s.ndim != 2:
        raise InputError(f"the scatter of a fleet has shape {s.shape}; give a row a machine and a column an indicator")
    shown = np.isfinite(s) & (s > 0) & (d > 0)
    number = np.sum(shown, axis=0)
    half = np.where(shown, d, 2.0) / 2
    log = 2 * np.log(np.where(shown, s, 1.0)) - digamma(half) + np.log(half)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.sum(log, axis=0, where=shown) / number
        variance = np.sum((log - mean) ** 2, axis=0, where=shown) / (number - 1)
        between = variance - np.sum(polygamma(1, half), axis=0, where=shown) / number
    worth = 2 * _inverse_trigamma(between)
    alike = ~np.isfinite(worth)
    middle = np.where(alike, 2.0, worth) / 2
    expected = np.where(alike, mean, mean + digamma(middle) - np.log(middle))
    enough = number >= LEAST_MACHINES
    s0 = np.maximum(np.exp(expected / 2), floor)
    return Prior(np.where(enough, np.minimum(worth, MOST), np.nan), np.where(enough, s0, np.nan))


def _inverse_trigamma(variance: Array) -> Array:
    """Where psi'(y) is the variance; infinite where that is not positive (Newton on 1/psi', Smyth 2004)."""
    positive = np.isfinite(variance) & (variance > 0)
    wanted = np.where(positive, variance, 1.0)
    y = 0.5 + 1 / wanted
    for _ in range(50):
        trigamma = polygamma(1, y)
        change = trigamma * (1 - trigamma / wanted) / polygamma(2, y)
        y = y + change
        if np.all(np.abs(change) <= 1e-12 * y):
            break
    return np.where(positive, y, np.inf)
