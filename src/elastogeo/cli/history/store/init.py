"""`elastogeo history init`: make a history, or bring it to the schema of this version."""

from __future__ import annotations

from typing import Annotated

import typer

from elastogeo.cli.options import STORE, Store, Who


def init(
    place: Annotated[str, typer.Argument(metavar="[STORE]", help="The same as --store.", show_default=False)] = "",
    store: Store = STORE,
    who: Who = "",
) -> None:
    """Make a history; migrate one that an older version made.

    Its raw files lie in a folder beside it, such as history.db.files; for PostgreSQL the variable ELASTOGEO_FILES names it.

    \b
    Examples:
      elastogeo history init
      elastogeo history init shop.db
      elastogeo history init postgresql://me@server/shop
    """
    from elastogeo.cli import screen
    from elastogeo.history.store import make_store

    made = make_store(place or store, who=who)
    if made.found is None:
        screen.say(f"Made: {made.url}")
    elif made.found == made.schema:
        screen.say(f"There already, nothing was changed: {made.url}")
    else:
        screen.say(f"Migrated from schema {made.found}: {made.url}")
    screen.say(f"Schema {made.schema}, {made.database}; raw files in {made.files}")
