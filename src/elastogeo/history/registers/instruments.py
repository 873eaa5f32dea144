"""Instruments as the store keeps them: read with their calibrations, tests and alarms."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime
from math import inf

from sqlalchemy import Connection, func, select

from elastogeo.changes import Calibration, Event, InstrumentRecord, KeptInstrument, KeptInstruments, TestWith, due_on
from elastogeo.changes.alarms import CLOSED
from elastogeo.errors import InputError
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import alarm, alarm_step, calibration, event, instrument, machine, series, test

MOST_TESTS = 100
"""Of an instrument that a record holds."""


def instruments(connection: Connection, store: str, at: datetime) -> KeptInstruments:
    """All instruments, those whose calibration has run out first."""
    made = _made_with(connection)
    alarms = _open_alarms(connection)
    known = _calibrations(connection)
    found = [
        _kept(row.id, row.serial, row.kind, known.get(row.id, ()), made.get(row.id), alarms.get(row.id), at)
        for row in connection.execute(select(instrument).order_by(instrument.c.serial))
    ]
    ordered = sorted(found, key=lambda one: (one.due.at if one.due.at is not None else inf, one.serial))
    return KeptInstruments(store, days(at), tuple(ordered))


def instrument_record(connection: Connection, key: int, at: datetime) -> InstrumentRecord:
    """One instrument with what was done with it.

    Raises
    ------
    InputError
        If there is none of this key.
    """
    found = next((one for one in instruments(connection, "", at).instruments if one.key == key), None)
    if found is None:
        raise InputError(f"there is no instrument {key}")
    return InstrumentRecord(days(at), found, _tests(connection, found), _alarms(connection, key), _events(connection, found))


Made = tuple[int, tuple[str, ...], float | None]


def _kept(
    key: int, serial: str, kind: str, known: Iterable[Calibration], made: Made | None, alarm_of: int | None, at: datetime
) -> KeptInstrument:
    known = tuple(known)
    due = due_on(known[0].due if known else None, 0.0, days(at))
    count, machines, last = made or (0, (), None)
    return KeptInstrument(key, serial, kind, known, due, count, machines, last, alarm_of)


def _calibrations(connection: Connection) -> dict[int, list[Calibration]]:
    """By instrument, the last first; of two of one day the later entry, which says more."""
    found: dict[int, list[Calibration]] = {}
    rows = connection.execute(select(calibration).order_by(calibration.c.at.desc(), calibration.c.id.desc()))
    for row in rows:
        due = None if row.due is None else days(row.due)
        found.setdefault(row.instrument, []).append(Calibration(days(row.at), due, row.certificate, row.who))
    return found


def _made_with(connection: Connection) -> dict[int, Made]:
    """By instrument how many tests, of which machines, and when the last was."""
    rows = connection.execute(
        select(test.c.instrument, machine.c.name, func.count(), func.max(test.c.at))
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
        .where(test.c.instrument.is_not(None))
        .group_by(test.c.instrument, machine.c.name)
        .order_by(machine.c.name)
    )
    found: dict[int, Made] = {}
    for key, name, count, last in rows:
        known, names, latest = found.get(key, (0, (), None))
        at = days(last)
        found[key] = (known + count, (*names, name), at if latest is None else max(latest, at))
    return found


def _open_alarms(connection: Connection) -> dict[int, int]:
    closed = select(alarm_step.c.alarm).where(alarm_step.c.state.in_(CLOSED))
    rows = connection.execute(
        select(alarm.c.instrument, alarm.c.id).where(alarm.c.instrument.is_not(None), alarm.c.id.not_in(closed))
    )
    return {row.instrument: row.id for row in rows}


def _tests(connection: Connection, of: KeptInstrument) -> tuple[TestWith, ...]:
    rows = connection.execute(
        select(test.c.id, test.c.name, test.c.at, machine.c.name.label("machine"), series.c.name.label("series"))
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
        .where(test.c.instrument == of.key)
        .order_by(test.c.at.desc(), test.c.id.desc())
        .limit(MOST_TESTS)
    )
    return tuple(
        TestWith(row.id, row.name, row.machine, row.series, days(row.at), _expired(of.calibrations, days(row.at)))
        for row in rows
    )


def _expired(known: Iterable[Calibration], at: float) -> bool:
    """Whether the last calibration before a test had run out when it was made."""
    last = next((one for one in known if one.at <= at), None)
    return last is not None and last.due is not None and last.due < at


def _alarms(connection: Connection, key: int) -> tuple[tuple[int, str, float], ...]:
    last = select(func.max(alarm_step.c.id)).group_by(alarm_step.c.alarm)
    rows = connection.execute(
        select(alarm.c.id, alarm_step.c.state, alarm_step.c.at)
        .join(alarm_step, alarm_step.c.alarm == alarm.c.id)
        .where(alarm.c.instrument == key, alarm_step.c.id.in_(last))
        .order_by(alarm.c.id.desc())
    )
    return tuple((row.id, row.state, days(row.at)) for row in rows)


def _events(connection: Connection, of: KeptInstrument) -> tuple[Event, ...]:
    rows = connection.execute(
        select(event).where(event.c.instrument == of.key).order_by(event.c.at.desc(), event.c.id.desc())
    )
    return tuple(Event(row.kind, days(row.at), row.note, row.who, of.serial) for row in rows)
