"""What a history keeps of what was computed: tests and drawings, recomputations, campaigns, plans. A part of `History`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

from elastogeo.changes import (
    Comparable,
    ComparedTests,
    Explored,
    KeptCampaign,
    KeptCampaigns,
    KeptPlans,
    KeptTest,
    Recomputed,
)
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.analyses import (
    campaigns,
    draw,
    drawing_of,
    due_date,
    finish_plan,
    keep_plan,
    kept_campaign,
    kept_test,
    plans,
    raw_file,
    read_plan,
    recompute,
    recompute_campaign,
)
from elastogeo.history.comparing import comparable, compare_tests
from elastogeo.history.exploring import explore
from elastogeo.history.intake.machines import machine_named
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, read
from elastogeo.planning import Plan


class Records:
    """What is done with an open history and its computed records.

    Attributes
    ----------
    store : Store
    who : str
        For the audit trail.
    """

    store: Store
    who: str

    def test(self, number: int) -> KeptTest:
        """A test: what is known of it, its raw files, what it was evaluated to.

        Raises
        ------
        InputError
            If there is none of this number.
        """
        with read(self.store) as connection:
            return kept_test(connection, number)

    def raw_file(self, test: int, number: int) -> tuple[str, bytes]:
        """The name and the content of a raw file of a test, by its place among them from 1, checked against its hash."""
        return raw_file(self.store, test, number)

    def draw(self, test: int, *, again: bool = False) -> int:
        """Draw what the page of a test shows, once for each version of the software; the key of the analysis shown."""
        return draw(self.store, test, self.who, again)

    def drawing(self, analysis: int) -> dict[str, Any] | None:
        """What is drawn of an analysis: `view`, `causes`; None if nothing is yet."""
        with read(self.store) as connection:
            return drawing_of(connection, analysis)

    def recompute(
        self, series: Iterable[int] | None = None, *, progress: Callable[[str], None] | None = None, jobs: int = 1
    ) -> Recomputed:
        """Compute series, by default all, again from their raw records; a new version takes them over, each as a whole.

        Each is judged again as soon as it is done, so that an interruption leaves none unjudged; nobody is told.

        Raises
        ------
        InputError
            If there is no such series, or a later version than this one computed it.
        """
        return recompute(self.store, series, self.who, progress, jobs, judge=partial(assess, self.store))

    def compare(self, one: int, other: int) -> ComparedTests:
        """Two tests held against each other, the earlier one first: what changed, and whether it is more than scatter."""
        return compare_tests(self.store, one, other)

    def comparable(self, test: int) -> Comparable:
        """The tests of the machine of a test, the newest first: with which it may be compared."""
        return comparable(self.store, test)

    def explore(self, test: int) -> Explored:
        """The readings of a test, run by run, beside what its kept parameters predict."""
        return explore(self.store, test)

    def campaigns(self, machine: str | None = None) -> KeptCampaigns:
        """The campaigns of a machine, or of all, in the order in which they were kept."""
        with read(self.store) as connection:
            of = None if machine is None else machine_named(connection, machine)
            kept = tuple(kept_campaign(connection, key) for key in campaigns(connection, None if of is None else of.key))
        return KeptCampaigns(self.store.url, "" if of is None else of.name, kept)

    def campaign(self, number: int) -> KeptCampaign:
        """A campaign, with what its tests say together."""
        with read(self.store) as connection:
            return kept_campaign(connection, number)

    def recompute_campaign(self, number: int) -> KeptCampaign:
        """Ask the tests of a campaign again: the same version must say the same, a new one replaces what was said."""
        return recompute_campaign(self.store, number, self.who)

    def keep_plan(self, plan: Plan | str | Path, *, machine: str, name: str = "", due: str = "", grace: float = 7.0) -> int:
        """Keep a plan of tests for a machine, until when it is to be done, and after how many days it is overdue.

        Parameters
        ----------
        plan : Plan, str or Path
            From `eg.plan`, or the file that `elastogeo plan --json` printed.
        machine, name : str
            By default the plan is called after its file, or the day.
        due : str
            `2026-05-01`; empty: no date.
        grace : float [d]

        Returns
        -------
        int
            Its number.

        Raises
        ------
        InputError
            If it is no plan, or the machine has one of this name.
        """
        document = plan.to_dict() if isinstance(plan, Plan) else read_plan(Path(plan))
        called = name or (f"{now():%Y-%m-%d}" if isinstance(plan, Plan) else Path(plan).stem)
        with read(self.store) as connection:
            owner = machine_named(connection, machine).key
        return keep_plan(self.store, owner, called, document, due_date(due), grace, self.who)

    def finish_plan(self, number: int, why: str = "") -> None:
        """Say that a plan was done."""
        finish_plan(self.store, number, self.who, why)

    def plans(self, machine: str | None = None) -> KeptPlans:
        """The plans of a machine, or of all, the most urgent first."""
        with read(self.store) as connection:
            of = None if machine is None else machine_named(connection, machine).key
            return KeptPlans(self.store.url, days(now()), plans(connection, now(), of))
