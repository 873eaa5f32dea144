"""What happened to machines and instruments: repairs, crashes, moves, calibrations, notes."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form, Query

from elastogeo.changes import EVENT_KINDS, EventList
from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask
from elastogeo.web.fields import Key, Why, Word
from elastogeo.web.pages import Pages

pages = Pages()

Kind = Annotated[str, Form(max_length=40)]
Day = Annotated[str, Form(max_length=40)]
Year = Annotated[int, Query(ge=0, le=9999)]


@pages.shows("/events")
def events(
    asked: Ask,
    machine: Key = 0,
    kind: Word = "",
    year: Year = 0,
) -> Shown:
    """The events of all machines and instruments, by machine, kind and year."""
    of = asked.machine(machine).name if machine else ""
    found = asked.history.events(of, kind, year or None)
    return _shown(asked, found, {"machine": machine, "kind": kind, "year": year, "own": False})


@pages.shows("/machines/{key:int}/events")
def of_machine(
    asked: Ask,
    key: int,
    kind: Word = "",
    year: Year = 0,
) -> Shown:
    """What happened to a machine and to the instruments that tested it."""
    found = asked.history.events(asked.machine(key).name, kind, year or None)
    return _shown(asked, found, {"machine": key, "kind": kind, "year": year, "own": True})


@pages.acts("/machines/{key:int}/events", role=ENGINEER)
def add_to_machine(asked: Ask, key: int, kind: Kind, note: Why, at: Day = "") -> Done:
    """Write down what happened to a machine."""
    got = asked.history.add_event(kind, note, machine=asked.machine(key).name, at=at)
    return Done(f"/machines/{key}/events", f"Written down: {got.kind} of {got.of}.", {"event": got.key})


@pages.acts("/events", role=ENGINEER)
def add(
    asked: Ask,
    kind: Kind,
    note: Why,
    machine: Annotated[int, Form(ge=0, le=2**53)] = 0,
    instrument: Annotated[str, Form(max_length=200)] = "",
    at: Day = "",
) -> Done:
    """Write down what happened to a machine, or to an instrument by its serial number."""
    serial = instrument.strip()
    if bool(machine) == bool(serial):
        raise InputError("an event is of one machine or of one instrument: choose a machine, or give a serial number")
    of = asked.machine(machine).name if machine else None
    got = asked.history.add_event(kind, note, machine=of, instrument=serial or None, at=at)
    return Done("/events", f"Written down: {got.kind} of {got.of}.", {"event": got.key})


def _shown(asked: Ask, found: EventList, context: dict[str, object]) -> Shown:
    more = {"kinds": EVENT_KINDS, "machines": asked.history.machines(), "years": found.years}
    return Shown("machines/events.html.j2", view_of(found), context=context | more)
