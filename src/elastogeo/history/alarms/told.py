"""One alarm with its steps and messages, as a person reads it."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import Connection, select

from elastogeo.changes.alarms import AlarmMessage, AlarmStep, KeptAlarm
from elastogeo.history.alarms.addresses import shown
from elastogeo.history.alarms.open_ones import rows_of
from elastogeo.history.alarms.rows import Kept, alarm_of
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import alarm_step, outbox, recipient


def kept_alarm(connection: Connection, number: int, at: datetime) -> KeptAlarm:
    """An alarm, open or closed.

    Raises
    ------
    InputError
        If there is none of this number.
    """
    kept = alarm_of(connection, number)
    (row,) = rows_of(connection, [kept], at)
    steps = tuple(
        AlarmStep(step.state, days(step.at or kept.opened), step.who, step.why, step.test, dict(step.facts.get("over", {})))
        for step in kept.steps
    )
    return KeptAlarm(days(at), row, steps, _messages(connection, kept))


def _messages(connection: Connection, kept: Kept) -> tuple[AlarmMessage, ...]:
    rows = connection.execute(
        select(outbox, recipient.c.channel, recipient.c.address, alarm_step.c.state.label("of"))
        .join(recipient, recipient.c.id == outbox.c.recipient)
        .join(alarm_step, alarm_step.c.id == outbox.c.step)
        .where(outbox.c.step.in_(kept.keys))
        .order_by(outbox.c.id)
    )
    return tuple(
        AlarmMessage(
            row.of,
            row.channel,
            shown(row.address),
            row.state,
            days(row.made_at),
            None if row.sent_at is None else days(row.sent_at),
            row.tries,
            row.error,
        )
        for row in rows
    )
