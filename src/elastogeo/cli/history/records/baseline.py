"""`elastogeo history baseline`: which tests count as the ordinary state of a machine."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, OfSeries, Store, Who


def baseline(
    machine: Annotated[str, typer.Argument(help="The machine, by name or serial number.")],
    why: Annotated[str, typer.Option(help="The reason, for those who read it later.")],
    first: Annotated[int | None, typer.Option(help="The first so many tests.", min=1)] = None,
    last: Annotated[int | None, typer.Option(help="The last so many tests.", min=1)] = None,
    begin: Annotated[str, typer.Option("--from", help="Tests from this day on: 2026-03-01.")] = "",
    end: Annotated[str, typer.Option("--to", help="Tests up to this day.")] = "",
    test: Annotated[list[int] | None, typer.Option(help="A test by its number; may be repeated.")] = None,
    series: OfSeries = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Set which tests count as the ordinary state of a machine.

    It stays as it is until a person sets another, after a repair for example. Ten tests are good, six the least for alarms.

    \b
    Examples:
      elastogeo history baseline "Mill 3" --first 10 --why "new machine"
      elastogeo history baseline "Mill 3" --from 2026-06-20 --why "guideway replaced"
    """
    from elastogeo.cli import screen

    if first is None and last is None and not (begin or end or test):
        raise eg.InputError("say which tests: --first 10, --last 10, --from DATE, or --test NUMBER")
    with eg.History(store, who=who) as history:
        found = history.set_baseline(
            machine, series, why=why, tests=test or (), first=first, last=last, begin=begin, end=end
        )
    said = "set" if found.new else "is as it was"
    span = " to ".join(dict.fromkeys((f"{found.first:%Y-%m-%d}", f"{found.last:%Y-%m-%d}")))
    screen.say(f"Baseline {said}: {len(found.tests)} tests, {span}.")
