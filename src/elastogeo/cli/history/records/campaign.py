"""`elastogeo history campaign`: the sets of tests that were asked together, and what they say."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def campaign(
    number: Annotated[int | None, typer.Argument(metavar="[NUMBER]", help="Of a campaign; none: list them.")] = None,
    recompute: Annotated[bool, typer.Option("--recompute", help="Ask its tests again, from their raw records.")] = False,
    machine: Annotated[str | None, typer.Option("--machine", "-m", help="List those of this machine only.")] = None,
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Show sets of tests, and what they say together.

    A campaign comes in with its tests: `elastogeo history import` of its folder.

    \b
    Examples:
      elastogeo history campaign
      elastogeo history campaign 1
      elastogeo history campaign 1 --recompute
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history, screen.progress("identifying", quiet=as_json):
        found: object = (
            history.campaigns(machine)
            if number is None
            else history.recompute_campaign(number)
            if recompute
            else history.campaign(number)
        )
    screen.show(found, None, as_json)
