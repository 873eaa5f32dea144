"""`elastogeo history token`: with what programs come in to the pages."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def token(
    owner: Annotated[str, typer.Argument(metavar="[ACCOUNT]", help="Whose; none: list all tokens.")] = "",
    purpose: Annotated[str, typer.Option("--for", help="Make one, for this: 'cell 4'.")] = "",
    end: Annotated[int | None, typer.Option(help="The number of a token that is to open nothing any more.")] = None,
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Make a token for a program, end one, or list them.

    A token is shown once, when it is made; the history keeps its SHA-256 only. A program sends it as
    `Authorization: Bearer TOKEN` and may do what the account may.

    \b
    Examples:
      elastogeo history token "Cell 4" --for "upload of its tests"
      elastogeo history token --end 3
    """
    from elastogeo.cli import screen

    if purpose and not owner:
        raise eg.InputError("a token is of an account; name it, as elastogeo history account shows it")
    with eg.History(store, who=who) as history:
        if end is not None:
            history.end_token(end)
        if purpose:
            made = history.make_token(owner, purpose)
            if as_json:
                screen.show_json(
                    {"schema": "elastogeo.token/1", "number": made.number, "owner": owner, "token": made.secret}
                )
                return
            screen.say(f"Token {made.number} of {owner}, for {purpose}. It is not shown again:")
            screen.say(made.secret)
            return
        found = history.tokens(owner or None)
    screen.show(found, None, as_json)
