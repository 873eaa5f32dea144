"""`elastogeo history backup`: a copy of everything, while others work."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import STORE, AsJson, Store


def backup(
    folder: Annotated[Path, typer.Argument(help="A new folder to write to.")],
    store: Store = STORE,
    as_json: AsJson = False,
) -> None:
    """Copy everything, while others work, and check the copy.

    The folder gets its name when all is in it and checked: what has the name is a backup.

    \b
    Examples:
      elastogeo history backup backup-2026-11-22
      elastogeo history backup /mnt/nas/shop-2026-11-22 --store shop.db
    """
    from elastogeo.cli import screen
    from elastogeo.cli.copies import show_copied

    with eg.History(store) as history, screen.progress("the database", quiet=as_json) as step:
        copied = history.back_up(folder, step)
    show_copied("Backed up", copied, as_json)
