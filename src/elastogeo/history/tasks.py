"""What a history is asked to do later: jobs, done by a worker. A part of `History`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from elastogeo.changes import KeptJob, KeptJobs
from elastogeo.changes.records import DONE, RUNNING, WAITING
from elastogeo.errors import InputError
from elastogeo.history.intake.machines import machines
from elastogeo.history.jobs import rows
from elastogeo.history.parcels.confirming import ToConfirm, confirmed, to_confirm
from elastogeo.history.store import Store, now, read

_IMPORTS = 100
"""The last ones, among which the import of a parcel is looked for."""


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

    @staticmethod
    def to_confirm(looked: KeptJob) -> ToConfirm | None:
        """What a person is to say of what a look has found; None of a job that is no look, or is not done."""
        return to_confirm(looked)

    def put_import(self, number: int, said: Sequence[tuple[str, str, str]], date: str = "") -> int:
        """Ask a worker to import the tests that a look has found.

        Parameters
        ----------
        number : int
            Of the job that looked.
        said : sequence of (serial, machine, name)
            Of the tests that say this serial number the machine, or the name of a new one.
        date : str
            Of the tests that do not say theirs.

        Returns
        -------
        int
            The number of the job; of the one that imports, or imported, the same, for a form may be sent twice.

        Raises
        ------
        InputError
            If nothing was found, a machine or a date is missing, or there is no such machine.
        """
        found = to_confirm(self.job(number))
        if found is None:
            raise InputError(f"job {number} has found no tests; upload them, and wait until they were looked at")
        for one in self.jobs(last=_IMPORTS, kind="import").jobs:
            if one.asked.get("parcel") == found.parcel and one.state in (WAITING, RUNNING, DONE):
                return one.key
        return self.put_job("import", confirmed(self.store, found, said, date, self.who))

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
