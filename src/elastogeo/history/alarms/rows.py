"""Alarms as the store keeps them: read with their steps, opened, and a step further."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime

from sqlalchemy import ColumnElement, Connection, insert, select, update

from elastogeo.changes.alarms import CLOSED
from elastogeo.errors import InputError
from elastogeo.history.alarms.life import Step, is_held, is_open
from elastogeo.history.store import audit
from elastogeo.history.store.schema import alarm, alarm_step

PROGRAM = "elastogeo"
"""Who takes the steps that no person takes."""


@dataclass(frozen=True, slots=True)
class Kept:
    """An alarm with its steps.

    Attributes
    ----------
    key : int
    series, instrument : int or None
        Of one of them it is the alarm.
    held_by : int or None
        The alarm of the instrument that holds it back.
    opened : datetime
    steps : tuple of Step
        Oldest first.
    keys : tuple of int
        Of the steps.
    """

    key: int
    series: int | None
    instrument: int | None
    held_by: int | None
    opened: datetime
    steps: tuple[Step, ...]
    keys: tuple[int, ...]

    @property
    def is_open(self) -> bool:
        """Whether it waits for a person to close it."""
        return is_open(self.steps)

    @property
    def is_held(self) -> bool:
        """Whether the alarm of an instrument holds it back."""
        return is_held(self.steps)


def alarms(connection: Connection, *which: ColumnElement[bool]) -> tuple[Kept, ...]:
    """The alarms that fit, oldest first, each with its steps."""
    rows = connection.execute(select(alarm).where(*which).order_by(alarm.c.id)).all()
    if not rows:
        return ()
    steps: dict[int, list[tuple[int, Step]]] = {row.id: [] for row in rows}
    taken = connection.execute(select(alarm_step).where(alarm_step.c.alarm.in_(list(steps))).order_by(alarm_step.c.id))
    for row in taken:
        steps[row.alarm].append((row.id, Step(row.state, row.facts, row.test, row.at, row.who, row.why)))
    return tuple(
        Kept(
            row.id,
            row.series,
            row.instrument,
            row.held_by,
            row.opened_at,
            tuple(step for _, step in steps[row.id]),
            tuple(key for key, _ in steps[row.id]),
        )
        for row in rows
    )


def open_alarms(connection: Connection) -> tuple[Kept, ...]:
    """All that no person has closed, oldest first."""
    closed = select(alarm_step.c.alarm).where(alarm_step.c.state.in_(CLOSED))
    return alarms(connection, alarm.c.id.not_in(closed))


def open_alarm(connection: Connection, series: int | None = None, instrument: int | None = None) -> Kept | None:
    """The open alarm of a series or of an instrument: there is one at most."""
    own = alarm.c.series == series if series is not None else alarm.c.instrument == instrument
    closed = select(alarm_step.c.alarm).where(alarm_step.c.state.in_(CLOSED))
    found = alarms(connection, own, alarm.c.id.not_in(closed))
    return found[-1] if found else None


def alarm_of(connection: Connection, key: int) -> Kept:
    """The alarm of a key.

    Raises
    ------
    InputError
        If there is none.
    """
    found = alarms(connection, alarm.c.id == key)
    if not found:
        raise InputError(f"there is no alarm {key}; `elastogeo history digest` lists those that are open")
    return found[0]


def open_one(connection: Connection, at: datetime, series: int | None = None, instrument: int | None = None) -> Kept:
    """A new alarm, which has no step yet: its first must follow in the same transaction."""
    key = connection.execute(insert(alarm).values(series=series, instrument=instrument, opened_at=at)).inserted_primary_key
    assert key is not None
    return Kept(key[0], series, instrument, None, at, (), ())


def take(connection: Connection, kept: Kept, steps: Sequence[Step], at: datetime) -> Kept:
    """Add steps to an alarm, and to the audit trail."""
    for step in steps:
        step = replace(step, at=at)
        values = {
            "state": step.state,
            "at": at,
            "test": step.test,
            "facts": dict(step.facts),
            "who": step.who,
            "why": step.why,
        }
        key = connection.execute(insert(alarm_step).values(alarm=kept.key, **values)).inserted_primary_key
        assert key is not None
        before = kept.steps[-1].state if kept.steps else None
        audit.record(connection, step.who or PROGRAM, "alarm", f"alarm {kept.key}", before, step.state, step.why)
        kept = replace(kept, steps=(*kept.steps, step), keys=(*kept.keys, key[0]))
    return kept


def hold(connection: Connection, kept: Kept, by: int | None) -> Kept:
    """Note which alarm of an instrument holds this one back; None: none does."""
    connection.execute(update(alarm).where(alarm.c.id == kept.key).values(held_by=by))
    return replace(kept, held_by=by)
