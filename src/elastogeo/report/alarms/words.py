"""The words of alarms: dates, states, how far off."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime, timedelta

from elastogeo.changes.alarms import AlarmRow
from elastogeo.report.numbers import significant

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def date_said(day: float) -> str:
    """`11 June 2026`, of days since 1970-01-01 UTC."""
    at = _EPOCH + timedelta(days=day)
    return f"{at.day} {at:%B %Y}"


def moment_said(day: float) -> str:
    """`11 Jun 2026 08:30 UTC`."""
    at = _EPOCH + timedelta(days=day)
    return f"{at.day} {at:%b %Y %H:%M} UTC"


def iso(day: float | None) -> str | None:
    """As JSON has it: `2026-06-11T08:00:00Z`; none for none."""
    return None if day is None else f"{_EPOCH + timedelta(days=day):%Y-%m-%dT%H:%M:%SZ}"


def of_what(row: AlarmRow) -> str:
    """Machine and series, or the instrument, that an alarm is of."""
    return f"instrument {row.instrument}" if row.instrument else f"{row.machine}, {row.series}"


def simulated_said(simulated: str) -> str:
    """From what tests are simulated: of many simulations the first and how many more there are; empty for none."""
    first, *others = simulated.split("; ")
    return f"Simulated: {first}{f' and {len(others)} more' if others else ''}" if simulated else ""


def over_said(over: Mapping[str, float]) -> str:
    """`stiffness X 1.8 times its limit, squareness XY 1.2`, the furthest first."""
    ordered = sorted(over.items(), key=lambda item: -item[1])
    said = [f"{name} {significant(ratio, 2)}" for name, ratio in ordered]
    return ", ".join((f"{said[0]} times its limit", *said[1:])) if said else ""


def counted(number: int, noun: str) -> str:
    """`1 alarm`, `3 alarms`, `no alarm`."""
    return f"{number or 'no'} {noun}{'' if number in (0, 1) else 's'}"


def entry(row: AlarmRow) -> dict[str, object]:
    """An alarm as JSON has it."""
    return {
        "number": row.number,
        "machine": row.machine or None,
        "series": row.series or None,
        "instrument": row.instrument or None,
        "state": row.state,
        "opened": iso(row.opened),
        "over": dict(row.over),
        "confirmed": row.confirmed,
        "who": row.who or None,
        "why": row.why or None,
        "at": iso(row.at),
        "holds": list(row.holds),
        "silent_until": iso(row.silent_until),
        "simulated": row.simulated or None,
    }
