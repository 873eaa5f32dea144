"""The view of a fleet: which machines need somebody, the worst first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from elastogeo.changes import ALARM, MACHINE_STATES, NO_BASELINE, OVERDUE, STEADY, SUSPECT, WATCH, FleetState
from elastogeo.report.changes.fleets.document import fleet_json
from elastogeo.report.changes.fleets.rows import fleet_table, move_said, move_table, predicate_of
from elastogeo.report.changes.words import MARKS, TONES, title_of
from elastogeo.report.days import date_said, simulated_said
from elastogeo.report.later import Later, LaterRows
from elastogeo.report.text import listed
from elastogeo.report.view import Badge, KeyValue, Section, Table, View, views

_MOST_NAMED = 3
MEANINGS = {
    ALARM: "a repeat confirmed a change, or none was made",
    SUSPECT: "repeat the test the same day",
    WATCH: "drifting, or a short baseline",
    STEADY: "as their baselines show them",
    OVERDUE: "due date and grace have gone by",
    NO_BASELINE: "nothing to judge by",
}


@views(FleetState)
def fleet_view(fleet: FleetState) -> View:
    """All that is shown of a fleet."""
    document = Later(lambda: fleet_json(fleet, fleet.machines))
    return answered(fleet, document, fleet_table(fleet, fleet.machines))


def answered(fleet: FleetState, document: Mapping[str, Any], table: Table) -> View:
    """The answer of a fleet, with this document and this table of machines."""
    moves = move_table(fleet)
    tables = (*((moves,) if moves is not None else ()), table) if fleet.machines else ()
    return View(
        kind="Fleet",
        title=_machines(len(fleet.machines)),
        origin=_origin(fleet),
        badge=_badge(fleet),
        head=(("Judged on", date_said(fleet.now)),),
        sentence=_sentence(fleet),
        values=tuple(_values(fleet)),
        alert=tuple(map(move_said, fleet.instruments)),
        document=document,
        rows=LaterRows(lambda: document["rows"]),
        tables=tables,
        sections=(Section("Machines", tables=tables),) if tables else (),
    )


def _origin(fleet: FleetState) -> str:
    """Whether all machines, or which, are simulated."""
    simulated = [row for row in fleet.machines if row.simulated]
    if not simulated:
        return ""
    some = f" ({len(simulated)} of {_machines(len(fleet.machines))})" if len(simulated) < len(fleet.machines) else ""
    said = simulated_said("\n".join(dict.fromkeys(row.simulated for row in simulated)))
    return said.replace("Simulated", f"Simulated{some}", 1)


def _badge(fleet: FleetState) -> Badge | None:
    worst = next((state for state in MACHINE_STATES if fleet.counts.get(state)), None)
    if worst is None:
        return None
    return Badge(MARKS[worst], f"{title_of(worst)}: {_machines(fleet.counts[worst])}", TONES[worst])


def _sentence(fleet: FleetState) -> str:
    if not fleet.machines:
        return "There is no machine yet: add one, then import its tests."
    every = [row for row in fleet.machines if row.state == ALARM]
    bad = [row for row in every if not row.held_by]
    if len(bad) < len(every):
        serials = listed(dict.fromkeys(row.held_by for row in every if row.held_by))
        rest = f"{_machines(len(bad))} {'is' if len(bad) == 1 else 'are'}" if bad else "no machine is"
        return f"Instrument {serials} seems to have changed, not the machines tested with it; {rest} in alarm besides."
    if bad:
        first = f"{bad[0].machine} {predicate_of(bad[0]) or 'has changed'}"
        others = [row.machine for row in bad[1:]]
        if not others:
            return f"{first}; no other machine is in alarm."
        named = listed(others) if len(others) <= _MOST_NAMED else f"{len(others)} others"
        return f"{first}; {named} {'is' if len(others) == 1 else 'are'} in alarm too."
    waiting = [row.machine for row in fleet.machines if row.state == SUSPECT]
    if waiting:
        return f"No machine is in alarm; {listed(waiting[:_MOST_NAMED])} must be tested again."
    late = fleet.counts.get(OVERDUE, 0)
    if late:
        return f"No machine is in alarm; {_machines(late)} {'is' if late == 1 else 'are'} overdue for a test."
    steady = fleet.counts.get(STEADY, 0)
    if steady == len(fleet.machines):
        return f"{'The machine is' if steady == 1 else f'All {steady} machines are'} as the baseline shows."
    return f"No machine is in alarm; {steady} of {_machines(len(fleet.machines))} steady."


def _values(fleet: FleetState) -> Iterator[KeyValue]:
    for state in (ALARM, SUSPECT, WATCH, STEADY, OVERDUE, NO_BASELINE):
        count = fleet.counts.get(state, 0)
        if count or state != SUSPECT:
            yield KeyValue(f"{MARKS[state]} {title_of(state)}", str(count), "", MEANINGS[state])


def _machines(count: int) -> str:
    return f"{count} machine{'' if count == 1 else 's'}"
