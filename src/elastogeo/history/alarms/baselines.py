"""What a series is judged by: its baseline as it holds now, and what a person wants of its indicators."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import Connection, select

from elastogeo.changes import Baseline, Tolerance
from elastogeo.changes.alarms import CLOSED, FALSE, REPAIRED
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import alarm, alarm_step, baseline, tolerance


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
    if any(state == REPAIRED and at >= row.set_at for state, at in ended):
        return None
    cleared = tuple(days(at) for state, at in ended if state == FALSE and at >= row.since)
    return Baseline(tuple(str(key) for key in row.tests), days(row.since), cleared)


def closed(connection: Connection, series: int) -> tuple[tuple[str, datetime], ...]:
    """How and when alarms of a series were closed."""
    rows = connection.execute(
        select(alarm_step.c.state, alarm_step.c.at)
        .join(alarm, alarm.c.id == alarm_step.c.alarm)
        .where(alarm.c.series == series, alarm_step.c.state.in_(CLOSED))
        .order_by(alarm_step.c.id)
    )
    return tuple((row.state, row.at) for row in rows)


def tolerances_of(connection: Connection, series: int) -> dict[str, Tolerance]:
    """By indicator what a person wants of it, as it was said last."""
    rows = connection.execute(select(tolerance).where(tolerance.c.series == series).order_by(tolerance.c.id))
    return {row.indicator: Tolerance(row.lower, row.upper, row.relevance) for row in rows}
