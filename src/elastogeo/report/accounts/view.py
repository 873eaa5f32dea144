"""The views of accounts and tokens. No document holds a password, a token, or what is kept of them.

`elastogeo.accounts/1`

store : where
accounts : [{name, role, active, has_password, changed_at, seen_at, sessions, tokens}], by name; points in time in UTC

`elastogeo.tokens/1`

owner : whose; null: all
tokens : [{number, purpose, owner, made_at, ended_at}], the last made first
"""

from __future__ import annotations

from datetime import datetime

from elastogeo.changes import Account, KeptAccounts, KeptToken, KeptTokens
from elastogeo.report.document import document
from elastogeo.report.view import Table, View, lines, views

ACCOUNTS, TOKENS = "elastogeo.accounts/1", "elastogeo.tokens/1"


@lines(Account)
def account_line(one: Account) -> str:
    """`A. Miller, engineer`."""
    return f"{one.name}, {one.role}{'' if one.active else ', switched off'}"


@lines(KeptToken)
def token_line(one: KeptToken) -> str:
    """`token 3 of A. Miller for the cell of mill 3`."""
    return f"token {one.number} of {one.owner} for {one.purpose}{'' if one.ended_at is None else ', ended'}"


@views(KeptAccounts)
def accounts_view(result: KeptAccounts) -> View:
    """Who may come in, as what."""
    rows = [
        {
            "name": one.name,
            "role": one.role,
            "active": one.active,
            "has_password": one.has_password,
            "changed_at": _exact(one.changed_at),
            "seen_at": _exact(one.seen_at),
            "sessions": one.sessions,
            "tokens": one.tokens,
        }
        for one in result.accounts
    ]
    table = Table(
        ("Name", "Role", "State", "Comes in by", "Here last (UTC)", "Sessions", "Tokens"),
        tuple(
            (
                one.name,
                one.role,
                "on" if one.active else "switched off",
                "password" if one.has_password else "tokens only",
                _short(one.seen_at) or "never",
                str(one.sessions),
                str(one.tokens),
            )
            for one in result.accounts
        ),
        words=(0, 1, 2, 3, 4),
        name="accounts",
        keys=tuple(one.key for one in result.accounts),
    )
    return View(
        kind="Accounts",
        title=result.store,
        origin="",
        sentence=_who(result),
        document=document(ACCOUNTS, {"store": result.store, "accounts": rows}),
        rows=rows,
        tables=(table,) if rows else (),
    )


@views(KeptTokens)
def tokens_view(result: KeptTokens) -> View:
    """With what programs come in."""
    rows = [
        {
            "number": one.number,
            "purpose": one.purpose,
            "owner": one.owner,
            "made_at": _exact(one.made_at),
            "ended_at": _exact(one.ended_at),
        }
        for one in result.tokens
    ]
    table = Table(
        ("No.", "For", "Owner", "Made (UTC)", "Ended (UTC)"),
        tuple((str(one.number), one.purpose, one.owner, _short(one.made_at), _short(one.ended_at)) for one in result.tokens),
        words=(1, 2, 3, 4),
        name="tokens",
        keys=tuple(one.number for one in result.tokens),
    )
    live = sum(one.ended_at is None for one in result.tokens)
    of = f" of {result.owner}" if result.owner is not None else ""
    return View(
        kind="Tokens",
        title=result.owner or "all accounts",
        origin="",
        sentence=f"No token{of} opens anything." if not live else f"Tokens{of} that open something: {live}.",
        document=document(TOKENS, {"owner": result.owner, "tokens": rows}),
        rows=rows,
        tables=(table,) if rows else (),
    )


def _who(result: KeptAccounts) -> str:
    if not result.accounts:
        return "Nobody has an account: the pages open on this computer only, for whoever works at it."
    on = [one for one in result.accounts if one.active]
    able = sum(one.role == "administrator" and one.has_password for one in on)
    administrators = "no administrator can log in" if not able else f"administrators: {able}"
    return f"Accounts that are on: {len(on)} of {len(result.accounts)}; {administrators}."


def _exact(at: datetime | None) -> str | None:
    return None if at is None else f"{at:%Y-%m-%dT%H:%M:%SZ}"


def _short(at: datetime | None) -> str:
    return "" if at is None else f"{at:%Y-%m-%d %H:%M}"
