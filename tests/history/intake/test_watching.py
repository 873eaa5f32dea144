"""A folder is watched: what is whole comes in once, what is half written waits, what is bad is told once and not touched."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from sqlalchemy import func, select

from elastogeo.errors import InputError, StoreError
from elastogeo.history import History
from elastogeo.history.intake.folders import in_order, paths_of_tests, written
from elastogeo.history.intake.imports import import_test
from elastogeo.history.intake.machines import add_machine
from elastogeo.history.intake.notebook import Notebook
from elastogeo.history.intake.watching import Watch
from elastogeo.history.store import open_store, read
from elastogeo.history.store.schema import test
from tests.history.intake.small_tests import write_test

WHO = "A. Nobody"


class Time:
    """A clock that goes on only when somebody sleeps; what happens meanwhile is a list of functions, one a sleep."""

    def __init__(self) -> None:
        self.now = 0.0
        self.events: list = []

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds
        if not self.events:
            raise KeyboardInterrupt
        self.events.pop(0)()


@pytest.fixture
def clock():
    return Time()


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "bar").mkdir()
    return tmp_path / "bar"


@pytest.fixture
def watcher(store, standing_clock, clock, folder, tmp_path):  # noqa: ARG001
    """`watcher(...)`: a watch over the folder, as one that was started anew."""
    add_machine(store, "Mill 3", who=WHO, serial="4711")

    def started(machine="Mill 3", bring=None, settle=5.0, machines=lambda: ""):
        def bringing(path):
            return import_test(store, path, machine=machine, who=WHO)

        notebook = Notebook(tmp_path / "notes" / "n.jsonl")
        return Watch(folder, bring or bringing, notebook, machines, settle, 10.0, clock.sleep, clock)

    return started


def seen(watch, clock, *events):
    """What a watch says while these things happen, one a sleep, until Ctrl-C."""
    clock.events = list(events)
    told = []
    try:
        for one in watch.run():
            told.append((one.what, one.path.name, one.said))
    except KeyboardInterrupt:
        pass
    return told


def nothing() -> None:
    pass


def count(store) -> int:
    with read(store) as connection:
        return connection.execute(select(func.count()).select_from(test)).scalar()


def state_of(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_what_is_there_and_what_comes_is_imported_once(store, watcher, clock, folder):
    write_test(folder / "one")
    told = seen(watcher(), clock, nothing, lambda: write_test(folder / "late" / "two", seed=1), nothing, nothing, nothing)
    assert [(what, name) for what, name, _ in told] == [("new", "one"), ("new", "two")]
    assert count(store) == 2
    assert seen(watcher(), clock, nothing, nothing) == []  # started again: it knows


def test_without_its_notes_it_finds_them_known(store, watcher, clock, folder, tmp_path):
    write_test(folder / "one")
    seen(watcher(), clock, nothing)
    shutil.rmtree(tmp_path / "notes")
    assert [what for what, _, _ in seen(watcher(), clock, nothing)] == ["known"]
    assert count(store) == 1


def test_half_a_test_waits_until_it_is_whole(store, watcher, clock, folder, tmp_path):
    """As a copy over a network comes: the test file first, then half a run, then the other half, then the second run."""
    whole = write_test(tmp_path / "whole")
    run = (whole / "runs" / "36N.csv").read_bytes()
    half = folder / "one" / "runs"

    def second():
        shutil.copy(whole / "runs" / "742N.csv", half / "742N.csv")

    half.mkdir(parents=True)
    shutil.copy(whole / "test.toml", folder / "one")
    told = seen(
        watcher(), clock, nothing, lambda: (half / "36N.csv").write_bytes(run[:100]), nothing, nothing,
        lambda: (half / "36N.csv").write_bytes(run), second, nothing, nothing,
    )  # fmt: skip
    assert told == [
        ("waits", "one", "for runs/36N.csv, runs/742N.csv"),
        ("waits", "one", "for runs/742N.csv"),
        ("new", "one", ""),
    ]
    assert count(store) == 1


def test_a_file_that_grows_is_left_alone(watcher, clock, folder):
    path = write_test(folder / "one") / "runs" / "742N.csv"
    data = path.read_bytes()
    grows = [lambda k=k: path.write_bytes(data[: 40 * k]) for k in range(1, 6)]
    told = seen(watcher(settle=15.0), clock, *grows, lambda: path.write_bytes(data), nothing, nothing)
    assert [what for what, _, _ in told] == ["new"]


def test_a_bad_test_is_told_once_and_again_when_it_changes(store, watcher, clock, folder):
    path = write_test(folder / "one") / "runs" / "742N.csv"
    good = path.read_bytes()
    path.write_bytes(b"angle_deg,radial_um\n0,one\n")
    before = state_of(folder)
    told = seen(watcher(), clock, nothing, nothing, nothing)
    assert [what for what, _, _ in told] == ["refused"]
    assert "742N.csv" in told[0][2]
    assert state_of(folder) == before
    assert seen(watcher(), clock, nothing, nothing) == []
    assert [what for what, _, _ in seen(watcher(), clock, lambda: path.write_bytes(good), nothing, nothing)] == ["new"]
    assert count(store) == 1


def test_a_test_of_a_machine_that_is_not_known_is_held_until_it_is(store, watcher, clock, folder):
    write_test(folder / "one", machine_serial="99")
    machines = []
    watch = watcher(machine=None, machines=lambda: repr(machines))
    assert [what for what, _, _ in seen(watch, clock, nothing, nothing, nothing)] == ["held"]

    def added():
        add_machine(store, "Mill 4", who=WHO, serial="99")
        machines.append("Mill 4")

    assert [what for what, _, _ in seen(watch, clock, added, nothing)] == ["new"]


def test_a_history_that_fails_is_told_and_tried_again(watcher, clock, folder, store):
    write_test(folder / "one")
    answers = iter([StoreError("disk full"), StoreError("disk full"), None])

    def bring(path):
        error = next(answers)
        if error:
            raise error
        return import_test(store, path, machine="Mill 3", who=WHO)

    told = seen(watcher(bring=bring), clock, nothing, nothing, nothing)
    assert told == [("failed", "one", "disk full"), ("new", "one", "")]


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_date_or_a_name_that_no_computer_can_take_stops_nothing(watcher, clock, folder, tmp_path):
    write_test(folder / "a", date="0001-01-01T00:00:00+02:00")
    away = tmp_path / "away" / "742N.csv"
    named = write_test(folder / "b", seed=1) / "test.toml"
    named.write_text(named.read_text("utf-8").replace("runs/742N.csv", away.as_posix()), "utf-8")
    write_test(folder / "c", seed=2)
    told = seen(watcher(), clock, nothing, nothing)
    assert {(name, what) for what, name, _ in told} == {("a", "refused"), ("b", "waits"), ("c", "new")}
    said = {name: words for _, name, words in told}
    assert "is '0001-01-01T00:00:00+02:00'; write it as 2026-03-01" in said["a"]
    assert said["b"] == f"for {away.as_posix()}"


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_database_that_fails_for_a_while_is_told_once_and_asked_again(watcher, clock, folder):
    write_test(folder / "one")
    answers = iter([StoreError("no answer"), StoreError("no answer"), None, None, None])

    def machines():
        error = next(answers)
        if error:
            raise error
        return ""

    told = seen(watcher(machines=machines), clock, nothing, nothing, nothing)
    assert told == [("failed", "bar", "no answer"), ("new", "one", "")]


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_test_that_was_held_or_refused_comes_in_as_it_was_told_to(store, url, tmp_path):
    write_test(tmp_path / "in" / "one")
    write_test(tmp_path / "in" / "two", date="", seed=1, machine_serial="4711")
    with History(url, who=WHO) as history:
        add_machine(store, "Mill 3", who=WHO, serial="4711")

        def told(**more):
            return [
                (one.what, one.path.name, one.said) for one in history.watch(tmp_path / "in", once=True, settle=0, **more)
            ]

        first = told()
        assert [(what, name) for what, name, _ in first] == [("held", "one"), ("refused", "two")]
        assert "--machine NAME" in first[0][2]
        assert "--dates-of-files" in first[1][2]
        assert "--date " not in f"{first[1][2]} "
        assert told() == []
        assert [line[:2] for line in told(machine="Mill 3")] == [("new", "one"), ("refused", "two")]
        assert [line[:2] for line in told(machine="Mill 3", dates_of_files=True)] == [("new", "two")]
        assert told() == []


@pytest.mark.parametrize("kind", ["truncate"])
def test_what_came_into_another_history_comes_into_this_one(url, tmp_path):
    write_test(tmp_path / "in" / "one", machine_serial="4711")
    for _ in range(2):
        with open_store(url, create=True, who=WHO) as store:
            add_machine(store, "Mill 3", who=WHO, serial="4711")
        with History(url, who=WHO) as history:
            assert [one.what for one in history.watch(tmp_path / "in", once=True, settle=0)] == ["new"]
        Path(url).unlink()


def test_a_fault_of_the_program_does_not_stop_it(watcher, clock, folder, store):
    write_test(folder / "a")
    write_test(folder / "b", seed=1)

    def bring(path):
        if path.name == "a":
            raise ZeroDivisionError("of nothing")
        return import_test(store, path, machine="Mill 3", who=WHO)

    told = seen(watcher(bring=bring), clock, nothing)
    assert told == [
        ("refused", "a", "ZeroDivisionError: of nothing; a fault of elastogeo, please report it"),
        ("new", "b", ""),
    ]


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_folder_that_goes_away_is_waited_for(watcher, clock, folder, tmp_path):
    write_test(folder / "one")
    told = seen(
        watcher(), clock, lambda: folder.rename(tmp_path / "away"), nothing,
        lambda: (tmp_path / "away").rename(folder), nothing,
    )  # fmt: skip
    assert told == [("failed", "bar", "the folder is away; it is looked for again"), ("new", "one", "")]


@pytest.mark.parametrize("kind", ["truncate"])
def test_runs_without_a_test_file_are_told_once(watcher, clock, folder):
    write_test(folder / "one")
    (folder / "one" / "test.toml").unlink()
    (folder / "reports").mkdir()
    (folder / "reports" / "r.pdf").write_bytes(b"%PDF")
    told = seen(watcher(), clock, nothing, nothing)
    assert told == [("waits", "runs", "for a test.toml beside its run files; elastogeo new makes one to fill in")]
    assert seen(watcher(), clock, nothing, nothing) == []


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_machine_file_beside_the_test_that_is_mended_is_seen(watcher, clock, folder):
    shipped = Path(__file__).resolve().parents[3] / "src/elastogeo/formats/machines/hermle_c50.toml"
    write_test(folder / "one", machine="../mill.toml")
    assert [what for what, _, _ in seen(watcher(), clock, nothing, nothing)] == ["refused"]
    told = seen(watcher(), clock, lambda: shutil.copy(shipped, folder / "mill.toml"), nothing, nothing)
    assert [what for what, _, _ in told] == ["new"]


@pytest.mark.parametrize("kind", ["truncate"])
def test_once_ends_when_all_that_is_whole_is_in(watcher, clock, folder):
    write_test(folder / "one")
    path = write_test(folder / "two", seed=1) / "runs" / "36N.csv"
    data = path.read_bytes()
    clock.events = [lambda: path.write_bytes(data[:50])]
    told = [(one.what, one.path.name, one.said) for one in watcher().run(once=True)]
    assert told == [("new", "one", ""), ("waits", "two", "is still being written")]
    assert clock.now == 5.0


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_crash_in_the_middle_of_a_note_loses_that_note_only(watcher, clock, folder, store, tmp_path):
    write_test(folder / "one")
    write_test(folder / "two", seed=1)
    seen(watcher(), clock, nothing)
    notes = tmp_path / "notes" / "n.jsonl"
    notes.write_bytes(notes.read_bytes()[:-20])
    assert [(what, name) for what, name, _ in seen(watcher(), clock, nothing)] == [("known", "two")]
    assert seen(watcher(), clock, nothing) == []
    assert count(store) == 2


@pytest.mark.parametrize("kind", ["truncate"])
def test_what_is_no_folder_or_no_time_is_refused(watcher, folder):
    with pytest.raises(InputError, match="give positive times"):
        watcher(settle=-1.0)
    shutil.rmtree(folder)
    with pytest.raises(InputError, match="is no folder to watch"):
        watcher()


def test_tests_of_a_folder_come_in_the_order_of_their_days(tmp_path):
    for k, day in enumerate(("2026-02-01", "2025-12-01T10:00:00+01:00", "2026-01-15")):
        write_test(tmp_path / f"t{k}", date=day)
    write_test(tmp_path / "t0" / "inner")
    write_test(tmp_path / ".hidden")
    write_test(tmp_path / "undated", date="")
    found = in_order(paths_of_tests(tmp_path))
    assert [path.name for path in found] == ["t1", "t2", "t0", "inner", "undated"]
    assert paths_of_tests(tmp_path / "t0") == (tmp_path / "t0",)


@pytest.mark.parametrize(("made", "message"), [(False, "is not there; check the path"), (True, "holds no test: no folder")])
def test_a_folder_without_tests_is_refused(made, message, tmp_path):
    if made:
        (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match=message):
        paths_of_tests(tmp_path / "empty")


def test_when_the_files_of_a_test_were_written(tmp_path):
    folder = write_test(tmp_path / "one", date="")
    for k, path in enumerate(sorted((folder / "runs").iterdir())):
        os.utime(path, (1_700_000_000 + k, 1_700_000_000 + k))
    assert written(folder) == "2023-11-14T22:13:21+00:00"


@pytest.mark.parametrize("kind", ["truncate"])
def test_the_command_imports_and_ends(store, url, tmp_path):
    add_machine(store, "Mill 3", who=WHO)
    write_test(tmp_path / "in" / "one", date="2025-03-01")
    write_test(tmp_path / "in" / "two", date="")
    command = [sys.executable, "-m", "elastogeo", "history", "watch", str(tmp_path / "in"), "--once", "--settle-s", "0"]
    done = subprocess.run([*command, "--store", url, "-m", "Mill 3"], capture_output=True, text=True)
    assert done.returncode == 2
    assert " new: Test 1: Monthly, Mill 3, 2025-03-01, loaded ball bar XY R150 36 to 742 N" in done.stdout
    assert " refused: two: " in done.stderr
    dated = subprocess.run(
        [*command, "--store", url, "-m", "Mill 3", "--again", "--dates-of-files"], capture_output=True, text=True
    )
    assert dated.returncode == 0
    assert [line.split()[2] for line in dated.stdout.splitlines() if "Test" in line] == ["known:", "new:"]
