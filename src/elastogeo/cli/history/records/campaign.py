"""`elastogeo history campaign`: keep tests as a set, with what they say together."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def campaign(
    path: Annotated[
        Path | None, typer.Argument(metavar="[CAMPAIGN]", help="A folder with a campaign.toml; none: list the campaigns.")
    ] = None,
    machine: Annotated[
        str | None, typer.Option("--machine", "-m", help="The machine, by name; else as the tests say.")
    ] = None,
    date: Annotated[str, typer.Option(help="When it was measured, if a test does not say so.")] = "",
    recompute: Annotated[int | None, typer.Option(help="The number of a campaign to compute again.")] = None,
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Keep tests as a set, with what they say together.

    Tests that are not in the history are imported. They are identified together from their raw records.

    \b
    Examples:
      elastogeo history campaign my-campaign --machine "Mill 3"
      elastogeo history campaign
      elastogeo history campaign --recompute 1
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history, screen.progress("identifying", quiet=as_json):
        if path is not None:
            found = history.add_campaign(path, machine=machine, date=date)
        elif recompute is not None:
            found = history.recompute_campaign(recompute)
        else:
            kept = history.campaigns(machine)
            found = None
    if found is not None:
        screen.show(found, None, as_json)
    elif as_json:
        screen.show_json({"schema": "elastogeo.campaigns-kept/1", "campaigns": [one.to_dict() for one in kept]})
    else:
        screen.say(
            "\n".join(f"{one.key}  {one.machine}: {one.name}, {len(one.tests)} tests" for one in kept) or "No campaign."
        )
