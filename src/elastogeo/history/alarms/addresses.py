"""Recipients: who is told, by which channel."""

from __future__ import annotations

import os
from dataclasses import replace

from sqlalchemy import Connection, func, insert, select, update

from elastogeo.changes.alarms import Recipient, Recipients
from elastogeo.errors import InputError
from elastogeo.history.alarms.channels import Message, channel, channels
from elastogeo.history.alarms.channels.channel import Settings
from elastogeo.history.alarms.outbox import WAITING
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import outbox, recipient


def recipients(store: Store, whole: bool = True) -> Recipients:
    """All who are told, those who were removed too.

    Parameters
    ----------
    store : Store
    whole : bool
        Whether with all of each address; else without what may be a secret in it.
    """
    with read(store) as connection:
        found = _all(connection)
    return found if whole else replace(found, recipients=tuple(_shortened(one) for one in found.recipients))


def _shortened(one: Recipient) -> Recipient:
    return replace(one, address=shown(one.address))


def add_recipient(
    store: Store, by: str, address: str, who: str, digest: bool = True, settings: Settings | None = None
) -> Recipients:
    """Let somebody be told from now on; again, to change whether he gets the digest, or after he was removed.

    Raises
    ------
    SelectionError
        If there is no such channel.
    InputError
        If it is no address of the channel.
    """
    channel(by).check(address, os.environ if settings is None else settings)
    with write(store) as connection:
        mine = (recipient.c.channel == by) & (recipient.c.address == address)
        before = connection.execute(select(recipient).where(mine)).one_or_none()
        if before is None:
            connection.execute(insert(recipient).values(channel=by, address=address, digest=digest, active=True))
        elif before.digest != digest or not before.active:
            connection.execute(update(recipient).where(mine).values(digest=digest, active=True))
        else:
            return _all(connection)
        old = None if before is None else {"digest": before.digest, "active": before.active}
        audit.record(connection, who, "recipient", f"{by} {shown(address)}", old, {"digest": digest, "active": True})
        return _all(connection)


def remove_recipient(store: Store, by: str, address: str, who: str) -> Recipients:
    """Tell somebody nothing more; what waits for him is given up.

    Raises
    ------
    InputError
        If nobody of this address is told.
    """
    with write(store) as connection:
        mine = (recipient.c.channel == by) & (recipient.c.address == address) & recipient.c.active
        if not connection.execute(update(recipient).where(mine).values(active=False)).rowcount:
            raise InputError(f"nobody is told by {by} at {address!r}; `elastogeo history recipient` lists who is")
        audit.record(connection, who, "recipient", f"{by} {shown(address)}", {"active": True}, {"active": False})
        return _all(connection)


def try_recipient(by: str, address: str, settings: Settings | None = None) -> None:
    """Send a trial message, which no outbox keeps.

    Raises
    ------
    DeliveryError
        If it was not taken.
    """
    given = os.environ if settings is None else settings
    channel(by).check(address, given)
    at = f"{now():%Y-%m-%dT%H:%M:%SZ}"
    said = "Alarms of elastogeo will reach this address. This is a trial: nothing has changed."
    channel(by).send(Message(f"trial-{at}", "Trial of elastogeo", said, {"trial": True, "at": at}), address, given)


def shown(address: str) -> str:
    """An address without what may be a secret in it: of a web address the host only."""
    head, mark, rest = address.partition("://")
    return f"{head}{mark}{rest.partition('/')[0]}/..." if mark else address


def _all(connection: Connection) -> Recipients:
    waiting = select(outbox.c.recipient, func.count()).where(outbox.c.state == WAITING).group_by(outbox.c.recipient)
    counts: dict[int, int] = {row[0]: row[1] for row in connection.execute(waiting)}
    rows = connection.execute(select(recipient).order_by(recipient.c.id))
    found = tuple(Recipient(row.id, row.channel, row.address, row.digest, row.active, counts.get(row.id, 0)) for row in rows)
    return Recipients(found, tuple(made.name for made in channels()))
