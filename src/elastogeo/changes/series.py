"""A series: the tests of one machine by one recipe, in their order, with what each says of a few named indicators."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from elastogeo.changes.causes import Signatures
from elastogeo.changes.kinds import Kind
from elastogeo.equality import ByValue
from elastogeo.machine import Array
from elastogeo.result import Part

Counts = np.ndarray[tuple[int], np.dtype[np.int_]]
Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]

MOST = 8
"""Indicators of a series at most: each has its share of the false alarms."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Indicator(Part):
    """What one test says of one indicator.

    Attributes
    ----------
    name : str
        `stiffness X`, `squareness XY`, `backlash Y`.
    kind : Kind
    value : float
        In the unit of its kind.
    standard_uncertainty : float
        By the scatter within this test; NaN or infinite if nothing shows it. **What is systematic is not in it**: that is
        alike in all tests of a series, and no reason for them to differ.
    """

    name: str
    kind: Kind
    value: float
    standard_uncertainty: float


@dataclass(frozen=True, slots=True, eq=False)
class Series(ByValue):
    """The tests of one machine by one recipe, n tests and q indicators, in the order in which they were made.

    Attributes
    ----------
    name : str
        Of machine and recipe.
    indicators : tuple of str, length q
    kinds : tuple of Kind, length q
    tests : tuple of str, length n
        A name for each test that no other has.
    date : array, shape (n,) [d]
        Since 1970-01-01 UTC; never falls.
    value : array, shape (n, q)
        In the units of the kinds; NaN where a test does not determine it.
    standard_uncertainty : array, shape (n, q)
        By the test itself; NaN where there is none.
    temperature : array, shape (n,) [degC]
        Of the machine; NaN where it is not known.
    repeats : array of int, shape (n,)
        The test that each repeats on the same day because it was suspect; -1 where it repeats none.
    aside : array of bool, shape (n,)
        Whether a person set it aside.
    instruments : tuple of str, length n
        Serial number of the instrument of each test; empty where it is not known.
    simulated : str
        From what the tests are simulated; empty if they were measured.
    machine : str
        The very machine: `Hermle C50 no. 3`; empty where the name of the series says all.
    signatures : Signatures or None
        How faults of the machine's components move the indicators of this recipe (`signatures_of` one of its results).
    """

    name: str
    indicators: tuple[str, ...]
    kinds: tuple[Kind, ...]
    tests: tuple[str, ...]
    date: Array
    value: Array
    standard_uncertainty: Array
    temperature: Array
    repeats: Counts
    aside: Flags
    instruments: tuple[str, ...]
    simulated: str = ""
    machine: str = ""
    signatures: Signatures | None = None

    def __len__(self) -> int:
        return len(self.tests)


@dataclass(frozen=True, slots=True)
class Baseline:
    """What counts as the machine's ordinary state: set by a person, frozen until a person sets another.

    Attributes
    ----------
    tests : tuple of str
        Those it is made of; none of them is judged by it.
    since : float [d]
        From when on tests are judged by it; after a repair, the day of the repair.
    cleared : tuple of float [d]
        When an alarm was closed as false: the running mean starts anew there, the baseline stays.
    """

    tests: tuple[str, ...]
    since: float
    cleared: tuple[float, ...] = field(default=())


@dataclass(frozen=True, slots=True)
class Tolerance:
    """What a person wants of one indicator of a series.

    Attributes
    ----------
    lower, upper : float or None
        Between which it must stay, in the unit of its kind.
    relevance : float or None
        Least change that is an alarm, in the unit of its kind (a share of the mean where the kind is relative); in place of
        the kind's.
    """

    lower: float | None = None
    upper: float | None = None
    relevance: float | None = None
