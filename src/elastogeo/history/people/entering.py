"""Who comes in: by name and password, by what a cookie holds, by a token."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

from sqlalchemy import select, update

from elastogeo.errors import StoreError
from elastogeo.history.people.passwords import fits, hashed, outdated
from elastogeo.history.people.sessions import TOUCH, begin, digest, living, touch
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import account, person, session, token


@dataclass(frozen=True, slots=True)
class Person:
    """Who came in.

    Attributes
    ----------
    key : int
    name : str
    role : str
        `reader`, `engineer` or `administrator`.
    """

    key: int
    name: str
    role: str


def log_in(store: Store, name: str, password: str) -> str | None:
    """Begin a session of whoever has this name and password.

    It takes as long whether there is an account of this name or not. What failed is not kept in the history: whoever
    guesses would fill it.

    Returns
    -------
    str or None
        What the cookie holds; None if name or password is wrong, or the account is switched off.
    """
    asked = select(account.c.id, account.c.person, account.c.password, account.c.active, person.c.name)
    asked = asked.join(person, person.c.id == account.c.person).where(person.c.name == name)
    with read(store) as connection:
        found = connection.execute(asked).one_or_none()
    right = fits(found.password if found else None, password)
    if found is None or not right or not found.active:
        return None
    renewed = hashed(password) if outdated(found.password) else found.password
    with write(store) as connection:
        still = connection.execute(asked).one_or_none()
        if still is None or not still.active or still.password != found.password:  # changed meanwhile
            return None
        if renewed != found.password:
            connection.execute(update(account).where(account.c.id == found.id).values(password=renewed))
        secret = begin(connection, found.person)
        audit.record(connection, found.name, "log in", f"account {found.name}")
    return secret


def person_of_session(store: Store, secret: str) -> Person | None:
    """Whose session this is; None if it has ended or never was."""
    at = now()
    asked = (
        select(session.c.id, session.c.seen_at, session.c.person, person.c.name, person.c.role)
        .join(person, person.c.id == session.c.person)
        .join(account, account.c.person == person.c.id)
        .where(session.c.sha256 == digest(secret), living(at), account.c.active)
    )
    with read(store) as connection:
        found = connection.execute(asked).one_or_none()
    if found is None:
        return None
    if at - found.seen_at > TOUCH:
        with suppress(StoreError):  # the disk is full, or somebody writes for long: one may look all the same
            touch(store, found.id)
    return Person(found.person, found.name, found.role)


def person_of_token(store: Store, secret: str) -> Person | None:
    """Whose token this is; None if it was ended or never was."""
    asked = (
        select(token.c.person, person.c.name, person.c.role)
        .join(person, person.c.id == token.c.person)
        .join(account, account.c.person == person.c.id)
        .where(token.c.sha256 == digest(secret), token.c.ended_at.is_(None), account.c.active)
    )
    with read(store) as connection:
        found = connection.execute(asked).one_or_none()
    return None if found is None else Person(found.person, found.name, found.role)
