"""Assess a series: judge it, and write its state, the steps of its alarm and the messages in one transaction."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime
from math import inf, isfinite

from sqlalchemy import Connection, select

from elastogeo.changes import ALARM, SUSPECT, ChangeVerdict, Rule
from elastogeo.changes.alarms import AlarmNews
from elastogeo.history.alarms.baselines import closed
from elastogeo.history.alarms.instruments import assess_instrument
from elastogeo.history.alarms.judging import judged_with, shown
from elastogeo.history.alarms.life import Found, steps_of
from elastogeo.history.alarms.open_ones import rows_of, simulated
from elastogeo.history.alarms.outbox import post, was_told
from elastogeo.history.alarms.rows import open_alarm, open_one, take
from elastogeo.history.alarms.states import Waiting, keep
from elastogeo.history.alarms.telling import is_live, news
from elastogeo.history.series_of import days, instant
from elastogeo.history.store import Store, now, read, write
from elastogeo.history.store.schema import series_state, test


def assess(store: Store, series: int, live: int | None = None) -> ChangeVerdict:
    """Judge a series and act on it.

    Parameters
    ----------
    store : Store
    series : int
    live : int, optional
        Key of the test that was just imported. Without one (a re-analysis, a test set aside, another baseline) states and
        alarms change, and nobody is told; nor with one that was assessed before.

    Raises
    ------
    InputError
        If there is no such series.
    """
    with write(store) as connection:
        at = now()
        return assessed(connection, series, live is not None and _is_news(connection, series, live, at), at, live)


def assess_waiting(store: Store) -> tuple[ChangeVerdict, ...]:
    """Assess the series whose wait for a repeat is over: time passes without imports. Those that changed."""
    with read(store) as connection:
        waiting = _waiting(connection, now())
    found = []
    for key, live in waiting.items():
        with write(store) as connection:
            if key in _waiting(connection, now()):  # another process may have been quicker
                found.append(assessed(connection, key, live, now()))
    return tuple(found)


def assessed(connection: Connection, key: int, live: bool, at: datetime, by: int | None = None) -> ChangeVerdict:
    """The same in the caller's transaction; `live`: whether what is found is news, `by`: the test that was imported."""
    verdict, prior = judged_with(connection, key, at)
    found = found_of(verdict)
    kept = open_alarm(connection, series=key)
    before = () if kept is None else kept.steps
    was = kept is not None and was_told(connection, kept)
    steps = steps_of(found, before, _cleared(connection, key) if found.alarming and kept is None else None)
    if steps:
        kept = take(connection, kept or open_one(connection, at, series=key), steps, at)
    if assess_instrument(connection, key, verdict, live, at):
        kept = open_alarm(connection, series=key)
    if kept is not None:
        verdict = replace(verdict, alarm=shown(connection, kept))
    place = news(before, steps, found, live, was)
    if kept is not None and place is not None and not kept.is_held:
        (row,) = rows_of(connection, [kept], at)
        told = AlarmNews(kept.steps[place].state, row, verdict, simulated(connection, key))
        post(connection, kept, kept.keys[place], told, at)
    pending = bool(steps_of(replace(found, sure=found.size), () if kept is None else kept.steps)) and verdict.state == ALARM
    keep(connection, key, verdict, prior, Waiting(live, pending, by))
    return verdict


def found_of(verdict: ChangeVerdict) -> Found:
    """What the life of an alarm needs of a verdict."""
    cleared = max((() if verdict.baseline is None else verdict.baseline.cleared), default=-inf)
    standing = [step for step in verdict.steps if not step.replaced and step.date > cleared]
    if not standing:
        return Found(False)
    last, before = standing[-1], standing[-2] if standing[1:] else None
    size = _ratios(verdict, last.test, single=True)
    sure = size
    if verdict.now <= last.date + Rule().wait:
        there = {} if before is None else _ratios(verdict, before.test, single=True)
        sure = {name: min(ratio, there.get(name, 0.0)) for name, ratio in size.items()}
    over, test = _ratios(verdict, last.test), int(last.test)
    return Found(verdict.state == ALARM, over, size, sure, test, instant(last.date), verdict.is_confirmed)


def _ratios(verdict: ChangeVerdict, test: str, single: bool = False) -> dict[str, float]:
    """By indicator that is part of the alarm, how many limits it is away by a test, in either chart or in that of tests."""
    k = verdict.series.tests.index(test)
    found = {}
    for one in verdict.indicators:
        if one.state == ALARM and isfinite(one.single[k]):
            away = abs(one.single[k]) if single else max(abs(one.single[k]), abs(one.running[k]))
            found[one.name] = float(away / one.limit)
    return found


def _is_news(connection: Connection, key: int, by: int, at: datetime) -> bool:
    """Whether a test was just measured when it came, and comes now for the first time."""
    row = connection.execute(select(test.c.at, test.c.imported_at).where(test.c.id == by)).one()
    if not is_live(row.at, row.imported_at) or not is_live(row.at, at):
        return False
    kept = connection.scalar(select(series_state.c.verdict).where(series_state.c.series == key))
    return by not in (kept or {}).get("seen", ())


def _cleared(connection: Connection, key: int) -> datetime | None:
    """Up to when tests of a series were there when its last alarm was closed."""
    return max((one.until for one in closed(connection, key)), default=None)


def _waiting(connection: Connection, at: datetime) -> dict[int, bool]:
    """The series whose wait for a repeat is over, and whether the test that waits was news."""
    rows = connection.execute(
        select(series_state.c.series, series_state.c.verdict).where(series_state.c.state.in_((ALARM, SUSPECT)))
    )
    waits = {row.series: row.verdict["waits"] for row in rows}
    return {key: bool(wait["live"]) for key, wait in waits.items() if wait is not None and days(at) > wait["until"]}
