"""A backup while others write is one state, is checked, and comes back on either database."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from sqlalchemy import func, insert, select

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, audit, now, open_store, read, write
from elastogeo.history.store.schema import blob, machine
from elastogeo.history.upkeep import back_up, export, restore, verify
from tests.history.upkeep.stores import backed_up, raw, rows

Place = dict[str, str]


@pytest.mark.parametrize("other", ["truncate", "postgresql"])
def test_a_backup_comes_back_on_either_database(
    full: Store, kind: str, tmp_path: Path, other: str, place_for: Callable[[str], Place], opened: Callable[[Place], Store]
) -> None:
    said = back_up(full, tmp_path / "backup")
    assert (said.content, said.wrong) == ("rows" if kind == "postgresql" else "database", ())
    place = place_for(other)
    restore(tmp_path / "backup", **place)
    with opened(place) as restored:
        assert rows(restored) == backed_up(full)
        assert raw(restored) == raw(full)
        assert verify(restored).faults == ()


def test_a_backup_while_others_write_is_one_state(store: Store, url: str, tmp_path: Path) -> None:
    """A writer adds a raw file, a machine and a row of the trail at a time: a copy has as many of each."""
    stop, begun = threading.Event(), threading.Event()

    def add() -> None:
        with open_store(url) as other:
            for k in range(400):
                sha256 = other.files.put(f"{k}".encode())
                with write(other) as connection:
                    connection.execute(insert(blob).values(sha256=sha256, size=len(f"{k}"), made_at=now()))
                    connection.execute(insert(machine).values(name=f"{k}", made_at=now()))
                    audit.record(connection, "me", "add", f"{k}")
                begun.set()
                if stop.is_set():
                    return

    writer = threading.Thread(target=add)
    writer.start()
    assert begun.wait(30)
    copies = [back_up(store, tmp_path / f"backup {k}") for k in range(2)]
    stop.set()
    writer.join()
    for k, copied in enumerate(copies):
        assert copied.rows["machine"] == copied.rows["blob"] == copied.files == copied.rows["audit"] - 1 > 0
        restore(tmp_path / f"backup {k}", tmp_path / f"{k}.db")
        with open_store(tmp_path / f"{k}.db") as restored:
            assert verify(restored).faults == ()
    with read(store) as connection:
        assert connection.execute(select(func.count()).select_from(machine)).scalar_one() >= copies[1].rows["machine"]


@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_a_backup_of_sqlite_is_its_database(full: Store, tmp_path: Path) -> None:
    back_up(full, tmp_path / "backup")
    assert {path.name for path in (tmp_path / "backup").iterdir()} == {"manifest.json", "history.db", "files"}
    assert json.loads((tmp_path / "backup" / "manifest.json").read_bytes())["content"] == "database"
    with open_store(tmp_path / "backup" / "history.db", files=tmp_path / "backup" / "files") as store:
        assert rows(store) == backed_up(full)


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_backup_with_a_bit_flipped_is_refused(full: Store, tmp_path: Path) -> None:
    back_up(full, tmp_path / "backup")
    database = tmp_path / "backup" / "history.db"
    whole = database.read_bytes()
    at = whole.index(b"machine.place")
    database.write_bytes(whole[:at] + b"M" + whole[at + 1 :])
    with pytest.raises(StoreError, match="the table machine is not what its manifest says"):
        restore(tmp_path / "backup", tmp_path / "h.db")
    assert not (tmp_path / "h.db").exists()


@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_what_cannot_be_backed_up_is_named_and_what_can_is_told(full: Store, tmp_path: Path) -> None:
    from elastogeo.history.store.frozen import freeze, thaw

    with write(full) as connection:
        thaw(connection)
        connection.exec_driver_sql("UPDATE audit SET who = 'B. Smith' WHERE number = 1")
        freeze(connection)
    assert back_up(full, tmp_path / "backup").wrong == ("audit trail whole",)
    sha256 = next(iter(full.files.all()))
    full.files.path(sha256).unlink()
    with pytest.raises(StoreError, match=f"{sha256}: is missing; put it back from a backup"):
        back_up(full, tmp_path / "second")
    assert not [path for path in tmp_path.iterdir() if path.name.startswith("second")]


@pytest.mark.parametrize("kind", ["truncate", "postgresql"])
@pytest.mark.parametrize("copy", [back_up, export])
def test_a_copy_among_the_raw_files_is_refused(full: Store, tmp_path: Path, copy: Callable[[Store, Path], object]) -> None:
    """There the next check would call it stray, and a sweep could clear it."""
    before = sorted(full.files.folder.rglob("*"))
    (tmp_path / "link").symlink_to(full.files.folder)
    for target in (full.files.folder / "backup", full.files.folder / "ab" / ".." / "backup", tmp_path / "link" / "backup"):
        with pytest.raises(StoreError, match=r"among the raw files of the history; name a folder outside of it"):
            copy(full, target)
    assert sorted(full.files.folder.rglob("*")) == before
