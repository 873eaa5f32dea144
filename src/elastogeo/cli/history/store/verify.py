"""`elastogeo history verify`: whether all that is kept is as it was written."""

from __future__ import annotations

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Report, Store


def verify(store: Store = STORE, report: Report = None, as_json: AsJson = False) -> None:
    """Check that everything kept is as it was written.

    Ends with 0 if all is, with 1 if something is not: it is named.

    \b
    Examples:
      elastogeo history verify
      elastogeo history verify --store shop.db --json
    """
    from elastogeo.cli import screen

    with eg.History(store) as history, screen.progress("the database", quiet=as_json) as step:
        found = history.verify(step)
    screen.show(found, report, as_json)
