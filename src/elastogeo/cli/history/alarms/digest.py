"""`elastogeo history digest`: what waits for somebody."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store


def digest(
    number: Annotated[
        int | None, typer.Argument(metavar="[NUMBER]", help="Of one alarm: what happened to it, and who was told.")
    ] = None,
    store: Store = STORE,
    as_json: AsJson = False,
) -> None:
    """Show open alarms, overdue tests, messages that failed.

    With a number it shows one alarm: what happened to it, and who was told.

    \b
    Examples:
      elastogeo history digest
      elastogeo history digest 12
    """
    from elastogeo.cli import screen

    with eg.History(store) as history:
        found = history.alarms() if number is None else history.alarm(number)
    screen.show(found, None, as_json)
