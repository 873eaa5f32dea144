"""What the check of an audit trail says."""

from __future__ import annotations

from elastogeo.changes import TRAIL_WHOLE
from elastogeo.report.sentences import Facts, says

_FAULTS = {
    "changed": "row {0} was changed",
    "missing": "row {0} was deleted",
    "moved": "row {0} stood at {1}",
    "cut off": "the rows from {0} on were cut off",
    "head missing": "its end, row {0}, is not confirmed",
}


@says(TRAIL_WHOLE)
def trail_whole(facts: Facts, passed: bool | None) -> str:
    """Every row as it was written, or which are not."""
    if passed:
        return f"Every row has the seal of its content and of the row before; rows: {facts['rows']}."
    named = [_FAULTS[fault].format(number, was) for number, fault, was in facts["first"]]
    more = sum(facts["faults"].values()) - len(named)
    rest = f", and {more} more" if more else ""
    return f"Not as it was written: {', '.join(named)}{rest}. Compare it with a backup."
