"""Compute again from the raw records: is it the same, or what does a new version of the software say?

A series counts with one version. A new version computes all its tests, each written when it is done; only then, in one
transaction, the series switches over. Until that the chart is the old one, whole; a crash on the way leaves it so, and the
next attempt goes on where this one ended. Nothing is sent: the states are judged again without a live test.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import starmap
from multiprocessing import get_context
from time import monotonic
from typing import Any

from sqlalchemy import Connection, func, select, update

from elastogeo.changes import Recomputed, RecomputedTest, recomputed_same
from elastogeo.errors import InputError
from elastogeo.history.analyses.analysing import PROGRAM, keep, last_analysis
from elastogeo.history.analyses.computation import Computed, computed
from elastogeo.history.analyses.differences import differences
from elastogeo.history.analyses.raw import RawFile, raw_files
from elastogeo.history.store import Files, Store, audit, read, write
from elastogeo.history.store.schema import analysis, machine, series, test
from elastogeo.version import VERSION

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class _Job:
    """A test to compute: its files, which attempt it is, and the document to compare it with."""

    test: int
    name: str
    raw: tuple[RawFile, ...]
    before: int | None
    attempt: int


def recompute(
    store: Store,
    keys: Iterable[int] | None = None,
    who: str = PROGRAM,
    progress: Progress | None = None,
    jobs: int = 1,
    judge: Callable[[int], object] = lambda _: None,
) -> Recomputed:
    """Compute series again by this version of the software, and switch to it those that another version made.

    Parameters
    ----------
    store : Store
    keys : iterable of int, optional
        Of the series; by default all.
    who : str
        For the audit trail.
    progress : callable, optional
        Is told what goes on, and how long it will take.
    jobs : int
        Processes that compute at once.
    judge : callable, optional
        Is called with each series as soon as that counts with this version, changed or not: what an attempt that was
        interrupted between the two left unjudged, the next one judges.

    Returns
    -------
    Recomputed

    Raises
    ------
    InputError
        If there is no such series, or a later version than this one made it.
    StoreError
        If a raw file is missing or damaged, or nothing can be written.
    """
    with read(store) as connection:
        names = _series_names(connection, keys)
        for key, name in names.items():
            _check_later(connection, key, name)
    tests: list[RecomputedTest] = []
    switched: dict[str, tuple[str, str]] = {}
    changed: list[int] = []
    for key, name in names.items():
        told = partial(_tell, progress or (lambda _: None), name)
        found = _recomputed(store, key, name, who, told, jobs)
        before = _switch(store, key, who, told, jobs)
        if before != VERSION:
            switched[name] = (before, VERSION)
        if before != VERSION or any(one.mended or not one.before for one in found):
            changed.append(key)
        judge(key)
        tests += found
    return Recomputed(store.url, tuple(tests), switched, tuple(changed), (recomputed_same(tests),))


def outdated(connection: Connection) -> tuple[int, ...]:
    """Keys of the series whose chart counts with another version than this one."""
    return tuple(connection.execute(select(series.c.id).where(series.c.software != VERSION).order_by(series.c.id)).scalars())


def _recomputed(
    store: Store, key: int, name: str, who: str, told: Callable[[int, int, float], None], jobs: int
) -> list[RecomputedTest]:
    with read(store) as connection:
        counts_already = connection.execute(select(series.c.software).where(series.c.id == key)).scalar_one() == VERSION
        todo = [_job(connection, one) for one in (_all_of(connection, key) if counts_already else _missing(connection, key))]
    found = []
    began = monotonic()
    for job, result in zip(todo, _all_computed(store.files, todo, jobs), strict=True):
        found.append(_compared(store, name, job, result, who))
        told(len(found), len(todo), monotonic() - began)
    return found


def _switch(store: Store, key: int, who: str, told: Callable[[int, int, float], None], jobs: int) -> str:
    """Let the chart count with this version once it has every test, those too that came meanwhile; the version before."""
    while True:
        with write(store) as connection:
            before = str(connection.execute(select(series.c.software).where(series.c.id == key)).scalar_one())
            if before == VERSION:
                return before
            missing = _missing(connection, key)
            if not missing:
                connection.execute(update(series).where(series.c.id == key).values(software=VERSION))
                audit.record(connection, who, "recompute", f"series {key}", {"software": before}, {"software": VERSION})
                return before
            todo = [_job(connection, one) for one in missing]
        for job, result in zip(todo, _all_computed(store.files, todo, jobs), strict=True):
            keep(store, job.test, result, who)
            told(len(todo), len(todo), 0.0)


def _all_computed(files: Files, todo: Sequence[_Job], jobs: int) -> Iterator[Computed]:
    """All jobs in their order, by so many processes: they read files and write nothing."""
    asked = [(files, job.raw, job.attempt) for job in todo]
    if jobs <= 1 or len(todo) < 2:
        yield from starmap(computed, asked)
        return
    with ProcessPoolExecutor(min(jobs, len(todo)), mp_context=get_context("spawn")) as pool:
        yield from pool.map(computed, *zip(*asked, strict=True))


def _all_of(connection: Connection, key: int) -> list[int]:
    """The tests of a series, in the order of their dates."""
    return list(connection.execute(select(test.c.id).where(test.c.series == key).order_by(test.c.at, test.c.id)).scalars())


def _job(connection: Connection, one: int) -> _Job:
    """What to compare with is the analysis by this version, else the last by another."""
    before = (
        last_analysis(connection, one, VERSION)
        or connection.execute(select(func.max(analysis.c.id)).where(analysis.c.test == one)).scalar()
    )
    settings = {} if before is None else _row(connection, before)["settings"]
    name = str(connection.execute(select(test.c.name).where(test.c.id == one)).scalar_one())
    return _Job(one, name, raw_files(connection, one), before, int(settings.get("attempt", 1)))


def _row(connection: Connection, key: int) -> dict[str, Any]:
    return dict(connection.execute(select(analysis).where(analysis.c.id == key)).mappings().one())


def _missing(connection: Connection, key: int) -> list[int]:
    """Those of them that this version has not analysed."""
    here = select(analysis.c.test).join(test, test.c.id == analysis.c.test)
    done = set(connection.execute(here.where(test.c.series == key, analysis.c.software == VERSION)).scalars())
    return [one for one in _all_of(connection, key) if one not in done]


def _compared(store: Store, series_name: str, job: _Job, found: Computed, who: str) -> RecomputedTest:
    """Held against what was kept; kept itself if this version had none, or failed before and does no longer."""
    with read(store) as connection:
        before = {} if job.before is None else _row(connection, job.before)
    software = str(before.get("software", ""))
    mended = software == VERSION and before["error"] is not None and found.error is None
    if mended:
        keep(store, job.test, computed(store.files, job.raw, job.attempt + 1), who)
    elif software != VERSION:
        keep(store, job.test, found, who)
    same = bool(before) and found.document_sha256 == before["document_sha256"] and found.error == before["error"]
    apart = (
        ()
        if same or not before
        else differences(
            {"document": before["document"], "error": before["error"]}, {"document": found.document, "error": found.error}
        )
    )
    return RecomputedTest(series_name, job.test, job.name, software, VERSION, same, apart, found.error or "", mended)


def _series_names(connection: Connection, keys: Iterable[int] | None) -> dict[int, str]:
    asked = (
        select(series.c.id, machine.c.name, series.c.name)
        .join(machine, machine.c.id == series.c.machine)
        .order_by(machine.c.name, series.c.name)
    )
    names = {key: f"{owner}: {name}" for key, owner, name in connection.execute(asked)}
    wanted = names if keys is None else {key: names.get(key, "") for key in keys}
    for key, name in wanted.items():
        if not name:
            raise InputError(f"there is no series {key}; `elastogeo history list` shows those that there are")
    return wanted


def _check_later(connection: Connection, key: int, name: str) -> None:
    """Refuse what a later version made: the chart would go back."""
    made_by = str(connection.execute(select(series.c.software).where(series.c.id == key)).scalar_one())
    if _order(made_by) > _order(VERSION):
        raise InputError(
            f"series {name!r} was computed by elastogeo {made_by}, this is {VERSION}; install that version or a later one"
        )


def _order(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split(".") if part.isdigit())


def _tell(progress: Progress, name: str, done: int, of: int, taken: float) -> None:
    left = taken / done * (of - done)
    progress(f"{name}: test {done} of {of}" + (f", {left:.0f} s left" if left >= 1 else ""))
