"""`elastogeo history silence`: send nothing of a machine until a date."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who


def silence(
    machine: Annotated[str, typer.Argument(metavar="MACHINE", help="By name.")],
    until: Annotated[str, typer.Option(help="The last day, 2026-12-24, or a time, 2026-12-24T12:00; or now, to end it.")],
    why: Annotated[str, typer.Option(help="It is kept with your name.")] = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Send nothing of a machine until a date. Alarms open all the same; what is held back is sent afterwards.

    \b
    Examples:
      elastogeo history silence "Mill 3" --until 2026-12-24 --why "taken apart"
      elastogeo history silence "Mill 3" --until now --why "runs again"
    """
    from elastogeo.cli import screen
    from elastogeo.history.alarms import end_of

    end = end_of(until, "--until")
    with eg.History(store, who=who) as history:
        history.silence(machine, end, why)
    screen.say(
        f"{machine} is not silent any more." if end is None else f"{machine} is silent until {end:%Y-%m-%d %H:%M %Z}."
    )
