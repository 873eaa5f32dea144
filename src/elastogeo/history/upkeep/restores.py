"""An empty place filled from a backup or an export, on either database; every row and every file is checked on the way."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Table, text

from elastogeo.errors import StoreError
from elastogeo.history.store import Files, Store, fill_store, open_store, read
from elastogeo.history.store.migrations import REVISIONS
from elastogeo.history.store.place import Place, place_of
from elastogeo.history.store.schema import metadata
from elastogeo.history.upkeep.folders import disk_in_words, flush_folder, sweep, unfinished
from elastogeo.history.upkeep.manifests import (
    AS_DATABASE,
    DATABASE,
    FILES,
    TABLES,
    Copied,
    Manifest,
    read_manifest,
)
from elastogeo.history.upkeep.raw_copies import Step, copy_raw, silent
from elastogeo.history.upkeep.rows import digest_of, lines_of, put_rows


def restore(folder: str | Path, url: str | Path, *, files: str | Path | None = None, step: Step = silent) -> Copied:
    """Fill an empty place from a backup or an export. A backup of one database may be restored into the other.

    Parameters
    ----------
    folder : str or Path
        Of the copy.
    url : str or Path
        Where the history is to be: a file of SQLite that is not there yet, or a database of PostgreSQL without tables.
    files : str or Path, optional
        The folder for the raw files, as in `open_store`; nothing may be in it.
    step : callable
        Is told what is going on.

    Returns
    -------
    Copied

    Raises
    ------
    StoreError
        If the place is not empty, or the copy is damaged or of a newer version; the place holds no history then.
    """
    source = Path(folder).expanduser().absolute()
    manifest = read_manifest(source)
    place = place_of(url, files)
    _check_empty(place, set(_hashes(source)))
    if manifest.revision != REVISIONS[-1]:
        raise StoreError(
            f"{source}: was made by an older elastogeo (schema {manifest.revision}, this one has {REVISIONS[-1]}); restore "
            f"it with that version, then migrate it with: elastogeo history init"
        )
    _check_files(source, manifest)
    with disk_in_words(place.files):
        copy_raw(Files(source / FILES), Files(place.files), _hashes(source), step)
        with _rows_of(source, manifest) as lines:

            def fill(connection: Connection) -> None:
                for table in metadata.sorted_tables:
                    step(f"rows of {table.name}")
                    put_rows(connection, table, lines(table))
                    _check_rows(connection, table, manifest, source)
                _count_on(connection)

            _fill(place, url, fill)
    return manifest.copied(place.url)


def _fill(place: Place, url: str | Path, fill: Callable[[Connection], None]) -> None:
    """Make the history: in one transaction on PostgreSQL, under another name, changed when it is whole, on SQLite."""
    if place.file is None:
        fill_store(url, fill, files=place.files).close()
        return
    sweep(place.file)
    made = unfinished(place.file)
    try:
        fill_store(made, fill, files=place.files).close()
        with open(made, "r+b") as written:
            os.fsync(written.fileno())
        _name(made, place.file)
        flush_folder(place.file.parent)
    except FileExistsError as error:
        raise _not_empty(place, "was made meanwhile") from error
    finally:
        for left in place.file.parent.glob(f"{made.name}*"):
            with suppress(OSError):
                left.unlink()


def _name(made: Path, file: Path) -> None:
    """Give a file its name, if nobody else has made one of that name."""
    try:
        os.link(made, file)
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        if file.exists():
            raise FileExistsError(file) from None
        os.rename(made, file)


def _count_on(connection: Connection) -> None:
    """New rows get keys after the last one; SQLite sees to that itself."""
    if connection.dialect.name == "sqlite":
        return
    for table in metadata.sorted_tables:
        if "id" not in table.c or not table.c.id.autoincrement:
            continue
        sequence = f"pg_get_serial_sequence('{table.name}', 'id')"
        connection.execute(text(f"SELECT setval({sequence}, max(id)) FROM {table.name} HAVING max(id) IS NOT NULL"))


def _check_empty(place: Place, ours: set[str]) -> None:
    """Nothing is there, but raw files of this copy: an attempt that was cut off left them."""
    if place.file is not None and (place.file.exists() or place.file.is_symlink()):
        raise _not_empty(place, "is there already")
    if place.files.exists() and not place.files.is_dir():
        raise StoreError(f"{place.files}: is no folder; name another one for the raw files")
    for path in place.files.rglob("*"):
        if path.is_file() and path.name not in ours and path.parent.name != "incoming":
            raise StoreError(f"{path}: is there already; a history is restored only where there is nothing")


def _not_empty(place: Place, why: str) -> StoreError:
    return StoreError(f"{place.url}: {why}; a history is restored only where there is nothing: name another place")


def _hashes(source: Path) -> list[str]:
    return list(Files(source / FILES).all())


def _check_files(source: Path, manifest: Manifest) -> None:
    there = len(_hashes(source))
    if there != manifest.files:
        raise StoreError(f"{source}: should hold {manifest.files} raw files and holds {there}; take another copy")


def _check_rows(connection: Connection, table: Table, manifest: Manifest, source: Path) -> None:
    wanted = manifest.tables.get(table.name)
    got = digest_of(lines_of(connection, table))
    if got != wanted:
        said = wanted["rows"] if wanted else "no"
        raise StoreError(
            f"{source}: the table {table.name} is not what its manifest says ({said} rows there, {got['rows']} read, "
            f"or other values): the copy was changed or is damaged; take another one"
        )


@contextmanager
def _rows_of(source: Path, manifest: Manifest) -> Iterator[Any]:
    """What gives the lines of a table, whichever way the copy holds them."""
    if manifest.content != AS_DATABASE:
        yield lambda table: _lines(source / TABLES / f"{table.name}.jsonl")
        return
    with tempfile.TemporaryDirectory(prefix="elastogeo-restore-") as folder:
        copy = Path(folder) / DATABASE  # opening a file of SQLite may write to it
        shutil.copyfile(source / DATABASE, copy)
        with _opened(copy, source) as store, read(store) as connection:
            yield lambda table: lines_of(connection, table)


@contextmanager
def _opened(copy: Path, source: Path) -> Iterator[Store]:
    with open_store(copy, files=source / FILES) as store:
        yield store


def _lines(path: Path) -> Iterator[bytes]:
    try:
        with open(path, "rb") as file:
            yield from file
    except OSError as error:
        raise StoreError(f"{path}: {error.strerror}; take another copy") from error
