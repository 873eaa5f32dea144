"""Where a history lies: a file of SQLite, or a database of PostgreSQL, and the folder of its raw files."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import URL, make_url
from sqlalchemy.exc import ArgumentError

from elastogeo.errors import StoreError

FILES_VARIABLE = "ELASTOGEO_FILES"
_POSTGRESQL = "postgresql"


@dataclass(frozen=True, slots=True)
class Place:
    """Where a history lies.

    Attributes
    ----------
    url : str
        As it is shown: without a password.
    file : Path or None
        Of SQLite; None for PostgreSQL.
    server : URL or None
        Of PostgreSQL.
    files : Path
        The folder of the raw files.
    """

    url: str
    file: Path | None
    server: URL | None
    files: Path


def place_of(url: str | Path, files: str | Path | None = None) -> Place:
    """Where a history lies.

    Parameters
    ----------
    url : str or Path
        A file of SQLite (`history.db`, `sqlite:///history.db`) or `postgresql://user@host/database`.
    files : str or Path, optional
        The folder of the raw files. Beside a file of SQLite it is `history.db.files` by default; for PostgreSQL it is
        needed, here or in the variable ELASTOGEO_FILES.

    Raises
    ------
    StoreError
        If this is no place for a history.
    """
    text = str(url)
    if isinstance(url, Path) or "://" not in text:
        return _file_place(text, files)
    kind = text.partition("://")[0]
    if kind == "sqlite":
        rest = text.removeprefix("sqlite://")
        if rest in ("", "/", "/:memory:"):
            raise StoreError(f"{text}: keeps nothing once the program ends; name a file, as in sqlite:///history.db")
        if not rest.startswith("/"):
            raise StoreError(f"{text}: a file of SQLite has three slashes before its name: sqlite:///{rest}")
        return _file_place(rest[1:], files)
    if kind.partition("+")[0] != _POSTGRESQL:
        raise StoreError(
            f"{_hidden(text)}: the history does not know {kind!r}; give a file (history.db) or postgresql://user@host/database"
        )
    return _server_place(text, files)


def _file_place(text: str, files: str | Path | None) -> Place:
    if not text:
        raise StoreError("the history has no name; give a file, such as history.db, or postgresql://user@host/database")
    file = Path(text).expanduser().absolute()
    folder = file.with_name(f"{file.name}.files") if files is None else Path(files).expanduser().absolute()
    return Place(text, file, None, folder)


def _server_place(text: str, files: str | Path | None) -> Place:
    folder = files or os.environ.get(FILES_VARIABLE)
    try:
        server = make_url(text).set(drivername=f"{_POSTGRESQL}+psycopg")
    except (ArgumentError, ValueError) as error:
        raise StoreError(f"{_hidden(text)}: {error}; write it as postgresql://user@host/database") from error
    shown = server.set(drivername=_POSTGRESQL).render_as_string(hide_password=True)
    if not folder:
        raise StoreError(
            f"{shown}: a history on PostgreSQL keeps its raw files in a folder; name it in the variable {FILES_VARIABLE}, "
            f"the same for all who use this history"
        )
    return Place(shown, None, server, Path(folder).expanduser().absolute())


def _hidden(text: str) -> str:
    """A URL that cannot be read, without what may be a password."""
    kind, _, rest = text.partition("://")
    return f"{kind}://{rest.rpartition('@')[2]}"
