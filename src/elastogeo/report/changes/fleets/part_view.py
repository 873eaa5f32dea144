"""The view of the machines of a fleet that fit what is asked for, and of what else can be asked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace

from elastogeo.changes import MACHINE_STATES, FleetPart, MachineRow, states_of
from elastogeo.report.changes.fleets.document import fleet_json
from elastogeo.report.changes.fleets.rows import fleet_table
from elastogeo.report.changes.fleets.view import MEANINGS, answered
from elastogeo.report.changes.words import MARKS, TONES, title_of
from elastogeo.report.later import Later
from elastogeo.report.view import Table, View, views


@views(FleetPart)
def fleet_part_view(part: FleetPart) -> View:
    """All that is shown of it: the answer is that of the whole fleet, the table and the document are of what fits."""
    asked = {"hall": part.place, "model": part.model, "state": part.state}
    document = Later(lambda: fleet_json(part.fleet, part.machines, asked))
    view = answered(part.fleet, document, fleet_table(part.fleet, part.machines, part.first))
    return replace(view, tables=(*view.tables, *_facets(part)), sections=())


def _facets(part: FleetPart) -> tuple[Table, ...]:
    """How many machines of each state, hall and model there are among those that fit the rest of what is asked for."""
    states = _counted(part, "state", states_of)
    rows = tuple((f"{MARKS[state]} {title_of(state)}", str(states[state]), MEANINGS[state]) for state in MACHINE_STATES)
    tones = tuple(TONES[state] for state in MACHINE_STATES)
    strong = tuple(k for k, state in enumerate(MACHINE_STATES) if state == part.state)
    return (
        Table(("state", "machines", ""), rows, (0, 2), strong=strong, name="states", keys=MACHINE_STATES, tones=tones),
        _facet("halls", "hall", _counted(part, "place", lambda row: (row.place,)), part.place),
        _facet("models", "model", _counted(part, "model", lambda row: (row.model,)), part.model),
    )


def _counted(part: FleetPart, which: str, values: Callable[[MachineRow], Iterable[str]]) -> Counter[str]:
    rows = (row for row in part.fleet.machines if part.fits(row, but=which))
    return Counter(value for row in rows for value in values(row) if value)


def _facet(name: str, heading: str, counts: Counter[str], asked: str) -> Table:
    values = tuple(sorted({*counts, *([asked] if asked else [])}))
    strong = tuple(k for k, value in enumerate(values) if value == asked)
    return Table(
        (heading, "machines"), tuple((value, str(counts[value])) for value in values), strong=strong, name=name, keys=values
    )
