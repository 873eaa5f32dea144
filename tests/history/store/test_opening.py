"""A history is opened, read and written on three databases by the same code."""

from pathlib import Path

import pytest
from sqlalchemy import Insert, insert, select
from sqlalchemy.exc import IntegrityError

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, audit, now, open_store, read, write
from elastogeo.history.store.schema import machine


def add_machine(store: Store, name: str) -> None:
    with write(store) as connection:
        connection.execute(insert(machine).values(name=name, made_at=now()))


def add_twice(store: Store, row: Insert) -> None:
    with write(store) as connection:
        connection.execute(row)
        connection.execute(row)


def names(store: Store) -> list[str]:
    with read(store) as connection:
        return list(connection.execute(select(machine.c.name).order_by(machine.c.id)).scalars())


def test_what_is_written_is_there_when_the_history_is_opened_again(place: str) -> None:
    with open_store(place, create=True, who="A. Miller") as store:
        add_machine(store, "Hermle C50 no. 3")
    with open_store(place) as again:
        assert names(again) == ["Hermle C50 no. 3"]
        with read(again) as connection:
            assert audit.verify(connection) == ()


def test_a_write_that_fails_leaves_nothing(store: Store) -> None:
    half = insert(machine).values(name="half", made_at=now())
    with pytest.raises(IntegrityError, match=r"(?i)unique"):
        add_twice(store, half)
    assert names(store) == []


def test_a_reader_sees_one_state_and_cannot_write(store: Store) -> None:
    with read(store) as connection:
        assert list(connection.execute(select(machine.c.name))) == []
    with pytest.raises(StoreError, match="was to be written while it was only read"), read(store) as connection:
        connection.execute(insert(machine).values(name="no", made_at=now()))
    add_machine(store, "after")
    assert names(store) == ["after"]


def test_the_journal_is_chosen_by_the_library(kind: str, store: Store) -> None:
    if kind == "postgresql":
        return
    with read(store) as connection:
        assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == kind
        assert connection.exec_driver_sql("PRAGMA synchronous").scalar() == 2
        assert connection.exec_driver_sql("PRAGMA foreign_keys").scalar() == 1


def test_a_history_that_is_not_there_is_not_made_by_opening_it(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="there is no history here; make one with: elastogeo history init"):
        open_store(tmp_path / "h.db")
    assert list(tmp_path.iterdir()) == []
