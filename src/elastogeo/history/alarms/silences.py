"""Silences: until when nothing is sent of a machine. What a silence holds is not lost: it is sent when it ends."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

from sqlalchemy import Connection, func, insert, select

from elastogeo.changes.alarms import SilenceRow
from elastogeo.errors import InputError
from elastogeo.history.names import machine_key
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import machine, silence


def silent_until(connection: Connection, at: datetime) -> dict[int, datetime]:
    """By machine that is silent, until when; what was said last of a machine counts."""
    last = select(func.max(silence.c.id)).group_by(silence.c.machine)
    rows = connection.execute(select(silence.c.machine, silence.c.until).where(silence.c.id.in_(last), silence.c.until > at))
    return {row.machine: row.until for row in rows}


def silences(connection: Connection, at: datetime) -> tuple[SilenceRow, ...]:
    """Those that hold, by machine."""
    last = select(func.max(silence.c.id)).group_by(silence.c.machine)
    rows = connection.execute(
        select(silence, machine.c.name)
        .join(machine, machine.c.id == silence.c.machine)
        .where(silence.c.id.in_(last), silence.c.until > at)
        .order_by(machine.c.name)
    )
    return tuple(SilenceRow(row.name, row.machine, days(row.until), days(row.at), row.who, row.why) for row in rows)


def end_of(said: str, where: str) -> datetime | None:
    """When a silence ends that is said to: a day ends at its midnight, where this computer is; None: now.

    Parameters
    ----------
    said : str
        `2026-12-24`, `2026-12-24T12:00`, `now`.
    where : str
        Who says it, for the message.

    Raises
    ------
    InputError
        If it is no date.
    """
    if said == "now":
        return None
    try:
        end = datetime.fromisoformat(said)
        if len(said) <= len("2026-12-24"):
            end += timedelta(days=1)
        end = end if end.tzinfo is not None else end.astimezone()
        end.astimezone(UTC)  # as it is kept: the last hours of the calendar are of no year there
    except (ValueError, OverflowError):
        raise InputError(
            f"{where} is {said[:40]!r}; give a day, as 2026-12-24, a time, as 2026-12-24T12:00, or now"
        ) from None
    return end


def silence_machine(store: Store, name: str, until: datetime | None, who: str, why: str) -> None:
    """Send nothing of a machine until then; None: send again, now.

    Raises
    ------
    InputError
        If there is no such machine, no reason, or the time has no zone or is past.
    """
    if not why.strip():
        raise InputError("a silence needs a reason, for whoever asks why nobody was told; give it with --why")
    if until is not None and until.tzinfo is None:
        raise InputError(f"{until} has no time zone; a silence ends at a point in time")
    with write(store) as connection:
        at, key = now(), machine_key(connection, name)
        if until is not None and until <= at:
            raise InputError(f"{until:%Y-%m-%d %H:%M %Z} is past; give a day to come, or now to end a silence")
        end = until or at
        connection.execute(insert(silence).values(machine=key, until=end, at=at, who=who, why=why))
        audit.record(connection, who, "silence", f"machine {key}", None, end.isoformat(), why)
