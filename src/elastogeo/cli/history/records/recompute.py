"""`elastogeo history recompute`: compute the tests again from their raw records."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store, Who


def recompute(
    series: Annotated[list[int] | None, typer.Option("--series", help="Its number; may be repeated. Else all.")] = None,
    jobs: Annotated[int, typer.Option(help="Processes that compute at once.", min=1)] = 1,
    store: Store = STORE,
    who: Who = "",
    as_json: AsJson = False,
) -> None:
    """Compute the tests again from their raw records.

    By the version that computed them it must be the same, to the last bit on the same platform; what differs is said, and
    nothing is changed. A new version takes series as a whole: the charts count with it once all tests of a series are done,
    and with the old one until then. Nobody is sent anything.

    \b
    Examples:
      elastogeo history recompute --store shop.db
      elastogeo history recompute --series 12 --jobs 4
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history, screen.progress("reading", quiet=as_json) as step:
        found = history.recompute(series or None, progress=step, jobs=jobs)
    screen.show(found, None, as_json)
