"""Distributions of influence quantities (JCGM 101, 6.4): what a half-width or a standard uncertainty stands for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite, sqrt

import numpy as np
from scipy.special import stdtrit

from elastogeo.errors import InputError
from elastogeo.estimate.factor import Array


@dataclass(frozen=True, slots=True)
class _Shape:
    """A centred distribution of unit scale: its standard deviation, and its quantile function of (0, 1)."""

    deviation: float
    quantile: Callable[[Array], Array]


def _triangular(q: Array) -> Array:
    return np.where(q < 0.5, np.sqrt(2 * q) - 1, 1 - np.sqrt(2 - 2 * q))


_BOUNDED = {
    "rectangular": _Shape(1 / sqrt(3), lambda q: 2 * q - 1),
    "triangular": _Shape(1 / sqrt(6), _triangular),
    "arcsine": _Shape(1 / sqrt(2), lambda q: np.sin(np.pi * (q - 0.5))),
}

DISTRIBUTIONS = ("normal", *_BOUNDED)

UNCERTAIN_SCALES = ("normal", "rectangular")
"""Distributions whose scale may be uncertain itself: those with finite degrees of freedom."""


@dataclass(frozen=True, slots=True)
class Influence:
    """An influence quantity: what is known of a systematic effect.

    Attributes
    ----------
    label : str
        What it is, in words: it travels into the budget.
    scale : float
        Of a normal distribution the standard uncertainty, of a rectangular, triangular or arcsine one the half-width.
    distribution : str
        One of `DISTRIBUTIONS`.
    degrees_of_freedom : float
        Of the scale; infinite if it is taken as known. If finite, a normal distribution becomes Student's, and the limits
        of a rectangular one are themselves uncertain by their `1 / sqrt(2 degrees_of_freedom)`-th part (JCGM 100, G.4.2;
        JCGM 101, 6.4.3); the others must be known.
    type_b : bool
        Whether it comes from other knowledge than the scatter of the readings (JCGM 100, 2.3.3).
    """

    label: str
    scale: float
    distribution: str = "normal"
    degrees_of_freedom: float = inf
    type_b: bool = True

    def __post_init__(self) -> None:
        """Refuse what is no distribution."""
        if self.distribution not in DISTRIBUTIONS:
            raise InputError(f"influence {self.label!r}: {self.distribution!r} is none of {', '.join(DISTRIBUTIONS)}")
        if not (isfinite(self.scale) and self.scale > 0):
            raise InputError(f"influence {self.label!r}: its scale is {self.scale:g}, it must be positive and finite")
        if not self.degrees_of_freedom > 0:
            raise InputError(
                f"influence {self.label!r}: {self.degrees_of_freedom:g} degrees of freedom, it needs more than 0"
            )
        if isfinite(self.degrees_of_freedom) and self.distribution not in UNCERTAIN_SCALES:
            raise InputError(
                f"influence {self.label!r}: a {self.distribution} distribution cannot have finite degrees of freedom, "
                f"only {' or '.join(UNCERTAIN_SCALES)} can"
            )
        if self.distribution == "rectangular" and self.degrees_of_freedom < 0.5:
            raise InputError(
                f"influence {self.label!r}: with {self.degrees_of_freedom:g} degrees of freedom the limits would be more "
                f"uncertain than they are wide; a rectangular distribution needs at least 0.5"
            )

    @property
    def standard_uncertainty(self) -> float:
        """Standard uncertainty (JCGM 100, 4.3); what the scale itself is worth is in the degrees of freedom."""
        return self.scale * (_BOUNDED[self.distribution].deviation if self.distribution in _BOUNDED else 1.0)

    def draws(self, random: np.random.Generator, count: int) -> Array:
        """Random values about zero, shape (count,) (JCGM 101, 6.4).

        With finite degrees of freedom they spread wider than the standard uncertainty: they include that of the scale.
        """
        if self.distribution in _BOUNDED:
            scale: float | Array = self.scale
            if isfinite(self.degrees_of_freedom):
                scale = scale * (1 + (2 * random.random(count) - 1) / sqrt(2 * self.degrees_of_freedom))
            return np.asarray(scale * _BOUNDED[self.distribution].quantile(random.random(count)))
        if isfinite(self.degrees_of_freedom):
            return np.asarray(self.scale * random.standard_t(self.degrees_of_freedom, count))
        return np.asarray(self.scale * random.standard_normal(count))


def coverage_factor(degrees_of_freedom: Array, coverage: float = 0.95) -> Array:
    """Student's coverage factor k (JCGM 100, G.3), shape of the degrees of freedom."""
    return np.asarray(stdtrit(degrees_of_freedom, 0.5 + coverage / 2))
