"""What a person does about an alarm: acknowledge it, or close it as repaired or as false. Always with a reason."""

from __future__ import annotations

from sqlalchemy import Connection

from elastogeo.changes.alarms import ACKNOWLEDGED, FALSE, RELEASED, REPAIRED, AlarmList, AlarmNews
from elastogeo.errors import InputError
from elastogeo.history.alarms.assessing import assessed
from elastogeo.history.alarms.baselines import known_at_close
from elastogeo.history.alarms.life import Step, is_acknowledged
from elastogeo.history.alarms.open_ones import rows_of, simulated
from elastogeo.history.alarms.outbox import post, told, withdraw
from elastogeo.history.alarms.rows import Kept, alarm_of, alarms, hold, take
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, write
from elastogeo.history.store.schema import alarm


def acknowledge(store: Store, number: int, who: str, why: str) -> AlarmList:
    """Say that somebody knows of an alarm and what is done. It stays open; if it becomes worse, everybody is told again.

    Raises
    ------
    InputError
        If there is no such alarm, it is closed, or no reason is given.
    """
    _check_reason(why, "acknowledge")
    with write(store) as connection:
        kept = _open(connection, number)
        if is_acknowledged(kept.steps) and kept.steps[-1].who == who and kept.steps[-1].why == why:
            return _as_list(connection, kept)
        kept = take(connection, kept, [Step(ACKNOWLEDGED, who=who, why=why)], now())
        _judge_again(connection, kept)
        return _as_list(connection, kept)


def close(store: Store, number: int, repaired: bool, who: str, why: str) -> AlarmList:
    """Close an alarm: as repaired, so that its series needs a new baseline; or as false, so that it keeps the one it has.

    The alarm of an instrument lets those that it holds go: closed as false they count again by themselves; closed as
    repaired they are closed as false with it, since it was the instrument that changed.

    Raises
    ------
    InputError
        If there is no such alarm, it is closed, or no reason is given.
    """
    _check_reason(why, "close")
    with write(store) as connection:
        kept = _closed(connection, _open(connection, number), REPAIRED if repaired else FALSE, who, why)
        if kept.instrument is not None:
            _let_go(connection, kept, repaired, who)
        return _as_list(connection, kept)


def _closed(connection: Connection, kept: Kept, state: str, who: str, why: str) -> Kept:
    """Close an alarm and tell those who were told of it."""
    at = now()
    knew = told(connection, kept)
    facts = {} if kept.series is None else known_at_close(connection, kept.series)
    kept = take(connection, kept, [Step(state, facts, who=who, why=why)], at)
    withdraw(connection, kept, "the alarm was closed before it was sent")
    post(connection, kept, kept.keys[-1], _news(connection, kept), at, only=knew)
    _judge_again(connection, kept)
    return kept


def _judge_again(connection: Connection, kept: Kept) -> None:
    """What a person does changes the state of the series, and is no news of the machine."""
    if kept.series is not None:
        assessed(connection, kept.series, False, now())


def _let_go(connection: Connection, instrument: Kept, repaired: bool, who: str) -> None:
    why = f"with alarm {instrument.key} of the instrument"
    for held in alarms(connection, alarm.c.held_by == instrument.key):
        if not held.is_open:
            continue
        if repaired:
            _closed(connection, held, FALSE, who, why)
            continue
        at = now()
        freed = hold(connection, take(connection, held, [Step(RELEASED, who=who, why=why)], at), None)
        post(connection, freed, freed.keys[-1], _news(connection, freed), at)
        _judge_again(connection, freed)


def _news(connection: Connection, kept: Kept) -> AlarmNews:
    (row,) = rows_of(connection, [kept], now())
    return AlarmNews(kept.steps[-1].state, row, None, simulated(connection, kept.series))


def _open(connection: Connection, number: int) -> Kept:
    kept = alarm_of(connection, number)
    if not kept.is_open:
        last = kept.steps[-1]
        raise InputError(
            f"alarm {number} was {last.state} by {last.who}: {last.why}; `elastogeo history digest` lists the open ones"
        )
    return kept


def _check_reason(why: str, what: str) -> None:
    if not why.strip():
        raise InputError(f"say why you {what} the alarm: --why 'nut of X replaced'; it is kept with your name")


def _as_list(connection: Connection, kept: Kept) -> AlarmList:
    at = now()
    return AlarmList(days(at), rows_of(connection, [kept], at), (), (), simulated(connection, kept.series), acted=True)
