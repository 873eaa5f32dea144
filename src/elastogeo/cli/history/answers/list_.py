"""`elastogeo history list`: the machines of a history, the worst first."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Report, Store


def list_(
    machine: Annotated[str, typer.Option("--machine", "-m", help="Only this machine: its series, the worst first.")] = "",
    store: Store = STORE,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """List the machines, the worst first.

    The state of each is that of its worst series, as it was judged when its last test came in.

    \b
    Examples:
      elastogeo history list
      elastogeo history list --machine "Mill 3"
    """
    from elastogeo.cli import screen

    with eg.History(store) as history:
        found = history.machine(machine) if machine else history.fleet()
    screen.show(found, report, as_json)
