"""Whether all that a history keeps is as it was written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from elastogeo.identification import Check
from elastogeo.result import Part, Result

DATABASE_SOUND = "database sound"
ROWS_PROTECTED = "rows protected"
REFERENCES_WHOLE = "references whole"
RAW_FILES_WHOLE = "raw files whole"
DOCUMENTS_WHOLE = "documents whole"
RECORDS_AGREE = "records agree"
NO_STRAY_FILES = "no stray files"

UNREADABLE, UNPROTECTED, DANGLING = "unreadable", "unprotected", "dangling"
MISSING, CHANGED, RESIZED, STRAY = "missing", "changed", "resized", "stray"
"""What can be wrong with a thing."""
_FIRST = 5


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class StoreFault(Part):
    """One thing that is not as it was written.

    Attributes
    ----------
    check : str
        The check that found it.
    subject : str
        `raw file ab34...`, `analysis 12`, `test 3`.
    fault : str
        One of UNREADABLE, UNPROTECTED, DANGLING, MISSING, CHANGED, RESIZED, STRAY; of the audit trail as in `AuditFault`.
    detail : str
        Which column, where it lies, or what the database says.
    """

    check: str
    subject: str
    fault: str
    detail: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Verified(Result):
    """A history that was checked.

    Attributes
    ----------
    store : str
    rows : dict of str to int
        By table.
    files, size : int
        Raw files that were read, and their size [bytes].
    faults : tuple of StoreFault
    verdict : tuple of Check
    """

    store: str
    rows: dict[str, int]
    files: int
    size: int
    faults: tuple[StoreFault, ...]
    verdict: tuple[Check, ...]


def as_written(name: str, checked: int, faults: Sequence[StoreFault], tested: bool = True, decisive: bool = True) -> Check:
    """A check of so many things, from what was found of it; not tested where the database could not be read."""
    own = [fault for fault in faults if fault.check == name]
    facts = {
        "checked": checked,
        "faults": len(own),
        "first": [(fault.subject, fault.fault, fault.detail) for fault in own[:_FIRST]],
    }
    return Check(name, not own if tested or own else None, facts, decisive=decisive)
