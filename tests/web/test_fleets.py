"""The fleet that the tests of the pages look at: every state that a machine can be in, and nothing that was measured."""

from __future__ import annotations

from pathlib import Path

from elastogeo.changes import ALARM, NO_BASELINE, OVERDUE, SUSPECT
from elastogeo.history import History
from tests.web.fleets import ALARMED, LATE, SUSPECTED, VARIED


def test_the_fleet_has_the_states_that_the_pages_show(fleet: Path) -> None:
    with History(fleet) as history:
        states = {one.machine: one.state for one in history.fleet().machines}
        kept = history.campaigns(VARIED).campaigns, history.plans(VARIED).plans
    assert (states[ALARMED.name], states[SUSPECTED.name]) == (ALARM, SUSPECT)
    assert states[LATE.name] == OVERDUE
    assert states[VARIED] == NO_BASELINE
    assert list(map(len, kept)) == [1, 1]
