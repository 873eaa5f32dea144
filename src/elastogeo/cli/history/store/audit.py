"""`elastogeo history audit`: who did what, and whether the trail is whole."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Report, Store


def audit(
    last: Annotated[int, typer.Option(help="Rows to show.", min=0)] = 20,
    subject: Annotated[str, typer.Option(help="Only what was done to this: 'test 12'.")] = "",
    by: Annotated[str, typer.Option(help="Only what this person did.")] = "",
    store: Store = STORE,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Show who did what, and check the trail.

    Note the seal of the last row somewhere else: it shows later that no row before it was written anew.

    \b
    Examples:
      elastogeo history audit
      elastogeo history audit --subject "test 12" --last 100
    """
    from elastogeo.cli import screen

    with eg.History(store) as history:
        trail = history.audit(last, subject, by)
    screen.show(trail, report, as_json)
