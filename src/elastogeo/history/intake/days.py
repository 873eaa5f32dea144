"""When a test was measured, or something happened: what a person or a file says -> a point in time, or a refusal."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, date, datetime, time, timedelta

from elastogeo.errors import InputError

EARLIEST = datetime(1980, 1, 1, tzinfo=UTC)
"""No such test is older: an earlier date is a slip, or a clock that was never set."""

AHEAD = timedelta(hours=1)
"""By so much the clock of an instrument may run before this computer's."""

FARTHEST = timedelta(hours=14)
"""The zone that is farthest before UTC: a time without a zone may be that much ahead."""


@dataclass(frozen=True, slots=True)
class Day:
    """A point in time, as it was said.

    Attributes
    ----------
    at : datetime
        UTC; of a day without a time of day its noon.
    zone : str
        As it was said, `+01:00`; empty if it was not: it then counts as UTC.
    whole : bool
        Whether only the day was said.
    """

    at: datetime
    zone: str = ""
    whole: bool = False


def day_of(text: str, where: str, now: datetime) -> Day:
    """The point in time that a date says.

    Parameters
    ----------
    text : str
        `2026-03-01`, `2026-03-01T14:30`, `2026-03-01T14:30:00+01:00`.
    where : str
        Who says it, for the message.
    now : datetime

    Raises
    ------
    InputError
        If it is no date, is before 1980, or lies in the future.
    """
    found = _read(text.strip(), where)
    latest = now + AHEAD + (timedelta() if found.zone else FARTHEST)
    earliest = found.at - timedelta(hours=12) if found.whole else found.at
    if found.at < EARLIEST:
        raise InputError(f"{where} is {text}; nothing was measured then: write the date as 2026-03-01")
    if earliest > latest:
        raise InputError(
            f"{where} is {text}, which is in the future: it is {now:%Y-%m-%d %H:%M} UTC by the clock of this computer; "
            f"correct the date, or the clock"
        )
    return found


def ends_of_day(text: str, where: str, now: datetime) -> tuple[datetime, datetime]:
    """When what a date says begins and ends: a whole day, or a moment.

    Raises
    ------
    InputError
        If it is no date.
    """
    day = day_of(text, where, now)
    half = timedelta(hours=12) if day.whole else timedelta()
    return day.at - half, day.at + half


def _read(text: str, where: str) -> Day:
    try:
        if len(text) <= len("2026-03-01"):
            return Day(datetime.combine(date.fromisoformat(text), time(12), UTC), whole=True)
        said = datetime.fromisoformat(text)
        at = said.replace(tzinfo=UTC) if said.tzinfo is None else said.astimezone(UTC)
    except (ValueError, OverflowError):  # the first and the last day of the calendar are of no year in another zone
        raise InputError(
            f"{where} is {text[:40]!r}; write it as 2026-03-01, or with time and zone as 2026-03-01T14:30+01:00"
        ) from None
    if said.tzinfo is None:
        return Day(at)
    minutes = round((said.utcoffset() or timedelta()).total_seconds() / 60)
    hours, rest = divmod(abs(minutes), 60)
    return Day(at, f"{'-' if minutes < 0 else '+'}{hours:02d}:{rest:02d}")
