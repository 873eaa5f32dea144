"""What was found of an error, in parts that are written or left out each for itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.estimate import coverage_factor, effective_degrees_of_freedom
from elastogeo.machine import Array, ErrorTable


@dataclass(frozen=True, slots=True, eq=False)
class ErrorPart(ByValue):
    """A part of an error: a curve, or what the axis loses when it turns back.

    Attributes
    ----------
    names : tuple of str
        Of the parameters that it is made of; of a table by targets `E_XX` and `B_XX`.
    value, uncertainty : array, shape (k, 2) [mm or rad]
        By position and direction; the uncertainty is expanded, for 95 %, and NaN where nothing shows it.
    """

    names: tuple[str, ...]
    value: Array
    uncertainty: Array

    @property
    def size(self) -> float:
        """Root mean square over all points [mm or rad]."""
        return float(np.sqrt(np.mean(self.value**2)))

    @property
    def doubt(self) -> float:
        """Root mean square of the expanded uncertainty; NaN if it is not known at every point."""
        return float(np.sqrt(np.mean(self.uncertainty**2)))

    @property
    def is_certain(self) -> bool:
        """Whether writing it makes the error smaller for sure: it is greater than its expanded uncertainty."""
        return self.size > self.doubt


@dataclass(frozen=True, slots=True, eq=False)
class FoundError(ByValue):
    """What was found of one component along one axis.

    Attributes
    ----------
    table : ErrorTable
        All of it, with its uncertainty.
    parts : tuple of ErrorPart
        Their sum is the table.
    zero_at : float [mm or rad]
        Position at which the mean of both directions counts as zero.
    unknown : tuple of str
        What belongs to it and was not determined.
    by_target : bool
        Whether it was read at targets; if not, it follows from parameters.
    """

    table: ErrorTable
    parts: tuple[ErrorPart, ...]
    zero_at: float
    unknown: tuple[str, ...] = ()
    by_target: bool = False

    def certain(self) -> ErrorTable | None:
        """The table of those parts whose uncertainty allows it; None if there are none."""
        chosen = [part for part in self.parts if part.is_certain]
        if not chosen:
            return None
        table = self.table
        value = np.sum([part.value for part in chosen], axis=0)
        return ErrorTable(table.axis, table.component, table.position, value, table.uncertainty)


def zero_within(axis: str, low: float, high: float, wanted: float | None) -> float:
    """The position whose error counts as zero: as wanted, else 0, or the end nearest to it.

    Raises
    ------
    InputError
        If what is wanted is outside.
    """
    if wanted is None:
        return min(max(0.0, low), high)
    if not low <= wanted <= high:
        raise InputError(f"the error of {axis} is to be zero at {wanted:g}, and was read from {low:g} to {high:g} only")
    return wanted


def expanded(contributions: Array, freedom: Array) -> Array:
    """Expanded uncertainty of 95 %, shape (q,), of independent contributions, shape (q, n), and their degrees of freedom."""
    factor = coverage_factor(effective_degrees_of_freedom(contributions, freedom))
    return np.asarray(factor * np.linalg.norm(contributions, axis=1))
