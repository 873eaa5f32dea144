"""An estimate as the GUM names it: a value, its standard uncertainty, and the degrees of freedom of that uncertainty."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate.distributions import coverage_factor


@dataclass(frozen=True, slots=True)
class Estimate:
    """A number and what it is worth (JCGM 100, 7.2.1).

    Attributes
    ----------
    value : float
        In the unit that the place it stands at names.
    standard_uncertainty : float
        In the same unit; zero if the value is exact, infinite if nothing shows it: then there is no interval.
    degrees_of_freedom : float
        Of the standard uncertainty; infinite if it is known.

    Raises
    ------
    InputError
        If the value is not finite, the uncertainty is negative or no number, or there are no degrees of freedom.
    """

    value: float
    standard_uncertainty: float
    degrees_of_freedom: float = inf

    def __post_init__(self) -> None:
        """Refuse what is no estimate."""
        size = self.standard_uncertainty
        if not (isfinite(self.value) and size >= 0):
            raise InputError(
                f"{self.value:g} with the standard uncertainty {size:g} is no estimate; the value must be finite, the "
                f"uncertainty a number of zero or more"
            )
        if not self.degrees_of_freedom > 0:
            raise InputError(f"an estimate has {self.degrees_of_freedom:g} degrees of freedom; it needs more than 0")

    @property
    def known(self) -> bool:
        """Whether anything shows its uncertainty."""
        return isfinite(self.standard_uncertainty)

    def expanded(self, coverage: float = 0.95) -> float:
        """Expanded uncertainty U: half the width of the coverage interval, by Student's t (JCGM 100, G.3)."""
        return float(coverage_factor(np.array(self.degrees_of_freedom), coverage)) * self.standard_uncertainty

    def interval(self, coverage: float = 0.95) -> tuple[float, float]:
        """Coverage interval, by Student's t (JCGM 100, G.3)."""
        half = self.expanded(coverage)
        return self.value - half, self.value + half

    def scaled(self, factor: float) -> Estimate:
        """The estimate times an exact factor: in another unit, at another place of a transmission."""
        return Estimate(self.value * factor, self.standard_uncertainty * abs(factor), self.degrees_of_freedom)

    def inverse(self) -> Estimate:
        """One over it, with its uncertainty to first order: the stiffness of a compliance.

        Raises
        ------
        UnsupportedError
            If its 95 % interval holds zero, or the value is zero: the inverse is then unbounded.
        """
        if not self.known and self.value:
            return Estimate(1 / self.value, inf)
        low, high = self.interval()
        if low <= 0 <= high:
            raise UnsupportedError(
                f"the value {self.value:.3g} has the 95 % interval {low:.3g} to {high:.3g}, which holds zero: its inverse "
                f"is unbounded; load harder or read finer"
            )
        relative = self.standard_uncertainty / abs(self.value)
        return Estimate(1 / self.value, relative / abs(self.value), self.degrees_of_freedom)
