"""Fleets and machines to be shown, made by hand. All are simulated."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from elastogeo.changes import (
    ALARM,
    MACHINE_STATES,
    NO_BASELINE,
    OVERDUE,
    STEADY,
    SUSPECT,
    WATCH,
    DueDate,
    FleetState,
    InstrumentMove,
    MachineRow,
    MachineState,
)
from tests.report.changes.cases import DAY_ONE, guideway, healthy, no_baseline

NOW = DAY_ONE + 1000.0


def row(name, state, since=None, **given):
    """A machine in one row."""
    quiet = {
        "place": "hall 1", "series": "loaded ball bar, XY", "indicator": "", "kind": "", "unit": "", "change": np.nan,
        "mean": np.nan, "change_interval": (np.nan, np.nan), "changed_at": None, "points_to": (), "last_test": NOW - 10,
        "due": NOW + 20, "overdue": 0.0, "simulated": "tests/report/changes/fleet_cases.py",
        "strip": tuple((f"indicator {k}", STEADY, 0.3) for k in range(8)),
    }  # fmt: skip
    return MachineRow(machine=name, state=state, since=since, **{**quiet, **given})


SOFTER = {
    "indicator": "stiffness X",
    "kind": "stiffness",
    "unit": "N/mm",
    "change": -1771.0,
    "mean": 16_100.0,
    "change_interval": (-2000.0, -1500.0),
    "changed_at": NOW - 90,
    "points_to": ("guideway X",),
    "strip": (("stiffness X", ALARM, 2.1), ("straightness X", WATCH, 0.9), *(("other", STEADY, 0.2),) * 6),
}


def fleet_of(*rows, instruments=()):
    """A fleet of rows that come in their order."""
    counts = {state: sum(one.state == state for one in rows) for state in MACHINE_STATES}
    counts[OVERDUE] = sum(one.overdue > 0 for one in rows)
    return FleetState(NOW, tuple(rows), counts, tuple(instruments))


def shop():
    """One machine in every state, the worst first."""
    return fleet_of(
        row("Hermle C50 no. 3", ALARM, NOW - 85, place="hall 2", **SOFTER),
        row("DMU 80", SUSPECT, NOW - 2, **{**SOFTER, "change": 2.2e-3, "mean": 1e-3, "unit": "mm", "kind": "backlash",
            "indicator": "backlash Y", "points_to": ()}),
        row("Huron KX8", OVERDUE, NOW - 12, overdue=12.0, due=NOW - 19),
        row("Mill 4", WATCH),
        row("Mill 5", NO_BASELINE, strip=(), due=None),
        row("Mill 6", STEADY, place="hall 2"),
    )  # fmt: skip


def moved():
    """Three machines that moved alike with one bar, a fourth that did not; their alarms are held back."""
    held = {**SOFTER, "held_by": "LDBB 0042"}
    move = InstrumentMove(
        "LDBB 0042", NOW - 40, ("Mill 1", "Mill 2", "Mill 3"), ("loaded ball bar, XY",) * 3, ("stiffness X", "stiffness Y"),
        (-0.031, -0.029), ((-0.04, -0.02), (-0.04, -0.02)), ("Mill 9",), 0.61,
    )  # fmt: skip
    return fleet_of(
        *(row(f"Mill {k}", ALARM, NOW - 9, **held) for k in (1, 2, 3)), row("Mill 9", STEADY), instruments=(move,)
    )


def large():
    """Two hundred machines with long names."""
    return fleet_of(*(row(f"Machining centre with a long name, number {k}", STEADY) for k in range(200)))


def several_series():
    """A machine with three series: one in alarm, one steady and overdue, one without a baseline."""
    late = replace(healthy(), due=DueDate(NOW - 19, 7.0, "overdue", 12.0))
    late = replace(late, series=replace(late.series, name="ball bar, YZ, R 100 mm"))
    new = no_baseline()
    new = replace(new, series=replace(new.series, name="positioning, X"))
    return MachineState("Hermle C50 no. 3", (guideway(), late, new), ALARM, {"ball bar, YZ, R 100 mm": 12.0}, open_alarms=1)


def overdue():
    """A machine whose one test is late."""
    late = replace(healthy(), due=DueDate(NOW - 19, 7.0, "overdue", 12.0))
    return MachineState("Hermle C50 no. 3", (late,), OVERDUE, {late.series.name: 12.0}, 0)


def untested():
    """A machine without a test."""
    return MachineState("Mill 7", (), NO_BASELINE, {}, 0)


FLEETS = {one.__name__: one for one in (shop, moved, large)}
MACHINES = {one.__name__: one for one in (several_series, overdue, untested)}
