"""Whether the database can be read, follows its references, and refuses to change what was written."""

from __future__ import annotations

from collections.abc import Iterator

from sqlalchemy import Connection, select
from sqlalchemy.exc import DBAPIError

from elastogeo.changes import DANGLING, DATABASE_SOUND, REFERENCES_WHOLE, ROWS_PROTECTED, UNPROTECTED, UNREADABLE, StoreFault
from elastogeo.history.store.frozen import frozen
from elastogeo.history.store.schema import FROZEN, metadata
from elastogeo.history.upkeep.raw_copies import Step
from elastogeo.history.upkeep.rows import digest_of, lines_of

_INVALID = """
SELECT 'index ' || c.relname FROM pg_index i JOIN pg_class c ON c.oid = i.indexrelid WHERE NOT i.indisvalid
UNION ALL SELECT 'rule ' || conname FROM pg_constraint WHERE NOT convalidated
"""
_NAMED = 100


def unreadable(connection: Connection, rows: dict[str, int], step: Step) -> Iterator[StoreFault]:
    """What the database says of itself, and tables whose rows cannot be read; fills `rows`, by table."""
    step("the database")
    try:
        if connection.dialect.name == "sqlite":
            said = connection.exec_driver_sql(f"PRAGMA integrity_check({_NAMED})").scalars().all()
            yield from (StoreFault(DATABASE_SOUND, "the file", UNREADABLE, line) for line in said if line != "ok")
        else:
            said = connection.exec_driver_sql(_INVALID).scalars().all()
            yield from (StoreFault(DATABASE_SOUND, name, UNREADABLE, "not valid") for name in said)
        for table in metadata.sorted_tables:
            step(f"rows of {table.name}")
            rows[table.name] = digest_of(lines_of(connection, table))["rows"]
    except DBAPIError as error:
        yield StoreFault(DATABASE_SOUND, "the database", UNREADABLE, " ".join(str(error.orig).split()))


def unprotected(connection: Connection) -> Iterator[StoreFault]:
    """Tables whose rows the database would let anybody change."""
    for table in sorted(set(FROZEN) - frozen(connection)):
        yield StoreFault(ROWS_PROTECTED, f"table {table}", UNPROTECTED)


def dangling(connection: Connection, step: Step) -> Iterator[StoreFault]:
    """Rows that name another row which is not there."""
    for table in metadata.sorted_tables:
        step(f"references of {table.name}")
        (key,) = table.primary_key.columns
        for column in table.columns:
            for reference in column.foreign_keys:
                named = reference.column.table.alias()
                wanted = named.c[reference.column.name]
                asked = (
                    select(key, column)
                    .select_from(table.outerjoin(named, wanted == column))
                    .where(column.is_not(None), wanted.is_(None))
                )
                for row in connection.execute(asked):
                    detail = f"{column.name} {row[1]}"
                    yield StoreFault(REFERENCES_WHOLE, f"{table.name} {row[0]}", DANGLING, detail)


def references() -> int:
    """How many columns name a row of a table."""
    return sum(len(column.foreign_keys) for table in metadata.sorted_tables for column in table.columns)
