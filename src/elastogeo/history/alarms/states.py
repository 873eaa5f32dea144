"""The state of each series as the fleet's page needs it: written whenever a series is assessed, read without judging."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from math import inf, nan
from typing import Any

import numpy as np
from sqlalchemy import Connection, insert, select, update

from elastogeo.changes import (
    ALARM,
    MACHINE_STATES,
    NO_BASELINE,
    OVERDUE,
    ChangeVerdict,
    FleetState,
    IndicatorState,
    MachineRow,
    Prior,
    Rule,
    due_after,
)
from elastogeo.history.alarms.priors import facts_of, number
from elastogeo.history.series_of import days, instant
from elastogeo.history.store.schema import machine, series, series_state

_EXPLAINED = 0.5
"""Of the changes, below which a component is not named as their cause."""
_MOST_NAMED = 3


def keep(connection: Connection, key: int, verdict: ChangeVerdict, prior: Prior | None, live: bool, pending: bool) -> None:
    """Write the state of a series; its version grows only if something changed.

    Parameters
    ----------
    connection : Connection
        Of `write`.
    key : int
        Of the series.
    verdict : ChangeVerdict
    prior : Prior or None
        That it was judged with.
    live : bool
        Whether the verdict is news.
    pending : bool
        Whether the alarm becomes worse if no repeat of the last test says otherwise.
    """
    before = connection.execute(select(series_state).where(series_state.c.series == key)).one_or_none()
    waits = _waits(verdict, live, pending, {} if before is None else before.verdict)
    made = verdict.series
    stands = ~made.aside & np.isfinite(made.value).any(axis=1)
    last = float(made.date[stands][-1]) if stands.any() else None
    due = None if verdict.due is None else verdict.due.at
    values = {
        "state": verdict.state,
        "since": None if verdict.since is None else instant(verdict.since),
        "last_test": None if last is None else instant(last),
        "due": None if due is None else instant(due),
        "verdict": {"row": _row(verdict), "waits": waits, "prior": facts_of(connection, key, made, prior)},
    }
    if before is None:
        connection.execute(insert(series_state).values(series=key, version=1, **values))
    elif any(getattr(before, name) != value for name, value in values.items()):
        changed = update(series_state).where(series_state.c.series == key)
        connection.execute(changed.values(version=before.version + 1, **values))


def fleet_state(connection: Connection, at: datetime) -> FleetState:
    """All machines by their worst series, from what was kept: nothing is judged."""
    now = days(at)
    rows = connection.execute(
        select(
            machine.c.id, machine.c.name, machine.c.place, series.c.name.label("of"), series.c.interval_days,
            series.c.grace_days, series_state.c.state, series_state.c.since, series_state.c.last_test,
            series_state.c.due, series_state.c.verdict,
        )
        .outerjoin(series, series.c.machine == machine.c.id)
        .outerjoin(series_state, series_state.c.series == series.c.id)
        .order_by(machine.c.name, series.c.id)
    )  # fmt: skip
    by_machine: dict[int, list[MachineRow]] = {}
    for row in rows:
        by_machine.setdefault(row.id, []).append(_machine_row(row, now))
    machines = sorted((min(found, key=_worst) for found in by_machine.values()), key=_worst)
    counts = {state: sum(row.state == state for row in machines) for state in MACHINE_STATES}
    counts[OVERDUE] = sum(any(row.overdue > 0 for row in found) for found in by_machine.values())
    return FleetState(now, tuple(machines), counts)


def _worst(row: MachineRow) -> tuple[int, float, str]:
    return MACHINE_STATES.index(row.state), inf if row.since is None else row.since, row.machine


def _machine_row(row: Any, now: float) -> MachineRow:
    """A series of a machine as a row; a machine without one has no baseline."""
    facts = {} if row.verdict is None else row.verdict["row"]
    last = None if row.last_test is None else days(row.last_test)
    late = 0.0 if row.of is None else due_after(last, row.interval_days, row.grace_days, now).overdue
    state = row.state or NO_BASELINE
    if late > 0 and MACHINE_STATES.index(OVERDUE) < MACHINE_STATES.index(state):
        state = OVERDUE
    return MachineRow(
        machine=row.name,
        place=row.place,
        series=row.of or "",
        state=state,
        since=None if row.since is None else days(row.since),
        indicator=facts.get("indicator", ""),
        kind=facts.get("kind", ""),
        unit=facts.get("unit", ""),
        change=_known(facts.get("change")),
        mean=_known(facts.get("mean")),
        change_interval=(_known(facts.get("low")), _known(facts.get("high"))),
        changed_at=facts.get("changed_at"),
        points_to=tuple(facts.get("points_to", ())),
        strip=tuple((name, seen, _known(ratio)) for name, seen, ratio in facts.get("strip", ())),
        last_test=last,
        due=None if row.due is None else days(row.due),
        overdue=late,
        held_by=facts.get("held_by", ""),
        simulated=facts.get("simulated", ""),
    )


def _known(value: float | None) -> float:
    return nan if value is None else value


def _row(verdict: ChangeVerdict) -> dict[str, Any]:
    """What a row of the fleet says of a verdict, as JSON has it."""
    worst = verdict.changed[0] if verdict.changed else None
    point = None if worst is None else worst.change_point or verdict.change_point
    causes = [cause.component for cause in verdict.causes if cause.share >= _EXPLAINED]
    return {
        "indicator": "" if worst is None else worst.name,
        "kind": "" if worst is None else worst.kind.name,
        "unit": "" if worst is None else worst.kind.unit,
        "change": None if worst is None else number(worst.change),
        "mean": None if worst is None else number(worst.mean),
        "low": None if worst is None else number(worst.change_interval[0]),
        "high": None if worst is None else number(worst.change_interval[1]),
        "changed_at": None if point is None else number(point.date),
        "points_to": list(dict.fromkeys(causes))[:_MOST_NAMED],
        "strip": [[one.name, one.state, number(_ratio(verdict, one))] for one in verdict.indicators],
        "held_by": "" if verdict.alarm is None else verdict.alarm.held_by,
        "simulated": verdict.series.simulated,
    }


def _ratio(verdict: ChangeVerdict, one: IndicatorState) -> float:
    """Greatest |T| of the last test that stands over its limit."""
    standing = [step for step in verdict.steps if not step.replaced]
    if not standing:
        return nan
    k = verdict.series.tests.index(standing[-1].test)
    return float(max(abs(one.single[k]), abs(one.running[k])) / one.limit)


def _waits(verdict: ChangeVerdict, live: bool, pending: bool, before: Mapping[str, Any]) -> dict[str, Any] | None:
    """Until when what the charts say waits for a repeat; whether it is news stays with the test that it waits for."""
    if verdict.waiting and verdict.repeat_by is not None:
        asked, until = verdict.waiting, verdict.repeat_by
    elif pending and verdict.state == ALARM:
        asked, until = verdict.steps[-1].test, verdict.steps[-1].date + Rule().wait
    else:
        return None
    was = before.get("waits") or {}
    return {"test": asked, "until": until, "live": live or (was.get("test") == asked and bool(was["live"]))}
