"""`elastogeo history digest`: what waits for somebody."""

from __future__ import annotations

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store


def digest(store: Store = STORE, as_json: AsJson = False) -> None:
    """Show open alarms, overdue tests, messages that failed.

    \b
    Example:
      elastogeo history digest
    """
    from elastogeo.cli import screen

    with eg.History(store) as history:
        found = history.alarms()
    screen.show(found, None, as_json)
