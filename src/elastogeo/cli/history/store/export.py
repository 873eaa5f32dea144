"""`elastogeo history export`: everything as files that any program reads."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store


def export(
    folder: Annotated[Path, typer.Argument(help="A new folder to write to.")],
    store: Store = STORE,
    as_json: AsJson = False,
) -> None:
    """Write everything as files: rows as JSON, raw files by hash.

    `history restore` makes a history of it again, on either database.

    \b
    Examples:
      elastogeo history export shop-2026-11
    """
    from elastogeo.cli import screen
    from elastogeo.cli.copies import show_copied

    with eg.History(store) as history, screen.progress("rows", quiet=as_json) as step:
        copied = history.export(folder, step)
    show_copied("Exported", copied, as_json)
