"""A history with a row in each table."""

from __future__ import annotations

from datetime import UTC, datetime

from sqlalchemy import Connection, Table, insert

from elastogeo.history.store import Store, read
from elastogeo.history.store.columns import Document, Instant, Packed
from elastogeo.history.store.schema import metadata

AT = datetime(2026, 3, 2, 8, 0, tzinfo=UTC)
CHOICES = {"origin": "simulated", "kind": "repair", "state": "open", "role": "reader"}


def row_of(table: Table, **given: object) -> dict[str, object]:
    """A row that the table takes, which refers to rows of number 1."""
    row: dict[str, object] = {}
    for column in table.columns:
        if column.name in given:
            row[column.name] = given[column.name]
        elif column.foreign_keys:
            row[column.name] = "a" * 64 if column.name == "sha256" else 1
        elif isinstance(column.type, Instant):
            row[column.name] = AT
        elif isinstance(column.type, Document | Packed):
            row[column.name] = {"x": [1.5, None, "µ"]}
        elif column.name in CHOICES and not (column.name == "kind" and table.name != "event"):
            row[column.name] = "waiting" if table.name in ("outbox", "job") else CHOICES[column.name]
        elif column.name == "sha256":
            row[column.name] = "a" * 64
        elif column.type.python_type in (int, float, bool):
            row[column.name] = 1
        else:
            row[column.name] = f"{table.name}.{column.name}"
    return row


def fill(connection: Connection) -> None:
    """A row in each table, but for those of the audit trail, which fills itself."""
    for table in metadata.sorted_tables:
        if not table.name.startswith("audit"):
            connection.execute(insert(table).values(**row_of(table)))


def contents(store: Store) -> dict[str, list[tuple[object, ...]]]:
    with read(store) as connection:
        return {table.name: [tuple(row) for row in connection.execute(table.select())] for table in metadata.sorted_tables}
