"""The store: an open history, and its two kinds of transactions."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from sqlalchemy import Connection, Engine

from elastogeo.errors import StoreError
from elastogeo.history.extra import needs_history_extra
from elastogeo.history.store import audit
from elastogeo.history.store.files import Files
from elastogeo.history.store.migrations import check_revision, make_filled, upgrade
from elastogeo.history.store.place import Place, place_of
from elastogeo.history.store.postgresql import server_engine, take_turn
from elastogeo.history.store.refusals import in_words
from elastogeo.history.store.sqlite import WAIT, check_drive, driver, sqlite_engine


@dataclass(frozen=True, slots=True, weakref_slot=True, eq=False)
class Store:
    """An open history.

    Attributes
    ----------
    engine : Engine
    files : Files
    url : str
        As it is shown: without a password.
    found : str or None
        The schema that it had when it was opened; None if it was made then.
    """

    engine: Engine
    files: Files
    url: str
    found: str | None

    def close(self) -> None:
        """Let go of the database; it opens again by itself when it is used."""
        self.engine.dispose()

    def __enter__(self) -> Store:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()


def open_store(url: str | Path, create: bool = False, *, files: str | Path | None = None, who: str = "") -> Store:
    """Open a history.

    Parameters
    ----------
    url : str or Path
        A file of SQLite (`history.db`, `sqlite:///history.db`) or `postgresql://user@host/database`.
    create : bool
        Make it if it is not there, and migrate it to the schema of this version.
    files : str or Path, optional
        The folder of the raw files: `history.db.files` beside a file of SQLite; for PostgreSQL it is needed, here or in the
        variable ELASTOGEO_FILES.
    who : str
        Who makes or migrates it, for the audit trail; who is logged in by default.

    Raises
    ------
    StoreError
        If it is not there, lies on a network drive, cannot be reached, or has another schema.
    """
    with needs_history_extra():
        return _opened(place_of(url, files), create, who)


def fill_store(url: str | Path, fill: Callable[[Connection], None], *, files: str | Path | None = None) -> Store:
    """Make a history that holds what another held: its tables and all rows in one transaction.

    Parameters
    ----------
    url, files : as in `open_store`
    fill : callable
        Puts the rows in, those of the audit trail too; they are frozen afterwards.

    Raises
    ------
    StoreError
        If there is something already, or there is no place for one.
    """
    with needs_history_extra():
        place = place_of(url, files)
        engine = _engine(place, True)
        store = Store(engine, Files(place.files), place.url, None)
        weakref.finalize(store, engine.dispose)
        try:
            store.files.make()
            with _writing(store, migrates=True) as connection:
                make_filled(connection, store.url, fill)
        except BaseException:
            engine.dispose()
            raise
        return store


def _opened(place: Place, create: bool, who: str) -> Store:
    engine = _engine(place, create)
    files = Files(place.files)
    try:
        found = _prepared(Store(engine, files, place.url, None), create, who or audit.login())
    except BaseException:
        engine.dispose()
        raise
    store = Store(engine, files, place.url, found)
    weakref.finalize(store, engine.dispose)
    return store


def _prepared(store: Store, create: bool, who: str) -> str | None:
    """The schema that a history had, which has that of this version now."""
    if create:
        store.files.make()
        with _writing(store, migrates=True) as connection:
            found = upgrade(connection, store.url, who)
    else:
        with read(store) as connection:
            found = check_revision(connection, store.url)
    store.files.sweep()
    return found


@contextmanager
def write(store: Store, wait: float = WAIT) -> Iterator[Connection]:
    """A transaction that writes: one writer at a time, all or nothing.

    Parameters
    ----------
    store : Store
    wait : float [s]
        How long it waits for others.

    Raises
    ------
    StoreError
        If another program writes for too long, the disk is full or fails, or the database cannot be reached.
    """
    with _writing(store, wait=wait) as connection:
        yield connection


@contextmanager
def read(store: Store) -> Iterator[Connection]:
    """A transaction that reads: one consistent state, whatever others write meanwhile.

    End it before you write: on SQLite in TRUNCATE a writer waits for readers, those of its own program too.
    """
    with in_words(store.url, writes=False), store.engine.connect() as connection:
        if connection.dialect.name == "postgresql":
            connection.execution_options(isolation_level="REPEATABLE READ", postgresql_readonly=True)
        with connection.begin():
            yield connection


@contextmanager
def _writing(store: Store, migrates: bool = False, wait: float = WAIT) -> Iterator[Connection]:
    with in_words(store.url, writes=True), store.engine.connect() as connection:
        connection.execution_options(writes=True, migrates=migrates, wait=wait)
        with connection.begin():
            if connection.dialect.name == "postgresql":
                take_turn(connection, wait)
            yield connection


def _engine(place: Place, create: bool) -> Engine:
    if place.server is not None:
        return server_engine(place.server)
    assert place.file is not None
    if not place.file.is_file():
        if not create:
            raise StoreError(
                f"{place.url}: there is no history here; make one with: elastogeo history init {place.url}; "
                "or name yours with --store or in the variable ELASTOGEO_STORE"
            )
        _check_place(place.file)
    check_drive(place.file)
    return sqlite_engine(place.file, driver())


def _check_place(file: Path) -> None:
    if file.is_dir():
        raise StoreError(f"{file}: is a folder; name a file in it, such as {file / 'history.db'}")
    if not file.parent.is_dir():
        raise StoreError(f"{file}: there is no folder {file.parent}; make it first")
