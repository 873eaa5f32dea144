"""The audit trail of a history: who did what, when and why, and whether its rows are as they were written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from elastogeo.identification import Check
from elastogeo.result import Part, Result

TRAIL_WHOLE = "audit trail whole"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AuditRow(Part):
    """One thing that somebody did.

    Attributes
    ----------
    number : int
    at : datetime
        With its zone (UTC).
    who, what, subject : str
    old, new : JSON value
        None where there is none.
    why : str
    sha256 : str
        The seal of the row.
    """

    number: int
    at: datetime
    who: str
    what: str
    subject: str
    old: Any
    new: Any
    why: str
    sha256: str


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AuditFault(Part):
    """A row that is not as it was written.

    Attributes
    ----------
    number : int
    fault : str
        `changed`, `missing`, `moved`, `cut off` (from this row on) or `head missing`.
    was : int or None
        Where a moved row stood.
    """

    number: int
    fault: str
    was: int | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AuditTrail(Result):
    """The audit trail, the last rows of it, and whether all of it is as it was written.

    Attributes
    ----------
    store : str
    count : int
        Of all rows.
    head : str
        The seal of the last row: noted elsewhere, it shows later that nothing before it was written anew.
    rows : tuple of AuditRow
        Those asked for, the last first.
    faults : tuple of AuditFault
    verdict : tuple of Check
    """

    store: str
    count: int
    head: str
    rows: tuple[AuditRow, ...]
    faults: tuple[AuditFault, ...]
    verdict: tuple[Check, ...]


def trail_whole(count: int, faults: Sequence[AuditFault], checked: bool = True) -> Check:
    """Whether every row is as it was written; not tested where nobody looked."""
    facts = {
        "rows": count,
        "faults": dict(Counter(fault.fault for fault in faults)),
        "first": [(fault.number, fault.fault, fault.was) for fault in faults[:5]],
    }
    return Check(TRAIL_WHOLE, not faults if checked else None, facts, decisive=True)
