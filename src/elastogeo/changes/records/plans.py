"""Plans of tests that a history keeps: what was planned, for when, and whether it was done."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from elastogeo.changes.due_dates import DueDate
from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptPlan(Part):
    """One plan.

    Attributes
    ----------
    key : int
    machine, name : str
    made_at : float [d]
    due : DueDate
        How it stands now; without a date where none was set, or where it is done.
    done_at : float or None [d]
        None while it is not done.
    tests : tuple of str
        Names of the planned tests, in the order of doing.
    minutes : float or None
        That they take.
    document : dict
        Of the plan's view, as `elastogeo plan --json` printed it.
    """

    key: int
    machine: str
    name: str
    made_at: float
    due: DueDate
    done_at: float | None
    tests: tuple[str, ...]
    minutes: float | None
    document: dict[str, Any]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptPlans(Result):
    """The plans that a history keeps.

    Attributes
    ----------
    store : str
    now : float [d]
    plans : tuple of KeptPlan
        Overdue first, then by their date, those without one and the done ones last.
    """

    store: str
    now: float
    plans: tuple[KeptPlan, ...]
