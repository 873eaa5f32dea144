"""`elastogeo history compare`: two tests of a history, and what changed between them."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Report, Store


def compare(
    one: Annotated[int, typer.Argument(metavar="TEST", help="Number of a test.")],
    other: Annotated[int, typer.Argument(metavar="TEST", help="Number of another of the same machine.")],
    store: Store = STORE,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Say what changed between two tests of a machine.

    \b
    Example:
      elastogeo history compare 12 31
    """
    from elastogeo.cli import screen

    with eg.History(store) as history:
        found = history.compare(one, other)
    screen.show(found, report, as_json)
