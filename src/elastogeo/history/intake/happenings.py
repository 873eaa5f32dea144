"""What happened to a machine or an instrument: it stands on the charts and explains, and changes no verdict by itself."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import Connection, insert, or_, select

from elastogeo.changes import EVENT_KINDS, Event, EventList, KeptEvent
from elastogeo.errors import InputError
from elastogeo.history.intake.days import day_of
from elastogeo.history.intake.instruments import instrument_numbered
from elastogeo.history.intake.machines import machine_named
from elastogeo.history.series_of import days, instant
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import calibration, event, instrument, machine, series, test


@dataclass(frozen=True, slots=True)
class Happened:
    """An event that was kept.

    Attributes
    ----------
    key : int
    kind : str
    at : datetime
    note : str
    of : str
        The machine, or the instrument.
    """

    key: int
    kind: str
    at: datetime
    note: str
    of: str


def record_event(
    store: Store,
    kind: str,
    note: str,
    *,
    who: str,
    machine: str | None = None,
    instrument: str | None = None,
    at: str = "",
) -> Happened:
    """Keep an event.

    Parameters
    ----------
    store : Store
    kind : str
        `repair`, `parameter edit`, `move`, `crash`, `calibration` or `note`.
    note : str
        What was done, in words.
    who : str
    machine, instrument : str
        Name of the one, or serial number of the other.
    at : str
        When; by default now.

    Raises
    ------
    InputError
        If the kind is none, there is no note, neither or both are named, or the date cannot be.
    """
    kind = kind.strip().replace("-", " ")
    if kind not in EVENT_KINDS:
        raise InputError(f"{kind!r} is no kind of event; write one of {', '.join(EVENT_KINDS)}")
    if not note.strip():
        raise InputError("an event needs a note: what was done, as in 'X guideway: carriage 2 replaced'")
    if (machine is None) == (instrument is None):
        raise InputError("an event is of one machine or of one instrument; give --machine NAME or --instrument SERIAL")
    when = day_of(at, "the date of the event", now()).at if at else now()
    with write(store) as connection:
        if machine is not None:
            of = machine_named(connection, machine)
            place, name = {"machine": of.key}, of.name
        else:
            tool = instrument_numbered(connection, str(instrument))
            place, name = {"instrument": tool.key}, f"instrument {tool.serial}"
        row = {**place, "kind": kind, "at": when, "note": note.strip(), "who": who, "made_at": now()}
        key = connection.execute(insert(event).values(row).returning(event.c.id)).scalar_one()
        said = {"of": name, "kind": kind, "at": when.isoformat(), "note": note.strip()}
        audit.record(connection, who, "add event", f"event {key}", new=said)
    return Happened(key, kind, when, note.strip(), name)


def listed_events(store: Store, of: str = "", kind: str = "", year: int | None = None) -> EventList:
    """What happened, the newest first, calibrations of instruments among it.

    Parameters
    ----------
    store : Store
    of : str
        A machine, by name or serial number: what happened to it and to the instruments that tested it.
    kind : str
        One of `EVENT_KINDS`; empty: of all.
    year : int, optional

    Raises
    ------
    InputError
        If there is no such machine or kind.
    """
    kind = kind.strip().replace("-", " ")
    if kind and kind not in EVENT_KINDS:
        raise InputError(f"{kind!r} is no kind of event; write one of {', '.join(EVENT_KINDS)}")
    with read(store) as connection:
        owner = machine_named(connection, of) if of else None
        every = _events(connection, None if owner is None else owner.key)
    every.sort(key=lambda one: (-one.event.date, -(one.key or 0)))
    alike = [one for one in every if not kind or one.event.kind == kind]
    years = tuple(sorted({instant(one.event.date).year for one in every}, reverse=True))
    chosen = tuple(one for one in alike if year is None or instant(one.event.date).year == year)
    return EventList(store.url, "" if owner is None else owner.name, kind, year, chosen, years)


def _events(connection: Connection, of: int | None) -> list[KeptEvent]:
    """Of a machine and the instruments that tested it, or all."""
    used = (
        select(test.c.instrument)
        .join(series, series.c.id == test.c.series)
        .where(series.c.machine == of, test.c.instrument.is_not(None))
    )
    asked = (
        select(event, machine.c.name.label("machine_name"), instrument.c.serial)
        .outerjoin(machine, machine.c.id == event.c.machine)
        .outerjoin(instrument, instrument.c.id == event.c.instrument)
    )
    made = select(calibration, instrument.c.serial).join(instrument, instrument.c.id == calibration.c.instrument)
    if of is not None:
        asked = asked.where(or_(event.c.machine == of, event.c.instrument.in_(used)))
        made = made.where(calibration.c.instrument.in_(used))
    found = [
        KeptEvent(
            row.id,
            Event(row.kind, days(row.at), row.note, row.who, row.serial or ""),
            row.machine_name or "",
            row.machine,
        )
        for row in connection.execute(asked)
    ]
    known = {(one.event.instrument, one.event.date) for one in found}
    return found + [
        KeptEvent(None, Event("calibration", days(row.at), row.certificate, row.who, row.serial))
        for row in connection.execute(made)
        if (row.serial, days(row.at)) not in known
    ]
