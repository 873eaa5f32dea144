"""Long work that a history keeps: what was asked, how far it is, what came of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from elastogeo.result import Result

WAITING, RUNNING, DONE, FAILED, CANCELLED = "waiting", "running", "done", "failed", "cancelled"
"""States of a job."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptJob(Result):
    """One job.

    Attributes
    ----------
    key : int
    kind, who : str
    asked : dict
        What exactly was asked, as its kind takes it.
    state : str
        `WAITING`, `RUNNING`, `DONE`, `FAILED` or `CANCELLED`.
    now, made_at : float [d]
    started_at, beat_at, ended_at : float or None [d]
        When it was begun last; when its worker was alive last; when it was over.
    tries : int
        How often it was begun since it last got on.
    step : str
        What it does now, in words.
    done, total : int
        Steps; a total of 0 is not known.
    result : dict or None
        What its kind returned.
    error : str
        Why it failed; empty if it did not.
    before : int
        Jobs that wait before it.
    """

    key: int
    kind: str
    who: str
    asked: dict[str, Any]
    state: str
    now: float
    made_at: float
    started_at: float | None
    beat_at: float | None
    ended_at: float | None
    tries: int
    step: str
    done: int
    total: int
    result: dict[str, Any] | None
    error: str
    before: int = 0

    @property
    def is_over(self) -> bool:
        """Whether nothing more will come of it."""
        return self.state in (DONE, FAILED, CANCELLED)

    @property
    def errors(self) -> tuple[str, ...]:
        """What went wrong, in sentences: why it failed, and the parts that were refused."""
        parts = (self.result or {}).get("errors", [])
        return tuple(filter(None, (self.error, *map(str, parts))))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptJobs(Result):
    """Jobs that a history keeps.

    Attributes
    ----------
    store : str
    jobs : tuple of KeptJob
        Running ones first, then waiting ones, then those that are over, the last first.
    """

    store: str
    jobs: tuple[KeptJob, ...]
