"""Every released schema becomes that of this version, on all databases, whole or not at all."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection, Engine, create_engine, event, inspect, text
from sqlalchemy.exc import IntegrityError

from elastogeo.errors import StoreError
from elastogeo.history.store import Store, audit, migrations, open_store, read, write
from elastogeo.history.store.frozen import frozen
from elastogeo.history.store.migrations import REVISIONS, VERSION_TABLE, revision
from elastogeo.history.store.schema import FROZEN, metadata, test
from tests.history.store.filled import contents, fill, row_of
from tests.history.store.kept_schemas import dump_of, load

NEXT = """
import sqlalchemy as sa
from alembic import op

revision, down_revision = "0003", "0002"


def upgrade():
    op.create_table("hall", sa.Column("id", sa.Integer(), primary_key=True), sa.Column("name", sa.Text(), nullable=False))
    op.execute("INSERT INTO hall (id, name) SELECT id, place FROM machine")
    checked = sa.CheckConstraint("origin IN ('measured', 'simulated', 'reconstructed')", name=op.f("ck_test_origin"))
    with op.batch_alter_table("test", table_args=[checked]) as table:
        table.add_column(sa.Column("humidity", sa.Float()))
        table.alter_column("who", new_column_name="operator")
    op.execute("UPDATE test SET humidity = 45.5")
"""
"""An artificial step: a new table, a frozen one that gains a column, and rows of it that are changed."""


def database_of(kind: str) -> str:
    return "postgresql" if kind == "postgresql" else "sqlite"


@pytest.fixture
def next_schema(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """This version has one schema more."""
    folder = tmp_path / "versions"
    folder.mkdir()
    (folder / "s0003.py").write_text(NEXT, encoding="utf-8")
    monkeypatch.setattr(migrations, "FOLDERS", (*migrations.FOLDERS, folder))
    monkeypatch.setattr(migrations, "REVISIONS", ("0001", "0002", "0003"))


@pytest.fixture
def older(store: Store, request: pytest.FixtureRequest) -> Store:
    """A history with rows, whose schema is not that of this version any more."""
    with write(store) as connection:
        fill(connection)
    store.close()
    request.getfixturevalue("next_schema")
    return store


def described(connection: Connection, schema: str | None = None) -> dict[str, Any]:
    """All that a database has of each table, but its rows."""
    eye = inspect(connection)
    plain = {"schema": schema}

    def sorted_by_name(found: Any) -> list[Any]:
        dropped = {"referred_schema", "dialect_options", "comment", "options"}
        rows = [{key: str(value) for key, value in one.items() if key not in dropped} for one in found]
        return sorted(rows, key=lambda row: row["name"])

    return {
        table: (
            sorted_by_name(eye.get_columns(table, **plain)),
            eye.get_pk_constraint(table, **plain)["constrained_columns"],
            sorted_by_name(eye.get_foreign_keys(table, **plain)),
            sorted_by_name(eye.get_unique_constraints(table, **plain)),
            sorted_by_name(eye.get_indexes(table, **plain)),
            sorted_by_name(eye.get_check_constraints(table, **plain)),
        )
        for table in eye.get_table_names(schema=schema)
        if table != VERSION_TABLE
    }


def as_the_schema_says(store: Store, kind: str) -> dict[str, Any]:
    """What a database is that `schema.py` makes by itself."""
    if kind != "postgresql":
        engine = create_engine("sqlite://")
        with engine.connect() as connection:
            metadata.create_all(connection)
            made = described(connection)
        engine.dispose()
        return made
    with write(store) as connection:
        connection.execute(text("CREATE SCHEMA other"))
        apart = connection.execution_options(schema_translate_map={None: "other"})
        metadata.create_all(apart)
        made = described(connection, "other")
        connection.execute(text("DROP SCHEMA other CASCADE"))
    return {table: eval(repr(parts).replace("other.", "")) for table, parts in made.items()}


def test_migrations_make_what_the_schema_says(store: Store, kind: str) -> None:
    with read(store) as connection:
        context = MigrationContext.configure(connection, opts={"version_table": VERSION_TABLE})
        assert compare_metadata(context, metadata) == []
        made = described(connection)
        assert frozen(connection) == set(FROZEN)
    wanted = as_the_schema_says(store, kind)
    assert set(made) == set(metadata.tables)
    for table in wanted:
        assert made[table] == wanted[table]


def test_the_list_of_schemas_is_that_of_the_steps() -> None:
    steps = ScriptDirectory(str(Path(migrations.__file__).parent)).walk_revisions()
    assert tuple(step.revision for step in reversed(list(steps))) == REVISIONS


@pytest.mark.parametrize("released", REVISIONS)
def test_every_released_schema_becomes_that_of_this_version(released: str, kind: str, place: str) -> None:
    load(dump_of(released, database_of(kind)), place)
    with open_store(place, create=True, who="A. Miller") as store:
        with read(store) as connection:
            assert revision(connection) == REVISIONS[-1]
            assert audit.verify(connection) == ()
            assert frozen(connection) == set(FROZEN)
            context = MigrationContext.configure(connection, opts={"version_table": VERSION_TABLE})
            assert compare_metadata(context, metadata) == []
        kept = contents(store)
    assert kept["machine"][0][:2] == (1, "machine.name")
    assert [row[:4] for row in kept["test_file"]] == [(1, 1, "test_file.path", "a" * 64)]
    assert [row[3:5] for row in kept["audit"][:2]] == [("migrate", "schema"), ("set aside", "test 1")]


@pytest.mark.usefixtures("next_schema")
def test_an_older_schema_is_refused_until_it_is_migrated(url: str) -> None:
    with pytest.raises(
        StoreError, match=r"an older elastogeo \(schema 0002, this one needs 0003\); back it up, then migrate"
    ):
        open_store(url)
    with open_store(url, create=True, who="A. Miller") as store, read(store) as connection:
        row = connection.execute(text("SELECT who, what, old, new FROM audit ORDER BY number DESC")).first()
    assert row is not None
    assert tuple(row) == ("A. Miller", "migrate", '"0002"', '"0003"')
    open_store(url).close()


def test_a_newer_schema_is_refused(store: Store, url: str) -> None:
    with write(store) as connection:
        connection.execute(text(f"UPDATE {VERSION_TABLE} SET version_num = '0999'"))
    for create in (False, True):
        with pytest.raises(
            StoreError, match=r"a newer elastogeo \(schema 0999; .* knows 0002 and older\); install that version"
        ):
            open_store(url, create=create)


def test_a_database_of_something_else_is_left_alone(place: str) -> None:
    driver = "postgresql+psycopg" + place.removeprefix("postgresql") if "://" in place else f"sqlite:///{place}"
    engine = create_engine(driver)
    with engine.begin() as connection:
        connection.execute(text("CREATE TABLE invoice (id INTEGER)"))
    with pytest.raises(StoreError, match="holds no history; make one with: elastogeo history init"):
        open_store(place)
    with pytest.raises(StoreError, match=r"holds something else \(the table invoice\); give the history a place of its own"):
        open_store(place, create=True)
    with engine.connect() as connection:
        assert inspect(connection).get_table_names() == ["invoice"]
    engine.dispose()


def test_making_a_history_that_is_there_changes_nothing(store: Store, url: str) -> None:
    with write(store) as connection:
        fill(connection)
    before = contents(store)
    open_store(url, create=True).close()
    assert contents(store) == before


def check_next(store: Store) -> None:
    """The artificial step was made, and nothing else."""
    with read(store) as connection:
        assert revision(connection) == "0003"
        assert audit.verify(connection) == ()
        assert frozen(connection) == set(FROZEN)
        assert connection.execute(text("SELECT name FROM hall")).scalars().all() == ["machine.place"]
        assert connection.execute(text("SELECT humidity, operator FROM test")).all() == [(45.5, "test.who")]
        checks = {one["name"] for one in inspect(connection).get_check_constraints("test")}
        assert "ck_test_origin" in checks
        assert {one["name"] for one in inspect(connection).get_indexes("test")} >= {"ix_test_series_at"}
    refused(store, "rows of test are never changed", "UPDATE test SET humidity = 1")
    refused(store, "(?i)foreign key", "INSERT INTO test_file (id, test, path, sha256) VALUES (9, 99, 'x', 'none')")


def refused(store: Store, said: str, statement: str) -> None:
    with pytest.raises(IntegrityError, match=said), write(store) as connection:
        connection.execute(text(statement))


def test_a_step_changes_frozen_rows_and_freezes_them_again(older: Store, url: str) -> None:
    before = contents(older)
    older.close()
    with open_store(url, create=True) as migrated:
        check_next(migrated)
        with write(migrated) as connection:
            connection.execute(text("INSERT INTO machine (id, name, made_at) VALUES (9, 'after', 0)"))
        with read(migrated) as connection:
            kept = connection.execute(text("SELECT sha256, name FROM test")).all()
    assert kept == [(row_of(test)["sha256"], row_of(test)["name"])]
    assert before["test"][0][2] == row_of(test)["sha256"]


def test_a_step_that_fails_leaves_the_history_as_it_was(older: Store, url: str, tmp_path: Path) -> None:
    before = contents(older)
    older.close()
    step = tmp_path / "versions" / "s0003.py"
    step.write_text(NEXT + "    raise ZeroDivisionError\n", encoding="utf-8")
    with pytest.raises(ZeroDivisionError):
        open_store(url, create=True)
    with read(older) as connection:
        assert revision(connection) == "0002"
        assert frozen(connection) == set(FROZEN)
    assert contents(older) == before


def statements_of(action: Callable[[], None], kill_at: int = 0) -> int:
    """How many statements something executes; at that of number `kill_at` this process is killed."""
    done = 0

    def executed(*_: object) -> None:
        nonlocal done
        done += 1
        if done == kill_at:
            os.kill(os.getpid(), signal.SIGKILL)

    event.listen(Engine, "after_cursor_execute", executed)
    try:
        action()
    finally:
        event.remove(Engine, "after_cursor_execute", executed)
    return done


def killed(action: Callable[[], None], kill_at: int) -> bool:
    """Whether a child process that does something is killed at its statement of that number."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of threads, of which the child uses none
        child = os.fork()
    if child == 0:
        try:
            statements_of(action, kill_at)
        finally:
            os._exit(0)
    return os.WIFSIGNALED(os.waitpid(child, 0)[1])


cannot_kill = pytest.mark.skipif(
    sys.platform == "win32", reason="kills in the middle of a migration, which Windows cannot fork for"
)


@cannot_kill
def test_a_migration_that_is_killed_leaves_the_history_as_it_was(older: Store, url: str) -> None:
    assert kills_between_statements(older, url, 27) >= 3


@cannot_kill
@pytest.mark.nightly
def test_a_migration_that_is_killed_at_any_statement_leaves_the_history_as_it_was(older: Store, url: str) -> None:
    assert kills_between_statements(older, url, 1) >= 60


def kills_between_statements(older: Store, url: str, step: int) -> int:
    """How often a migration was killed, each time some statements later, until it came to its end."""
    before = contents(older)
    older.close()

    def migrate() -> None:
        open_store(url, create=True, who="A. Miller").close()

    kills = 0
    while killed(migrate, 1 + kills * step):
        kills += 1
        with read(older) as connection:
            assert revision(connection) == "0002"
            assert frozen(connection) == set(FROZEN)
        assert contents(older) == before
        older.close()
    with open_store(url) as migrated:
        check_next(migrated)
    return kills
