"""Jobs as rows: put, taken by one worker at a time, beaten, finished, put back, cancelled; each in one transaction.

Whoever takes a job writes his name into it; all that he writes of it later holds only while his name is there. So a worker
that was given up, and is alive after all, changes nothing.
"""

from __future__ import annotations

import os
import socket
from collections.abc import Mapping
from datetime import datetime, timedelta
from typing import Any

from sqlalchemy import Connection, Row, Select, case, delete, func, insert, select, update

from elastogeo.changes import KeptJob, KeptJobs
from elastogeo.changes.records import CANCELLED, DONE, FAILED, RUNNING, WAITING
from elastogeo.errors import InputError
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, read, write
from elastogeo.history.store.schema import job
from elastogeo.history.work import kind_named

TRIES = 3
"""How often a job is begun, at most, without getting on."""
STALE = timedelta(seconds=60)
"""Without a beat after which a worker on another computer counts as gone."""
LOST = timedelta(minutes=10)
"""The same of one on this computer whose number somebody has: the number may have been given again."""
KEPT = timedelta(days=30)
"""After which a job that is over is forgotten."""
_PATIENCE = 0.25
"""Seconds that a beat waits for its turn: it must not keep others waiting, and the next one comes soon."""


def put_job(store: Store, kind: str, asked: Mapping[str, Any] = {}, who: str = "") -> int:
    """Ask for a job.

    Parameters
    ----------
    store : Store
    kind : str
        A registered kind.
    asked : mapping
        What exactly, as the kind takes it: plain JSON types.
    who : str
        Who asks.

    Returns
    -------
    int
        Its key; that of the same job, if one waits or runs.

    Raises
    ------
    InputError
        If there is no such kind.
    """
    kind_named(kind)
    with write(store) as connection:
        same = select(job.c.id).where(job.c.kind == kind, job.c.asked == dict(asked), job.c.state.in_((WAITING, RUNNING)))
        known = connection.execute(same.order_by(job.c.id).limit(1)).scalar_one_or_none()
        if known is not None:
            return int(known)
        row = {"kind": kind, "asked": dict(asked), "state": WAITING, "who": who, "made_at": now()}
        return int(connection.execute(insert(job).values(row).returning(job.c.id)).scalar_one())


def take_job(store: Store, worker: str) -> KeptJob | None:
    """The job that has waited longest, now this worker's; None if none waits."""
    with read(store) as connection:  # looking alone keeps nobody waiting
        if connection.execute(select(job.c.id).where(job.c.state == WAITING).limit(1)).first() is None:
            return None
    with write(store) as connection:
        first = select(job.c.id).where(job.c.state == WAITING).order_by(job.c.id).limit(1)
        key = connection.execute(first).scalar_one_or_none()
        if key is None:
            return None
        at = now()
        row = {"state": RUNNING, "worker": worker, "started_at": at, "beat_at": at, "tries": job.c.tries + 1}
        connection.execute(update(job).where(job.c.id == key).values(row))
        return kept_job(connection, key)


def beat_job(store: Store, key: int, worker: str, step: str, done: int, total: int) -> bool:
    """Say that a job is being worked on, and how far it is; whether it is still this worker's."""
    further = job.c.done < done  # than it ever was: begun again it is known how far it was before
    tries, most = case((further, 1), else_=job.c.tries), case((further, done), else_=job.c.done)
    row = {"beat_at": now(), "step": step, "done": most, "total": total, "tries": tries}
    with write(store, _PATIENCE) as connection:
        return connection.execute(update(job).where(*_mine(key, worker)).values(row)).rowcount == 1


def finish_job(store: Store, key: int, worker: str, result: Mapping[str, Any] | None) -> bool:
    """Keep what came of a job; whether it was still this worker's."""
    row = {"state": DONE, "result": result, "done": job.c.total, "error": ""}
    return _end(store, key, worker, row)


def fail_job(store: Store, key: int, worker: str, error: str) -> bool:
    """Keep why nothing came of a job; whether it was still this worker's."""
    return _end(store, key, worker, {"state": FAILED, "error": error})


def requeue_job(store: Store, key: int, worker: str, why: str = "") -> bool:
    """Put a job back that was not finished; whether it was still this worker's.

    Without a reason it does not count as a try: its worker was asked to stop.
    """
    with write(store) as connection:
        row = connection.execute(select(job).where(*_mine(key, worker))).one_or_none()
        if row is not None:
            _put_back(connection, row, why)
        return row is not None


def requeue_lost(store: Store, worker: str = "", *, counts: bool = True) -> int:
    """Put back the jobs whose worker is gone, and this worker's own, which it does not know of any more; how many.

    It does not count as a try where more than the worker was ended: the job is not what ended it.
    """
    with read(store) as connection:
        if not _lost(connection, worker):
            return 0
    with write(store) as connection:
        lost = _lost(connection, worker)
        for row in lost:
            _put_back(connection, row, "the program ended while it ran" if counts else "")
        return len(lost)


def cancel_job(store: Store, key: int) -> None:
    """Ask that a job end: one that waits never begins, one that runs ends after its step; one that is over stays.

    Raises
    ------
    InputError
        If there is no such job.
    """
    with write(store) as connection:
        kept_job(connection, key)
        row = {"state": CANCELLED, "ended_at": now()}
        connection.execute(update(job).where(job.c.id == key, job.c.state.in_((WAITING, RUNNING))).values(row))


def try_again(store: Store, key: int) -> None:
    """Let a job that failed or was cancelled wait again.

    Raises
    ------
    InputError
        If there is no such job, or it did not fail.
    """
    with write(store) as connection:
        found = kept_job(connection, key)
        if found.state not in (FAILED, CANCELLED):
            raise InputError(f"job {key} is {found.state}; only one that failed or was cancelled can be tried again")
        row = {"state": WAITING, "tries": 0, "done": 0, "error": "", "ended_at": None, "worker": ""}
        connection.execute(update(job).where(job.c.id == key).values(row))


def forget_old_jobs(store: Store) -> None:
    """Delete the jobs that were over long ago."""
    with write(store) as connection:
        connection.execute(delete(job).where(job.c.ended_at < now() - KEPT))


def kept_job(connection: Connection, key: int) -> KeptJob:
    """A job as it stands.

    Raises
    ------
    InputError
        If there is none of this key.
    """
    row = connection.execute(_asked().where(job.c.id == key)).one_or_none()
    if row is None:
        raise InputError(f"there is no job {key}; one that was over a month ago is forgotten")
    return _kept(row, now())


def kept_jobs(connection: Connection, store: str, last: int = 50, kind: str = "") -> KeptJobs:
    """The last jobs, of one kind or all: running ones first, then waiting ones, then those that are over, the last first."""
    rank = case((job.c.state == RUNNING, 0), (job.c.state == WAITING, 1), else_=2)
    asked = _asked().order_by(rank, job.c.id.desc()).limit(last)
    rows = connection.execute(asked.where(job.c.kind == kind) if kind else asked)
    return KeptJobs(store, tuple(_kept(row, now()) for row in rows))


def _asked() -> Select[Any]:
    other = job.alias()
    before = select(func.count()).select_from(other).where(other.c.state.in_((WAITING, RUNNING)), other.c.id < job.c.id)
    return select(job, before.scalar_subquery().label("before"))


def _kept(row: Row[Any], at: datetime) -> KeptJob:
    started, beat, ended = (None if one is None else days(one) for one in (row.started_at, row.beat_at, row.ended_at))
    return KeptJob(
        row.id, row.kind, row.who, row.asked, row.state, days(at), days(row.made_at), started, beat, ended, row.tries,
        row.step, row.done, row.total, row.result, row.error, row.before if row.state == WAITING else 0,
    )  # fmt: skip


def _mine(key: int, worker: str) -> tuple[Any, ...]:
    return job.c.id == key, job.c.worker == worker, job.c.state == RUNNING


def _end(store: Store, key: int, worker: str, row: Mapping[str, Any]) -> bool:
    with write(store) as connection:
        ended = update(job).where(*_mine(key, worker)).values({**row, "step": "", "ended_at": now()})
        return connection.execute(ended).rowcount == 1


def _put_back(connection: Connection, row: Row[Any], why: str) -> None:
    """Let a job wait again, or give it up; a stop that was asked for is no try."""
    if why and row.tries >= TRIES:
        error = f"given up after {row.tries} tries that got no further: {why}"
        values: dict[str, Any] = {"state": FAILED, "error": error, "ended_at": now()}
    else:
        values = {"state": WAITING, "tries": row.tries if why else max(row.tries - 1, 0), "error": why}
    connection.execute(update(job).where(job.c.id == row.id).values(**values, worker=""))


def _lost(connection: Connection, worker: str) -> list[Row[Any]]:
    running = connection.execute(select(job).where(job.c.state == RUNNING).order_by(job.c.id)).all()
    return [row for row in running if row.worker == worker or _is_gone(row.worker, now() - (row.beat_at or row.made_at))]


def _is_gone(worker: str, silent: timedelta) -> bool:
    """Whether a worker is gone: `host/process/nonce`, without a beat for so long."""
    host, _, rest = worker.partition("/")
    if host != socket.gethostname():
        return silent > STALE
    number = rest.partition("/")[0]
    return silent > LOST or not number.isdigit() or not _is_alive(int(number))


def _is_alive(process: int) -> bool:
    if os.name != "posix":
        return True  # there, asking would end it: the missing beat decides
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return not _is_dead_child(process)


def _is_dead_child(process: int) -> bool:
    """Whether a process has ended and only waits for its parent to notice."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii", errors="replace") as file:
            return file.read().rpartition(")")[2].split()[0] in ("Z", "X")
    except (OSError, IndexError):
        return False
