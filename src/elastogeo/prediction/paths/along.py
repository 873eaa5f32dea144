"""What is known of very many functionals that follow one another along a path.

Two things make a million of them cheap. On a piece of a path they are combinations of a few, so that all that is linear in
them is found of these few. And their degrees of freedom, which are not, change with their direction only, and slowly: they
are found where it has turned by `TURN`, and interpolated between.
"""

from __future__ import annotations

import numpy as np

from elastogeo.machine import Array
from elastogeo.prediction.knowledge import Flags, Knowledge, Predicted, Span
from elastogeo.prediction.support import SUPPORTED

TURN = 0.02
"""Angle [rad] in scaled parameters between two functionals whose degrees of freedom are found; the error between them is of
its square, some thousandths, and that of U far below."""

_MOST = 60
"""Directions from which on a piece of a path is no longer a combination of a few."""

_ROUNDING = 1e-14
"""Square of what a functional may be off in them, as a part of its length: far below what decides on support."""

_INDEPENDENT = 1e-9
"""Singular value, relative to the greatest, of functionals of unit length that counts as a direction."""

_TRIES = 4

Rows = np.ndarray[tuple[int], np.dtype[np.intp]]
"""Numbers of points."""


def predicted_along(knowledge: Knowledge, functional: Array, prior: bool = False) -> Predicted:
    """As `Knowledge.predict`, of functionals that follow one another.

    Parameters
    ----------
    knowledge : Knowledge
    functional : array, shape (c, m, p)
        Of each of c components, m functionals in the order of the path.
    prior : bool

    Returns
    -------
    Predicted
        c m values: all of the first component, then all of the second, ...
    """
    components, m, p = functional.shape
    flat = functional.reshape(-1, p)
    scaled = flat * knowledge.scales
    if prior:
        return knowledge.predict(flat, prior)
    few = _few_directions(scaled)
    span, coefficients, lengths = knowledge.span, flat, scaled
    if few is not None:
        span, coefficients = knowledge.span.of(few / knowledge.scales), scaled @ few.T
        lengths = coefficients
    of_each = zip(coefficients.reshape(components, m, -1), lengths.reshape(components, m, -1), strict=True)
    return Predicted.joined([_one_component(span, part, _knots(length)) for part, length in of_each])


def _one_component(span: Span, coefficients: Array, knots: Rows) -> Predicted:
    if span.scatter is None or 2 * len(knots) > len(coefficients):
        return span.predict(coefficients)
    seen, unseen = (np.sum((coefficients @ part) ** 2, axis=1) for part in (span.seen, span.unseen))
    whole = seen + unseen
    unsupported = np.sqrt(np.divide(unseen, whole, out=np.zeros_like(whole), where=whole > 0))
    supported: Flags = np.asarray(unsupported < SUPPORTED)
    variance = np.sum((coefficients @ span.scatter.moved(span.over)) ** 2, axis=1)
    variance += np.sum((coefficients @ span.systematic) ** 2, axis=1)
    degrees = _between(knots, span.predict(coefficients[knots]).degrees_of_freedom, len(coefficients))
    known = supported & ~np.isnan(degrees)
    return Predicted(
        value=np.where(supported, coefficients @ span.value, np.nan),
        standard_uncertainty=np.where(known, np.sqrt(variance), np.nan),
        degrees_of_freedom=np.where(known, degrees, np.nan),
        supported=supported,
        unsupported=unsupported,
        prior_share=np.zeros(len(coefficients)),
    )


def _knots(scaled: Array) -> Rows:
    """The first and last functional, those that have turned by `TURN` since the knot before, and both ends of each jump."""
    size = np.linalg.norm(scaled, axis=1, keepdims=True)
    unit = np.divide(scaled, size, out=np.zeros_like(scaled), where=size > 0)
    turn = np.linalg.norm(np.diff(unit, axis=0), axis=1)
    steps = np.floor(np.cumsum(turn) / TURN)
    turned = np.flatnonzero(np.diff(steps, prepend=0.0)) + 1
    jumps = np.flatnonzero(turn > TURN)
    return np.unique(np.concatenate([[0, len(unit) - 1], turned, jumps, jumps + 1])).astype(np.intp)


def _between(knots: Rows, degrees: Array, m: int) -> Array:
    """Degrees of freedom at all of m functionals: NaN between two of which one has none."""
    shares = np.interp(np.arange(m), knots, 1.0 / degrees)
    return np.asarray(np.divide(1.0, shares, out=np.full(m, np.inf), where=shares != 0))


def _few_directions(rows: Array) -> Array | None:
    """Orthonormal directions, shape (b, p), of which the rows are combinations to `_ROUNDING`; None if there are many.

    Found from some of the rows, held against all, and mended with those that it misses most.
    """
    size = np.linalg.norm(rows, axis=1)
    there = np.flatnonzero(size)
    if len(there) < 4 * _MOST:
        return None
    unit = rows[there] / size[there, np.newaxis]
    chosen = np.unique(np.linspace(0, len(unit) - 1, 2 * _MOST).round().astype(np.intp))
    for _ in range(_TRIES):
        _, singular_values, directions = np.linalg.svd(unit[chosen], full_matrices=False)
        few = directions[singular_values > _INDEPENDENT * singular_values[0]]
        if len(few) > _MOST:
            return None
        missed = 1.0 - np.sum((unit @ few.T) ** 2, axis=1)
        if missed.max() < _ROUNDING:
            return np.asarray(few)
        chosen = np.append(chosen, np.argsort(missed)[-_MOST:])
    return None
