"""Tokens: what a program shows in place of a password. Made once and shown once; only the SHA-256 is kept."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import Connection, Select, insert, select, update

from elastogeo.changes import KeptToken, KeptTokens
from elastogeo.errors import InputError
from elastogeo.history.people.sessions import digest, new_secret
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import account, person, token

PREFIX = "egt_"
"""By which scanners for lost secrets find one."""
_MOST, _LONGEST = 50, 80


@dataclass(frozen=True, slots=True)
class MadeToken:
    """A token that was made just now: nobody sees it again.

    Attributes
    ----------
    number : int
    secret : str
        Not in its `repr`, so that no log holds it.
    """

    number: int
    secret: str = field(repr=False)


def make_token(store: Store, owner: str, purpose: str, *, who: str) -> MadeToken:
    """Make a token, with which a program comes in as its owner.

    Parameters
    ----------
    store : Store
    owner : str
        Name of the account.
    purpose : str
        What it is for.
    who : str

    Raises
    ------
    InputError
        If there is no such account, it is switched off, or the purpose is not said.
    """
    purpose = " ".join(purpose.split())
    if not purpose:
        raise InputError("say what the token is for, so that whoever finds it in the list knows whether it may go")
    if len(purpose) > _LONGEST:
        raise InputError(f"what the token is for has {len(purpose)} characters; take at most {_LONGEST}")
    secret = PREFIX + new_secret()
    with write(store) as connection:
        asked = select(account.c.person, account.c.active).join(person, person.c.id == account.c.person)
        found = connection.execute(asked.where(person.c.name == owner)).one_or_none()
        if found is None:
            raise InputError(f"there is no account {owner!r}; `elastogeo history account` shows those that there are")
        if not found.active:
            raise InputError(f"the account {owner!r} is switched off; switch it on first")
        live = connection.scalars(_living(found.person)).all()
        if len(live) >= _MOST:
            raise InputError(f"{owner} has {len(live)} tokens; end some that nobody uses")
        row = {"person": found.person, "name": purpose, "sha256": digest(secret), "made_at": now()}
        number = connection.execute(insert(token).values(row).returning(token.c.id)).scalar_one()
        audit.record(connection, who, "make token", f"account {owner}", new={"token": number, "for": purpose})
    return MadeToken(number, secret)


def end_token(store: Store, number: int, *, who: str, owner: str | None = None) -> None:
    """End a token: it opens nothing any more.

    Parameters
    ----------
    store : Store
    number : int
    who : str
    owner : str, optional
        Whose it must be: that of another is not there.

    Raises
    ------
    InputError
        If there is no such token.
    """
    with write(store) as connection:
        asked = select(token.c.ended_at, person.c.name).join(person, person.c.id == token.c.person)
        found = connection.execute(asked.where(token.c.id == number)).one_or_none()
        if found is None or (owner is not None and found.name != owner):
            raise InputError(f"there is no token {number}; `elastogeo history token` shows those that there are")
        if found.ended_at is not None:
            return
        connection.execute(update(token).where(token.c.id == number).values(ended_at=now()))
        audit.record(connection, who, "end token", f"account {found.name}", old={"token": number})


def end_all_tokens(connection: Connection, of: int) -> int:
    """End every token of a person; how many there were."""
    live = connection.scalars(_living(of)).all()
    connection.execute(update(token).where(token.c.person == of, token.c.ended_at.is_(None)).values(ended_at=now()))
    return len(live)


def kept_tokens(store: Store, owner: str | None = None) -> KeptTokens:
    """The tokens of a person, or all, the last made first."""
    asked = select(token, person.c.name.label("owner")).join(person, person.c.id == token.c.person)
    if owner is not None:
        asked = asked.where(person.c.name == owner)
    with read(store) as connection:
        rows = connection.execute(asked.order_by(token.c.id.desc())).all()
    return KeptTokens(owner, tuple(KeptToken(row.id, row.name, row.owner, row.made_at, row.ended_at) for row in rows))


def _living(of: int) -> Select[Any]:
    return select(token.c.id).where(token.c.person == of, token.c.ended_at.is_(None))
