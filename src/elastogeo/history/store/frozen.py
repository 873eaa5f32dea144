"""Rows that are written once: the database itself refuses to change or delete them.

Only a migration thaws them, and freezes them again in the same transaction. A copy of the whole database keeps the
triggers; whoever fills an empty one row by row only adds, and is not in their way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sqlalchemy import Connection, inspect

from elastogeo.history.store.schema import FROZEN

_PREFIX = "frozen_"
_FUNCTION = "refuse_change"
_MADE = {
    "sqlite": f"SELECT name, tbl_name FROM sqlite_master WHERE type = 'trigger' AND name LIKE '{_PREFIX}%'",
    "postgresql": "SELECT t.tgname, c.relname FROM pg_trigger t JOIN pg_class c ON c.oid = t.tgrelid "
    f"JOIN pg_proc f ON f.oid = t.tgfoid WHERE f.proname = '{_FUNCTION}'",
}


def freeze(connection: Connection) -> None:
    """Let the database refuse changes of the frozen tables."""
    present = set(inspect(connection).get_table_names())
    tables = [table for table in FROZEN if table in present]
    _run(connection, _for_sqlite(tables) if connection.dialect.name == "sqlite" else _for_postgresql(tables))


def thaw(connection: Connection) -> None:
    """Let a migration change what is frozen; `freeze` follows in the same transaction."""
    _run(connection, _thawing(connection))


def frozen(connection: Connection) -> set[str]:
    """The tables whose rows the database refuses to change."""
    return {table for _, table in connection.exec_driver_sql(_MADE[connection.dialect.name])}


def _run(connection: Connection, statements: Iterable[str]) -> None:
    for statement in statements:
        connection.exec_driver_sql(statement)


def _for_sqlite(tables: list[str]) -> Iterator[str]:
    for table in tables:
        for act in ("UPDATE", "DELETE"):
            yield (
                f'CREATE TRIGGER "{_PREFIX}{act.lower()}_{table}" BEFORE {act} ON "{table}" '
                f"BEGIN SELECT RAISE(ABORT, 'rows of {table} are never changed or deleted'); END"
            )


def _for_postgresql(tables: list[str]) -> Iterator[str]:
    yield (
        f"CREATE OR REPLACE FUNCTION {_FUNCTION}() RETURNS trigger LANGUAGE plpgsql AS "
        "$$ BEGIN RAISE EXCEPTION 'rows of %% are never changed or deleted', TG_TABLE_NAME "
        "USING ERRCODE = 'integrity_constraint_violation'; END $$"
    )
    for table in tables:
        for name, act, each in (("change", "UPDATE OR DELETE", "ROW"), ("truncate", "TRUNCATE", "STATEMENT")):
            yield (
                f'CREATE TRIGGER "{_PREFIX}{name}_{table}" BEFORE {act} ON "{table}" '
                f"FOR EACH {each} EXECUTE FUNCTION {_FUNCTION}()"
            )


def _thawing(connection: Connection) -> Iterator[str]:
    made = connection.exec_driver_sql(_MADE[connection.dialect.name]).all()
    for name, table in made:
        yield f'DROP TRIGGER "{name}"' + ("" if connection.dialect.name == "sqlite" else f' ON "{table}"')
