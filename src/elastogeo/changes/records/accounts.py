"""Accounts and tokens that a history keeps, without what lets anybody in."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Account(Part):
    """One account.

    Attributes
    ----------
    key : int
        Of the person.
    name : str
    role : str
        `reader`, `engineer` or `administrator`.
    active : bool
        False if it is switched off.
    has_password : bool
        False: tokens only.
    changed_at : datetime
        When it was made, switched, or got its password.
    seen_at : datetime or None
        When the person was here last; None: never.
    sessions, tokens : int
        That have not ended.
    """

    key: int
    name: str
    role: str
    active: bool
    has_password: bool
    changed_at: datetime
    seen_at: datetime | None
    sessions: int
    tokens: int


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptAccounts(Result):
    """Who may come in.

    Attributes
    ----------
    store : str
    accounts : tuple of Account
        By name.
    """

    store: str
    accounts: tuple[Account, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptToken(Part):
    """One token, without itself.

    Attributes
    ----------
    number : int
    purpose, owner : str
    made_at : datetime
    ended_at : datetime or None
        None while it opens something.
    """

    number: int
    purpose: str
    owner: str
    made_at: datetime
    ended_at: datetime | None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptTokens(Result):
    """With what programs come in.

    Attributes
    ----------
    owner : str or None
        Whose; None: all.
    tokens : tuple of KeptToken
        The last made first.
    """

    owner: str | None
    tokens: tuple[KeptToken, ...]
