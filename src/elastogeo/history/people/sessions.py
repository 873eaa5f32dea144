"""Sessions: from log-in to log-out, a pause too long, or the end of the week.

Only the SHA-256 of what the cookie holds is kept.
"""

from __future__ import annotations

import hashlib
import secrets
from datetime import datetime, timedelta

from sqlalchemy import ColumnElement, Connection, and_, delete, insert, select, update

from elastogeo.history.store import Store, now, write
from elastogeo.history.store.schema import session

IDLE, ABSOLUTE = timedelta(hours=12), timedelta(days=7)
"""After which a session ends: a pause of a shift; a week, whatever happens."""
TOUCH = timedelta(minutes=5)
"""How old it may be when somebody was seen last: not every page writes."""
_FORGET = timedelta(days=90)
_PATIENCE = 0.25
"""Seconds that it waits for its turn to keep who was here: the next page does it as well."""
_BYTES = 32


def new_secret() -> str:
    """What nobody guesses: 256 bits."""
    return secrets.token_urlsafe(_BYTES)


def digest(secret: str) -> str:
    """What is kept of a secret; one of 256 bits needs no salt and no slow function."""
    return hashlib.sha256(secret.encode("utf-8", "replace")).hexdigest()


def living(at: datetime) -> ColumnElement[bool]:
    """Sessions that have not ended."""
    return and_(session.c.ended_at.is_(None), session.c.seen_at > at - IDLE, session.c.made_at > at - ABSOLUTE)


def begin(connection: Connection, person: int) -> str:
    """Begin a session of a person, and forget those that ended long ago: what its cookie holds."""
    at, secret = now(), new_secret()
    connection.execute(delete(session).where(session.c.made_at < at - _FORGET))
    connection.execute(insert(session).values(person=person, sha256=digest(secret), made_at=at, seen_at=at))
    return secret


def touch(store: Store, key: int) -> None:
    """Keep that somebody was here just now."""
    with write(store, _PATIENCE) as connection:
        connection.execute(update(session).where(session.c.id == key).values(seen_at=now()))


def end_session(store: Store, secret: str) -> None:
    """End a session: its cookie opens nothing any more."""
    with write(store) as connection:
        connection.execute(
            update(session).where(session.c.sha256 == digest(secret), session.c.ended_at.is_(None)).values(ended_at=now())
        )


def end_all(connection: Connection, person: int) -> int:
    """End every session of a person; how many there were."""
    at = now()
    keys = connection.scalars(select(session.c.id).where(session.c.person == person, living(at))).all()
    connection.execute(update(session).where(session.c.person == person, session.c.ended_at.is_(None)).values(ended_at=at))
    return len(keys)
