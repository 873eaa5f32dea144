"""Migrations: how a history of an older schema becomes one of this version, and what is refused.

To change the schema: change `schema.py`, write a file in `versions` that does the same to a database, add its revision to
`REVISIONS`, and (when a version is released) keep a dump of its schema under `tests/history/store/released`. Whatever the
number of steps, a migration is one transaction. Rows that are frozen are thawed for it, and frozen again at its end.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from sqlalchemy import Connection, inspect, text

from elastogeo.errors import StoreError
from elastogeo.history.store import audit
from elastogeo.history.store.frozen import freeze, thaw
from elastogeo.version import VERSION

REVISIONS = ("0001", "0002")
"""The schemas that there were, the oldest first; the last one is that of `schema.py`."""
VERSION_TABLE = "schema_version"
FOLDERS = (Path(__file__).parent / "versions",)
"""Where the steps from each schema to the next are."""


def revision(connection: Connection) -> str | None:
    """The schema that a database has; None if it has none of a history."""
    if not inspect(connection).has_table(VERSION_TABLE):
        return None
    found: str | None = connection.execute(text(f"SELECT version_num FROM {VERSION_TABLE}")).scalar()
    return found


def check_revision(connection: Connection, url: str) -> str:
    """The schema of a history; one that is not of this version is refused, and so is a database that is no history.

    Raises
    ------
    StoreError
        With what to do.
    """
    found = revision(connection)
    if found is None:
        raise StoreError(f"{url}: holds no history; make one with: elastogeo history init {url}")
    _refuse_newer(found, url)
    if found != REVISIONS[-1]:
        raise StoreError(
            f"{url}: was made by an older elastogeo (schema {found}, this one needs {REVISIONS[-1]}); back it up, "
            f"then migrate it with: elastogeo history init {url}"
        )
    return found


def upgrade(connection: Connection, url: str, who: str) -> str | None:
    """Make the tables, or bring them to the schema of this version; in the caller's transaction. The schema that was found.

    Raises
    ------
    StoreError
        If the schema is newer than this version, or the database holds something else.
    """
    found = revision(connection)
    if found is None:
        _refuse_others(connection, url)
    else:
        _refuse_newer(found, url)
    if found == REVISIONS[-1]:
        return found
    _run(connection)
    audit.record(connection, who, "migrate", "schema", old=found, new=REVISIONS[-1], why=f"elastogeo {VERSION}")
    return found


def make_filled(connection: Connection, url: str, fill: Callable[[Connection], None]) -> None:
    """Make the tables, fill them with what another history held, and freeze them; in the caller's transaction.

    Raises
    ------
    StoreError
        If the database holds something already.
    """
    if revision(connection) is not None:
        raise StoreError(f"{url}: holds a history already; name a place that holds nothing")
    _refuse_others(connection, url)
    _run(connection)
    thaw(connection)
    fill(connection)
    freeze(connection)
    _check_references(connection)


def _refuse_others(connection: Connection, url: str) -> None:
    others = inspect(connection).get_table_names()
    if others:
        raise StoreError(f"{url}: holds something else (the table {sorted(others)[0]}); give the history a place of its own")


def _refuse_newer(found: str, url: str) -> None:
    if found not in REVISIONS:
        raise StoreError(
            f"{url}: was written by a newer elastogeo (schema {found}; {VERSION} knows {REVISIONS[-1]} and older); "
            "install that version, or restore a backup that this one made"
        )


def _run(connection: Connection) -> None:
    from alembic.command import upgrade as run
    from alembic.config import Config

    configuration = Config(attributes={"connection": connection})
    configuration.set_main_option("script_location", str(Path(__file__).parent).replace("%", "%%"))
    configuration.set_main_option("path_separator", "newline")
    configuration.set_main_option("version_locations", "\n".join(map(str, FOLDERS)).replace("%", "%%"))
    thaw(connection)
    run(configuration, "head")
    freeze(connection)
    _check_references(connection)


def _check_references(connection: Connection) -> None:
    """SQLite does not follow references while tables are made anew, so they are checked at the end."""
    if connection.dialect.name == "sqlite" and (broken := connection.exec_driver_sql("PRAGMA foreign_key_check").first()):
        raise StoreError(
            f"a row of the table {broken[0]} names a row of {broken[2]} that is not there; nothing was migrated"
        )
