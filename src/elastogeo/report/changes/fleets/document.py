"""A fleet as a JSON document, `elastogeo.fleet/1`.

now, counts : when; machines by state, overdue ones also where they are in another state
asked : {hall, model, state}, which rows there are; empty of any
rows : [{id, name, hall, model, series, state, since, sentence, strip, last, due, overdue_days, points_to, held_by,
    simulated}]. The worst first; `strip` [{indicator, state, ratio}], `ratio` of |T| to its limit.
facets : {hall, model, state}, each how many machines of what
instruments : [{serial, since, machines, series, indicators, shifts, shifts95, others, p_value, sentence}]
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from elastogeo.changes import FleetState, MachineRow
from elastogeo.report.changes.fleets.rows import move_said, row_said
from elastogeo.report.days import iso_date
from elastogeo.report.document import document


def fleet_json(
    fleet: FleetState, shown: Sequence[MachineRow], asked: Mapping[str, str] = MappingProxyType({})
) -> dict[str, Any]:
    """The document of a fleet with the rows of these machines."""
    rows = fleet.machines
    return document(
        "elastogeo.fleet/1",
        {
            "now": iso_date(fleet.now),
            "counts": fleet.counts,
            "asked": {facet: asked.get(facet, "") for facet in ("hall", "model", "state")},
            "rows": [_row(row) for row in shown],
            "facets": {
                "hall": _counted(row.place for row in rows),
                "model": _counted(row.model for row in rows),
                "state": _counted(row.state for row in rows),
            },
            "instruments": [
                {
                    "serial": move.instrument,
                    "since": iso_date(move.since),
                    "machines": move.machines,
                    "series": move.series,
                    "indicators": move.indicators,
                    "shifts": move.shifts,
                    "shifts95": move.intervals,
                    "others": move.others,
                    "p_value": move.p_value,
                    "sentence": move_said(move),
                }
                for move in fleet.instruments
            ],
            "simulated": "\n".join(dict.fromkeys(row.simulated for row in rows if row.simulated)),
        },
    )


def _row(row: MachineRow) -> dict[str, Any]:
    return {
        "id": row.key,
        "name": row.machine,
        "hall": row.place,
        "model": row.model,
        "series": row.series,
        "state": row.state,
        "since": iso_date(row.since),
        "sentence": row_said(row),
        "strip": [{"indicator": name, "state": state, "ratio": ratio} for name, state, ratio in row.strip],
        "last": iso_date(row.last_test),
        "due": iso_date(row.due),
        "overdue_days": row.overdue,
        "points_to": row.points_to,
        "held_by": row.held_by,
        "simulated": row.simulated,
    }


def _counted(words: Iterable[str]) -> dict[str, int]:
    return dict(sorted(Counter(word for word in words if word).items()))
