"""`elastogeo history restore`: a history from a backup or an export, where there is nothing yet."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elastogeo.cli.options import STORE, AsJson, Store


def restore(
    folder: Annotated[Path, typer.Argument(help="The folder of a backup or an export.")],
    place: Annotated[str, typer.Argument(metavar="[STORE]", help="The same as --store.", show_default=False)] = "",
    store: Store = STORE,
    as_json: AsJson = False,
) -> None:
    """Make a history from a backup or an export.

    Every row and every file is checked. What one database backed up may be restored into the other.

    \b
    Examples:
      elastogeo history restore backup-2026-11-22 shop.db
      elastogeo history restore backup-2026-11-22 postgresql://me@server/shop
    """
    from elastogeo.cli import screen
    from elastogeo.cli.copies import show_copied
    from elastogeo.history.upkeep import restore as restored

    with screen.progress("checking the copy", quiet=as_json) as step:
        copied = restored(folder, place or store, step=step)
    show_copied("Restored", copied, as_json)
