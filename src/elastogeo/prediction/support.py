"""Whether the tests support a prediction: whether what it asks of the parameters lies in what the tests see of them."""

from __future__ import annotations

import numpy as np

from elastogeo.machine import Array

SUPPORTED = 1e-6
"""Unsupported share of a functional below which it is rounding error. Nothing was found between it and 0.05."""


def unsupported_share(functional: Array, seen: Array, scales: Array) -> Array:
    """The share of each functional that no test sees, shape (m,), 0 to 1: `|c - Q Q^T c| / |c|` in scaled parameters.

    Parameters
    ----------
    functional : array, shape (m, p)
        What is asked of the parameters, in their units.
    seen : array, shape (p, r)
        Orthonormal basis of the row space of the tests, in scaled parameters.
    scales : array, shape (p,)
        Of the parameters, so that no unit decides.
    """
    scaled = functional * scales
    left = scaled - (scaled @ seen) @ seen.T
    length = np.linalg.norm(scaled, axis=1)
    return np.asarray(np.divide(np.linalg.norm(left, axis=1), length, out=np.zeros_like(length), where=length > 0))
