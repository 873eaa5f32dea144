"""How deviations are magnified and thinned to be drawn: for figures and for plots of plain shapes. No matplotlib."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, floor, log10

import numpy as np

from elastogeo.machine import Array

_OUTWARD, _INWARD = 0.8, 0.6
"""The greatest deviations are drawn at most at these parts of the nominal radius."""
_DIVISIONS = 6
_EDGE = 1e-9
_POINTS, _FEWEST = 30000, 150


@dataclass(frozen=True, slots=True)
class Scale:
    """How deviations are drawn about a nominal circle.

    Attributes
    ----------
    radius : float
        Of the nominal circle, as drawn.
    magnification : float
    division : float [mm]
        Deviation from one ring to the next.
    inner, outer : int
        The innermost and outermost ring, counted from the nominal circle.
    """

    radius: float
    magnification: float
    division: float
    inner: int
    outer: int

    @property
    def limit(self) -> float:
        """Radius that holds all that is drawn."""
        return self.radius + (self.outer + 0.3) * self.division * self.magnification


def scale_for(deviations: Array, radius: float) -> Scale:
    """The scale at which all deviations [mm] can be seen."""
    inward, outward = max(-float(deviations.min()), 0.0), max(float(deviations.max()), 0.0)
    magnification = nice_step(radius / (max(outward / _OUTWARD, inward / _INWARD) or 1.0))
    division = nice_step((inward + outward or 1.0) / _DIVISIONS * 2)
    inner, outer = -ceil(inward / division - _EDGE), max(ceil(outward / division - _EDGE), 1)
    return Scale(radius, magnification, division, inner, outer)


def centre_part(angle: Array, deviation: Array, at: Array) -> Array:
    """The part of a trace that an offset of the circle's centre makes: least squares, orders 0 and 1; of order 1 only.

    Parameters
    ----------
    angle, deviation : array, shape (m,) [rad], [mm]
    at : array, shape (k,) [rad]
        Where it is wanted.

    Returns
    -------
    array, shape (k,) [mm]
        To subtract from the trace, as ball-bar software does before it draws one.
    """
    first = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
    fitted = np.linalg.lstsq(first, deviation, rcond=None)[0]
    return np.asarray(fitted[1] * np.cos(at) + fitted[2] * np.sin(at))


def around(angle: Array, deviation: Array, scale: Scale, traces: int) -> tuple[Array, Array]:
    """Nominal circle plus magnified deviation, as points of the plane; the gap of a full turn is closed."""
    angle, deviation = thinned(angle, deviation, traces)
    gap = 2 * np.pi - float(np.ptp(angle))
    if 0 < gap < 3 * 2 * np.pi / len(angle):
        angle, deviation = np.append(angle, angle[0]), np.append(deviation, deviation[0])
    r = scale.radius + scale.magnification * deviation
    return r * np.cos(angle), r * np.sin(angle)


def nice_step(largest: float) -> float:
    """The greatest of 1, 2, 5 times a power of ten that is not above `largest`."""
    power = 10.0 ** floor(log10(largest))
    return next(step * power for step in (5, 2, 1) if step * power <= largest * (1 + 1e-9))


def thinned(pose: Array, values: Array, traces: int) -> tuple[Array, Array]:
    """What is drawn of a trace: all of it, or the least and the greatest of each of many short pieces, in order.

    Parameters
    ----------
    pose, values : array, shape (m,)
    traces : int
        How many traces the figure has; together they get a bounded number of points, so that its file stays small.
    """
    pieces = max(_FEWEST, _POINTS // (2 * traces))
    if len(values) <= 2 * pieces:
        return pose, values
    edges = np.linspace(0, len(values), pieces + 1).astype(int)
    kept = {0, len(values) - 1}
    for first, last in pairwise(edges):
        kept |= {first + int(np.argmin(values[first:last])), first + int(np.argmax(values[first:last]))}
    chosen = np.array(sorted(kept))
    return pose[chosen], values[chosen]
