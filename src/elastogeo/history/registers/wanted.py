"""What people want of the series, as the store keeps it: baselines, tolerances, intervals."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from math import nan
from typing import Any

from sqlalchemy import Connection, Row, func, select

from elastogeo.changes import (
    NO_BASELINE,
    ChangeVerdict,
    SeriesRecord,
    SetBaseline,
    TestOfSeries,
    WantedOfIndicator,
    WantedOfSeries,
)
from elastogeo.errors import InputError
from elastogeo.history.series_of import asides_of, days
from elastogeo.history.store.schema import baseline, machine, series, series_state, test, tolerance


def wanted_of_series(connection: Connection, key: int | None = None) -> tuple[WantedOfSeries, ...]:
    """Of every series, or of one: those without a baseline that holds first, then by machine."""
    counted = select(test.c.series, func.count()).group_by(test.c.series)
    tests: dict[int, int] = {row[0]: row[1] for row in connection.execute(counted)}
    last = {row.series: row for row in connection.execute(select(baseline).order_by(baseline.c.id))}
    limits: dict[int, set[str]] = {}
    for row in connection.execute(_last_tolerances()):
        if (row.lower, row.upper, row.relevance) != (None, None, None):
            limits.setdefault(row.series, set()).add(row.indicator)
    asked = (
        select(
            series,
            machine.c.name.label("machine_name"),
            machine.c.place,
            series_state.c.state,
        )
        .join(machine, machine.c.id == series.c.machine)
        .outerjoin(series_state, series_state.c.series == series.c.id)
        .order_by(machine.c.name, series.c.id)
    )
    rows = connection.execute(asked if key is None else asked.where(series.c.id == key))
    found = [_wanted(row, tests.get(row.id, 0), last.get(row.id), len(limits.get(row.id, ()))) for row in rows]
    return tuple(sorted(found, key=lambda one: one.baseline is not None and one.baseline.holds))


def series_record(connection: Connection, key: int, verdict: ChangeVerdict, at: datetime) -> SeriesRecord:
    """One series, with what its settings are decided from.

    Raises
    ------
    InputError
        If there is no such series.
    """
    found = wanted_of_series(connection, key)
    if not found:
        raise InputError(f"there is no series {key}")
    return SeriesRecord(
        days(at),
        found[0],
        verdict,
        _indicators(connection, key, verdict),
        _tests(connection, key, verdict),
        _baselines(connection, key, found[0]),
    )


def _wanted(row: Row[Any], tests: int, last: Row[Any] | None, limits: int) -> WantedOfSeries:
    state = row.state or NO_BASELINE
    return WantedOfSeries(
        key=row.id,
        machine=row.machine_name,
        machine_key=row.machine,
        place=row.place,
        series=row.name,
        state=state,
        tests=tests,
        baseline=None if last is None else _baseline(last, state != NO_BASELINE),
        limits=limits,
        interval=row.interval_days,
        grace=row.grace_days,
    )


def _baseline(row: Row[Any], holds: bool) -> SetBaseline:
    return SetBaseline(len(row.tests), days(row.set_at), row.who, row.why, holds)


def _baselines(connection: Connection, key: int, of: WantedOfSeries) -> tuple[SetBaseline, ...]:
    rows = connection.execute(select(baseline).where(baseline.c.series == key).order_by(baseline.c.id.desc())).all()
    holds = of.baseline is not None and of.baseline.holds
    return tuple(_baseline(row, holds and not place) for place, row in enumerate(rows))


def _last_tolerances() -> Any:
    last = select(func.max(tolerance.c.id)).group_by(tolerance.c.series, tolerance.c.indicator)
    return select(tolerance).where(tolerance.c.id.in_(last))


def _indicators(connection: Connection, key: int, verdict: ChangeVerdict) -> tuple[WantedOfIndicator, ...]:
    said: Mapping[str, Row[Any]] = {
        row.indicator: row for row in connection.execute(_last_tolerances().where(tolerance.c.series == key))
    }
    found = []
    for one in verdict.indicators:
        row = said.get(one.name)
        found.append(
            WantedOfIndicator(one.name, one.kind)
            if row is None
            else WantedOfIndicator(
                one.name, one.kind, row.lower, row.upper, row.relevance, days(row.set_at), row.who, row.why
            )
        )
    return tuple(found)


def _tests(connection: Connection, key: int, verdict: ChangeVerdict) -> tuple[TestOfSeries, ...]:
    own = set() if verdict.baseline is None else set(verdict.baseline.tests)
    states = {step.test: step.state for step in verdict.steps}
    aside = asides_of(connection, key)
    rows = connection.execute(select(test).where(test.c.series == key).order_by(test.c.at.desc(), test.c.id.desc()))
    return tuple(
        TestOfSeries(
            row.id,
            row.name,
            days(row.at),
            nan if row.temperature is None else row.temperature,
            row.id in aside,
            str(row.id) in own,
            states.get(str(row.id), ""),
        )
        for row in rows
    )
