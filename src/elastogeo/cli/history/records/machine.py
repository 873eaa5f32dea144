"""`elastogeo history machine`: add a machine, or say more of one."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who


def machine(
    name: Annotated[str, typer.Argument(help="Of this very machine: 'Mill 3'.")],
    serial: Annotated[str, typer.Option(help="Its serial number; tests that say it need no --machine.")] = "",
    kind: Annotated[str, typer.Option(help="Its model; by default that of its first test.")] = "",
    place: Annotated[str, typer.Option(help="Hall or plant.")] = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Add a machine, or say more of it.

    \b
    Example:
      elastogeo history machine "Mill 3" --serial 4711 --place "hall 2"
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        known = history.add_machine(name, kind=kind, serial=serial, place=place)
    said = {"model": known.kind, "serial number": known.serial, "place": known.place}
    screen.say(", ".join([known.name, *(f"{label} {value}" for label, value in said.items() if value)]))
