"""`elastogeo history demo`: a fleet to look at, three years of simulated tests."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg


def demo(
    place: Annotated[
        str, typer.Argument(metavar="[STORE]", help="The history to make: a file of SQLite, or postgresql://...")
    ] = "demo-fleet.db",
    years: Annotated[float, typer.Option(min=1.0, max=3.0, help="How many years to live through.")] = 3.0,
) -> None:
    """Make a history of a simulated fleet, and show what it says.

    Seven machines, a test every four weeks: a guideway and a nut that wear, a collision, a bar that was recalibrated, balls
    badly seated, seasons, and machines that are well. Every test is simulated, is imported as a measured one would be, and
    takes a few minutes together.

    \b
    Examples:
      elastogeo history demo
      elastogeo history show "Hermle C50 no. 1" --store demo-fleet.db
    """
    from elastogeo.cli import screen
    from elastogeo.history.fleets import live

    if "://" not in place and Path(place).exists():
        raise eg.InputError(f"{place} is there already; name another file, or remove it and {place}.files")
    with eg.History(place, create=True, who="demo") as history:
        with screen.progress("making the fleet", quiet=False) as step:
            for one in live(history, datetime.now(UTC), years=years):
                step(f"test {one.done} of {one.of}: {one.machine}, {one.at:%Y-%m-%d}, {one.state}")
        screen.show_view(eg.view_of(history.fleet()))
    screen.say("")
    screen.say(f'Look at one machine: elastogeo history show "Hermle C50 no. 1" --store {place} --report demo-machine')
