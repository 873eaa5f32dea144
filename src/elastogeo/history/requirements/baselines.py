"""The baseline of a series: set by a person, with a reason, and frozen until a person sets another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, insert, select

from elastogeo.errors import InputError
from elastogeo.history.series_of import asides_of
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import baseline, series, test

LEAST = 2
"""Tests of a baseline: one alone shows no scatter. Below six a series is only watched."""


@dataclass(frozen=True, slots=True)
class Chosen:
    """A baseline as it holds.

    Attributes
    ----------
    series : int
    tests : tuple of int
        Keys, in the order of time.
    since : datetime
        From when on tests are judged by it.
    first, last : datetime
        Of its tests.
    new : bool
        False if it was set so already.
    """

    series: int
    tests: tuple[int, ...]
    since: datetime
    first: datetime
    last: datetime
    new: bool


def choose(
    connection: Connection,
    key: int,
    first: int | None = None,
    last: int | None = None,
    begin: datetime | None = None,
    end: datetime | None = None,
) -> tuple[int, ...]:
    """Tests for a baseline: the first or the last so many of those between two dates that are not set aside.

    Parameters
    ----------
    connection : Connection
    key : int
        Of the series.
    first, last : int, optional
        How many; without both all of them.
    begin, end : datetime, optional
        Both included.

    Raises
    ------
    InputError
        If both counts are given, or there are fewer tests.
    """
    if first is not None and last is not None:
        raise InputError("a baseline is made of the first tests or of the last ones; give one of both counts")
    aside = asides_of(connection, key)
    found = [
        row.id
        for row in _tests(connection, key)
        if row.id not in aside and (begin is None or row.at >= begin) and (end is None or row.at <= end)
    ]
    wanted = first if first is not None else last if last is not None else len(found)
    if wanted < LEAST or len(found) < max(wanted, LEAST):
        raise InputError(
            f"{max(wanted, LEAST) if wanted >= LEAST else wanted} tests were asked for as a baseline, and {len(found)} are "
            f"there that are not set aside; take {LEAST} or more of them, 6 or more for alarms"
        )
    return tuple(found[:wanted] if last is None else found[-wanted:])


def set_baseline(
    store: Store, key: int, tests: Sequence[int], *, who: str, why: str, since: datetime | None = None
) -> Chosen:
    """Set the baseline of a series; the same again changes nothing.

    Parameters
    ----------
    store : Store
    key : int
        Of the series.
    tests : sequence of int
        Keys of the tests it is made of.
    who, why : str
    since : datetime, optional
        From when on tests are judged by it; by default from the last of its tests on.

    Raises
    ------
    InputError
        If there are too few, one is of another series or set aside, or no reason is given.
    """
    if not why.strip():
        raise InputError("a baseline is set for a reason that others can read later; give one with --why")
    with write(store) as connection:
        chosen = _checked(connection, key, tests)
        ends = (chosen[0].at, chosen[-1].at)
        begins = since or ends[1]
        keys: list[int] = [row.id for row in chosen]
        old = connection.execute(
            select(baseline.c.tests, baseline.c.since)
            .where(baseline.c.series == key)
            .order_by(baseline.c.id.desc())
            .limit(1)
        ).one_or_none()
        if old is not None and (list(old.tests), old.since) == (keys, begins):
            return Chosen(key, tuple(keys), begins, *ends, new=False)
        row = {"series": key, "tests": keys, "since": begins, "set_at": now(), "who": who, "why": why.strip()}
        connection.execute(insert(baseline).values(row))
        before = None if old is None else {"tests": list(old.tests), "since": old.since.isoformat()}
        told = {"tests": keys, "since": begins.isoformat()}
        audit.record(connection, who, "set baseline", f"series {key}", old=before, new=told, why=why.strip())
    return Chosen(key, tuple(keys), begins, *ends, new=True)


def _checked(connection: Connection, key: int, tests: Sequence[int]) -> list[Any]:
    """The tests in the order of time."""
    if connection.scalar(select(series.c.id).where(series.c.id == key)) is None:
        raise InputError(f"there is no series {key}; `elastogeo history list` shows those that there are")
    wanted, aside = set(tests), asides_of(connection, key)
    known = [row for row in _tests(connection, key) if row.id in wanted]
    missing = wanted - {row.id for row in known}
    if missing:
        raise InputError(f"test {min(missing)} is no test of this series; a baseline is made of its own tests")
    if wanted & aside:
        raise InputError(f"test {min(wanted & aside)} is set aside; a baseline is made of tests that stand")
    if len(known) < LEAST:
        raise InputError(f"a baseline of {len(known)} tests shows no scatter; take {LEAST} or more, 6 or more for alarms")
    return known


def _tests(connection: Connection, key: int) -> Sequence[Any]:
    return connection.execute(select(test.c.id, test.c.at).where(test.c.series == key).order_by(test.c.at, test.c.id)).all()
