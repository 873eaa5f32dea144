"""`elastogeo history deliver`: send what is due."""

from __future__ import annotations

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store


def deliver(store: Store = STORE, as_json: AsJson = False) -> None:
    """Send what is due: messages, and once a week the digest.

    Let a timer call it every few minutes. It also makes an alarm of a suspect test that nobody repeated within a week.
    What a receiver does not take is tried again, later each time, for about a day and a half.

    \b
    Example:
      elastogeo history deliver --store shop.db
    """
    from elastogeo.cli import screen

    with eg.History(store) as history, screen.progress("sending", quiet=as_json):
        found = history.deliver()
    screen.show(found, None, as_json)
