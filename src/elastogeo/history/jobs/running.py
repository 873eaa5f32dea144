"""The worker: takes the oldest job, does it, keeps what came of it, and takes the next.

A thread of its own says every second that the worker is alive and how far it is. What must not be lost is in the database:
a worker that is killed leaves a running job, which the next one finds and puts back. Asked to stop, it finishes its step and
puts the job back itself.
"""

from __future__ import annotations

import os
import secrets
import signal
import socket
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from elastogeo.changes import KeptJob
from elastogeo.errors import ElastogeoError, StoreError
from elastogeo.history.jobs import rows
from elastogeo.history.store import Store
from elastogeo.history.work import JobEnded, Work, kind_named

BEAT = 1.0
"""Seconds between two beats."""
LOOK = 0.5
"""Seconds between two looks for a job."""
_LOST_EVERY = 15.0
"""Seconds between two looks for jobs whose worker is gone."""
_TIDY_EVERY = 600.0
NICE = 5
"""How much less than a page a job counts where both want the same core: a third (POSIX)."""
_PAUSE = 5.0
"""Seconds to wait after the history could not be read or written."""

Told = Callable[[str], None]


class Worker:
    """Does the jobs of a history, one after the other.

    Parameters
    ----------
    store : Store
    told : callable
        Is told what becomes of each job, a line each.
    tidy : callable, optional
        What is to be done now and then beside the jobs.
    """

    def __init__(self, store: Store, told: Told = lambda _: None, tidy: Callable[[Store], object] | None = None) -> None:
        self.store = store
        self.name = f"{socket.gethostname()}/{os.getpid()}/{secrets.token_hex(4)}"
        self._told = told
        self._tidy = tidy
        self._stopping = threading.Event()

    def stop(self) -> None:
        """Ask it to stop after the step that it is at."""
        self._stopping.set()

    def run(self, once: bool = False) -> int:
        """Do jobs until asked to stop; how many were done. With `once` it stops when none waits."""
        done, looked, tidied = 0, -_LOST_EVERY, -_TIDY_EVERY
        while not self._stopping.is_set():
            try:
                if time.monotonic() - looked >= _LOST_EVERY:
                    rows.requeue_lost(self.store, self.name)
                    looked = time.monotonic()
                found = rows.take_job(self.store, self.name)
                if found is not None:
                    self._do(found)
                    done += 1
                    continue
                if time.monotonic() - tidied >= _TIDY_EVERY:
                    self._tidy_up()
                    tidied = time.monotonic()
            except StoreError as error:
                self._told(str(error))
                looked = -_LOST_EVERY  # its own job may be left running
                if once:
                    raise
                self._stopping.wait(_PAUSE)
                continue
            if once:
                break
            self._stopping.wait(LOOK)
        return done

    def _tidy_up(self) -> None:
        rows.forget_old_jobs(self.store)
        if self._tidy is not None:
            self._tidy(self.store)

    def _do(self, found: KeptJob) -> None:
        """Do a job, and keep what came of it."""
        self._told(f"job {found.key}, {found.kind}: begun")
        beats = _Beats(self.store, found, self.name, self._stopping)
        try:
            with beats.beating():
                work = Work(self.store, found.who, beats.step, beats.ends)
                result = kind_named(found.kind)(work, found.asked)
            kept, became = rows.finish_job(self.store, found.key, self.name, result), "done"
        except JobEnded:
            kept, became = rows.requeue_job(self.store, found.key, self.name), "put back"
        except StoreError as error:
            beats.last()
            kept, became = rows.requeue_job(self.store, found.key, self.name, str(error)), f"put back: {error}"
            self._stopping.wait(_PAUSE)
        except ElastogeoError as error:
            kept, became = rows.fail_job(self.store, found.key, self.name, str(error)), f"failed: {error}"
        except Exception as error:  # noqa: BLE001 - a fault of the program in one job must not stop the worker
            traceback.print_exc(file=sys.stderr)
            said = f"{type(error).__name__}: {error}; a fault of elastogeo, please report it"
            kept, became = rows.fail_job(self.store, found.key, self.name, said), f"failed: {said}"
        self._told(f"job {found.key}, {found.kind}: {became if kept else 'cancelled'}")


class _Beats:
    """How far a job is, told to the database by a thread; and whether it is to end."""

    def __init__(self, store: Store, found: KeptJob, worker: str, stopping: threading.Event) -> None:
        self._store, self._key, self._worker, self._stopping = store, found.key, worker, stopping
        self._at = ("", 0, 0)
        self._lost = threading.Event()
        self._over = threading.Event()

    def step(self, text: str, done: int = 0, total: int = 0) -> None:
        """Say what is done now; end the job here if it is to end."""
        self._at = (text, done, total)
        if self.ends():
            raise JobEnded

    def ends(self) -> bool:
        """Whether the job is to end: cancelled, another worker's, or this one stops."""
        return self._lost.is_set() or self._stopping.is_set()

    def last(self) -> None:
        """Tell once more how far it was."""
        with suppress(StoreError):  # the next worker finds it without
            rows.beat_job(self._store, self._key, self._worker, *self._at)

    @contextmanager
    def beating(self) -> Iterator[None]:
        """Tell how far it is while this lasts."""
        thread = threading.Thread(target=self._beat, name=f"beat of job {self._key}", daemon=True)
        thread.start()
        try:
            yield
        finally:
            self._over.set()
            thread.join()

    def _beat(self) -> None:
        told: tuple[str, int, int] | None = None
        pause = 0.2  # the first words soon
        while not self._over.wait(pause):
            pause = BEAT
            at = self._at
            try:
                mine = rows.beat_job(self._store, self._key, self._worker, *at)
            except StoreError:
                continue  # somebody writes or reads for longer: the next beat comes soon
            if not mine:
                self._lost.set()
                return
            told = at
        if told != self._at:
            self.last()


def give_way() -> None:
    """Let other programs go first: who waits for a page notices a tenth of a second, nobody that of a job."""
    if hasattr(os, "nice"):
        os.nice(NICE)


def stop_at_signals(worker: Worker) -> None:
    """Let SIGTERM and SIGINT stop a worker after its step."""

    def asked(_number: int, _frame: FrameType | None) -> None:
        worker.stop()

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, asked)
