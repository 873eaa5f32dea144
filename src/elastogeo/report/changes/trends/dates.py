"""Where an axis of time has its dates, and how they are written: the same on every computer."""

from __future__ import annotations

from datetime import UTC, datetime

from elastogeo.report.days import moment

_MOST = 6
_MONTHS = (1, 2, 3, 6, 12, 24, 60, 120)
_DAYS = (1, 2, 7, 14)
_DAY = 86_400.0


def date_ticks(first: float, last: float) -> dict[float, str]:
    """The dates to write on an axis of time, at most six, each with its words.

    Parameters
    ----------
    first, last : float [d]
        Since 1970-01-01 UTC.
    """
    for step in _DAYS:
        if (last - first) / step < _MOST:
            return _by_days(first, last, step)
    for step in _MONTHS:
        ticks = _by_months(first, last, step)
        if len(ticks) <= _MOST:
            return ticks
    return {first: f"{moment(first):%Y}", last: f"{moment(last):%Y}"}


def _by_days(first: float, last: float, step: int) -> dict[float, str]:
    days = [float(day) for day in range(int(-(-first // 1)), int(last // 1) + 1, step)]
    dates = {day: at for day in days if (at := moment(day)) is not None}
    new_year = {day for day, at in dates.items() if day == days[0] or at.timetuple().tm_yday <= step}
    return {day: f"{at.day} {at:%b}{f' {at:%Y}' if day in new_year else ''}" for day, at in dates.items()}


def _by_months(first: float, last: float, step: int) -> dict[float, str]:
    start, end = moment(first), moment(last)
    if start is None or end is None:
        return {}
    begins = [
        datetime(month // 12, month % 12 + 1, 1, tzinfo=UTC)
        for month in range(-(-(12 * start.year + start.month - 1) // step) * step, 12 * end.year + end.month, step)
    ]
    found = {at.timestamp() / _DAY: at for at in begins}
    shown = {day: at for day, at in found.items() if first <= day <= last}
    return {day: _month(at, step, day == min(shown)) for day, at in shown.items()}


def _month(at: datetime, step: int, is_first: bool) -> str:
    if step >= 12:
        return f"{at:%Y}"
    return f"{at:%b %Y}" if is_first or at.month == 1 else f"{at:%b}"
