"""`elastogeo history event`: what happened to a machine or an instrument."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def event(
    kind: Annotated[
        str, typer.Argument(metavar="[KIND]", help="repair, parameter-edit, move, crash, calibration or note.")
    ] = "",
    note: Annotated[str, typer.Argument(metavar="[NOTE]", help="What was done, in words; without it, list events.")] = "",
    machine: Annotated[str | None, typer.Option("--machine", "-m", help="The machine it happened to.")] = None,
    instrument: Annotated[str | None, typer.Option(help="Or the instrument, by its serial number.")] = None,
    at: Annotated[str, typer.Option(help="When: 2026-03-01, or with time and zone; by default now.")] = "",
    year: Annotated[int | None, typer.Option(help="List those of this year only.")] = None,
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Keep what happened: a repair, a crash; or list it.

    It stands on the charts. After a repair, set the baseline anew.

    \b
    Examples:
      elastogeo history event repair "X guideway: carriage 2 replaced" --machine "Mill 3"
      elastogeo history event
      elastogeo history event repair --machine "Mill 3" --year 2026
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        if not note:
            screen.show(history.events(machine or "", kind, year), None, as_json)
            return
        got = history.add_event(kind, note, machine=machine, instrument=instrument, at=at)
    screen.say(f"{got.of}, {got.at:%Y-%m-%d}, {got.kind}: {got.note}")
