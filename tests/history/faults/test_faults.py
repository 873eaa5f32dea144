"""No room, or a disk that fails, at each write in turn: one clear error, nothing half, and the next attempt succeeds."""

from __future__ import annotations

import builtins
import errno
import io
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import event, func, select

from elastogeo.errors import StoreError
from elastogeo.history.analyses import analyse
from elastogeo.history.intake.imports import import_test
from elastogeo.history.intake.machines import add_machine
from elastogeo.history.store import Store, read
from elastogeo.history.store.schema import analysis, audit, test
from elastogeo.history.upkeep import back_up, export, verify
from tests.history.intake.small_tests import write_test

SAID = {
    ("sqlite", errno.ENOSPC): "database or disk is full",
    ("sqlite", errno.EIO): "disk I/O error",
    ("postgresql", errno.ENOSPC): "could not extend file: No space left on device",
    ("postgresql", errno.EIO): "could not write block 3: Input/output error",
}


class Disk:
    """Counts what is written, and fails at the write of a number."""

    def __init__(self, fails_at: int, code: int) -> None:
        self.fails_at, self.code, self.writes = fails_at, code, 0

    def fails(self) -> bool:
        self.writes += 1
        return self.writes == self.fails_at

    def tick(self) -> None:
        if self.fails():
            raise OSError(self.code, os.strerror(self.code))


class Failing(io.BufferedWriter):
    """A file whose writes are counted."""

    disk: Disk

    def write(self, block: Any) -> int:
        self.disk.tick()
        return super().write(block)


@contextmanager
def failing(disk: Disk, store: Store, patch: pytest.MonkeyPatch) -> Iterator[None]:
    """Every write of this process to files and to the database goes past the disk."""
    real_open = builtins.open
    dialect = store.engine.dialect
    library: Any = dialect.loaded_dbapi

    def refuse() -> None:
        if disk.fails():
            raise library.OperationalError(SAID[dialect.name, disk.code])

    def opened(path: Any, mode: str = "r", *given: Any, **named: Any) -> Any:
        if mode != "xb":
            return real_open(path, mode, *given, **named)
        disk.tick()
        file = Failing(io.FileIO(path, "xb"))
        file.disk = disk
        return file

    def counted(real: Callable[..., Any]) -> Callable[..., Any]:
        def call(*given: Any, **named: Any) -> Any:
            disk.tick()
            return real(*given, **named)

        return call

    def before(cursor: Any, statement: str, parameters: Any, context: Any) -> None:  # noqa: ARG001
        if not statement.lstrip().upper().startswith(("SELECT", "PRAGMA")):
            refuse()

    def before_many(cursor: Any, statement: str, parameters: Any, context: Any) -> None:
        before(cursor, statement, parameters, context)

    real_commit = dialect.do_commit

    def commit(connection: Any) -> None:
        refuse()
        real_commit(connection)

    with patch.context() as inner:
        inner.setattr(builtins, "open", opened)
        for name in ("fsync", "replace", "rename", "mkdir"):
            inner.setattr(os, name, counted(getattr(os, name)))
        inner.setattr(dialect, "do_commit", commit)
        event.listen(store.engine, "do_execute", before)
        event.listen(store.engine, "do_executemany", before_many)
        try:
            yield
        finally:
            event.remove(store.engine, "do_execute", before)
            event.remove(store.engine, "do_executemany", before_many)


def counts(store: Store) -> tuple[int, ...]:
    with read(store) as connection:
        return tuple(connection.execute(select(func.count()).select_from(of)).scalar_one() for of in (test, analysis, audit))


def wrong(store: Store) -> list[str]:
    return [one.name for one in verify(store).verdict if one.decisive and not one.passed]


@pytest.fixture
def mill(store: Store, tmp_path: Path) -> Store:
    """A history with a machine and a test that is analysed: what is used first is imported then."""
    add_machine(store, "Mill 3", who="the tests")
    analyse(store, import_test(store, write_test(tmp_path / "first", seed=9), machine="Mill 3", who="the tests").test)
    return store


def each_write_fails(
    store: Store, patch: pytest.MonkeyPatch, code: int, action: Callable[[int], Any], writes_store: bool = True
) -> int:
    """Let each write of an action fail in turn, until it succeeds: how many there are."""
    before = counts(store)
    for number in range(1, 200):
        disk = Disk(number, code)
        error: StoreError | None = None
        with failing(disk, store, patch):
            try:
                action(number)
            except StoreError as caught:
                error = caught
        if disk.writes < number:
            assert error is None
            assert wrong(store) == []
            return number - 1
        if error is not None:
            assert "\n" not in str(error)
            assert any(words in str(error) for words in (os.strerror(code), "there is no room on the", "disk failed"))
            assert counts(store) == before
            assert not writes_store or wrong(store) == []
        before = counts(store)  # a write that it does without may have failed
    raise AssertionError("it never succeeded")


CODES = pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO], ids=["no room", "I/O error"])


@CODES
def test_import_at_each_write(mill: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int) -> None:
    """Another test each time, since raw files that an attempt kept are not written again; then all of them come in."""
    folders = [write_test(tmp_path / f"{k}", seed=100 + k) for k in range(60)]

    def attempt(number: int) -> int:
        return import_test(mill, folders[number], machine="Mill 3", who="the tests").test

    writes = each_write_fails(mill, monkeypatch, code, attempt)
    assert 15 <= writes < 60
    for number in range(1, writes + 1):
        attempt(number)
    assert counts(mill)[0] == writes + 2
    assert [one.passed for one in verify(mill).verdict] == [True] * 8


@CODES
def test_analysis_at_each_write(mill: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int) -> None:
    key = import_test(mill, write_test(tmp_path / "test", seed=1), machine="Mill 3", who="the tests").test
    assert each_write_fails(mill, monkeypatch, code, lambda _: analyse(mill, key)) >= 4
    assert counts(mill)[1] == 2


@CODES
@pytest.mark.parametrize("kind", ["truncate"])
@pytest.mark.parametrize("copy", [back_up, export])
def test_copies_at_each_write(
    mill: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int, copy: Callable[[Store, Path], Any]
) -> None:
    target = tmp_path / "copy"

    def made(_: int) -> None:
        shutil.rmtree(target, ignore_errors=True)  # made although a write failed that it does without
        assert [path.name for path in tmp_path.iterdir() if path.name.startswith("copy")] == []
        copy(mill, target)

    assert each_write_fails(mill, monkeypatch, code, made, writes_store=False) >= 15
    assert target.is_dir()
