"""`elastogeo history list`: the machines of a history, the worst first."""

from __future__ import annotations

from pathlib import Path

import elastogeo as eg
from elastogeo.cli.options import STORE, Store


def list_(store: Store = STORE) -> None:
    """List the machines, the worst first.

    \b
    Example:
      elastogeo history list --store shop.db
    """
    if "://" not in store and not Path(store).is_file():
        raise eg.InputError(f"{store}: there is no history here; name it with --store, or make one: elastogeo history init")
    raise eg.UnsupportedError(f"{store}: this version keeps machines, but does not list them yet")
