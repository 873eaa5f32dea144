"""The views of jobs, and their documents.

`elastogeo.job/1`, one job:

key, kind, who, asked : what was asked, of what kind, by whom
state : `waiting`, `running`, `done`, `failed`, `cancelled`
made_at, started_at, beat_at, ended_at : when it was asked for, begun last, its worker was alive last, it was over
before : jobs that are done before it
tries : how often it was begun since it last got on
step, done, total : what it does now, and how much of it is; a total of 0 is not known
result : what its kind returned, or null
errors : [sentence]: why it failed, and which parts were refused

`elastogeo.jobs/1` holds a list of them, `jobs`.
"""

from __future__ import annotations

from typing import Any

from elastogeo.changes import KeptJob, KeptJobs
from elastogeo.changes.records import CANCELLED, DONE, FAILED, RUNNING, WAITING
from elastogeo.report.days import iso_date, moment_said
from elastogeo.report.document import document
from elastogeo.report.jobs.parcels import came_in, looked_at, simulated, waits_for_a_person
from elastogeo.report.view import Badge, Table, View, lines, views

SCHEMA, LIST_SCHEMA = "elastogeo.job/1", "elastogeo.jobs/1"
_MARKS = {WAITING: "–", RUNNING: "▷", DONE: "●", FAILED: "■", CANCELLED: "–"}
_TONES = {WAITING: "none", RUNNING: "none", DONE: "good", FAILED: "bad", CANCELLED: "none"}
_TOLD = {"look": looked_at, "import": came_in}
"""Kinds of which more is told than how long they took."""
_TITLES = {
    "look": "What was sent",
    "import": "Import",
    "demo": "A simulated fleet",
    "draw": "Drawing of a test",
    "plan": "Ways to test",
    "map": "Map of the workspace",
}
_SECONDS_A_DAY = 86_400.0


@lines(KeptJob)
def job_line(job: KeptJob) -> str:
    """`job 12, import: running, 3 of 10`."""
    return f"job {job.key}, {job.kind}: {job.state}{_share(job)}"


@views(KeptJob)
def job_view(job: KeptJob) -> View:
    """How far a job is, and what came of it."""
    told = _TOLD[job.kind](job.result) if job.state == DONE and job.result and job.kind in _TOLD else (_answer(job), ())
    return View(
        kind="Job",
        title=_title(job),
        subtitle=f"job {job.key}",
        origin=simulated(job.result or {}),
        head=tuple(
            (label, text)
            for label, text in (
                ("Asked by", job.who),
                ("Asked", moment_said(job.made_at)),
                ("Begun", moment_said(job.started_at)),
                ("Over", moment_said(job.ended_at)),
            )
            if text
        ),
        sentence=told[0],
        document=document(SCHEMA, entry_of(job)),
        rows=(job.result or {}).get("tests", ()),
        tables=told[1],
        badge=_badge(job),
        notes=job.errors,
    )


@views(KeptJobs)
def jobs_view(found: KeptJobs) -> View:
    """What runs, what waits, what is over."""
    rows = [entry_of(job) for job in found.jobs]
    table = Table(
        ("Job", "What", "By", "Asked", "State", "Now"),
        tuple(
            (str(job.key), _title(job), job.who, moment_said(job.made_at), f"{job.state}{_share(job)}", _brief(job))
            for job in found.jobs
        ),
        words=(0, 1, 2, 3, 4, 5),
        name="jobs",
        keys=tuple(job.key for job in found.jobs),
    )
    return View(
        kind="Jobs",
        title=found.store,
        origin="",
        sentence=_counts(found),
        document=document(LIST_SCHEMA, {"store": found.store, "jobs": rows}),
        rows=rows,
        tables=(table,) if rows else (),
    )


def entry_of(job: KeptJob) -> dict[str, Any]:
    """A job as its document has it."""
    return {
        "key": job.key,
        "kind": job.kind,
        "who": job.who,
        "asked": job.asked,
        "state": job.state,
        "made_at": iso_date(job.made_at),
        "started_at": iso_date(job.started_at),
        "beat_at": iso_date(job.beat_at),
        "ended_at": iso_date(job.ended_at),
        "before": job.before,
        "tries": job.tries,
        "step": job.step,
        "done": job.done,
        "total": job.total,
        "result": job.result,
        "errors": list(job.errors),
    }


def _title(job: KeptJob) -> str:
    return _TITLES.get(job.kind, f"{job.kind[:1].upper()}{job.kind[1:]}")


def _badge(job: KeptJob) -> Badge:
    if job.state == DONE and job.kind == "look" and not (job.result or {}).get("tests"):
        return Badge("■", "Nothing to import", "bad")
    if job.state == DONE and job.kind == "look" and waits_for_a_person(job.result or {}):
        return Badge("▷", "To be confirmed", "care")
    return Badge(_MARKS[job.state], f"{job.state[:1].upper()}{job.state[1:]}{_share(job)}", _TONES[job.state])


def _answer(job: KeptJob) -> str:
    if job.state == WAITING:
        again = f" It was begun and put back: {job.error}." if job.error else ""
        first = "It waits for the worker." if not job.before else f"It waits; {job.before} before it."
        return f"{first}{again}"
    if job.state == RUNNING:
        return f"{job.step[:1].upper()}{job.step[1:]}." if job.step else "It has begun."
    if job.state == FAILED:
        return job.error
    if job.state == CANCELLED:
        return "It was cancelled; what it had done until then stays."
    count = len(job.errors)
    refused = f", {count} {'part was' if count == 1 else 'parts were'} refused" if count else ""
    return f"Done in {_took(job)}{refused}."


def _took(job: KeptJob) -> str:
    seconds = ((job.ended_at or job.now) - (job.started_at or job.made_at)) * _SECONDS_A_DAY
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


def _share(job: KeptJob) -> str:
    if job.state not in (RUNNING, WAITING) or not job.total:
        return ""
    return f", {job.done} of {job.total}"


def _brief(job: KeptJob) -> str:
    return job.step or (job.errors[0] if job.errors else "")


def _counts(found: KeptJobs) -> str:
    states = [job.state for job in found.jobs]
    running, waiting, failed = (states.count(state) for state in (RUNNING, WAITING, FAILED))
    if not states:
        return "No job was asked for yet."
    parts = [
        f"{running} running" if running else "",
        f"{waiting} waiting" if waiting else "",
        f"{failed} failed" if failed else "",
    ]
    said = ", ".join(part for part in parts if part)
    return f"{said[:1].upper()}{said[1:]}." if said else "Nothing runs and nothing waits."
