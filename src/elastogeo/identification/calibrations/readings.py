"""The readings of a calibration: checked pairs, the straight line through them, what its residuals show."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import fdtrc

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Solution, factor_blocks, solve
from elastogeo.machine import Array

SIGNIFICANT = 0.01
"""Probability below which a bend, or a difference of rising and falling pressure, is no chance."""
_ONE_LEVEL = 1e-9
_ROUNDING = 1e-12
"""Share of a reading below which what a fit leaves is rounding."""


def checked_pairs(pressure: Array, reading: Array, what: str, least: int) -> tuple[Array, Array]:
    """Both as arrays of one length, finite, at more than one pressure.

    Parameters
    ----------
    pressure : array, shape (m,) [bar]
    reading : array, shape (m,)
    what : str
        What is read, for messages: `force`.
    least : int
        Readings that are needed.

    Raises
    ------
    InputError
        If they do not fit together, or hold a value that is no finite number.
    UnsupportedError
        If there are too few, or one pressure only.
    """
    pressure, reading = np.asarray(pressure, dtype=float), np.asarray(reading, dtype=float)
    if pressure.ndim != 1 or pressure.shape != reading.shape:
        raise InputError(f"every pressure needs one {what}: got the shapes {pressure.shape} and {reading.shape}")
    for name, values in (("pressure", pressure), (what, reading)):
        if not np.isfinite(values).all():
            row = int(np.flatnonzero(~np.isfinite(values))[0])
            raise InputError(f"the {name} of reading {row + 1} is {values[row]}; remove the reading")
    if len(pressure) < least:
        raise UnsupportedError(f"{len(pressure)} readings are too few for this calibration; take {least} at least")
    if np.ptp(pressure) <= _ONE_LEVEL * np.abs(pressure).max():
        raise UnsupportedError(f"the pressure is {pressure[0]:g} bar at every reading; read at two pressures at least")
    return pressure, reading


def line(columns: Sequence[Array], labels: Sequence[str], reading: Array) -> Solution:
    """Ordinary least squares of a reading on columns, shape (m,) each, with the covariance of white scatter."""
    return solve(factor_blocks(list(labels), [np.asfortranarray(np.column_stack([*columns, reading]))]))


def explained_by_chance(residual: Array, columns: Sequence[Array], more: Array, size: float) -> float:
    """Probability (F-test) that another column explains so much of the residuals of a fit by chance.

    Parameters
    ----------
    residual : array, shape (m,)
    columns : sequence of array, shape (m,)
        Of the fit.
    more : array, shape (m,)
    size : float
        Of the greatest reading: residuals that are rounding show nothing.
    """
    if float(np.abs(residual).max()) <= _ROUNDING * size:
        return 1.0
    basis = np.linalg.qr(np.column_stack(columns))[0]
    extra = more - basis @ (basis.T @ more)
    length = float(extra @ extra)
    freedom = len(residual) - len(columns) - 1
    if length <= _ROUNDING * float(more @ more) or freedom < 1:
        return 1.0
    total = float(residual @ residual)
    gained = min(float(extra @ residual) ** 2 / length, total)
    left = (total - gained) / freedom
    return float(fdtrc(1, freedom, gained / left)) if left > 0 else 0.0


def ways(pressure: Array) -> Array:
    """Whether each reading was reached with rising (1) or falling (-1) pressure, shape (m,); 0 where it does not show."""
    step = np.sign(np.diff(pressure, prepend=pressure[0]))
    for k in range(1, len(step)):
        step[k] = step[k] or step[k - 1]
    return np.asarray(step)
