"""How often a series is tested, and how long a test may be late."""

from __future__ import annotations

from math import isfinite

from sqlalchemy import select, update

from elastogeo.errors import InputError
from elastogeo.history.store import Store, audit, write
from elastogeo.history.store.schema import series

LONGEST = 36_500.0
"""Days: a hundred years, beyond which a date may be none of the calendar."""


def set_interval(store: Store, key: int, days: float | None, grace: float = 7.0, *, who: str, why: str = "") -> None:
    """Set when the next test of a series is due; None: never.

    Parameters
    ----------
    store : Store
    key : int
        Of the series.
    days : float or None [d]
        Between tests.
    grace : float [d]
        How long after that a test comes in time.
    who, why : str

    Raises
    ------
    InputError
        If there is no such series, or a number is none.
    """
    if days is not None and not (isfinite(days) and days > 0):
        raise InputError(f"the interval between tests is {days:g} days; give a positive number, or 0 for none")
    if not (isfinite(grace) and grace >= 0):
        raise InputError(f"the grace is {grace:g} days; give zero or more")
    for what, number in (("interval between tests", days or 0.0), ("grace", grace)):
        if number > LONGEST:
            raise InputError(f"the {what} is {number:g} days; give at most {LONGEST:g}")
    with write(store) as connection:
        old = connection.execute(select(series.c.interval_days, series.c.grace_days).where(series.c.id == key)).one_or_none()
        if old is None:
            raise InputError(f"there is no series {key}; `elastogeo history list` shows those that there are")
        if (old.interval_days, old.grace_days) == (days, grace):
            return
        connection.execute(update(series).where(series.c.id == key).values(interval_days=days, grace_days=grace))
        before = {"interval_days": old.interval_days, "grace_days": old.grace_days}
        after = {"interval_days": days, "grace_days": grace}
        audit.record(connection, who, "set interval", f"series {key}", old=before, new=after, why=why.strip())
