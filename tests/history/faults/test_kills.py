"""Killed at random points, a history loses nothing that it acknowledged, keeps nothing half and nothing twice."""

from __future__ import annotations

import os
import random
import signal
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest
from sqlalchemy import func, select

from elastogeo.errors import StoreError
from elastogeo.history.analyses import analyse
from elastogeo.history.intake.imports import import_test
from elastogeo.history.intake.machines import add_machine
from elastogeo.history.store import Store, open_store, read
from elastogeo.history.store.schema import analysis, audit, test
from elastogeo.history.upkeep import back_up, export, restore, verify
from tests.history.intake.small_tests import write_test

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="kills at random points, for which Windows cannot fork")

Say = Callable[[str], object]
PAUSE = 0.15
"""After the last line that is waited for, until the child is killed, at most [s]."""


def child_killed(work: Callable[[Say], None], lines: int, pause: float) -> list[str]:
    """What a child process acknowledged until it was killed: so many lines at least, and a while after."""
    heard, said = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of threads, of which the child uses none
        child = os.fork()
    if child == 0:
        try:
            work(lambda line: os.write(said, f"{line}\n".encode()))
        finally:
            os._exit(0)
    os.close(said)
    with open(heard, encoding="utf-8") as output:
        first = [output.readline() for _ in range(lines)]
        time.sleep(pause)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        return [line.rstrip("\n") for line in (*first, *output) if line.endswith("\n")]


def worker(url: str, folder: Path, first: int) -> Callable[[Say], None]:
    """Imports, analyses and backs up in a loop, and says what is done."""

    def work(say: Say) -> None:
        with open_store(url) as store:
            for k in range(first, first + 1000):
                got = import_test(store, write_test(folder / f"{k}", seed=k), machine="Mill 3", who="a child")
                say(f"test {got.test}")
                say(f"analysis {analyse(store, got.test)}")
                if k % 2:
                    back_up(store, folder / f"backup-{k}")
                    say(f"backup {k}")

    return work


def check(store: Store, acknowledged: set[str], folder: Path, again: Path) -> None:
    """The history opens, is whole, and holds what was acknowledged, once."""
    checked = verify(store)
    assert [one.name for one in checked.verdict if one.decisive and not one.passed] == []
    with read(store) as connection:
        tests = set(connection.execute(select(test.c.id)).scalars())
        analyses = connection.execute(select(analysis.c.id, analysis.c.test)).all()
        told = dict(connection.execute(select(audit.c.what, func.count()).group_by(audit.c.what)).all())
    assert {f"test {key}" for key in tests} >= {one for one in acknowledged if one.startswith("test")}
    assert {f"analysis {key}" for key, _ in analyses} >= {one for one in acknowledged if one.startswith("analysis")}
    assert len({of for _, of in analyses}) == len(analyses)
    assert (told.get("import", 0), told.get("analyse", 0)) == (len(tests), len(analyses))
    backups = {path.name for path in folder.glob("backup-*") if ".unfinished-" not in path.name}
    assert backups >= {f"backup-{one.split()[1]}" for one in acknowledged if one.startswith("backup")}
    for name in sorted(backups)[-1:]:
        restore(folder / name, again / f"{len(list(again.iterdir()))}.db")


@pytest.fixture
def random_times() -> random.Random:
    return random.Random(11)


def killed_so_often(kills: int, url: str, tmp_path: Path, times: random.Random) -> set[str]:
    folder, again = tmp_path / "work", tmp_path / "again"
    folder.mkdir()
    again.mkdir()
    with open_store(url) as store:
        add_machine(store, "Mill 3", who="the tests")
        analyse(store, import_test(store, write_test(tmp_path / "first"), machine="Mill 3", who="the tests").test)
        back_up(store, folder / "backup-0")
    acknowledged: set[str] = set()
    for k in range(kills):
        done = child_killed(worker(url, folder, 1 + 1000 * k), times.randrange(5), times.uniform(0, PAUSE))
        assert len(set(done) & acknowledged) == 0
        acknowledged |= set(done)
        with open_store(url) as store:
            check(store, acknowledged, folder, again)
    return acknowledged


def test_kills_lose_and_double_nothing(url: str, tmp_path: Path, random_times: random.Random) -> None:
    """Ten on each of the three databases."""
    acknowledged = killed_so_often(10, url, tmp_path, random_times)
    assert {one.split()[0] for one in acknowledged} >= {"test", "analysis"}


@pytest.mark.nightly
def test_a_thousand_kills_lose_and_double_nothing(url: str, tmp_path: Path, random_times: random.Random) -> None:
    """334 on each of the three databases."""
    acknowledged = killed_so_often(334, url, tmp_path, random_times)
    assert {one.split()[0] for one in acknowledged} == {"test", "analysis", "backup"}


@pytest.fixture
def copy(url: str, tmp_path: Path) -> Path:
    with open_store(url) as store:
        add_machine(store, "Mill 3", who="the tests")
        for k in range(3):
            import_test(store, write_test(tmp_path / f"{k}", seed=k), machine="Mill 3", who="the tests")
        export(store, tmp_path / "copy")
    return tmp_path / "copy"


@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_a_restore_that_is_killed_leaves_no_history_and_goes_on(
    copy: Path, tmp_path: Path, random_times: random.Random
) -> None:
    place = tmp_path / "restored.db"
    for _ in range(4):
        child_killed(lambda say: say(restore(copy, place).place), 0, random_times.uniform(0, 0.1))
        if place.exists():
            break
        with pytest.raises(StoreError, match="there is no history here"):
            open_store(place)
    if not place.exists():
        restore(copy, place)
    with open_store(place) as store:
        assert [one.passed for one in verify(store).verdict] == [True] * 8
