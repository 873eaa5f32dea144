"""Delivery: what waits in the outbox is claimed, sent without any transaction open, and noted.

A message is sent at least once: whoever claims it and dies has it tried again when its lease ends, under the same key. Two
senders at once claim different messages, since only one writes at a time.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import Connection, and_, func, or_, select, update

from elastogeo.changes.alarms import Delivered, Delivery
from elastogeo.errors import DeliveryError, SelectionError
from elastogeo.history.alarms.assessing import assess_waiting
from elastogeo.history.alarms.channels import Channel, channel
from elastogeo.history.alarms.channels.channel import Settings
from elastogeo.history.alarms.open_ones import standing
from elastogeo.history.alarms.outbox import GIVEN_UP, SENT, WAITING, message_of, post_digest
from elastogeo.history.alarms.rows import PROGRAM
from elastogeo.history.alarms.silences import silent_until
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import alarm, alarm_step, outbox, recipient, series

LEASE = timedelta(minutes=15)
"""For which a message belongs to whoever claimed it: longer than any channel takes."""
FIRST, LONGEST = timedelta(minutes=1), timedelta(hours=8)
"""Wait after the first try; each wait is twice the one before, up to the longest."""
MOST_TRIES = 14
"""After which a message is given up: about a day and a half."""

Draw = Callable[[], float]


def wait_after(tries: int, draw: Draw = random.random) -> timedelta:
    """How long to wait after so many tries: doubled each time, half of it by chance, so that senders do not beat in time."""
    whole = min(FIRST * 2.0 ** min(tries - 1, 20), LONGEST)
    return whole * (0.5 + 0.5 * draw())


def deliver(store: Store, settings: Settings | None = None) -> Delivery:
    """Judge what waited for a repeat long enough, make this week's digest if it is not made, and send what is due.

    Parameters
    ----------
    store : Store
    settings : mapping of str to str, optional
        Variables that the channels look at; else those of the environment.

    Returns
    -------
    Delivery
        What was tried, and what is left.
    """
    settings = os.environ if settings is None else settings
    judged = assess_waiting(store)
    with write(store) as connection:
        at = now()
        post_digest(connection, standing(connection, at), at)
    tried: dict[int, Delivered] = {}
    while (claimed := _claim(store, set(tried))) is not None:
        error = _sent(claimed, settings)
        tried[claimed.key] = _noted(store, claimed, error)
    with read(store) as connection:
        waiting, silenced = _left(connection, now())
    series = tuple(verdict.series.name for verdict in judged)
    return Delivery(days(now()), tuple(tried.values()), waiting, silenced, series)


@dataclass(frozen=True, slots=True)
class _Claimed:
    key: int
    recipient: int
    channel: str
    address: str
    content: dict[str, Any]
    tries: int


def _claim(store: Store, tried: set[int]) -> _Claimed | None:
    """The next message that is due, marked as being sent; None if none is."""
    with write(store) as connection:
        at = now()
        _drop_of_inactive(connection)
        row = connection.execute(_due(connection, at, tried)).first()
        if row is None:
            return None
        values = {"tries": row.tries + 1, "next_at": at + LEASE}
        connection.execute(update(outbox).where(outbox.c.id == row.id).values(**values))
        return _Claimed(row.id, row.recipient, row.channel, row.address, row.content, row.tries + 1)


def _due(connection: Connection, at: datetime, tried: set[int]) -> Any:
    """What is due, oldest first; also what waits for longer than any wait is, since then the clock went back."""
    late = or_(outbox.c.next_at.is_(None), outbox.c.next_at <= at, outbox.c.next_at > at + max(LEASE, LONGEST))
    silent = outbox.c.step.in_(_silent_steps(connection, at))
    return (
        select(outbox, recipient.c.channel, recipient.c.address)
        .join(recipient, recipient.c.id == outbox.c.recipient)
        .where(outbox.c.state == WAITING, late, or_(outbox.c.step.is_(None), ~silent), outbox.c.id.not_in(tried))
        .order_by(outbox.c.id)
        .limit(1)
    )


def _silent_steps(connection: Connection, at: datetime) -> Any:
    return (
        select(alarm_step.c.id)
        .join(alarm, alarm.c.id == alarm_step.c.alarm)
        .join(series, series.c.id == alarm.c.series)
        .where(series.c.machine.in_(list(silent_until(connection, at))))
    )


def _drop_of_inactive(connection: Connection) -> None:
    gone = select(recipient.c.id).where(~recipient.c.active)
    mine = and_(outbox.c.state == WAITING, outbox.c.recipient.in_(gone))
    connection.execute(update(outbox).where(mine).values(state=GIVEN_UP, error="the recipient was removed"))


def _sent(claimed: _Claimed, settings: Settings) -> DeliveryError | None:
    """Send a message; the error if it was not taken."""
    try:
        by: Channel = channel(claimed.channel)
        by.send(message_of(claimed.content, claimed.recipient), claimed.address, settings)
    except DeliveryError as error:
        return error
    except SelectionError as error:
        return DeliveryError(str(error), lasting=True)
    except Exception as error:  # noqa: BLE001 - a fault of one channel must not hold the messages of the others
        # its text is left out: it may quote a secret
        return DeliveryError(f"{claimed.channel}: {type(error).__name__}; correct its address or settings")
    return None


def _noted(store: Store, claimed: _Claimed, error: DeliveryError | None) -> Delivered:
    """Note what became of a try."""
    subject = str(claimed.content["subject"])
    with write(store) as connection:
        at = now()
        mine = outbox.c.id == claimed.key
        if error is None:
            connection.execute(update(outbox).where(mine).values(state=SENT, sent_at=at, next_at=None, error=""))
            audit.record(connection, PROGRAM, "send", f"message {claimed.key}", WAITING, SENT)
            return Delivered(claimed.channel, claimed.address, subject)
        said = str(error)
        mine = and_(mine, outbox.c.state == WAITING)  # one that was withdrawn meanwhile stays so
        if error.lasting or claimed.tries >= MOST_TRIES:
            connection.execute(update(outbox).where(mine).values(state=GIVEN_UP, next_at=None, error=said))
            audit.record(connection, PROGRAM, "send", f"message {claimed.key}", WAITING, GIVEN_UP, said)
            return Delivered(claimed.channel, claimed.address, subject, said)
        again = at + wait_after(claimed.tries)
        connection.execute(update(outbox).where(mine).values(next_at=again, error=said))
        return Delivered(claimed.channel, claimed.address, subject, said, days(again))


def _left(connection: Connection, at: datetime) -> tuple[int, int]:
    """Messages that wait, and how many of them a silence holds."""
    waiting = select(func.count()).select_from(outbox).where(outbox.c.state == WAITING)
    silent = waiting.where(outbox.c.step.in_(_silent_steps(connection, at)))
    return int(connection.scalar(waiting) or 0), int(connection.scalar(silent) or 0)
