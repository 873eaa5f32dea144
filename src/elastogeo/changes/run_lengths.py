"""Average run lengths of textbook charts: how many tests it takes, on average, until one signals.

The frame is that of the textbooks: values with known mean and deviation, independent, normal, and charts that begin at zero.
What charts do with a baseline of ten tests is another matter; these are what they are compared with.

A run length as a function of where the chart stands solves an integral equation, here by Gauss-Legendre quadrature:
E. S. Page (1954), Biometrika 41, 100; S. V. Crowder (1987), Technometrics 29, 401.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi, sqrt

import numpy as np
from scipy.special import ndtr

from elastogeo.errors import InputError
from elastogeo.machine import Array

NODES = 64
"""Of the quadrature; twice as many change no run length below a million by 1e-9 of itself."""


def shewhart_run_length(shift: Array | float, limit: float = 3.0) -> Array:
    """Of single values beyond +-`limit`.

    Parameters
    ----------
    shift : float or array
        Of the mean, in standard deviations.
    limit : float
        In standard deviations.

    Raises
    ------
    InputError
        If the limit is not above 0.
    """
    _check_positive(limit)
    at = np.asarray(shift, dtype=float)
    return np.asarray(1 / (ndtr(at - limit) + ndtr(-at - limit)))


def ewma_run_length(shift: Array | float, limit: float, smoothing: float = 0.4) -> Array:
    """Of a running mean beyond +-`limit` of the standard deviation that it has after many tests.

    Parameters
    ----------
    shift : float or array
        Of the mean, in standard deviations of one value, from the first value on.
    limit : float
        In standard deviations of the running mean: sqrt(smoothing / (2 - smoothing)) of that of one value.
    smoothing : float
        Share of the newest value, below 1.

    Raises
    ------
    InputError
        If the limit is not above 0, or the smoothing not between 0 and 1.
    """
    _check_positive(limit)
    if not 0 < smoothing < 1:
        raise InputError(f"the smoothing of a running mean is {smoothing}; give a share between 0 and 1")
    h = limit * sqrt(smoothing / (2 - smoothing))
    node, weight = _quadrature(-h, h)
    old = (1 - smoothing) * node

    def from_zero(at: float) -> float:
        """L(z) = 1 + integral of L(y) density(y from z) dy."""
        kernel = _density((node - old[:, np.newaxis]) / smoothing - at) / smoothing * weight
        length = np.linalg.solve(np.eye(NODES) - kernel, np.ones(NODES))
        return float(1 + _density(node / smoothing - at) / smoothing * weight @ length)

    return _of_each(shift, from_zero)


def cusum_run_length(shift: Array | float, limit: float, slack: float = 0.5) -> Array:
    """Of two cumulative sums, one a side, beyond `limit`.

    Parameters
    ----------
    shift : float or array
        Of the mean, in standard deviations.
    limit, slack : float
        h and k, in standard deviations.

    Raises
    ------
    InputError
        If the limit is not above 0.

    Notes
    -----
    1/L = 1/L_up + 1/L_down (K. W. Kemp, 1961, J. Roy. Stat. Soc. B 23, 149).
    """
    _check_positive(limit)
    node, weight = _quadrature(0.0, limit)

    def one_sided(at: float) -> float:
        """L(z) = 1 + L(0) P(back to zero) + integral of L(y) density(y from z) dy, the last row and column for zero."""
        z = np.append(node, 0.0)
        inside = _density(node - z[:, np.newaxis] + slack - at) * weight
        kernel = np.column_stack([inside, ndtr(slack - at - z)])
        return float(np.linalg.solve(np.eye(NODES + 1) - kernel, np.ones(NODES + 1))[-1])

    return _of_each(shift, lambda at: 1 / (1 / one_sided(at) + 1 / one_sided(-at)))


def _check_positive(limit: float) -> None:
    if not limit > 0:
        raise InputError(f"the limit of a chart is {limit}; give a number of standard deviations above 0")


def _quadrature(low: float, high: float) -> tuple[Array, Array]:
    node, weight = np.polynomial.legendre.leggauss(NODES)
    half = (high - low) / 2
    return low + half * (node + 1), half * weight


def _density(x: Array) -> Array:
    return np.asarray(np.exp(-(x**2) / 2) / sqrt(2 * pi))


def _of_each(shift: Array | float, length: Callable[[float], float]) -> Array:
    at = np.asarray(shift, dtype=float)
    return np.reshape([length(one) for one in at.ravel().tolist()], at.shape)
