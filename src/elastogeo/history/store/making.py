"""A history made, or brought to the schema of this version, and what it is then."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from elastogeo.history.store.migrations import REVISIONS
from elastogeo.history.store.opening import open_store, read


@dataclass(frozen=True, slots=True)
class Made:
    """What became of a place where a history was to be.

    Attributes
    ----------
    url : str
    found : str or None
        The schema that was there before; None if there was no history.
    schema : str
        That it has now.
    database : str
        `SQLite 3.53.4, journal wal` or `PostgreSQL 18.4`.
    files : Path
        The folder of the raw files.
    """

    url: str
    found: str | None
    schema: str
    database: str
    files: Path


def make_store(url: str | Path, *, files: str | Path | None = None, who: str = "") -> Made:
    """Make a history where there is none, or bring it to the schema of this version.

    Raises
    ------
    StoreError
        If there is no place for one.
    """
    with open_store(url, create=True, files=files, who=who) as store, read(store) as connection:
        version = ".".join(map(str, connection.dialect.server_version_info or ()))
        if connection.dialect.name == "sqlite":
            journal = connection.exec_driver_sql("PRAGMA journal_mode").scalar()
            database = f"SQLite {version}, journal {journal}"
        else:
            database = f"PostgreSQL {version}"
        return Made(store.url, store.found, REVISIONS[-1], database, store.files.folder)
