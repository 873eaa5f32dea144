"""Machines and fleets: the worst first, overdue by the date, and a row that survives being kept."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np

from elastogeo.changes import (
    ALARM,
    NO_BASELINE,
    OVERDUE,
    STEADY,
    SUSPECT,
    WATCH,
    ChangeVerdict,
    MachineRow,
    OpenAlarm,
    due_after,
    fleet_state,
    judge,
    machine_row,
    machine_shown,
    machine_state,
)
from tests.changes.simulated_series import baseline_of, series_of, stepped

LAST = 20000.0 + 30 * 15


def verdict(state: str, machine: str = "M", interval: float | None = 30.0, now: float = LAST) -> ChangeVerdict:
    """A machine in this state; its next test is due an interval after its last, with a week's grace."""
    size = {ALARM: -9.0, SUSPECT: -9.0}.get(state, 0.0)
    off = np.vstack(
        [
            np.random.default_rng(3).standard_normal((10, 4)),
            stepped(5 if state == SUSPECT else 2, 1 if state == SUSPECT else 4, size),
        ]
    )
    series = replace(series_of(off), machine=machine, name=f"{machine}: circle")
    tests = {NO_BASELINE: 0, WATCH: 4}.get(state, 10)
    found = judge(series, baseline_of(series, tests) if tests else None, now=LAST)
    assert found.state == state
    return replace(found, due=due_after(float(series.date[-1]), interval, 7.0, now))


def test_a_machine_is_in_the_worst_state_of_its_series() -> None:
    found = machine_state("M", [verdict(STEADY), verdict(ALARM), verdict(SUSPECT)])
    assert found.state == ALARM
    assert [one.state for one in found.series] == [ALARM, SUSPECT, STEADY]
    assert machine_state("M", []).state == NO_BASELINE


def test_a_series_without_a_baseline_says_nothing_of_those_that_are_watched() -> None:
    """A campaign adds circles that nobody goes on to watch."""
    once, watched = verdict(NO_BASELINE), verdict(STEADY)
    found = machine_state("M", [once, watched])
    assert found.state == STEADY
    assert [one.state for one in found.series] == [STEADY, NO_BASELINE]
    rows = [machine_row(once), machine_row(watched)]
    for given in (rows, rows[::-1]):
        assert [row.state for row in fleet_state(given, LAST).machines] == [STEADY]
        assert [row.state for row in machine_shown("M", [], given, LAST).rows] == [STEADY, NO_BASELINE]


def test_an_overdue_test_is_worse_than_steady_and_no_alarm() -> None:
    late = verdict(STEADY, now=LAST + 60)
    assert machine_state("M", [late]).state == OVERDUE
    assert machine_state("M", [late]).overdue == {"M: circle": 60 - 30 - 7.0}
    assert machine_state("M", [late, verdict(ALARM)]).state == ALARM


def test_a_held_alarm_names_its_instrument() -> None:
    held = replace(verdict(ALARM), alarm=OpenAlarm(LAST, held_by="bar 7"))
    found = machine_state("M", [held])
    assert (found.open_alarms, found.held_by) == (1, "bar 7")


def test_a_row_survives_being_kept_as_json() -> None:
    for state in (ALARM, SUSPECT, WATCH, STEADY, NO_BASELINE):
        row = machine_row(verdict(state), place="hall 2")
        assert MachineRow.of_document(json.loads(json.dumps(row.document(), allow_nan=False))) == row


def test_a_row_shows_what_changed_most() -> None:
    row = machine_row(verdict(ALARM))
    assert (row.state, row.indicator, row.kind) == (ALARM, "stiffness X", "stiffness")
    assert row.change_interval[0] < row.change < row.change_interval[1] < 0
    assert [name for name, _, _ in row.strip] == ["stiffness X", "stiffness Y", "squareness XY", "backlash X"]
    assert row.strip[0][2] > 1 > row.strip[1][2]
    assert machine_row(verdict(STEADY)).indicator == ""


def test_a_fleet_lists_the_worst_first_and_counts_each_state() -> None:
    rows = [
        machine_row(verdict(state, f"{k} {state}"))
        for k, state in enumerate((STEADY, ALARM, WATCH, NO_BASELINE, SUSPECT, STEADY))
    ]
    found = fleet_state(rows, LAST)
    assert [row.state for row in found.machines] == [ALARM, SUSPECT, WATCH, NO_BASELINE, STEADY, STEADY]
    assert found.counts == {ALARM: 1, SUSPECT: 1, OVERDUE: 0, WATCH: 1, NO_BASELINE: 1, STEADY: 2}


def test_a_row_that_was_made_in_time_is_overdue_later() -> None:
    rows = [
        machine_row(verdict(STEADY, "late")),
        machine_row(verdict(ALARM, "both")),
        machine_row(verdict(STEADY, "never", None)),
    ]
    found = fleet_state(rows, LAST + 60)
    assert {row.machine: row.state for row in found.machines} == {"both": ALARM, "late": OVERDUE, "never": STEADY}
    assert found.counts[OVERDUE] == 2, "a machine in alarm can be overdue too"
    assert found.machines[1].overdue == 60 - 30 - 7
    assert found.machines[1].since == LAST + 30


def test_several_series_of_one_machine_are_one_row_and_all_its_alarms() -> None:
    alarm = machine_row(replace(verdict(ALARM), alarm=OpenAlarm(LAST)))
    for rows in ([alarm, machine_row(verdict(STEADY)), alarm], [machine_row(verdict(STEADY)), alarm, alarm]):
        found = fleet_state(rows, LAST)
        assert [(row.machine, row.state, row.open_alarms) for row in found.machines] == [("M", ALARM, 2)]


def test_an_empty_fleet_counts_nothing() -> None:
    assert fleet_state([], LAST).machines == ()
    assert not any(fleet_state([], LAST).counts.values())
