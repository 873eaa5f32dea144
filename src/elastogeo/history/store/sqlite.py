"""SQLite: how its file is opened.

The journal is a write-ahead log only where the library has no WAL-reset fault (https://sqlite.org/wal.html#walresetbug:
two connections that write and checkpoint at the same instant may damage the file); otherwise `TRUNCATE`, which costs a
reader its wait for a writer and nothing else. Both are synchronous to the disk at each commit.
"""

from __future__ import annotations

import os
import sqlite3
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event

from elastogeo.errors import StoreError
from elastogeo.history.store.mounts import network_drive

DRIVER_VARIABLE = "ELASTOGEO_SQLITE"
"""Names a module to use in place of Python's own `sqlite3`: `pysqlite3` brings a newer library."""
WAIT = 30.0
"""How long a writer waits for another [s]."""
_SWITCH = 300  # ms to wait for another before its journal is left as it is
_MENDED = ((3, 51, 3), (3, 50, 7), (3, 44, 6))


def has_wal_reset_fault(version: tuple[int, int, int]) -> bool:
    """Whether a version of the SQLite library may damage a file in WAL mode.

    Mended in 3.51.3, and in 3.50.7 and 3.44.6 of the older branches.
    """
    newest, *branches = _MENDED
    return version < newest and not any(version[:2] == branch[:2] and version >= branch for branch in branches)


def driver() -> ModuleType:
    """The module that talks to SQLite.

    Raises
    ------
    StoreError
        If the variable ELASTOGEO_SQLITE names one that is not there.
    """
    name = os.environ.get(DRIVER_VARIABLE) or "sqlite3"
    if name == "sqlite3":
        return sqlite3
    try:
        return import_module(f"{name}.dbapi2")
    except ModuleNotFoundError as error:
        raise StoreError(
            f"{DRIVER_VARIABLE} is {name!r}, which is no module of SQLite here; install it, or remove the variable"
        ) from error


def check_drive(file: Path) -> None:
    """Refuse a network drive.

    Raises
    ------
    StoreError
        With the ways out.
    """
    kind = network_drive(file.parent.resolve())
    if kind:
        raise StoreError(
            f"{file}: lies on a network drive ({kind}), where two programs can damage a file of SQLite; "
            "put the history on a drive of this computer, or use PostgreSQL: postgresql://user@host/database"
        )


def sqlite_engine(file: Path, library: ModuleType) -> Engine:
    """The engine of a file; transactions are begun by us, at once for writing where the option `writes` says so."""
    faulty = has_wal_reset_fault(library.sqlite_version_info)
    engine = create_engine(
        URL.create("sqlite", database=str(file)), module=library, connect_args={"timeout": WAIT}, pool_size=4
    )

    @event.listens_for(engine, "connect")
    def opened(connection: Any, _record: object) -> None:
        connection.isolation_level = None  # the driver begins no transaction: we do
        for setting in ("recursive_triggers = ON", "mmap_size = 0", "synchronous = FULL"):
            connection.execute(f"PRAGMA {setting}")
        _set_journal(connection, file, faulty)

    @event.listens_for(engine, "begin")
    def begin(connection: Connection) -> None:
        options = connection.get_execution_options()
        writes, migrates = options.get("writes", False), options.get("migrates", False)
        own: Any = connection.connection.driver_connection  # a page reads five times, and this costs a tenth
        own.execute(f"PRAGMA busy_timeout = {options.get('wait', WAIT) * 1000:.0f}")
        own.execute(f"PRAGMA query_only = {'OFF' if writes else 'ON'}")
        own.execute(f"PRAGMA foreign_keys = {'OFF' if migrates else 'ON'}")
        connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
        if writes and faulty and connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal":
            connection.exec_driver_sql("ROLLBACK")  # another program has changed it since this connection was made
            raise _refused_wal(file)

    return engine


def _set_journal(connection: Any, file: Path, faulty: bool) -> None:
    """Choose the journal; another program may hold the file in its own."""
    wanted = "truncate" if faulty else "wal"
    if connection.execute("PRAGMA journal_mode").fetchone()[0] == wanted:
        return
    connection.execute(f"PRAGMA busy_timeout = {_SWITCH}")
    try:
        got = connection.execute(f"PRAGMA journal_mode = {wanted}").fetchone()[0]
    except Exception as error:
        if "locked" not in str(error):
            raise
        got = "locked"
    finally:
        connection.execute(f"PRAGMA busy_timeout = {WAIT * 1000:.0f}")
    if faulty and got != wanted:
        raise _refused_wal(file)
    if got != wanted:
        connection.execute("PRAGMA journal_mode = truncate")


def _refused_wal(file: Path) -> StoreError:
    return StoreError(
        f"{file}: another program writes it in WAL mode; the SQLite of this one has a fault that may then damage the file; "
        "close the other program, or use a Python with SQLite 3.51.3 or later"
    )
