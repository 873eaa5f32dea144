"""Jobs on all three databases: taken once, in their order, done again after a crash, given up after three tries."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from datetime import timedelta

import pytest

import elastogeo as eg
from elastogeo.errors import InputError
from elastogeo.history.jobs import Worker, put_job, rows, running
from elastogeo.history.store import open_store, read, write
from elastogeo.history.store.schema import job
from elastogeo.history.work import kind_named
from tests.history.jobs import toy_jobs  # noqa: F401 - its kinds register themselves

DEAD = f"{socket.gethostname()}/{2**22 + 1}/x"  # no process has a number as large as this


def done(store, once=True):
    return Worker(store).run(once)


def kept(store, key):
    with read(store) as connection:
        return rows.kept_job(connection, key)


def test_a_job_is_done_and_what_came_of_it_is_kept(store):
    key = put_job(store, "count", {"to": 3}, who="A. Nobody")
    assert kept(store, key).state == "waiting"
    assert done(store) == 1
    found = kept(store, key)
    assert (found.state, found.result, found.who, found.tries, found.errors) == ("done", {"counted": 3}, "A. Nobody", 1, ())
    assert found.started_at <= found.ended_at
    assert done(store) == 0


def test_jobs_are_taken_in_the_order_in_which_they_were_asked_for(store):
    keys = [put_job(store, "count", {"to": n}) for n in (5, 3, 4)]
    assert [kept(store, key).before for key in keys] == [0, 1, 2]
    taken = [rows.take_job(store, "one") for _ in range(4)]
    assert [one and one.key for one in taken] == [*keys, None]


def test_the_same_job_is_not_asked_for_twice_until_it_is_over(store):
    key = put_job(store, "count", {"to": 3})
    assert put_job(store, "count", {"to": 3}) == key
    rows.take_job(store, "one")
    assert put_job(store, "count", {"to": 3}) == key
    assert put_job(store, "count", {"to": 4}) != key
    rows.finish_job(store, key, "one", None)
    assert put_job(store, "count", {"to": 3}) != key


def test_many_takers_at_once_take_each_job_once(url, store):
    keys = [put_job(store, "count", {"to": n}) for n in range(12)]
    taken, lock = [], threading.Lock()

    def take(name):
        with open_store(url) as own:
            while (found := rows.take_job(own, name)) is not None:
                with lock:
                    taken.append(found.key)

    threads = [threading.Thread(target=take, args=(f"taker {n}",)) for n in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(taken) == keys


def test_what_a_kind_refuses_is_told_as_it_stands_and_the_worker_goes_on(store):
    refused, broken, last = (
        put_job(store, "refuse", {"what": "x"}),
        put_job(store, "break"),
        put_job(store, "count", {"to": 1}),
    )
    assert done(store) == 3
    assert kept(store, refused).errors == ("x: is no number; give one",)
    assert kept(store, broken).errors == ("ZeroDivisionError: by nothing; a fault of elastogeo, please report it",)
    assert [kept(store, key).state for key in (refused, broken, last)] == ["failed", "failed", "done"]


def test_a_history_that_cannot_be_written_is_tried_again_and_given_up(store, monkeypatch):
    monkeypatch.setattr(running, "_PAUSE", 0.0)
    key = put_job(store, "no room")
    assert done(store) == rows.TRIES
    assert kept(store, key).errors == ("given up after 3 tries that got no further: there is no room on the disk",)


def test_a_kind_that_is_not_there_is_refused(store):
    with pytest.raises(InputError, match=r"there is no job of the kind 'cook'; there are .*count"):
        put_job(store, "cook")
    with pytest.raises(InputError, match="there is no job 7; one that was over a month ago is forgotten"):
        kept(store, 7)


def test_a_job_whose_worker_was_killed_is_done_again(store):
    key = put_job(store, "count", {"to": 3})
    rows.take_job(store, DEAD)
    assert done(store) == 1
    assert (kept(store, key).state, kept(store, key).result) == ("done", {"counted": 3})


def test_a_job_that_kills_its_worker_is_given_up_with_the_reason(store):
    key = put_job(store, "count", {"to": 3})
    for _ in range(rows.TRIES):
        assert rows.take_job(store, DEAD).key == key
        assert rows.requeue_lost(store, "other") == 1
    assert rows.take_job(store, DEAD) is None
    assert kept(store, key).errors == ("given up after 3 tries that got no further: the program ended while it ran",)


def test_a_job_that_was_ended_with_all_else_is_not_given_up(store):
    key = put_job(store, "count", {"to": 3})
    for _ in range(2 * rows.TRIES):
        assert rows.take_job(store, DEAD).key == key
        assert eg.History.of(store, "A. Nobody").resume_jobs() == 1
    assert (kept(store, key).state, kept(store, key).tries) == ("waiting", 0)


def test_a_job_that_gets_further_each_time_is_not_given_up(store):
    key = put_job(store, "count", {"to": 30})
    for n in range(2 * rows.TRIES):
        rows.take_job(store, DEAD)
        assert rows.beat_job(store, key, DEAD, f"number {n}", n + 1, 30)
        rows.requeue_lost(store, "other")
    assert kept(store, key).state == "waiting"
    for _ in range(rows.TRIES):  # and now it stays where it is, begun at the first step each time
        rows.take_job(store, DEAD)
        rows.beat_job(store, key, DEAD, "number 3", 3, 30)
        rows.requeue_lost(store, "other")
    assert kept(store, key).state == "failed"


def test_a_worker_that_is_alive_keeps_its_job_and_one_elsewhere_until_it_is_silent(store, standing_clock):
    here = f"{socket.gethostname()}/{os.getpid()}/other"
    for to, name in enumerate((here, "elsewhere/1/x")):
        put_job(store, "count", {"to": to})
        rows.take_job(store, name)
    standing_clock.advance(seconds=rows.STALE.total_seconds() - 1)
    assert rows.requeue_lost(store, "me") == 0
    standing_clock.advance(seconds=2)
    assert rows.requeue_lost(store, "me") == 1  # the one elsewhere
    standing_clock.advance(seconds=rows.LOST.total_seconds())
    assert rows.requeue_lost(store, "me") == 1  # its number was given again


def test_a_worker_that_was_given_up_changes_nothing(store):
    key = put_job(store, "count", {"to": 3})
    rows.take_job(store, DEAD)
    rows.requeue_lost(store, "other")
    taken = rows.take_job(store, "other")
    assert taken.key == key
    assert not rows.beat_job(store, key, DEAD, "late", 3, 3)
    assert not rows.finish_job(store, key, DEAD, {"counted": -1})
    assert not rows.fail_job(store, key, DEAD, "late")
    assert not rows.requeue_job(store, key, DEAD)
    assert (kept(store, key).state, kept(store, key).result) == ("running", None)


def worker_of(store):
    worker = Worker(store)
    thread = threading.Thread(target=worker.run)
    thread.start()
    return worker, thread


def until(ready, seconds=10.0):
    for _ in range(int(seconds / 0.02)):
        if ready():
            return
        time.sleep(0.02)
    raise AssertionError("it did not happen")


def test_a_job_that_is_cancelled_ends_after_its_step_and_one_that_waits_never_begins(store, monkeypatch):
    monkeypatch.setattr(running, "BEAT", 0.05)
    first, second = put_job(store, "wait"), put_job(store, "count", {"to": 3})
    worker, thread = worker_of(store)
    until(lambda: kept(store, first).step.startswith("look"))
    rows.cancel_job(store, second)
    rows.cancel_job(store, first)
    rows.cancel_job(store, first)
    last = put_job(store, "count", {"to": 4})
    until(lambda: kept(store, last).state == "done")
    worker.stop()
    thread.join()
    assert [kept(store, key).state for key in (first, second)] == ["cancelled", "cancelled"]
    assert kept(store, second).tries == 0
    rows.try_again(store, second)
    assert done(store) == 1
    with pytest.raises(InputError, match=f"job {second} is done; only one that failed or was cancelled"):
        rows.try_again(store, second)


def test_a_worker_that_is_asked_to_stop_puts_its_job_back_and_it_is_no_try(store):
    key = put_job(store, "wait")
    for _ in range(rows.TRIES + 1):
        worker, thread = worker_of(store)
        until(lambda: kept(store, key).state == "running")
        worker.stop()
        thread.join()
        assert (kept(store, key).state, kept(store, key).tries) == ("waiting", 0)


def test_jobs_that_were_over_long_ago_are_forgotten_and_others_are_not(store, standing_clock):
    old, waiting = put_job(store, "count", {"to": 1}), None
    done(store)
    standing_clock.advance(days=rows.KEPT / timedelta(days=1) + 1)
    waiting = put_job(store, "refuse", {"what": "x"})
    rows.forget_old_jobs(store)
    with read(store) as connection:
        assert [one.key for one in rows.kept_jobs(connection, "", 9).jobs] == [waiting] != [old]


def test_the_list_has_running_jobs_first_then_waiting_ones_then_the_last(store):
    keys = [put_job(store, "count", {"to": n}) for n in range(4)]
    for _ in range(2):
        rows.finish_job(store, rows.take_job(store, "me").key, "me", None)
    rows.take_job(store, "me")
    with read(store) as connection:
        found = rows.kept_jobs(connection, "shop.db")
        assert [one.key for one in found.jobs] == [keys[2], keys[3], keys[1], keys[0]]
        assert [one.key for one in rows.kept_jobs(connection, "", 2, "count").jobs] == keys[2:]
    assert "1 running, 1 waiting" in str(found).lower()


def test_a_job_shows_itself_and_its_document(store):
    with eg.History.of(store, "A. Nobody").store as own:
        history = eg.History.of(own, "A. Nobody")
        key = history.put_job("refuse", {"what": "x"})
        assert history.job(key).to_dict()["state"] == "waiting"
        done(store)
        found = history.job(key).to_dict()
        assert {name: found[name] for name in ("schema", "state", "errors", "who", "asked")} == {
            "schema": "elastogeo.job/1",
            "state": "failed",
            "errors": ["x: is no number; give one"],
            "who": "A. Nobody",
            "asked": {"what": "x"},
        }
        assert "x: is no number" in str(history.job(key))
        history.try_job_again(key)
        history.cancel_job(key)
        assert [one.state for one in history.jobs().jobs] == ["cancelled"]


def test_every_kind_that_ships_is_found_by_itself():
    import elastogeo.history.work as work

    with pytest.raises(InputError, match="there is no job"):
        kind_named("nothing of this name")
    files = {path.stem for path in running_files()}
    modules = {kind.__module__.rpartition(".")[2] for kind in work._KINDS.values()} - {"toy_jobs"}
    assert modules == files


def running_files():
    from pathlib import Path

    return Path(running.__file__).parents[1].glob("*/*_job.py")


@pytest.mark.skipif(sys.platform == "win32", reason="sends SIGTERM and SIGKILL")
def test_the_command_does_what_waits_and_ends_with_the_program_that_started_it(tmp_path):
    url = tmp_path / "history.db"
    store = open_store(url, create=True)
    command = [sys.executable, "-m", "elastogeo", "history", "work", "--store", str(url)]
    with subprocess.Popen([*command, "--attached"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL) as attached:
        attached.stdin.close()
        assert attached.wait(60) == 0
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True) as alone:
        with write(store) as connection:
            connection.execute(job.insert().values(kind="cook", asked={}, state="waiting", made_at=rows.now()))
        assert "begun" in next(alone.stdout)
        gives_way = os.getpriority(os.PRIO_PROCESS, alone.pid) - os.getpriority(os.PRIO_PROCESS, 0)
        assert gives_way in (running.NICE, 19 - os.getpriority(os.PRIO_PROCESS, 0)), "pages go first; 19 is the most"
        assert "failed: there is no job of the kind 'cook'" in next(alone.stdout)
        alone.send_signal(signal.SIGTERM)
        assert alone.wait(60) == 0
