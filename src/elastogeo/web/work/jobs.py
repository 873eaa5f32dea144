"""Long work: what runs, what waits, what came of it."""

from __future__ import annotations

from elastogeo.changes import KeptJob
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER, Ask, Asked, or_not_found
from elastogeo.web.pages import Pages

pages = Pages()
ADMINISTRATORS = ("back up", "verify")
"""Jobs that only an administrator asks for, ends and begins again."""


@pages.shows("/jobs", fresh=True)
def jobs(asked: Ask) -> Shown:
    """What runs, what waits, and what is over, the last first."""
    found = asked.history.jobs()
    over = all(job.is_over for job in found.jobs)
    return Shown("work/jobs.html.j2", view_of(found), part="work/jobs_part.html.j2", context={"over": over})


@pages.shows("/jobs/{key:int}", fresh=True)
def job(asked: Ask, key: int) -> Shown:
    """How far a job is, and what came of it."""
    found = _found(asked, key)
    confirm = asked.history.to_confirm(found)
    context = {
        "job": found,
        "confirm": confirm,
        "machines": asked.history.machines() if confirm is not None else (),
    }
    return Shown("work/job.html.j2", view_of(found), part="work/job_part.html.j2", context=context)


@pages.acts("/jobs/{key:int}/cancel", role=ENGINEER)
def cancel(asked: Ask, key: int) -> Done:
    """End a job: one that waits never begins, one that runs ends after its step."""
    _mine(asked, key)
    asked.history.cancel_job(key)
    return Done(f"/jobs/{key}", "It ends after its step.")


@pages.acts("/jobs/{key:int}/again", role=ENGINEER)
def again(asked: Ask, key: int) -> Done:
    """Let a job that failed or was cancelled wait again."""
    _mine(asked, key)
    asked.history.try_job_again(key)
    return Done(f"/jobs/{key}", "It waits again.")


def _mine(asked: Asked, key: int) -> None:
    """Refuse who may not ask for such a job."""
    if _found(asked, key).kind in ADMINISTRATORS:
        asked.needs(ADMINISTRATOR)


def _found(asked: Asked, key: int) -> KeptJob:
    with or_not_found("There is no such job."):
        return asked.history.job(key)
