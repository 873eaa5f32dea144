"""Histories with rows of every table to copy, and what two histories hold."""

from __future__ import annotations

import hashlib
import json
from typing import Any

from sqlalchemy import Connection, insert

from elastogeo.history.store import Store, audit, read, write
from elastogeo.history.store.schema import metadata
from elastogeo.history.upkeep.rows import lines_of
from tests.history.store.filled import AT, row_of

RAW = (b"angle_deg,radial_um\n0,1.25\n", bytes(range(256)), b"")


def fill_all(store: Store) -> None:
    """A row in each table and three raw files; a document has the hash that an analysis gives it."""
    hashes = store.files.put_all(RAW)
    with write(store) as connection:
        for sha256, content in zip(hashes, RAW, strict=True):
            connection.execute(insert(metadata.tables["blob"]).values(sha256=sha256, size=len(content), made_at=AT))
        for table in metadata.sorted_tables:
            if not table.name.startswith("audit") and table.name != "blob":
                connection.execute(insert(table).values(**_row(table, hashes[0])))
        audit.record(connection, "A. Miller", "set aside", "test 1", old=False, new=True, why="ball not seated, 3 µm")


def _row(table: Any, raw: str) -> dict[str, object]:
    row = row_of(table)
    for column in table.columns:
        if column.name in ("repeats", "held_by") or (column.name == "error" and column.nullable):
            row[column.name] = None
    row.pop("id", None)  # the database gives it
    if table.name == "test_file":
        row["sha256"] = raw
    if table.name == "test":
        row["sha256"] = hashlib.sha256(f"{raw}  test_file.path\n".encode()).hexdigest()
    if table.name == "analysis":
        row["document_sha256"] = hashlib.sha256('{"x":[1.5,null,"µ"]}'.encode()).hexdigest()
    return row


def rows(store: Store) -> dict[str, list[bytes]]:
    """Every row of every table, as lines."""
    with read(store) as connection:
        return {table.name: list(lines_of(connection, table)) for table in metadata.sorted_tables}


def backed_up(store: Store) -> dict[str, list[bytes]]:
    """Every row of every table, as lines, without sessions."""
    return rows(store) | {"session": []}


def exported(store: Store) -> dict[str, list[bytes]]:
    """Every row of every table, as lines, without what lets anybody in."""
    accounts = [json.dumps({**json.loads(line), "password": None}, separators=(",", ":")) for line in rows(store)["account"]]
    return backed_up(store) | {"token": [], "account": [f"{line}\n".encode() for line in accounts]}


def raw(store: Store) -> dict[str, bytes]:
    """Every raw file, by its hash."""
    return {sha256: store.files.read(sha256) for sha256 in store.files.all()}


def is_whole(connection: Connection) -> bool:
    return audit.verify(connection) == ()
