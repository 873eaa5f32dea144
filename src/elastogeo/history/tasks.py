"""What a history is asked to do later: jobs, done by a worker. A part of `History`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from elastogeo.changes import KeptJob, KeptJobs
from elastogeo.errors import InputError
from elastogeo.history.intake.machines import machines
from elastogeo.history.jobs import rows
from elastogeo.history.store import Store, now, read


class Tasks:
    """What is done with an open history and its jobs.

    Attributes
    ----------
    store : Store
    who : str
        Who asks for them.
    """

    store: Store
    who: str

    def put_job(self, kind: str, asked: Mapping[str, Any] | None = None) -> int:
        """Ask a worker (`elastogeo history work`) to do something that takes long.

        Parameters
        ----------
        kind : str
            A registered kind of job.
        asked : mapping, optional
            What exactly, as the kind takes it: plain JSON types.

        Returns
        -------
        int
            Its number; that of the same job, if one waits or runs.

        Raises
        ------
        InputError
            If there is no such kind.
        """
        return rows.put_job(self.store, kind, asked or {}, self.who)

    def put_demo(self) -> int:
        """Ask a worker for the simulated fleet, as it would stand today; the number of the job.

        Raises
        ------
        InputError
            If the history has a machine: what is simulated never stands beside what is measured.
        """
        with read(self.store) as connection:
            if machines(connection):
                raise InputError(
                    "the simulated fleet is made in an empty history only, so that it never stands beside measured tests"
                )
        return self.put_job("demo", {"until": f"{now():%Y-%m-%dT00:00:00+00:00}"})

    def job(self, number: int) -> KeptJob:
        """A job as it stands.

        Raises
        ------
        InputError
            If there is none of this number.
        """
        with read(self.store) as connection:
            return rows.kept_job(connection, number)

    def jobs(self, last: int = 50, kind: str = "") -> KeptJobs:
        """The last jobs, of one kind or all: running ones first, then waiting ones, then those that are over."""
        with read(self.store) as connection:
            return rows.kept_jobs(connection, self.store.url, last, kind)

    def cancel_job(self, number: int) -> None:
        """End a job: one that waits never begins, one that runs ends after its step; one that is over stays."""
        rows.cancel_job(self.store, number)

    def resume_jobs(self) -> int:
        """Let the jobs wait again that ran when all was ended, by a power cut perhaps; how many."""
        return rows.requeue_lost(self.store, counts=False)

    def try_job_again(self, number: int) -> None:
        """Let a job that failed or was cancelled wait again."""
        rows.try_again(self.store, number)
