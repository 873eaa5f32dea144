"""Rows that are written once: the database refuses to change or delete them."""

import pytest
from sqlalchemy import text
from sqlalchemy.exc import IntegrityError

from elastogeo.history.store import Store, write
from elastogeo.history.store.frozen import frozen
from elastogeo.history.store.schema import FROZEN, metadata
from tests.history.store.filled import contents, fill, row_of


def execute(store: Store, statement: str) -> None:
    with write(store) as connection:
        connection.execute(text(statement))


def test_every_frozen_row_refuses_a_change_and_a_deletion(store: Store) -> None:
    with write(store) as connection:
        fill(connection)
        assert frozen(connection) == set(FROZEN)
    before = contents(store)
    assert all(before.values())
    for name in FROZEN:
        first = metadata.tables[name].columns[0].name
        for statement in (f"UPDATE {name} SET {first} = {first}", f"DELETE FROM {name}"):
            with pytest.raises(IntegrityError, match=f"rows of {name} are never changed or deleted"):
                execute(store, statement)
    assert contents(store) == before


def test_a_frozen_row_is_not_replaced_or_truncated_either(kind: str, store: Store) -> None:
    with write(store) as connection:
        fill(connection)
    before = contents(store)
    way = "TRUNCATE event CASCADE" if kind == "postgresql" else "INSERT OR REPLACE INTO event SELECT * FROM event"
    with pytest.raises(IntegrityError, match="rows of event are never changed or deleted"):
        execute(store, way)
    assert contents(store) == before


def test_what_is_not_frozen_can_be_written_over(store: Store) -> None:
    with write(store) as connection:
        fill(connection)
    execute(store, "UPDATE outbox SET tries = 2")
    execute(store, "UPDATE machine SET place = 'hall 2'")
    assert contents(store)["machine"][0][4] == "hall 2"


def test_what_is_written_comes_back_as_it_was(store: Store) -> None:
    with write(store) as connection:
        fill(connection)
    for table in metadata.sorted_tables:
        if not table.name.startswith("audit"):
            assert contents(store)[table.name] == [tuple(row_of(table).values())]
