"""How alarms stand: each as a row with its names, and the list of all that wait for somebody."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from datetime import datetime, timedelta

from sqlalchemy import Connection, select

from elastogeo.changes import MachineRow, due_after, due_on
from elastogeo.changes.alarms import ACKNOWLEDGED, CLOSED, HELD, OPEN, AlarmList, AlarmRow, FailedRow, OverdueRow
from elastogeo.history.alarms.addresses import shown
from elastogeo.history.alarms.life import Step, is_acknowledged, is_held, recorded
from elastogeo.history.alarms.outbox import GIVEN_UP, NEWER
from elastogeo.history.alarms.rows import Kept, alarms, open_alarms
from elastogeo.history.alarms.silences import silences, silent_until
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import (
    alarm,
    alarm_step,
    instrument,
    machine,
    outbox,
    plan,
    recipient,
    series,
    series_state,
    test,
)

WEEK = timedelta(days=7)


def standing(connection: Connection, at: datetime) -> AlarmList:
    """All that waits for somebody: open alarms, overdue tests, messages of the last week that did not arrive."""
    rows = rows_of(connection, open_alarms(connection), at)
    known = {OPEN: 0, HELD: 2}
    ordered = sorted(rows, key=lambda row: (known.get(row.state, 1), row.opened, row.number))
    return AlarmList(days(at), tuple(ordered), overdue(connection, at), _failed(connection, at), simulated(connection))


def unknown(connection: Connection) -> int:
    """How many open alarms nobody has acknowledged, but for those that are held back; every page asks: states alone."""
    closed = select(alarm_step.c.alarm).where(alarm_step.c.state.in_(CLOSED))
    asked = select(alarm_step.c.alarm, alarm_step.c.state).where(alarm_step.c.alarm.not_in(closed))
    steps: dict[int, list[Step]] = {}
    for row in connection.execute(asked.order_by(alarm_step.c.id)):
        steps.setdefault(row.alarm, []).append(Step(row.state))
    return sum(not is_held(taken) and not is_acknowledged(taken) for taken in steps.values())


def lately(connection: Connection, at: datetime, closed: timedelta) -> AlarmList:
    """The same, with the alarms that were closed within so long, and the machines of which nothing is sent."""
    ended = select(alarm_step.c.alarm).where(alarm_step.c.state.in_(CLOSED), alarm_step.c.at > at - closed)
    rows = rows_of(connection, alarms(connection, alarm.c.id.in_(ended)), at)
    known = sorted(rows, key=lambda row: (-row.at, row.number))
    return replace(standing(connection, at), closed=tuple(known), silences=silences(connection, at))


def rows_of(connection: Connection, kept: Iterable[Kept], at: datetime) -> tuple[AlarmRow, ...]:
    """Alarms with the names of what they are of."""
    kept = tuple(kept)
    named = {
        row.id: row
        for row in connection.execute(
            select(
                series.c.id,
                series.c.name,
                series.c.machine,
                machine.c.name.label("of"),
                machine.c.place,
                series_state.c.verdict,
            )
            .join(machine, machine.c.id == series.c.machine)
            .outerjoin(series_state, series_state.c.series == series.c.id)
            .where(series.c.id.in_([one.series for one in kept if one.series is not None]))
        )
    }
    serials = dict(connection.execute(select(instrument.c.id, instrument.c.serial)).all())
    silent = silent_until(connection, at)
    origins = _origins(connection, [one.series for one in kept if one.series is not None])
    rows = []
    for one in kept:
        own = named.get(one.series) if one.series is not None else None
        until = silent.get(own.machine) if own is not None else None
        shown = MachineRow.of_document(own.verdict["row"]) if own is not None and own.verdict and one.is_open else None
        confirmed = any(bool(step.facts.get("confirmed")) for step in one.steps)
        rows.append(
            AlarmRow(
                number=one.key,
                machine=own.of if own is not None else "",
                series=own.name if own is not None else "",
                instrument=serials[one.instrument] if one.instrument is not None else "",
                state=_state(one),
                opened=days(one.opened),
                over=recorded(one.steps),
                confirmed=confirmed or (shown is not None and shown.confirmed),
                who=next((step.who for step in reversed(one.steps) if step.who), ""),
                why=next((step.why for step in reversed(one.steps) if step.who), ""),
                at=days(one.steps[-1].at or one.opened),
                holds=_holds(connection, one),
                silent_until=None if until is None else days(until),
                simulated=simulated(connection) if one.series is None else origins.get(one.series, ""),
                place=own.place if own is not None else "",
                shown=shown,
                held_by=one.held_by if one.is_held else None,
                machine_key=own.machine if own is not None else None,
                series_key=one.series,
                instrument_key=one.instrument,
            )
        )
    return tuple(rows)


def overdue(connection: Connection, at: datetime) -> tuple[OverdueRow, ...]:
    """Series and plans whose due date and grace have gone by, the longest first."""
    now = days(at)
    rows = connection.execute(
        select(
            series.c.name, series.c.interval_days, series.c.grace_days, machine.c.name.label("of"), series_state.c.last_test
        )
        .join(machine, machine.c.id == series.c.machine)
        .outerjoin(series_state, series_state.c.series == series.c.id)
        .where(series.c.interval_days.is_not(None))
    ).all()
    found = []
    for row in rows:
        last = None if row.last_test is None else days(row.last_test)
        due = due_after(last, row.interval_days, row.grace_days, now)
        if due.is_late and due.at is not None:
            found.append(OverdueRow(row.of, row.name, due.at, due.overdue))
    plans = connection.execute(
        select(plan.c.name, plan.c.due, plan.c.grace_days, machine.c.name.label("of"))
        .join(machine, machine.c.id == plan.c.machine)
        .where(plan.c.done_at.is_(None), plan.c.due.is_not(None))
    ).all()
    for planned in plans:
        due = due_on(days(planned.due), planned.grace_days, now)
        if due.is_late and due.at is not None:
            found.append(OverdueRow(planned.of, planned.name, due.at, due.overdue))
    return tuple(sorted(found, key=lambda row: (-row.overdue, row.machine, row.series)))


def _origins(connection: Connection, keys: list[int]) -> dict[int, str]:
    """By series from what its tests are simulated; empty if any was measured."""
    rows = connection.execute(
        select(test.c.series, test.c.origin, test.c.from_what).where(test.c.series.in_(keys)).distinct()
    )
    found: dict[int, list[tuple[str, str]]] = {}
    for row in rows:
        found.setdefault(row.series, []).append((row.origin, row.from_what))
    return {key: _simulated(of) for key, of in found.items()}


def simulated(connection: Connection, key: int | None = None) -> str:
    """From what the tests of a series, or of all, are simulated; empty if any was measured or there is none."""
    which = select(test.c.origin, test.c.from_what).distinct()
    rows = connection.execute(which if key is None else which.where(test.c.series == key))
    return _simulated([(row.origin, row.from_what) for row in rows])


def _simulated(origins: Iterable[tuple[str, str]]) -> str:
    origins = list(origins)
    if any(origin != "simulated" for origin, _ in origins):
        return ""
    return "\n".join(sorted({what or "a model" for _, what in origins}))


def _state(one: Kept) -> str:
    if not one.is_open:
        return one.steps[-1].state
    if one.is_held:
        return HELD
    return ACKNOWLEDGED if is_acknowledged(one.steps) else OPEN


def _holds(connection: Connection, one: Kept) -> tuple[str, ...]:
    if one.instrument is None:
        return ()
    mine = [held.series for held in alarms(connection, alarm.c.held_by == one.key)]
    names = select(machine.c.name).join(series, series.c.machine == machine.c.id).where(series.c.id.in_(mine)).distinct()
    return tuple(sorted(connection.scalars(names)))


def _failed(connection: Connection, at: datetime) -> tuple[FailedRow, ...]:
    rows = connection.execute(
        select(outbox.c.content, outbox.c.error, outbox.c.made_at, recipient.c.channel, recipient.c.address)
        .join(recipient, recipient.c.id == outbox.c.recipient)
        .where(outbox.c.state == GIVEN_UP, outbox.c.tries > 0, outbox.c.error != NEWER, outbox.c.made_at > at - WEEK)
        .order_by(outbox.c.id)
    )
    return tuple(
        FailedRow(row.channel, shown(row.address), row.content["subject"], row.error, days(row.made_at)) for row in rows
    )
