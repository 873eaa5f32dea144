"""`elastogeo history close`: end an alarm, as repaired or as false."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def close(
    number: Annotated[int, typer.Argument(metavar="NUMBER", help="Of the alarm, as `history digest` lists it.")],
    repaired: Annotated[
        bool | None, typer.Option("--repaired/--false", help="Repaired: a new baseline follows. False: the old one stays.")
    ] = None,
    why: Annotated[str, typer.Option(help="What was found or done; it is kept with your name.")] = "",
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Close an alarm, as repaired or as false.

    The alarm of an instrument lets go those of machines that it held back: closed as false, they count again; closed as
    repaired, they are closed as false with it.

    \b
    Examples:
      elastogeo history close 12 --repaired --why "nut of X replaced"
      elastogeo history close 12 --false --why "coolant on the ball"
    """
    from elastogeo.cli import screen

    if repaired is None:
        raise eg.InputError("say how the alarm ends: --repaired (a new baseline follows) or --false (the baseline stays)")
    with eg.History(store, who=who) as history:
        found = history.close_alarm(number, repaired=repaired, why=why)
    screen.show(found, None, as_json)
