"""Rows that are written once: the database itself refuses to change or delete them.

Only a migration thaws them, and freezes them again in the same transaction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sqlalchemy import Connection, inspect

from elastogeo.history.store.schema import FROZEN

_FUNCTION = "refuse_change"


def freeze(connection: Connection) -> None:
    """Let the database refuse changes of the frozen tables that it has."""
    present = set(inspect(connection).get_table_names())
    _run(connection, _freezing(connection, [table for table in FROZEN if table in present]))


def thaw(connection: Connection) -> None:
    """Let a migration change what is frozen; `freeze` follows in the same transaction."""
    present = set(inspect(connection).get_table_names())
    _run(connection, _thawing(connection, [table for table in FROZEN if table in present]))


def _run(connection: Connection, statements: Iterable[str]) -> None:
    for statement in statements:
        connection.exec_driver_sql(statement)


def _freezing(connection: Connection, tables: list[str]) -> Iterator[str]:
    yield from _thawing(connection, tables)
    if connection.dialect.name == "sqlite":
        for table in tables:
            for act in ("UPDATE", "DELETE"):
                yield (
                    f'CREATE TRIGGER "{table}_{act.lower()}" BEFORE {act} ON "{table}" '
                    f"BEGIN SELECT RAISE(ABORT, 'rows of {table} are never changed or deleted'); END"
                )
        return
    yield (
        f"CREATE OR REPLACE FUNCTION {_FUNCTION}() RETURNS trigger LANGUAGE plpgsql AS "
        "$$ BEGIN RAISE EXCEPTION 'rows of %% are never changed or deleted', TG_TABLE_NAME; END $$"
    )
    for table in tables:
        yield (
            f'CREATE TRIGGER "{table}_change" BEFORE UPDATE OR DELETE ON "{table}" '
            f"FOR EACH ROW EXECUTE FUNCTION {_FUNCTION}()"
        )
        yield (
            f'CREATE TRIGGER "{table}_empty" BEFORE TRUNCATE ON "{table}" FOR EACH STATEMENT EXECUTE FUNCTION {_FUNCTION}()'
        )


def _thawing(connection: Connection, tables: list[str]) -> Iterator[str]:
    for table in tables:
        if connection.dialect.name == "sqlite":
            yield from (f'DROP TRIGGER IF EXISTS "{table}_{act}"' for act in ("update", "delete"))
        else:
            yield from (f'DROP TRIGGER IF EXISTS "{table}_{act}" ON "{table}"' for act in ("change", "empty"))
