"""Rows as lines: what a table keeps, bit for bit and the same whatever the database, and back.

A line is a JSON object, its columns in the order of the schema, rows in the order of their keys. Points in time stand as
microseconds since 1970 UTC, documents as the text that was kept, packed documents in base64, and numbers with all digits;
`Infinity` and `NaN`, which JSON does not know, as text. A negative zero is a zero, as SQLite keeps it.
"""

from __future__ import annotations

import hashlib
import json
import math
from base64 import b64decode, b64encode
from collections.abc import Callable, Collection, Iterable, Iterator
from itertools import islice
from typing import Any

from sqlalchemy import BigInteger, Column, Connection, Float, LargeBinary, Table, Text, insert, select, type_coerce, update

from elastogeo.errors import StoreError
from elastogeo.history.store.columns import Document, Instant, Packed

_AT_ONCE = 500
"""Rows that are read or written together."""


def lines_of(connection: Connection, table: Table, empty: Collection[str] = ()) -> Iterator[bytes]:
    """The rows of a table as lines, in the order of their keys; the columns `empty` without what is in them."""
    writers = [_nothing if column.name in empty else _writer(column) for column in table.columns]
    names = [column.name for column in table.columns]
    asked = select(*(_as_kept(column) for column in table.columns)).order_by(*table.primary_key.columns)
    found = connection.execute(asked, execution_options={"yield_per": _AT_ONCE})
    for row in found:
        values = [None if value is None else write(value) for write, value in zip(writers, row, strict=True)]
        yield json.dumps(dict(zip(names, values, strict=True)), ensure_ascii=False, separators=(",", ":")).encode() + b"\n"


class Counted:
    """Lines that go by, counted and hashed."""

    def __init__(self, lines: Iterable[bytes]) -> None:
        self._lines = lines
        self._digest = hashlib.sha256()
        self.rows = 0

    def __iter__(self) -> Iterator[bytes]:
        for line in self._lines:
            self._digest.update(line)
            self.rows += 1
            yield line

    def facts(self) -> dict[str, Any]:
        """How many lines there were, and the SHA-256 of all."""
        return {"rows": self.rows, "sha256": self._digest.hexdigest()}


def digest_of(lines: Iterable[bytes]) -> dict[str, Any]:
    """How many lines there are, and the SHA-256 of all."""
    counted = Counted(lines)
    for _ in counted:
        pass
    return counted.facts()


def put_rows(connection: Connection, table: Table, lines: Iterable[bytes]) -> None:
    """Write lines as rows of a table.

    A row that names another of its own table may stand before it, so such names are written when all rows are there; the
    rows must not be frozen then.

    Raises
    ------
    StoreError
        If a line is no row of this table.
    """
    columns = list(table.columns)
    readers = {column.name: _reader(column) for column in columns}
    own = [column for column in columns if any(key.column.table is table for key in column.foreign_keys)]
    later: list[tuple[Column[Any], int, Any]] = []
    statement = insert(_plain(table))
    rest = enumerate(lines, start=1)
    while rows := [_row(table, readers, number, line) for number, line in islice(rest, _AT_ONCE)]:
        for row in rows:
            for column in own:
                if row[column.name] is not None:
                    later.append((column, row["id"], row[column.name]))
                    row[column.name] = None
        connection.execute(statement, rows)
    for column, key, value in later:
        connection.execute(update(table).where(table.c.id == key).values({column.name: value}))


def _row(table: Table, readers: dict[str, Callable[[Any], Any]], number: int, line: bytes) -> dict[str, Any]:
    try:
        values = json.loads(line)
        if list(values) != list(readers):
            raise ValueError("its columns are others")
        return {name: None if values[name] is None else read(values[name]) for name, read in readers.items()}
    except (ValueError, TypeError, AttributeError) as error:
        raise StoreError(f"line {number} of the table {table.name} is no row of it: {error}") from error


def _as_kept(column: Column[Any]) -> Any:
    """A column, its values as the database keeps them."""
    kept = _kept_type(column)
    return column if kept is None else type_coerce(column, kept)


def _plain(table: Table) -> Any:
    """The table, to be filled with values as a database keeps them."""
    from sqlalchemy import column as named
    from sqlalchemy import table as plain_table

    columns = [named(column.name, _kept_type(column) or column.type) for column in table.columns]
    return plain_table(table.name, *columns)


def _kept_type(column: Column[Any]) -> Any:
    for ours, kept in ((Instant, BigInteger), (Document, Text), (Packed, LargeBinary)):
        if isinstance(column.type, ours):
            return kept()
    return None


def _nothing(value: Any) -> None:  # noqa: ARG001
    return None


def _writer(column: Column[Any]) -> Callable[[Any], Any]:
    if isinstance(column.type, Packed):
        return lambda value: b64encode(value).decode()
    if isinstance(column.type, Float):
        return lambda value: value + 0.0 if math.isfinite(value) else str(value)
    return lambda value: value


def _reader(column: Column[Any]) -> Callable[[Any], Any]:
    if isinstance(column.type, Packed):
        return lambda value: b64decode(value, validate=True)
    if isinstance(column.type, Float):
        return float
    return lambda value: value
