"""How fast: the slope of an indicator over time with its interval, and when it reaches a limit if it goes on."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part

YEAR = 365.2425
"""Days."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Drift(Part):
    """A significant slope of an indicator.

    Attributes
    ----------
    per_year : float
        In the unit of the kind.
    interval : tuple of 2 float
        Of it, 95 %.
    since : float [d]
        Date of the first test of the regression.
    tests : int
        In the regression.
    at_end : float
        The line at the last test, in the unit of the kind.
    end : float [d]
        Date of the last test.
    limit : float
        What it runs into, in the unit of the kind.
    limit_is : str
        `tolerance`, or `relevance` where no tolerance is set.
    limit_at : float or None [d]
        When the line reaches it, if it goes on; None if it never does.
    limit_at_interval : tuple of 2 float [d]
        95 % (Fieller); the later end is infinite where the slope could be too small to reach it.
    """

    per_year: float
    interval: tuple[float, float]
    since: float
    tests: int
    at_end: float
    end: float
    limit: float
    limit_is: str
    limit_at: float | None
    limit_at_interval: tuple[float, float]
