"""Long work as rows of the database: asked for by anybody, done by one worker, done again after a crash.

`rows` keeps the jobs, `running` is the worker. What a job may do is a kind: a file `*_job.py` in any wing (`history.work`).
"""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.history.jobs.rows import cancel_job, kept_job, kept_jobs, put_job
    from elastogeo.history.jobs.running import Worker, give_way, stop_at_signals
    from elastogeo.history.work import JobEnded, Work, job

__all__ = [
    "JobEnded",
    "Work",
    "Worker",
    "cancel_job",
    "give_way",
    "job",
    "kept_job",
    "kept_jobs",
    "put_job",
    "stop_at_signals",
]

_here = first_use(__name__, {"rows": "cancel_job kept_job kept_jobs put_job", "running": "Worker give_way stop_at_signals"})
_above = first_use("elastogeo.history", {"work": "JobEnded Work job"})


def __getattr__(name: str) -> object:
    """Import a name of the face where it is used first (PEP 562)."""
    return _above(name) if name in ("JobEnded", "Work", "job") else _here(name)
