"""Accounts: who may come in, as what. An administrator makes, changes and switches them off."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form

from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER, READER, Ask, Asked, NotFound
from elastogeo.web.pages import Pages

pages = Pages()
Name = Annotated[str, Form(max_length=200)]
Password = Annotated[str, Form(max_length=1000)]
Role = Annotated[str, Form(max_length=20)]


@pages.shows("/accounts", role=ADMINISTRATOR)
def accounts(asked: Ask) -> Shown:
    """Who may come in, as what."""
    kept = asked.history.accounts()
    context = {"accounts": kept.accounts, "roles": (READER, ENGINEER, ADMINISTRATOR)}
    return Shown("people/accounts.html.j2", view_of(kept), context=context)


@pages.acts("/accounts", role=ADMINISTRATOR)
def add_account(asked: Ask, name: Name, role: Role, password: Password = "", again: Password = "") -> Done:
    """Make an account; without a password it has tokens only."""
    asked.history.add_account(name, role, _same(password, again) or None)
    return Done("/accounts", "The account is made.")


@pages.acts("/accounts/{key:int}/role", role=ADMINISTRATOR)
def set_role(asked: Ask, key: int, role: Role) -> Done:
    """Make a person reader, engineer or administrator."""
    name = _named(asked, key)
    asked.history.set_role(name, role)
    return Done("/accounts", f"{name} is {role} from the next page on.")


@pages.acts("/accounts/{key:int}/password", role=ADMINISTRATOR)
def set_password(asked: Ask, key: int, password: Password, again: Password) -> Done:
    """Give a person another password; the person's sessions end."""
    name = _named(asked, key)
    asked.history.set_password(name, _same(password, again))
    return Done("/accounts", f"{name} has another password; all sessions of {name} have ended.")


@pages.acts("/accounts/{key:int}/switch", role=ADMINISTRATOR)
def switch_account(
    asked: Ask, key: int, to: Annotated[str, Form(max_length=3)], why: Annotated[str, Form(max_length=500)] = ""
) -> Done:
    """Switch an account `off`, which ends its sessions and tokens, or `on`."""
    name = _named(asked, key)
    asked.history.switch_account(name, to == "on", why)
    said = "can log in again" if to == "on" else "can do nothing any more; sessions and tokens have ended"
    return Done("/accounts", f"{name} {said}.")


def _named(asked: Asked, key: int) -> str:
    name = next((one.name for one in asked.history.accounts().accounts if one.key == key), None)
    if name is None:
        raise NotFound("There is no such account.")
    return name


def _same(password: str, again: str) -> str:
    if password != again:
        raise InputError("The two passwords differ.")
    return password
