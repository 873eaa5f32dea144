"""`elastogeo history interval`: how often a series is tested."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, OfSeries, Store, Who


def interval(
    machine: Annotated[str, typer.Argument(help="The machine, by name or serial number.")],
    days: Annotated[float, typer.Argument(help="Between tests; 0 for no date.", min=0)],
    grace: Annotated[float, typer.Option(help="Days that a test may be late.", min=0)] = 7.0,
    why: Annotated[str, typer.Option(help="The reason, for the audit trail.")] = "",
    series: OfSeries = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Set how often a machine is tested: then a late test is told.

    \b
    Example:
      elastogeo history interval "Mill 3" 30 --grace 7
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        history.set_interval(machine, days or None, series, grace=grace, why=why)
    screen.say(f"{machine} is tested every {days:g} days, with {grace:g} days of grace." if days else f"{machine}: no date.")
