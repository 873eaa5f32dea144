"""Tests that a person sets aside, and takes back: they stay in the history with all that they are, and count no more."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Connection, insert, select

from elastogeo.errors import InputError
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import machine, series, set_aside, test


@dataclass(frozen=True, slots=True)
class KnownTest:
    """A test of the history.

    Attributes
    ----------
    key, series : int
    name, machine : str
    at : datetime
    aside : bool
        Whether it is set aside.
    """

    key: int
    series: int
    name: str
    machine: str
    at: datetime
    aside: bool


def set_test_aside(store: Store, key: int, *, who: str, why: str, back: bool = False) -> KnownTest:
    """Set a test aside, or take it back.

    Parameters
    ----------
    store : Store
    key : int
        Of the test.
    who, why : str
    back : bool
        Whether it counts again.

    Raises
    ------
    InputError
        If there is no such test, no reason is given, or it is so already.
    """
    if not why.strip():
        raise InputError("a test is set aside for a reason; say it with --why: 'ball not seated'")
    with write(store) as connection:
        known = _numbered(connection, key)
        if known.aside is not back:
            raise InputError(f"test {key} is {'set aside' if known.aside else 'not set aside'} already; nothing was changed")
        row = {"test": key, "aside": not back, "at": now(), "who": who, "why": why.strip()}
        connection.execute(insert(set_aside).values(row))
        what = "take back" if back else "set aside"
        audit.record(connection, who, what, f"test {key}", old={"aside": back}, new={"aside": not back}, why=why.strip())
        return _numbered(connection, key)


def _numbered(connection: Connection, key: int) -> KnownTest:
    row = connection.execute(
        select(test.c.series, test.c.name, machine.c.name.label("machine"), test.c.at)
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
        .where(test.c.id == key)
    ).one_or_none()
    if row is None:
        raise InputError(f"there is no test {key}; elastogeo history show lists those of a machine")
    said = select(set_aside.c.aside).where(set_aside.c.test == key).order_by(set_aside.c.id.desc()).limit(1)
    aside = bool(connection.execute(said).scalar())
    return KnownTest(key, row.series, row.name, row.machine, row.at, aside)
