"""Accounts: who may come in, as what. Each act is a row of the audit trail, without any secret in it."""

from __future__ import annotations

import unicodedata
from typing import Any

from sqlalchemy import Connection, Row, Select, func, insert, select, update

from elastogeo.changes import Account, KeptAccounts
from elastogeo.errors import InputError, StoreError, several
from elastogeo.history.people.passwords import check_password, hashed
from elastogeo.history.people.sessions import end_all, living
from elastogeo.history.people.tokens import end_all_tokens
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import account, person, session, token

ROLES = ("reader", "engineer", "administrator")
"""From the least to the most."""
ADMINISTRATOR = "administrator"
_LONGEST = 80
_ANY = select(account.c.id).limit(1)


def has_accounts(store: Store) -> bool:
    """Whether anybody has an account; whoever comes must log in then."""
    with read(store) as connection:
        return connection.execute(_ANY).first() is not None


def check_reachable(store: Store) -> None:
    """Refuse pages for other computers that nobody could log in to.

    Raises
    ------
    StoreError
        If no administrator has a password.
    """
    with read(store) as connection:
        if _administrators(connection):
            return
    raise StoreError(
        f"{store.url}: no administrator can log in, and pages for other computers need one; "
        "make the account with: elastogeo history account NAME --role administrator"
    )


def add_account(store: Store, name: str, role: str, password: str | None, *, who: str) -> None:
    """Make an account.

    Parameters
    ----------
    store : Store
    name : str
        What the person types to log in, and what the audit trail says.
    role : str
        `reader`, `engineer` or `administrator`.
    password : str or None
        None: none, tokens only.
    who : str

    Raises
    ------
    InputError
        If there is one of this name, or name, role or password is none, or the first is no administrator with a password.
    """
    name = _checked_name(name)
    _check_role(role)
    if password is not None:
        check_password(password, name)
    kept = None if password is None else hashed(password)
    with write(store) as connection:
        for known in connection.scalars(select(person.c.name).join(account, account.c.person == person.c.id)):
            if known.casefold() == name.casefold():
                raise InputError(f"there is an account {known!r} already; take another name")
        if not _administrators(connection) and (role != ADMINISTRATOR or kept is None):
            raise InputError(
                "nobody could change accounts: no administrator can log in; make the account of one first, with a password"
            )
        key = connection.execute(select(person.c.id).where(person.c.name == name)).scalar()
        if key is None:
            made = insert(person).values(name=name, role=role, made_at=now()).returning(person.c.id)
            key = connection.execute(made).scalar_one()
        else:
            connection.execute(update(person).where(person.c.id == key).values(role=role))
        connection.execute(insert(account).values(person=key, password=kept, active=True, changed_at=now()))
        audit.record(connection, who, "add account", f"account {name}", new={"role": role, "password": kept is not None})


def set_role(store: Store, name: str, role: str, *, who: str) -> None:
    """Change what a person may do; nothing happens if it is that already.

    Raises
    ------
    InputError
        If there is no such account or role, or it is the last administrator who can log in.
    """
    _check_role(role)
    with write(store) as connection:
        found = _named(connection, name)
        if found.role == role:
            return
        if role != ADMINISTRATOR:
            _check_not_last(connection, found)
        connection.execute(update(person).where(person.c.id == found.person).values(role=role))
        audit.record(connection, who, "set role", f"account {name}", old=found.role, new=role)


def set_password(store: Store, name: str, password: str, *, who: str) -> None:
    """Give a person another password; all of the person's sessions end.

    Raises
    ------
    InputError
        If there is no such account, or the password is soon guessed.
    """
    check_password(password, name)
    kept = hashed(password)
    with write(store) as connection:
        found = _named(connection, name)
        connection.execute(update(account).where(account.c.id == found.id).values(password=kept, changed_at=now()))
        ended = end_all(connection, found.person)
        audit.record(connection, who, "set password", f"account {name}", new={"sessions_ended": ended})


def switch_account(store: Store, name: str, on: bool, *, who: str, why: str = "") -> None:
    """Switch an account off, which ends its sessions and tokens at once, or on again.

    Raises
    ------
    InputError
        If there is no such account, or it is the last administrator who can log in.
    """
    with write(store) as connection:
        found = _named(connection, name)
        if found.active == on:
            return
        if not on:
            _check_not_last(connection, found)
        connection.execute(update(account).where(account.c.id == found.id).values(active=on, changed_at=now()))
        ended = None
        if not on:
            sessions, tokens = end_all(connection, found.person), end_all_tokens(connection, found.person)
            ended = {"sessions_ended": sessions, "tokens_ended": tokens}
        what = "switch on" if on else "switch off"
        audit.record(connection, who, what, f"account {name}", old=found.active, new=ended or on, why=why)


def kept_accounts(store: Store) -> KeptAccounts:
    """All accounts, by name, with when each was here last."""
    at = now()
    with read(store) as connection:
        seen = dict(
            connection.execute(select(session.c.person, func.max(session.c.seen_at)).group_by(session.c.person)).all()
        )
        counted = select(session.c.person, func.count()).where(living(at)).group_by(session.c.person)
        sessions: dict[int, int] = dict(connection.execute(counted).all())
        made = select(token.c.person, func.count()).where(token.c.ended_at.is_(None)).group_by(token.c.person)
        tokens: dict[int, int] = dict(connection.execute(made).all())
        rows = connection.execute(_joined().order_by(person.c.name)).all()
    found = tuple(
        Account(
            row.person,
            row.name,
            row.role,
            row.active,
            row.password is not None,
            row.changed_at,
            seen.get(row.person),
            sessions.get(row.person, 0),
            tokens.get(row.person, 0),
        )
        for row in rows
    )
    return KeptAccounts(store.url, found)


def _joined() -> Select[Any]:
    return select(
        account.c.id,
        account.c.person,
        account.c.password,
        account.c.active,
        account.c.changed_at,
        person.c.name,
        person.c.role,
    ).join(person, person.c.id == account.c.person)


def _named(connection: Connection, name: str) -> Row[Any]:
    row = connection.execute(_joined().where(person.c.name == name)).one_or_none()
    if row is None:
        names = list(connection.scalars(select(person.c.name).join(account, account.c.person == person.c.id)))
        there = f"there are: {several(sorted(names))}" if names else "there is none yet"
        raise InputError(f"there is no account {name!r}; {there}")
    return row


def _administrators(connection: Connection) -> list[int]:
    """The persons who are administrators and can log in."""
    asked = _joined().where(person.c.role == ADMINISTRATOR, account.c.active, account.c.password.is_not(None))
    return [row.person for row in connection.execute(asked)]


def _check_not_last(connection: Connection, found: Row[Any]) -> None:
    if _administrators(connection) == [found.person]:
        raise InputError(
            f"{found.name} is the last administrator who can log in; make another one first, "
            "or nobody could change accounts any more"
        )


def _check_role(role: str) -> None:
    if role not in ROLES:
        raise InputError(f"the role is {role!r}; it is one of {', '.join(ROLES)}")


def _checked_name(name: str) -> str:
    name = " ".join(unicodedata.normalize("NFC", name).split())
    if not name:
        raise InputError("the account has no name; give one, such as 'A. Miller'")
    if len(name) > _LONGEST:
        raise InputError(f"the name of the account has {len(name)} characters; take at most {_LONGEST}")
    if any(unicodedata.category(character).startswith("C") for character in name):
        raise InputError("the name of the account holds a character that cannot be seen; leave it out")
    return name
