"""The alarm of an instrument: three machines or more that move alike with it. It holds back the alarms of these machines."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import Connection, func, select

from elastogeo.changes import ALARM, SUSPECT, ChangeVerdict, InstrumentMove, instrument_moves
from elastogeo.changes.alarms import CLOSED, HELD, OPEN, AlarmNews
from elastogeo.history.alarms.judging import judged
from elastogeo.history.alarms.life import Step
from elastogeo.history.alarms.open_ones import rows_of, simulated
from elastogeo.history.alarms.outbox import post, withdraw
from elastogeo.history.alarms.rows import Kept, alarms, hold, open_alarm, open_one, take
from elastogeo.history.alarms.states import note_held
from elastogeo.history.series_of import days
from elastogeo.history.store.schema import alarm, alarm_step, calibration, event, instrument, series, series_state, test

LEAST_MACHINES = 3
"""In alarm or suspect with one instrument, below which nothing is looked for."""


def assess_instrument(connection: Connection, key: int, verdict: ChangeVerdict, live: bool, at: datetime) -> bool:
    """Look whether the change of a series is one of the instrument of its last test, and act on it; whether it did.

    All series of the instrument are judged for it, in the transaction of the caller: only if three machines are in alarm or
    suspect with it, and its alarm is not open yet or one of theirs would join it. While three machines are in alarm with it
    for reasons of their own, each further test of theirs that is in alarm or suspect still judges all of them.

    Parameters
    ----------
    connection : Connection
        Of `write`.
    key : int
        Of the series that was just judged.
    verdict : ChangeVerdict
    live : bool
        Whether what is found is news.
    at : datetime
    """
    serial = _last_instrument(verdict)
    if verdict.state not in (ALARM, SUSPECT) or not serial:
        return False
    own = connection.scalar(select(instrument.c.id).where(instrument.c.serial == serial))
    if own is None:
        return False
    since = _since(connection, own)
    if len(_moving(connection, own, since, key)) < LEAST_MACHINES:
        return False
    if open_alarm(connection, instrument=own) is not None and not _would_join(connection, own, since):
        return False
    verdicts = {other: judged(connection, other, at) for other in _tested(connection, own, since) if other != key}
    verdicts[key] = verdict
    known = {} if since is None else {serial: days(since)}
    move = next((one for one in instrument_moves(verdicts.values(), known) if one.instrument == serial), None)
    if move is None:
        return False
    named = {found.series.name: other for other, found in verdicts.items()}
    _act(connection, own, move, [named[name] for name in move.series], live, at)
    return True


def _act(connection: Connection, own: int, move: InstrumentMove, keys: list[int], live: bool, at: datetime) -> None:
    """Open the alarm of the instrument if it is not, and hold back those of the machines that moved."""
    kept = open_alarm(connection, instrument=own)
    is_new = kept is None
    if kept is None:
        facts = {"machines": list(move.machines), "indicators": list(move.indicators), "shifts": list(move.shifts)}
        kept = take(connection, open_one(connection, at, instrument=own), [Step(OPEN, facts)], at)
    for key in keys:
        held = open_alarm(connection, series=key)
        if held is not None and not held.is_held and _is_of(connection, held, own):
            taken = hold(connection, take(connection, held, [Step(HELD)], at), kept.key)
            withdraw(connection, taken, "the alarm of the instrument holds it back")
            note_held(connection, key, move.instrument)
    if is_new and live:
        (row,) = rows_of(connection, [kept], at)
        post(connection, kept, kept.keys[-1], AlarmNews(OPEN, row, None, simulated(connection)), at)


def _is_of(connection: Connection, held: Kept, own: int) -> bool:
    """Whether the test that opened an alarm was made with this instrument."""
    return connection.scalar(select(test.c.instrument).where(test.c.id == held.steps[0].test)) == own


def _would_join(connection: Connection, own: int, since: datetime | None) -> bool:
    """Whether a series with tests by this instrument has an open alarm by such a test that nothing holds back."""
    closed = select(alarm_step.c.alarm).where(alarm_step.c.state.in_(CLOSED))
    waiting = alarms(connection, alarm.c.series.in_(_tested(connection, own, since)), alarm.c.id.not_in(closed))
    return any(not one.is_held and _is_of(connection, one, own) for one in waiting)


def _last_instrument(verdict: ChangeVerdict) -> str:
    if not verdict.steps:
        return ""
    return verdict.series.instruments[verdict.series.tests.index(verdict.steps[-1].test)]


def _since(connection: Connection, own: int) -> datetime | None:
    """When an instrument was last calibrated or repaired, or an alarm of it closed: what was before says nothing new."""
    looked_at = (
        select(func.max(calibration.c.at)).where(calibration.c.instrument == own),
        select(func.max(event.c.at)).where(event.c.instrument == own, event.c.kind.in_(("calibration", "repair"))),
        select(func.max(alarm_step.c.at))
        .join(alarm, alarm.c.id == alarm_step.c.alarm)
        .where(alarm.c.instrument == own, alarm_step.c.state.in_(CLOSED)),
    )
    times = [found for found in map(connection.scalar, looked_at) if found is not None]
    return max(times, default=None)


def _tested(connection: Connection, own: int, since: datetime | None) -> list[int]:
    """The series with tests by an instrument since then."""
    used = select(test.c.series).where(test.c.instrument == own).distinct().order_by(test.c.series)
    return list(connection.scalars(used if since is None else used.where(test.c.at >= since)))


def _moving(connection: Connection, own: int, since: datetime | None, key: int) -> set[int]:
    """The machines among them that were in alarm or suspect when they were last judged, and that of this series."""
    states = select(series.c.machine).join(series_state, series_state.c.series == series.c.id)
    moving = states.where(series.c.id.in_(_tested(connection, own, since)), series_state.c.state.in_((ALARM, SUSPECT)))
    mine = select(series.c.machine).where(series.c.id == key)
    return set(connection.scalars(moving)) | set(connection.scalars(mine))
