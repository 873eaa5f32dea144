"""One writer at a time, readers of one state, and what a database says when it cannot."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from sqlalchemy import Insert, event, func, insert, select

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, audit, now, open_store, postgresql, read, sqlite, write
from elastogeo.history.store.schema import machine


def add_machine(store: Store, name: str) -> None:
    with write(store) as connection:
        connection.execute(insert(machine).values(name=name, made_at=now()))
        audit.record(connection, "me", "add", name)


def count(store: Store) -> int:
    with read(store) as connection:
        return int(connection.execute(select(func.count()).select_from(machine)).scalar_one())


def test_writers_at_once_lose_and_double_nothing(url: str) -> None:
    """Each with a connection of its own; every one reads the last number before it writes the next."""

    def many(writer: int) -> None:
        with open_store(url) as store:
            for k in range(8):
                add_machine(store, f"{writer}.{k}")

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(many, range(4)))
    with open_store(url) as store:
        assert count(store) == 32
        with read(store) as connection:
            assert audit.verify(connection) == ()
            assert connection.execute(select(func.max(audit.audit.c.number))).scalar() == 33


def test_two_processes_make_the_same_history_at_once(place: str) -> None:
    code = f"from elastogeo.history.store import open_store; open_store({place!r}, create=True, who='me').close()"
    children = [subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True) for _ in range(2)]
    assert [(child.communicate()[1], child.returncode) for child in children] == [("", 0), ("", 0)]
    with open_store(place) as store, read(store) as connection:
        assert connection.execute(select(audit.audit.c.what)).scalars().all() == ["migrate"]


def test_a_reader_sees_one_state_while_another_writes(kind: str, store: Store, url: str) -> None:
    if kind == "truncate":  # a writer waits for readers here: the state is one because nothing is written
        return
    add_machine(store, "first")
    with open_store(url) as other, read(store) as connection:
        before = connection.execute(select(machine.c.name)).scalars().all()
        add_machine(other, "second")
        assert connection.execute(select(machine.c.name)).scalars().all() == before == ["first"]
    assert count(store) == 2


def test_a_writer_that_waits_too_long_says_for_what(url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sqlite, "WAIT", 0.1)
    monkeypatch.setattr(postgresql, "WAIT", 0.1)
    with open_store(url) as first, open_store(url) as second, write(first) as connection:
        connection.execute(insert(machine).values(name="slow", made_at=now()))
        with pytest.raises(StoreError, match="another program has held it for half a minute; wait until it is done"):
            add_machine(second, "impatient")
    with open_store(url) as store:
        assert count(store) == 1


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_writer_whom_a_reader_keeps_waiting_gives_up_as_a_whole(url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sqlite, "WAIT", 0.1)
    with open_store(url) as reader, open_store(url) as writer:
        with read(reader) as connection:
            connection.execute(select(machine)).all()
            with pytest.raises(StoreError, match="another program has held it for half a minute"):
                add_machine(writer, "given up")
        assert count(writer) == 0
        add_machine(writer, "after")
        assert count(reader) == 1


def test_a_writer_waits_for_another(url: str) -> None:
    begun = threading.Event()

    def slow() -> None:
        with open_store(url) as store, write(store) as connection:
            connection.execute(insert(machine).values(name="first", made_at=now()))
            begun.set()
            threading.Event().wait(0.1)

    thread = threading.Thread(target=slow)
    thread.start()
    assert begun.wait(30)
    with open_store(url) as store:
        add_machine(store, "second")
        with read(store) as connection:
            assert connection.execute(select(machine.c.name).order_by(machine.c.id)).scalars().all() == ["first", "second"]
    thread.join()


@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_a_disk_that_is_full_at_any_page_leaves_the_database_as_it_was(store: Store) -> None:
    """The library may use so many pages and no more: to it this is a disk without room."""
    with read(store) as connection:
        room = int(connection.exec_driver_sql("PRAGMA page_count").scalar_one())
    event.listen(store.engine, "connect", lambda raw, _: raw.execute(f"PRAGMA max_page_count = {room}"))
    refused = 0
    while count(store) == 0:
        store.close()
        said = ""
        try:
            add_machine(store, "large" * 10_000)
        except StoreError as error:
            said = str(error)
        assert not said or "there is no room on the disk; nothing was kept of this step" in said
        assert bool(said) is (count(store) == 0)
        refused += bool(said)
        room += 4
        with read(store) as connection:
            assert connection.exec_driver_sql("PRAGMA integrity_check").scalar() == "ok"
            assert audit.verify(connection) == ()
    assert refused >= 3


@pytest.mark.skipif(sys.platform == "win32", reason="a disk that fails while SQLite writes, which Windows cannot limit")
@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_a_disk_that_fails_leaves_the_database_as_it_was(store: Store, url: str) -> None:
    """A process that may write no file beyond its size, so that the system refuses its writes."""
    size = max(os.path.getsize(path) for path in Path(url).parent.glob("history.db*") if path.is_file())
    code = f"""
import resource
from sqlalchemy import insert
from elastogeo.errors import StoreError
from elastogeo.history.store import now, open_store, write
from elastogeo.history.store.schema import machine
store = open_store({url!r})
resource.setrlimit(resource.RLIMIT_FSIZE, ({size}, {size}))
try:
    with write(store) as connection:
        connection.execute(insert(machine).values(name="large" * 100_000, made_at=now()))
except StoreError as error:
    print(error)
"""
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert "the disk failed while it was read or written; check the disk, then: elastogeo history verify" in said
    assert count(store) == 0
    with read(store) as connection:
        assert connection.exec_driver_sql("PRAGMA integrity_check").scalar() == "ok"


@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_a_damaged_file_is_named(url: str) -> None:
    with open(url, "r+b") as file:
        file.seek(100)
        file.write(b"\xff" * 8000)
    with pytest.raises(StoreError, match=r"is damaged; restore it from a backup|is no file of SQLite, or is damaged"):
        open_store(url)


def test_the_history_costs_nothing_until_it_is_used() -> None:
    """Neither the face nor the room of the history imports SQLAlchemy; opening one does not import Alembic."""
    probe = "import sys, elastogeo.history, elastogeo.history.store as s; print('sqlalchemy' in sys.modules)"
    opened = "s.open_store; s.read; print('sqlalchemy' in sys.modules, 'alembic' in sys.modules, 'psycopg' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", f"{probe}; {opened}"], capture_output=True, text=True, check=True).stdout
    assert said.split() == ["False", "True", "False", "False"]


@pytest.mark.parametrize(
    ("missing", "said"),
    [
        (
            "sqlalchemy",
            "the history needs sqlalchemy, which is not installed; install it with: pip install 'elastogeo[history]'",
        ),
        ("alembic", "the history needs alembic, which is not installed; install it with: pip install 'elastogeo[history]'"),
        (
            "psycopg",
            "the history needs psycopg, which is not installed; install it with: pip install 'elastogeo[postgresql]'",
        ),
    ],
)
def test_a_missing_extra_is_named_with_its_remedy(missing: str, said: str, tmp_path: Path) -> None:
    place = "postgresql://localhost/none" if missing == "psycopg" else f"{tmp_path}/h.db"
    code = f"""
import sys
sys.modules[{missing!r}] = None
from elastogeo.errors import StoreError
from elastogeo.history import store
try:
    store.open_store({place!r}, create=True, files={str(tmp_path / "raw")!r})
except StoreError as error:
    print(error)
"""
    assert said in subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("kind", ["postgresql"])
def test_a_server_that_goes_away_is_named_and_met_again(store: Store, url: str) -> None:
    add_machine(store, "before")
    lost = insert(machine).values(name="lost", made_at=now())
    with open_store(url) as other, pytest.raises(StoreError, match=r"cannot be reached: .*check the address"):
        write_until_cut(store, other, lost)
    assert count(store) == 1
    add_machine(store, "after")
    assert count(store) == 2


def write_until_cut(store: Store, other: Store, row: Insert) -> None:
    with write(store) as connection:
        process = connection.exec_driver_sql("SELECT pg_backend_pid()").scalar()
        connection.execute(row)
        with read(other) as administrator:
            administrator.exec_driver_sql(f"SELECT pg_terminate_backend({process})")
        connection.execute(row.values(name="again"))
