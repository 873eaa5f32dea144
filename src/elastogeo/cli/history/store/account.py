"""`elastogeo history account`: who may come in through the pages, as what."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who
from elastogeo.cli.passwords import asked_password


def account(
    name: Annotated[str, typer.Argument(metavar="[NAME]", help="Of the person; none: list the accounts.")] = "",
    role: Annotated[str, typer.Option(help="reader, engineer or administrator; a new account needs it.")] = "",
    password: Annotated[
        bool, typer.Option("--password", help="Set another password; a new account is asked for one.")
    ] = False,
    tokens_only: Annotated[bool, typer.Option("--tokens-only", help="A new account without a password.")] = False,
    off: Annotated[bool, typer.Option("--off", help="Switch it off: sessions and tokens end at once.")] = False,
    on: Annotated[bool, typer.Option("--on", help="Switch it on again.")] = False,
    why: Annotated[str, typer.Option(help="Why it is switched off, for the audit trail.")] = "",
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Make or change an account for the pages, or list them.

    The password is asked twice at the terminal, or read as one line from standard input; it is never an argument, which
    other programs could see.

    \b
    Examples:
      elastogeo history account "A. Miller" --role administrator
      elastogeo history account "A. Miller" --password
      elastogeo history account "B. Former" --off --why "left the company"
    """
    from elastogeo.cli import screen

    if off and on:
        raise eg.InputError("--off and --on: say one of them")
    with eg.History(store, who=who) as history:
        known = name in {one.name for one in history.accounts().accounts}
        if name and not known:
            if not role or off or on:
                raise eg.InputError(
                    f"there is no account {name!r}; a new one needs --role reader, engineer or administrator"
                )
            history.add_account(name, role, None if tokens_only else asked_password(f"Password of {name}"))
        elif name:
            if tokens_only:
                raise eg.InputError(f"the account {name!r} is there already; --tokens-only is for a new one")
            if not (role or password or off or on):
                raise eg.InputError(
                    f"the account {name!r} is there already; say what is to change: --role, --password, --off or --on"
                )
            if role:
                history.set_role(name, role)
            if password:
                history.set_password(name, asked_password(f"New password of {name}"))
            if off or on:
                history.switch_account(name, on, why)
        found = history.accounts()
    screen.show(found, None, as_json)
