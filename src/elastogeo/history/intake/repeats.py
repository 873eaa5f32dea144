"""Which suspect test another one repeats: as a person says, else by itself where the series waits for a repeat.

A signal is first *suspect*: the tester is asked to repeat the test the same day, and only a repeat confirms it. The test
that comes next within the rule's wait is taken for that repeat, unless it comes as late as an ordinary test would: after
half of the usual interval of the series. A day's grace holds for those that test every day.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime, timedelta

import numpy as np
from sqlalchemy import Connection, select

from elastogeo.changes import ALARM, SUSPECT, Rule
from elastogeo.errors import InputError
from elastogeo.history.store.schema import series_state, set_aside, test

WasSuspect = Callable[[Connection, int, datetime], bool]

LAST = "last"
NONE = "none"

SHARE = 0.5
"""Of the usual interval between tests, after which a test is no repeat but the next one."""

LEAST = timedelta(days=1)
_LOOKED_AT = 12


def repeated_by(
    connection: Connection, series: int, at: datetime, asked: str | int | None, was_suspect: WasSuspect | None = None
) -> tuple[int | None, bool]:
    """The test that a new one repeats.

    Parameters
    ----------
    connection : Connection
    series : int
    at : datetime
        When the new one was measured.
    asked : str, int or None
        `last`: the last test of the series; `none`; the key of a test; None: found by itself.
    was_suspect : callable, optional
        `was_suspect(connection, series, at)`: whether the series waited for a repeat on that day. It is asked where the
        series is in alarm now: a suspect test and its repeat may both come in late, when the wait is over.

    Returns
    -------
    int or None
        Key of that test.
    bool
        Whether it was found by itself.

    Raises
    ------
    InputError
        If there is no such test in the series, or it was measured later.
    """
    if asked == NONE:
        return None, False
    last = _last(connection, series)
    if asked is None:
        near = last is not None and timedelta() <= at - last[1] <= _longest(connection, series)
        found = near and _is_suspect(connection, series, at, was_suspect)
        return (last[0] if last is not None and found else None), True
    if asked == LAST and last is None:
        raise InputError("the series has no test yet that this one could repeat; leave --repeats out")
    key = last[0] if asked == LAST and last is not None else _key(asked)
    measured = connection.execute(select(test.c.at).where(test.c.id == key, test.c.series == series)).scalar()
    if measured is None:
        raise InputError(f"test {key} is none of this series, so this one cannot repeat it; give last, or the right number")
    if measured > at:
        raise InputError(f"test {key} was measured at {measured:%Y-%m-%d %H:%M} UTC, after this one, which cannot repeat it")
    return key, False


def _key(asked: str | int) -> int:
    try:
        return int(asked)
    except ValueError:
        raise InputError(f"--repeats is {asked!r}; give last, none, or the number of a test") from None


def _is_suspect(connection: Connection, series: int, at: datetime, was_suspect: WasSuspect | None) -> bool:
    state = connection.execute(select(series_state.c.state).where(series_state.c.series == series)).scalar()
    return state == SUSPECT or (state == ALARM and was_suspect is not None and was_suspect(connection, series, at))


def _last(connection: Connection, series: int) -> tuple[int, datetime] | None:
    """The last test of a series that is not set aside."""
    rows = connection.execute(
        select(test.c.id, test.c.at)
        .where(test.c.series == series)
        .order_by(test.c.at.desc(), test.c.id.desc())
        .limit(_LOOKED_AT)
    )
    for key, at in rows:
        said = select(set_aside.c.aside).where(set_aside.c.test == key).order_by(set_aside.c.id.desc()).limit(1)
        if not connection.execute(said).scalar():
            return key, at
    return None


def _longest(connection: Connection, series: int) -> timedelta:
    """How long after a suspect test the next one is its repeat."""
    wait = timedelta(days=Rule().wait)
    dates = connection.execute(
        select(test.c.at).where(test.c.series == series).order_by(test.c.at.desc()).limit(_LOOKED_AT)
    ).scalars()
    days = np.array([at.timestamp() for at in dates]) / 86_400
    gaps = -np.diff(days)
    gaps = gaps[gaps > LEAST / timedelta(days=1)]  # a repeat the same day is no interval
    if not len(gaps):
        return wait
    return max(LEAST, min(wait, timedelta(days=SHARE * float(np.median(gaps)))))
