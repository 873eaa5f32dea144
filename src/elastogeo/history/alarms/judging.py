"""A series of the store, judged: what the charts say, with what only the store knows beside it."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime

from sqlalchemy import Connection, or_, select

from elastogeo.changes import ChangeVerdict, Event, OpenAlarm, Rule, due_of, judge
from elastogeo.changes.alarms import ACKNOWLEDGED
from elastogeo.history.alarms.baselines import baseline_of, tolerances_of
from elastogeo.history.alarms.life import is_acknowledged
from elastogeo.history.alarms.priors import KeptPrior, prior_of
from elastogeo.history.alarms.rows import Kept, alarm_of, open_alarm
from elastogeo.history.series_of import days, series_of
from elastogeo.history.store.schema import calibration, event, instrument, series


def judged(connection: Connection, key: int, at: datetime) -> ChangeVerdict:
    """A series by its charts, with its events, when its next test is due, and its open alarm.

    Raises
    ------
    InputError
        If there is no such series.
    """
    return judged_with(connection, key, at)[0]


def judged_with(connection: Connection, key: int, at: datetime) -> tuple[ChangeVerdict, KeptPrior]:
    """The same, and the scatter of the fleet that it was judged with, to be kept.

    Raises
    ------
    InputError
        If there is no such series.
    """
    made = series_of(connection, key)
    row = connection.execute(select(series).where(series.c.id == key)).one()
    base = baseline_of(connection, key)
    named = set() if base is None else set(base.tests)
    if base is not None and not named <= set(made.tests):  # a new software version has not analysed all of them yet
        base = replace(base, tests=tuple(test for test in base.tests if test in made.tests))
    prior, kept = (None, None) if base is None else prior_of(connection, key, row.software, made)
    wanted = {name: given for name, given in tolerances_of(connection, key).items() if name in made.indicators}
    verdict = judge(made, base, prior, Rule(alpha=row.alpha), days(at), wanted)
    return replace(
        verdict,
        events=events_of(connection, row.machine, made.instruments),
        due=due_of(made, row.interval_days, row.grace_days, days(at)),
        alarm=shown(connection, open_alarm(connection, series=key)),
    ), kept


def events_of(connection: Connection, machine: int, serials: tuple[str, ...]) -> tuple[Event, ...]:
    """What happened to a machine and to the instruments of its tests, in the order of time."""
    used = sorted(set(serials) - {""})
    rows = connection.execute(
        select(event, instrument.c.serial)
        .outerjoin(instrument, instrument.c.id == event.c.instrument)
        .where(or_(event.c.machine == machine, instrument.c.serial.in_(used)))
    )
    found = [Event(row.kind, days(row.at), row.note, row.who, row.serial or "") for row in rows]
    known = {(one.instrument, one.date) for one in found}
    made = connection.execute(
        select(calibration.c.at, calibration.c.certificate, calibration.c.who, instrument.c.serial)
        .join(instrument, instrument.c.id == calibration.c.instrument)
        .where(instrument.c.serial.in_(used))
    )
    found += [
        Event("calibration", days(row.at), row.certificate, row.who, row.serial)
        for row in made
        if (row.serial, days(row.at)) not in known
    ]
    return tuple(sorted(found, key=lambda one: one.date))


def shown(connection: Connection, kept: Kept | None) -> OpenAlarm | None:
    """An open alarm as it stands beside a verdict."""
    if kept is None:
        return None
    known = next((step for step in reversed(kept.steps) if step.state == ACKNOWLEDGED), None)
    if known is None or known.at is None or not is_acknowledged(kept.steps):
        return OpenAlarm(days(kept.opened), held_by=_holder(connection, kept), number=kept.key)
    return OpenAlarm(days(kept.opened), days(known.at), known.who, known.why, _holder(connection, kept), kept.key)


def _holder(connection: Connection, kept: Kept) -> str:
    if not kept.is_held or kept.held_by is None:
        return ""
    by = alarm_of(connection, kept.held_by).instrument
    return connection.scalar(select(instrument.c.serial).where(instrument.c.id == by)) or ""
