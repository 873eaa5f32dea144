"""Which component a changed set of indicators points to, and what this test cannot tell from it."""

from __future__ import annotations

from dataclasses import dataclass, field

from elastogeo.equality import ByValue
from elastogeo.machine import Array
from elastogeo.result import Part


@dataclass(frozen=True, slots=True, eq=False)
class Signatures(ByValue):
    """How each component's fault moves the indicators of a recipe: plain numbers, kept with the series.

    Attributes
    ----------
    components : tuple of str, length c
        `guideway X`, `drive Y`, `squareness XY`, `spindle side`, `instrument`.
    indicators : tuple of str, length q
    matrix : array, shape (c, q)
        Change of each indicator, in its unit, for a fault of the component of a typical size; zero where it moves nothing.
        A component that may fail in several ways has a row for each.
    """

    components: tuple[str, ...]
    indicators: tuple[str, ...]
    matrix: Array


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Cause(Part):
    """A component whose fault would change the indicators as they changed.

    Attributes
    ----------
    component : str
    share : float
        Of the changes, weighted by their scatter, that it explains, 0 to 1.
    score : float
        Its likelihood, relative to all components, 0 to 1.
    supported_by : tuple of str
        Indicators in alarm that it moves to the side on which they moved.
    against : tuple of str
        Indicators that it should have moved and that did not, or that moved although it does not move them.
    alike : tuple of str
        Components whose faults move the indicators of this test in the same way.
    """

    component: str
    share: float
    score: float
    supported_by: tuple[str, ...]
    against: tuple[str, ...] = field(default=())
    alike: tuple[str, ...] = field(default=())
