"""The words of alarms: states, how far off."""

from __future__ import annotations

from collections.abc import Mapping

from elastogeo.changes.alarms import AlarmRow
from elastogeo.report.days import iso_date
from elastogeo.report.numbers import significant


def of_what(row: AlarmRow) -> str:
    """Machine and series, or the instrument, that an alarm is of."""
    return f"instrument {row.instrument}" if row.instrument else f"{row.machine}, {row.series}"


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
        "opened": iso_date(row.opened),
        "over": dict(row.over),
        "confirmed": row.confirmed,
        "who": row.who or None,
        "why": row.why or None,
        "at": iso_date(row.at),
        "holds": list(row.holds),
        "silent_until": iso_date(row.silent_until),
        "simulated": row.simulated or None,
    }
