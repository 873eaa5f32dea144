"""What a series is judged by: its baseline as it holds now, and what a person wants of its indicators."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy import Connection, func, select

from elastogeo.changes import Baseline, Tolerance
from elastogeo.changes.alarms import CLOSED, FALSE, REPAIRED
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import alarm, alarm_step, baseline, test, tolerance

_JUST = timedelta(microseconds=1)
"""As finely as the store keeps time; a date of today in days tells it apart (spacing 0.3 us)."""


def baseline_of(connection: Connection, series: int) -> Baseline | None:
    """The baseline that a person set last, unless an alarm was closed as repaired since: then it holds no more.

    Alarms that were closed as false keep it; the running mean starts anew there.
    """
    row = connection.execute(
        select(baseline).where(baseline.c.series == series).order_by(baseline.c.id.desc()).limit(1)
    ).one_or_none()
    if row is None:
        return None
    ended = closed(connection, series)
    if any(one.state == REPAIRED and one.ends(row.id, row.set_at) for one in ended):
        return None
    cleared = tuple(days(one.until) for one in ended if one.state == FALSE and one.until >= row.since)
    return Baseline(tuple(str(key) for key in row.tests), days(row.since), cleared)


@dataclass(frozen=True, slots=True)
class Closing:
    """How an alarm of a series was closed.

    Attributes
    ----------
    state : str
        `REPAIRED` or `FALSE`.
    at : datetime
        When, by the clock of that computer, which may have been wrong.
    until : datetime
        Up to when tests count as before it: those that the series had then. Steps of old versions do not say: `at`.
    baseline : int or None
        Key of the newest baseline then; 0 if there was none, None where the step does not say.
    """

    state: str
    at: datetime
    until: datetime
    baseline: int | None

    def ends(self, key: int, set_at: datetime) -> bool:
        """Whether a baseline was set before: by its key, since clocks go wrong; by time where the step does not say."""
        return self.at >= set_at if self.baseline is None else self.baseline >= key


def closed(connection: Connection, series: int) -> tuple[Closing, ...]:
    """How and when alarms of a series were closed."""
    rows = connection.execute(
        select(alarm_step.c.state, alarm_step.c.at, alarm_step.c.facts)
        .join(alarm, alarm.c.id == alarm_step.c.alarm)
        .where(alarm.c.series == series, alarm_step.c.state.in_(CLOSED))
        .order_by(alarm_step.c.id)
    ).all()
    return tuple(
        Closing(row.state, row.at, _until(connection, series, row.facts.get("test"), row.at), row.facts.get("baseline"))
        for row in rows
    )


def known_at_close(connection: Connection, series: int) -> dict[str, int]:
    """Keys of the newest baseline and the newest test of a series, 0 if there is none: what comes later has a higher one."""
    newest = {
        "baseline": select(func.max(baseline.c.id)).where(baseline.c.series == series),
        "test": select(func.max(test.c.id)).where(test.c.series == series),
    }
    return {name: connection.scalar(asked) or 0 for name, asked in newest.items()}


def _until(connection: Connection, series: int, newest: int | None, at: datetime) -> datetime:
    """Just after the last test that the series had when its alarm was closed."""
    if not newest:
        return at
    last = connection.scalar(select(func.max(test.c.at)).where(test.c.series == series, test.c.id <= newest))
    return at if last is None else last + _JUST


def tolerances_of(connection: Connection, series: int) -> dict[str, Tolerance]:
    """By indicator what a person wants of it, as it was said last."""
    rows = connection.execute(select(tolerance).where(tolerance.c.series == series).order_by(tolerance.c.id))
    return {row.indicator: Tolerance(row.lower, row.upper, row.relevance) for row in rows}
