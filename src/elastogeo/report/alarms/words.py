"""The words of alarms: states with their marks, what changed, since when, how sure."""

from __future__ import annotations

from collections.abc import Mapping

from elastogeo.changes.alarms import CLOSED, AlarmRow
from elastogeo.report.changes.answers import component_said
from elastogeo.report.changes.fleets.rows import change_of
from elastogeo.report.days import date_said, iso_date
from elastogeo.report.numbers import significant
from elastogeo.report.text import listed

_NAMED = 2
"""Components that one line names."""


def of_what(row: AlarmRow) -> str:
    """Machine and series, or the instrument, that an alarm is of."""
    return f"instrument {row.instrument}" if row.instrument else f"{row.machine}, {row.series}"


def over_said(over: Mapping[str, float]) -> str:
    """`stiffness X 1.8 times its limit, squareness XY 1.2`, the furthest first."""
    ordered = sorted(over.items(), key=lambda item: -item[1])
    said = [f"{name} {significant(ratio, 2)}" for name, ratio in ordered]
    return ", ".join((f"{said[0]} times its limit", *said[1:])) if said else ""


def marked(state: str) -> str:
    """A state in words and shape: `■ open`. What is open has one shape, what is closed another."""
    return f"{'●' if state in CLOSED else '■'} {state}"


def change_said(row: AlarmRow) -> str:
    """What changed, short: `11 % softer in X`; how far off it is where the series does not say it now."""
    if row.instrument:
        return (
            f"{counted(len(row.holds), 'machine')} moved alike: {listed(row.holds)}" if row.holds else "machines moved alike"
        )
    return (change_of(row.shown) if row.shown is not None else "") or over_said(row.over)


def since_said(row: AlarmRow) -> str:
    """Since when it has changed; when the alarm was opened where that is not known; empty for an instrument."""
    shown = row.shown
    if row.instrument:
        return ""
    return date_said(row.opened if shown is None else shown.changed_at or shown.since or row.opened)


def sure_said(row: AlarmRow) -> str:
    """How sure it is: `confirmed by a second test; 5 tests since`."""
    if row.instrument:
        return ""
    sure = "confirmed by a second test" if row.confirmed else "no second test confirms it"
    since = row.shown.tests_since if row.shown is not None else 0
    return f"{sure}; {counted(since, 'test')} since" if since else sure


def points_said(row: AlarmRow) -> str:
    """What it points to; empty where nothing is known."""
    named = row.shown.points_to if row.shown is not None else ()
    return " or ".join(component_said(name) for name in named[:_NAMED])


def person_said(row: AlarmRow) -> str:
    """Who did what about it last, and why: `A. Miller: nut is ordered`."""
    return f"{row.who}: {row.why}" if row.who else ""


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
        "place": row.place or None,
        "since": None if row.shown is None else iso_date(row.shown.changed_at or row.shown.since),
        "points_to": [] if row.shown is None else list(row.shown.points_to),
        "held_by": row.held_by,
        "simulated": row.simulated or None,
    }
