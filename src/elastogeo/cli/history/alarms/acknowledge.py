"""`elastogeo history acknowledge`: say that somebody knows of an alarm."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who

Number = Annotated[int, typer.Argument(metavar="NUMBER", help="Of the alarm, as `history digest` lists it.")]


def acknowledge(
    number: Number,
    why: Annotated[str, typer.Option(help="What is done about it; it is kept with your name.")] = "",
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Say that you know of an alarm; it stays open.

    \b
    Example:
      elastogeo history acknowledge 12 --why "nut of X is ordered"
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        found = history.acknowledge(number, why)
    screen.show(found, None, as_json)
