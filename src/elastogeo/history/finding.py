"""Search: machines, series, tests, instruments and events that have all of some words in what is said of them."""

from __future__ import annotations

from typing import Any

from sqlalchemy import ColumnElement, Connection, Select, String, and_, cast, func, or_, select

from elastogeo.changes import FOUND_KINDS, Found, FoundEntry
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import event, instrument, machine, series, test

MOST = 20
"""Of each kind."""
_MOST_WORDS = 8
_LONGEST = 200
"""Letters of a search."""


def found_by(connection: Connection, words: str) -> Found:
    """What has all of these words, in any order, small letters as great ones; nothing for no words.

    A test is found by its number too.
    """
    asked = "".join(letter if letter.isprintable() else " " for letter in words[:_LONGEST]).strip()
    parts = asked.lower().split()[:_MOST_WORDS]
    entries: list[FoundEntry] = []
    more = []
    for kind in FOUND_KINDS if parts else ():
        rows = connection.execute(_QUERIES[kind](parts).limit(MOST + 1)).all()
        entries += [_entry(kind, row) for row in rows[:MOST]]
        more += [kind] if len(rows) > MOST else []
    return Found(asked, tuple(entries), tuple(more))


def _entry(kind: str, row: Any) -> FoundEntry:
    said = row._mapping
    about = " · ".join(dict.fromkeys(str(said[name]) for name in ("owner", "a", "b", "c") if said.get(name)))
    at = said.get("at")
    return FoundEntry(kind, row.id, row.name, about, said.get("machine"), None if at is None else days(at))


def _has(parts: list[str], *columns: ColumnElement[Any]) -> ColumnElement[bool]:
    """Each word is somewhere in these columns; what is a pattern to the database is a letter here."""
    lowered = [func.lower(func.coalesce(column, "")) for column in columns]
    return and_(*(or_(*(one.contains(part, autoescape=True) for one in lowered)) for part in parts))


def _machines(parts: list[str]) -> Select[Any]:
    of = machine.c
    told = (of.kind.label("a"), of.place.label("b"), of.serial.label("c"))
    return select(of.id, of.name, of.id.label("machine"), *told).where(_has(parts, of.name, *told)).order_by(of.name)


def _series(parts: list[str]) -> Select[Any]:
    of, owner = series.c, machine.c.name.label("owner")
    return (
        select(of.id, of.name, of.machine, owner)
        .join(machine, machine.c.id == of.machine)
        .where(_has(parts, of.name, machine.c.name))
        .order_by(machine.c.name, of.name)
    )


def _tests(parts: list[str]) -> Select[Any]:
    of, owner = test.c, machine.c.name.label("owner")
    told = (series.c.name.label("a"), of.who.label("b"), instrument.c.serial.label("c"))
    return (
        select(of.id, of.name, of.at, series.c.machine, owner, *told)
        .join(series, series.c.id == of.series)
        .join(machine, machine.c.id == series.c.machine)
        .outerjoin(instrument, instrument.c.id == of.instrument)
        .where(_has(parts, of.name, cast(of.id, String), of.who, instrument.c.serial, machine.c.name))
        .order_by(of.at.desc(), of.id.desc())
    )


def _instruments(parts: list[str]) -> Select[Any]:
    of = instrument.c
    return (
        select(of.id, of.serial.label("name"), of.kind.label("a")).where(_has(parts, of.serial, of.kind)).order_by(of.serial)
    )


def _events(parts: list[str]) -> Select[Any]:
    of, owner = event.c, machine.c.name.label("owner")
    return (
        select(of.id, of.note.label("name"), of.at, of.machine, owner, of.kind.label("a"), of.who.label("b"))
        .outerjoin(machine, machine.c.id == of.machine)
        .where(_has(parts, of.note, of.kind, of.who, machine.c.name))
        .order_by(of.at.desc(), of.id.desc())
    )


_QUERIES = dict(zip(FOUND_KINDS, (_machines, _series, _tests, _instruments, _events), strict=True))
