"""`elastogeo history tolerance`: between which values an indicator must stay, and from when on a change of it matters."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, OfSeries, Store, Who


def tolerance(
    machine: Annotated[str, typer.Argument(help="The machine, by name or serial number.")],
    indicator: Annotated[str, typer.Argument(help="As `elastogeo history show` names it: 'stiffness X'.")],
    why: Annotated[str, typer.Option(help="The reason, for those who read it later.")],
    lower: Annotated[
        float | None, typer.Option(help="Least value, in the unit that is shown: N/µm, µm, µrad, µm/m.")
    ] = None,
    upper: Annotated[float | None, typer.Option(help="Greatest value, in the same unit.")] = None,
    matters: Annotated[
        float | None, typer.Option(help="Least change that is an alarm: in percent of a stiffness, else in the same unit.")
    ] = None,
    series: OfSeries = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Set between which values an indicator must stay.

    A drift is said with the date on which it reaches the tolerance. Without any value the tolerance is taken back.

    \b
    Example:
      elastogeo history tolerance "Mill 3" "stiffness X" --lower 13 --why "roughing of part 4711"
    """
    from elastogeo.cli import screen
    from elastogeo.report.changes import shown_unit, taken

    with eg.History(store, who=who) as history:
        kind = history.kind(machine, indicator, series)
        unit = shown_unit(kind.unit)
        least, most, relevance = taken(kind, lower, upper, matters)
        history.set_tolerance(machine, indicator, series, why=why, lower=least, upper=most, relevance=relevance)
    said = [
        "" if lower is None else f"at least {lower:g} {unit.name}",
        "" if upper is None else f"at most {upper:g} {unit.name}",
        "" if matters is None else f"a change matters from {matters:g} {'%' if kind.relative else unit.name} on",
    ]
    screen.say(f"Tolerance of {indicator}: {', '.join(filter(None, said)) or 'none'}.")
