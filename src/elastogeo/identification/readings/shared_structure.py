"""What runs around a circle have in common and no parameter explains.

An uncertainty by run holds whatever differs from run to run, of any shape. What it cannot hold is what all runs share, or
what goes with their force or sense. It is looked for in the harmonics of every run, each judged by how it scatters between
runs.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import fdtrc

from elastogeo.identification.fit import FALSE_ALARM, HARMONICS, Harmonic
from elastogeo.identification.run_system import RunSystem
from elastogeo.machine import Array

_FULL = 10.0
"""Condition number of the waves above which the angles of a run are no whole turn."""

_ROUNDING = 1e-9
"""Share of the largest coefficient below which scatter is rounding error."""


def shared_harmonic(runs: Sequence[RunSystem], labels: Sequence[str], circles: int = 1) -> Harmonic | None:
    """The surest harmonic that no parameter explains and that runs share; None if they are too few, or no whole turns.

    Parameters
    ----------
    runs : sequence of RunSystem
        Of one circle, no reference subtracted.
    labels : sequence of str
        Parameters of the model.
    circles : int
        How many circles are looked at in one go: a harmonic is significant if it would be in all of them.

    Notes
    -----
    The parameters are fitted to the harmonics anew, each weighted by its own scatter between runs: so the scatter of one
    order does not leak into another through a parameter that has both. What is left of the cosine and sine of an order is
    then explained by what runs share, against what they scatter about that: Wilks' lambda of two variables, which is
    exactly F-distributed. Orders that the model fits are judged with caution, since it has taken their share.
    """
    angles = [run.observations.pose for run in runs]
    waves = [_waves(angle) for angle in angles]
    shared, freedom = _shared(np.array([(1.0, r.force, np.sign(a[-1] - a[0])) for r, a in zip(runs, angles, strict=True)]))
    if freedom < 2 or max(map(np.linalg.cond, waves)) > _FULL:
        return None
    backs = [np.linalg.pinv(wave) for wave in waves]
    seen = np.array([back @ run.reading for back, run in zip(backs, runs, strict=True)])
    designs = np.array([back @ run.design_of(labels) for back, run in zip(backs, runs, strict=True)])
    left = _left(seen, designs, _scatter(seen - shared @ seen, freedom))
    return _surest(left, shared, freedom, FALSE_ALARM / len(HARMONICS) / circles)


def _waves(angle: Array) -> Array:
    """A constant, then cosine and sine of every order, shape (m, 1 + 2 orders)."""
    pairs = [wave(order * angle) for order in HARMONICS for wave in (np.cos, np.sin)]
    return np.column_stack([np.ones_like(angle), *pairs])


def _shared(drivers: Array) -> tuple[Array, int]:
    """Projector, shape (runs, runs), on what runs may share: a constant, the force, the sense; and the freedom beside it."""
    scaled = drivers / np.abs(drivers).max(axis=0).clip(np.finfo(float).tiny)
    vectors, sizes, _ = np.linalg.svd(scaled, full_matrices=False)
    basis = vectors[:, sizes > 1e-6 * sizes[0]]
    return np.asarray(basis @ basis.T), len(drivers) - basis.shape[1]


def _scatter(left: Array, freedom: int) -> Array:
    """Standard deviation of each coefficient between runs, shape (coefficients,); cosine and sine of an order have one."""
    squares = np.sum(left**2, axis=0) / freedom
    squares[1:] = np.repeat(squares[1:].reshape(-1, 2).mean(axis=1), 2)
    return np.asarray(np.sqrt(squares))


def _left(seen: Array, designs: Array, scatter: Array) -> Array:
    """What the parameters leave of the coefficients, shape (runs, coefficients), each in units of its scatter."""
    if not seen.any():
        return seen
    scatter = np.maximum(scatter, _ROUNDING * np.abs(seen).max())
    rows, readings = designs / scatter[:, np.newaxis], seen / scatter
    rows = rows.reshape(-1, rows.shape[-1])
    norms = np.linalg.norm(rows, axis=0)
    values = np.linalg.lstsq(rows / norms, readings.ravel(), rcond=None)[0]
    return np.asarray((readings.ravel() - rows / norms @ values).reshape(seen.shape) * scatter)


def _surest(left: Array, shared: Array, freedom: int, level: float) -> Harmonic:
    """Of what is left, shape (runs, coefficients): the order that runs share most surely."""
    q = len(shared) - freedom
    floor = _ROUNDING * np.abs(left).max()
    surest, found = np.inf, Harmonic(HARMONICS[0], 0.0, False)
    for k, order in enumerate(HARMONICS):
        pair = left[:, 1 + 2 * k : 3 + 2 * k]
        common = shared @ pair
        rest = (pair - common).T @ (pair - common) + floor**2 * np.eye(2)
        within, whole = np.linalg.det(rest), np.linalg.det(rest + common.T @ common)
        root = float(np.sqrt(within / whole)) if 0 < within < whole else 1.0
        p_value = float(fdtrc(2 * q, 2 * (freedom - 1), (1.0 - root) / root * (freedom - 1) / q))
        if p_value < surest:
            amplitude = float(np.linalg.norm(common, axis=1).max())
            surest, found = p_value, Harmonic(order, amplitude, p_value < level)
    return found
