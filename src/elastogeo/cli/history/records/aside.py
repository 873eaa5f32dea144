"""`elastogeo history aside`: a test that counts no more."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, Store, Who


def aside(
    test: Annotated[int, typer.Argument(help="Its number.")],
    why: Annotated[str, typer.Option(help="For which reason: 'ball not seated'.")],
    back: Annotated[bool, typer.Option("--back", help="Take it back: it counts again.")] = False,
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Set a test aside, or take it back.

    Nothing is deleted: the test stays with all its files, and is shown as set aside.

    \b
    Example:
      elastogeo history aside 12 --why "ball not seated"
    """
    from elastogeo.cli import screen

    with eg.History(store, who=who) as history:
        got = history.set_aside(test, why, back=back)
    done = "counts again" if back else "is set aside"
    screen.say(f"Test {got.key}, {got.name}, {got.machine}, {got.at:%Y-%m-%d}: {done}.")
