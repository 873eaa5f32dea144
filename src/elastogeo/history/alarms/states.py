"""The state of each series as the fleet's page needs it: written whenever a series is assessed, read without judging."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from math import nan
from typing import Any

import numpy as np
from sqlalchemy import Connection, Row, insert, select, update

from elastogeo.changes import (
    ALARM,
    NO_BASELINE,
    ChangeVerdict,
    FleetState,
    InstrumentMove,
    MachineRow,
    Rule,
    fleet_state,
    machine_row,
)
from elastogeo.history.alarms.priors import KeptPrior
from elastogeo.history.alarms.rows import alarms
from elastogeo.history.series_of import days, instant
from elastogeo.history.store.schema import alarm, instrument, machine, series, series_state

SEEN = 24
"""Tests of a series, the last that were assessed, which are no news when they come again."""


@dataclass(frozen=True, slots=True)
class Waiting:
    """What a later assessment must know of this one.

    Attributes
    ----------
    live : bool
        Whether the verdict is news.
    pending : bool
        Whether the alarm becomes worse if no repeat of the last test says otherwise.
    by : int or None
        The test that was imported.
    """

    live: bool
    pending: bool
    by: int | None = None


def keep(connection: Connection, key: int, verdict: ChangeVerdict, prior: KeptPrior, waiting: Waiting) -> None:
    """Write the state of a series; its version grows only if something changed.

    Parameters
    ----------
    connection : Connection
        Of `write`.
    key : int
        Of the series.
    verdict : ChangeVerdict
    prior : dict or None
        That it was judged with.
    waiting : Waiting
    """
    before = connection.execute(select(series_state).where(series_state.c.series == key)).one_or_none()
    was = {} if before is None else before.verdict
    seen = list(was.get("seen", ()))
    if waiting.by is not None and waiting.by not in seen:
        seen = [*seen, waiting.by][-SEEN:]
    made = verdict.series
    stands = ~made.aside & np.isfinite(made.value).any(axis=1)
    last = float(made.date[stands][-1]) if stands.any() else None
    due = None if verdict.due is None else verdict.due.at
    values = {
        "state": verdict.state,
        "since": None if verdict.since is None else instant(verdict.since),
        "last_test": None if last is None else instant(last),
        "due": None if due is None else instant(due),
        "verdict": {
            "row": replace(machine_row(verdict), overdue=0.0).document(),
            "waits": _waits(verdict, waiting, was),
            "prior": prior,
            "seen": seen,
        },
    }
    if before is None:
        connection.execute(insert(series_state).values(series=key, version=1, **values))
    elif any(getattr(before, name) != value for name, value in values.items()):
        changed = update(series_state).where(series_state.c.series == key)
        connection.execute(changed.values(version=before.version + 1, **values))


def note_held(connection: Connection, key: int, serial: str) -> None:
    """Note in the state of a series which instrument's alarm holds its alarm back."""
    before = connection.execute(select(series_state).where(series_state.c.series == key)).one_or_none()
    if before is not None:
        kept = before.verdict | {"row": before.verdict["row"] | {"held_by": serial}}
        changed = update(series_state).where(series_state.c.series == key)
        connection.execute(changed.values(version=before.version + 1, verdict=kept))


def fleet(connection: Connection, at: datetime) -> FleetState:
    """All machines by their worst series, from what was kept when they were assessed: nothing is judged."""
    found = state_rows(connection)
    return fleet_state(found, days(at), _moves(connection, found))


def state_rows(connection: Connection, of: int | None = None) -> list[MachineRow]:
    """Every series of every machine, or of one, as it was kept when it was assessed; a machine without any is one row."""
    asked = (
        select(machine, series.c.id.label("series"), series.c.name.label("of"), series_state.c.verdict)
        .outerjoin(series, series.c.machine == machine.c.id)
        .outerjoin(series_state, series_state.c.series == series.c.id)
        .order_by(machine.c.name, series.c.id)
    )
    rows = connection.execute(asked if of is None else asked.where(machine.c.id == of))
    return [_machine_row(row) for row in rows]


def _moves(connection: Connection, rows: Iterable[MachineRow]) -> tuple[InstrumentMove, ...]:
    """The instruments whose alarms are open: the machines whose alarms they hold back, and what moved when they opened."""
    held: dict[str, list[str]] = {}
    for row in rows:
        held.setdefault(row.held_by, []).append(row.machine)
    serials = dict(connection.execute(select(instrument.c.id, instrument.c.serial)).all())
    found = []
    for kept in alarms(connection, alarm.c.instrument.is_not(None)):
        if kept.is_open and kept.instrument is not None:
            serial, facts = serials[kept.instrument], kept.steps[0].facts
            names, shifts = tuple(facts["indicators"]), tuple(facts["shifts"])
            machines = tuple(dict.fromkeys(held.get(serial) or facts["machines"]))
            found.append(InstrumentMove(serial, nan, machines, (), names, shifts, ((nan, nan),) * len(names), (), nan))
    return tuple(found)


_NO_TEST = MachineRow("", "", "", NO_BASELINE, None, "", "", "", nan, nan, (nan, nan), None, (), (), None, None, 0.0)
_UNKNOWN = _NO_TEST.document()


def _machine_row(row: Row[Any]) -> MachineRow:
    """A series of a machine as a row; one that was never assessed, or a machine without any, has no baseline."""
    named = {
        "machine": row.name,
        "place": row.place,
        "series": row.of or "",
        "model": row.kind,
        "key": row.id,
        "series_key": row.series,
    }
    return MachineRow.of_document({**(_UNKNOWN if row.verdict is None else row.verdict["row"]), **named})


def _waits(verdict: ChangeVerdict, waiting: Waiting, before: Mapping[str, Any]) -> dict[str, Any] | None:
    """Until when what the charts say waits for a repeat; whether it is news stays with the test that it waits for."""
    if verdict.waiting and verdict.repeat_by is not None:
        asked, until = verdict.waiting, verdict.repeat_by
    elif waiting.pending and verdict.state == ALARM:
        asked, until = verdict.steps[-1].test, verdict.steps[-1].date + Rule().wait
    else:
        return None
    was = before.get("waits") or {}
    return {"test": asked, "until": until, "live": waiting.live or (was.get("test") == asked and bool(was["live"]))}
