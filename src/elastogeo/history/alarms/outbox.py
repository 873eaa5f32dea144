"""The outbox: messages are rows, written in the transaction that makes their cause, and sent later by `delivery`."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, insert, or_, select, update

from elastogeo.changes.alarms import AlarmList, AlarmNews
from elastogeo.history.alarms.channels import Message
from elastogeo.history.alarms.rows import Kept
from elastogeo.history.store.schema import outbox, recipient
from elastogeo.report import view_of

WAITING, SENT, GIVEN_UP = "waiting", "sent", "given up"

NEWER = "a newer message took its place"


def told(connection: Connection, kept: Kept) -> set[int]:
    """Recipients that a message of an alarm reached, or may have reached."""
    mine = outbox.c.step.in_(kept.keys)
    reached = or_(outbox.c.state == SENT, outbox.c.tries > 0)
    return set(connection.scalars(select(outbox.c.recipient).where(mine, reached)))


def was_told(connection: Connection, kept: Kept) -> bool:
    """Whether a message of an alarm was ever made."""
    return connection.scalar(select(outbox.c.id).where(outbox.c.step.in_(kept.keys)).limit(1)) is not None


def post(
    connection: Connection, kept: Kept, step: int, news: AlarmNews, at: datetime, only: Iterable[int] | None = None
) -> int:
    """Put a message of a step into the outbox, for each recipient who has none of it; how many were put.

    What waits of earlier steps is given up: the newest message says all, and nobody is told of the past.

    Parameters
    ----------
    connection : Connection
        Of `write`.
    kept : Kept
    step : int
        Key of the step.
    news : AlarmNews
    at : datetime
    only : iterable of int, optional
        Recipients; else all who are active.
    """
    withdraw(connection, kept, NEWER)
    active = set(connection.scalars(select(recipient.c.id).where(recipient.c.active)))
    have = set(connection.scalars(select(outbox.c.recipient).where(outbox.c.step == step)))
    to = sorted((active if only is None else active.intersection(only)) - have)
    if to:
        view = view_of(news)
        made = content(_key(kept.key, step, at), f"{view.kind}: {view.title}", text_of(news), view.document)
        _put(connection, to, step, made, at)
    return len(to)


def withdraw(connection: Connection, kept: Kept, why: str) -> None:
    """Give up what is waiting of an alarm."""
    mine = outbox.c.step.in_(kept.keys)
    connection.execute(update(outbox).where(mine, outbox.c.state == WAITING).values(state=GIVEN_UP, error=why))


def post_digest(connection: Connection, standing: AlarmList, at: datetime) -> int:
    """Put the digest of this week into the outbox, for each recipient of it who has none yet; how many were put.

    A week is that of the calendar (ISO 8601, UTC), so that a clock that goes back sends no week twice.
    """
    week = "{}-W{:02}".format(*at.isocalendar()[:2])
    wanted = connection.scalars(
        select(recipient.c.id).where(recipient.c.active, recipient.c.digest).order_by(recipient.c.id)
    )
    to = [one for one in wanted if week not in _weeks(connection, one)]
    if to:
        view = view_of(standing)
        made = content(_key("digest", week, at), f"{view.kind}: {view.title}", text_of(standing), view.document)
        late = outbox.c.step.is_(None), outbox.c.state == WAITING, outbox.c.recipient.in_(to)
        connection.execute(update(outbox).where(*late).values(state=GIVEN_UP, error=NEWER))
        _put(connection, to, None, made | {"week": week}, at)
    return len(to)


def content(key: str, subject: str, text: str, document: Any) -> dict[str, Any]:
    """What the outbox keeps of a message."""
    return {"key": key, "subject": subject, "text": text, "document": document}


def message_of(kept: dict[str, Any], to: int) -> Message:
    """The message to one recipient: its key is the same whenever it is tried."""
    return Message(f"{kept['key']}-{to}", kept["subject"], kept["text"], kept["document"])


def text_of(result: AlarmNews | AlarmList) -> str:
    """A result as the text of a letter: the answer, what goes with it, the tables line by line."""
    view = view_of(result)
    tables = (line for table in view.tables for line in _lines(table.title, table.headings, table.rows))
    parts = (view.origin, *view.alert, view.sentence, *view.advice, *view.notes, *tables)
    return "\n\n".join(part for part in parts if part) + "\n"


def _lines(title: str, headings: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    said = ["; ".join(f"{name}: {cell}" for name, cell in zip(headings, row, strict=True) if cell) for row in rows]
    return ["\n".join((title, *said))] if said else []


def _put(connection: Connection, to: Iterable[int], step: int | None, made: dict[str, Any], at: datetime) -> None:
    row = {"step": step, "made_at": at, "content": made, "state": WAITING, "next_at": at}
    connection.execute(insert(outbox), [row | {"recipient": one} for one in to])


def _weeks(connection: Connection, to: int) -> set[str]:
    made = connection.scalars(select(outbox.c.content).where(outbox.c.step.is_(None), outbox.c.recipient == to))
    return {str(one.get("week")) for one in made}


def _key(*parts: object) -> str:
    """Of a message: of this history, since no other made the same step in the same microsecond."""
    return hashlib.sha256("\n".join(map(str, parts)).encode()).hexdigest()[:32]
