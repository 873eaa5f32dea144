"""Days since 1970 as a person and as JSON has them, and from what tests of many days are simulated."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from math import ceil, isfinite

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
_LAST_DAY = 2_900_000.0
"""Days since 1970 that a calendar holds."""
_MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")


def moment(day: float) -> datetime | None:
    """A date [d] as a calendar has it; none of what no calendar has."""
    return _EPOCH + timedelta(days=day) if isfinite(day) and abs(day) < _LAST_DAY and day > -_LAST_DAY / 4 else None


def date_said(day: float | None) -> str:
    """`11 June 2026`; empty for none."""
    at = None if day is None else moment(day)
    return "" if at is None else f"{at.day} {at:%B %Y}"


def short_date(day: float | None) -> str:
    """`11 Jun 2026`, for tables; empty for none."""
    at = None if day is None else moment(day)
    return "" if at is None else f"{at.day} {_MONTHS[at.month - 1]} {at.year}"


def month_said(day: float) -> str:
    """`April 2027`; `later than any date` of what no calendar has."""
    at = moment(day)
    return "later than any date" if at is None else f"{at:%B %Y}"


def moment_said(day: float | None) -> str:
    """`11 Jun 2026 08:30 UTC`; empty for none."""
    at = None if day is None else moment(day)
    return "" if at is None else f"{at.day} {at:%b %Y %H:%M} UTC"


def iso_date(day: float | None) -> str | None:
    """As JSON has it: `2026-06-11T08:00:00Z`; none for none."""
    at = None if day is None else moment(day)
    return None if at is None else f"{at:%Y-%m-%dT%H:%M:%SZ}"


def days_said(days: float) -> str:
    """A duration in whole days, a part of a day as a whole one."""
    whole = max(ceil(days - 1e-9), 0)
    return f"{whole} day{'' if whole == 1 else 's'}"


def origin_said(kind: str, what: str) -> str:
    """`Simulated from ...`: the kind said once, as files often begin with it themselves; empty for nothing.

    Parameters
    ----------
    kind : str
        `simulated` or `reconstructed`, and which of several.
    what : str
        As the file says it: `Not measured: simulated from ...`.
    """
    said = re.sub(r"^not measured\W+", "", what.strip(), flags=re.IGNORECASE)
    word = kind.split()[0]
    rest = said[len(word) :] if said.casefold().startswith(word) else f": {said}"
    return f"{kind[:1].upper()}{kind[1:]}{rest}" if said else ""


def simulated_said(simulated: str) -> str:
    """From what tests are simulated: of many simulations the first and how many more there are; empty for none."""
    first, *others = simulated.split("\n")
    more = f" and {len(others)} more" if others else ""
    return f"{origin_said('simulated', first).rstrip('.')}{more}" if simulated else ""
