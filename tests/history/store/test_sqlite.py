"""SQLite: the journal by the library's version, and two libraries on one file."""

import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from sqlalchemy import insert

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, now, open_store, read, sqlite, write
from elastogeo.history.store.schema import machine
from elastogeo.history.store.sqlite import has_wal_reset_fault

needs_newer = pytest.mark.skipif(
    sys.platform != "linux", reason=f"SQLite in WAL, whose newer library for tests is not made for {sys.platform}"
)


@pytest.mark.parametrize(
    ("version", "fault"),
    [
        ((3, 40, 1), True),  # Debian 12
        ((3, 44, 5), True),
        ((3, 44, 6), False),
        ((3, 45, 0), True),
        ((3, 49, 99), True),
        ((3, 50, 6), True),
        ((3, 50, 7), False),
        ((3, 51, 0), True),
        ((3, 51, 2), True),
        ((3, 51, 3), False),
        ((3, 52, 0), False),
        ((4, 0, 0), False),
    ],
)
def test_the_versions_with_the_fault(version: tuple[int, int, int], fault: bool) -> None:
    assert has_wal_reset_fault(version) is fault


def journal(store: Store) -> str:
    with read(store) as connection:
        return str(connection.exec_driver_sql("PRAGMA journal_mode").scalar())


def add_machine(store: Store, name: str) -> None:
    with write(store) as connection:
        connection.execute(insert(machine).values(name=name, made_at=now()))


class Other:
    """Another program that holds a file open by a library of its own: two libraries in one process share their locks."""

    def __init__(self, library: str, file: Path, journal: str, reads: bool) -> None:
        what = f"""
import sys
from {library} import dbapi2
connection = dbapi2.connect({str(file)!r}, isolation_level=None)
print(connection.execute("PRAGMA journal_mode = {journal}").fetchone()[0], flush=True)
connection.execute("BEGIN")
if {reads}:
    connection.execute("SELECT * FROM machine").fetchall()
print("ready", flush=True)
sys.stdin.read()
"""
        self._process = subprocess.Popen(
            [sys.executable, "-c", what], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._process.stdout is not None
        self.journal = self._process.stdout.readline().strip()
        assert self._process.stdout.readline() == "ready\n"

    def __enter__(self) -> "Other":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()


@pytest.fixture
def opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Store]]:
    """Open one file by a library with the fault (`False`) or by one without (`True`)."""
    monkeypatch.setattr(sqlite3, "sqlite_version_info", (3, 40, 1))
    stores = []

    def opened(newer: bool, create: bool = False) -> Store:
        monkeypatch.setenv(sqlite.DRIVER_VARIABLE, "pysqlite3" if newer else "sqlite3")
        stores.append(open_store(tmp_path / "h.db", create=create))
        return stores[-1]

    yield opened
    for store in stores:
        store.close()


@needs_newer
def test_a_file_goes_from_one_library_to_the_other_and_back(opened: Callable[..., Store]) -> None:
    for k, (newer, wanted) in enumerate([(True, "wal"), (False, "truncate"), (True, "wal")]):
        store = opened(newer, create=True)
        assert journal(store) == wanted
        add_machine(store, f"machine {k}")
        store.close()
    with read(store) as connection:
        assert len(connection.execute(machine.select()).all()) == 3
    store.close()


@needs_newer
def test_a_library_with_the_fault_refuses_a_file_that_is_open_in_wal(opened: Callable[..., Store], tmp_path: Path) -> None:
    opened(True, create=True).close()
    with (
        Other("pysqlite3", tmp_path / "h.db", "wal", reads=True),
        pytest.raises(StoreError, match="another program writes it in WAL mode; the SQLite of this one has a fault"),
    ):
        opened(False)
    assert journal(opened(False)) == "truncate"


@needs_newer
def test_a_connection_with_the_fault_sees_that_another_changed_the_journal_since(
    opened: Callable[..., Store], tmp_path: Path
) -> None:
    older = opened(False, create=True)
    add_machine(older, "before")
    with Other("pysqlite3", tmp_path / "h.db", "wal", reads=False) as newer:
        assert newer.journal == "wal"
        with pytest.raises(StoreError, match="another program writes it in WAL mode"):
            add_machine(older, "refused")


@needs_newer
def test_a_library_without_the_fault_keeps_to_truncate_while_another_reads(
    opened: Callable[..., Store], tmp_path: Path
) -> None:
    opened(False, create=True).close()
    with Other("sqlite3", tmp_path / "h.db", "truncate", reads=True):
        assert journal(opened(True)) == "truncate"


def test_a_driver_that_is_not_there_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(sqlite.DRIVER_VARIABLE, "sqlite9")
    with pytest.raises(StoreError, match="ELASTOGEO_SQLITE is 'sqlite9', which is no module of SQLite here"):
        open_store(tmp_path / "h.db", create=True)
