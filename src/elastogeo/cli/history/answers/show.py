"""`elastogeo history show`: whether a machine has changed."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Report, Store


def show(
    machine: Annotated[str, typer.Argument(help="The machine, by name or serial number.")],
    series: Annotated[str, typer.Argument(help="One of its series: its name, or a part of it; by default all.")] = "",
    store: Store = STORE,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Say whether a machine has changed, since when and where.

    What it cannot tell and what to do next belong to the answer. Of several series the worst is shown in full.

    \b
    Examples:
      elastogeo history show "Mill 3"
      elastogeo history show "Mill 3" "ball bar, XY" --report mill-3
    """
    from elastogeo.cli import screen

    with eg.History(store) as history:
        found = history.verdict(machine, series) if series else history.machine(machine)
    screen.show(found, report, as_json)
