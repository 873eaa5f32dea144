"""Huber's robust weights: readings far from the fit count less, by reweighted least squares.

The price, where nothing is wrong: 5 % of the information, so that standard uncertainties grow by 2.6 %.
"""

from __future__ import annotations

import numpy as np

from elastogeo.estimate.factor import Array

HUBER = 1.345
"""Residuals beyond so many standard deviations count less (Huber, 1981: 95 % efficiency for normal noise)."""

_MAD = 0.6744897501960817
"""Median absolute value of a standard normal variable."""


def huber_weights(residual: Array) -> Array:
    """Weights between 0 and 1, shape (m,), of readings with these residuals, shape (m,).

    Their standard deviation comes from the median of their absolute values, which outliers hardly move.
    """
    limit = HUBER * float(np.median(np.abs(residual))) / _MAD
    return np.minimum(1.0, np.divide(limit, np.abs(residual), out=np.ones_like(residual), where=np.abs(residual) > limit))
