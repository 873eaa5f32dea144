"""When the next test is due, and whether it is overdue: a pure function of dates. Days since 1970-01-01 UTC throughout."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

import numpy as np

from elastogeo.changes.series import Series
from elastogeo.errors import InputError
from elastogeo.result import Part

NOT_ASKED = "no date"
NEVER_TESTED = "never tested"
NOT_DUE = "not due"
DUE = "due"
OVERDUE = "overdue"

AHEAD = 1.0
"""Days that a test may be dated after now: time zones and slow clocks explain less."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DueDate(Part):
    """When a test is due, and how that stands now.

    Attributes
    ----------
    at : float or None [d]
        None where no test is asked for, or none was ever made that it could count from.
    grace : float [d]
        How long after it a test still comes in time.
    state : str
        `NOT_ASKED`, `NEVER_TESTED`, `NOT_DUE`, `DUE` (from the due date to the end of the grace, both
        included) or `OVERDUE`.
    overdue : float [d]
        How long ago the grace ended; zero unless the state is `OVERDUE`.
    """

    at: float | None
    grace: float
    state: str
    overdue: float = 0.0

    @property
    def is_late(self) -> bool:
        """Whether the due date and its grace have gone by without a test."""
        return self.state == OVERDUE


def due_on(at: float | None, grace: float, now: float) -> DueDate:
    """How a due date that was set stands now.

    Parameters
    ----------
    at : float or None [d]
        None: no test is asked for.
    grace : float [d]
    now : float [d]

    Raises
    ------
    InputError
        If the grace is negative, or a date is no number.
    """
    if not (isfinite(grace) and grace >= 0):
        raise InputError(f"the grace is {grace:g} days; give zero or more")
    if not isfinite(now) or not (at is None or isfinite(at)):
        raise InputError(f"a due date of {at} days and a present of {now} days are no dates; give both as numbers")
    if at is None:
        return DueDate(None, grace, NOT_ASKED)
    if now < at:
        return DueDate(at, grace, NOT_DUE)
    if now <= at + grace:
        return DueDate(at, grace, DUE)
    return DueDate(at, grace, OVERDUE, now - at - grace)


def due_after(last: float | None, interval: float | None, grace: float, now: float) -> DueDate:
    """When the next test of a series is due: one interval after the last that stands.

    Parameters
    ----------
    last : float or None [d]
        Date of the last test that was not set aside and showed something; None if there is none. It may lie after `now`,
        where a clock went back: then nothing is due.
    interval : float or None [d]
        Between tests; None: no test is asked for.
    grace, now : float [d]

    Raises
    ------
    InputError
        If the interval is not positive, the grace is negative, or a date is no number.
    """
    if interval is None:
        return due_on(None, grace, now)
    if not (isfinite(interval) and interval > 0):
        raise InputError(f"the interval between tests is {interval:g} days; give a positive number, or none")
    if last is None:
        return DueDate(None, due_on(None, grace, now).grace, NEVER_TESTED)
    return due_on(last + interval, grace, now)


def due_of(series: Series, interval: float | None, grace: float, now: float) -> DueDate:
    """When the next test of a series is due, counted from the last one that stands: not set aside, and it showed something.

    A test that is dated more than `AHEAD` after now has a wrong clock: it counts for no due date.

    Parameters
    ----------
    series : Series
    interval : float or None [d]
    grace, now : float [d]

    Raises
    ------
    InputError
        As `due_after`.
    """
    stands = ~series.aside & np.isfinite(series.value).any(axis=1) & (series.date <= now + AHEAD)
    last = float(series.date[stands][-1]) if stands.any() else None
    return due_after(last, interval, grace, now)
