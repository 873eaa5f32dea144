"""The demo fleet, lived through: each fault is found in time, the healthy machine is silent, nobody is told of old tests."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime

import pytest
from sqlalchemy import func, select

from elastogeo.changes import ALARM
from elastogeo.history import History
from elastogeo.history.alarms import add_recipient
from elastogeo.history.fleets.living import Lived, live
from elastogeo.history.fleets.stories import EVERY, FLEET, RECALIBRATED, RECALIBRATED_AFTER, Story, softened, worn
from elastogeo.history.store import read
from elastogeo.history.store.schema import alarm, instrument, machine, outbox, series, test

YEARS = 2.4
"""Until the last of the faults is there; the demo goes on for some months."""


@dataclass(frozen=True)
class Fleet:
    history: History
    lived: list[Lived]

    def first_alarm(self, name: str) -> float:
        """Days from the first test of the fleet to the one after which a machine's series is in alarm."""
        begin = self.lived[0].at
        at = next(one.at for one in self.lived if one.machine == name and one.state == ALARM)
        return (at - begin).total_seconds() / 86400


@pytest.fixture(scope="module")
def fleet(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Fleet]:
    with History(tmp_path_factory.mktemp("fleet") / "fleet.db", create=True, who="demo") as history:
        add_recipient(history.store, "log", str(tmp_path_factory.mktemp("told") / "alarms.log"), history.who)
        yield Fleet(history, list(live(history, datetime(2026, 11, 20, tzinfo=UTC), years=YEARS)))


def machine_with(kind: str) -> Story:
    return next(story for story in FLEET for fault in story.faults if fault.kind == kind)


def test_the_guideway_is_found_before_six_per_cent_of_loss(fleet: Fleet) -> None:
    story = machine_with("guideway")
    assert 0 < softened(story, fleet.first_alarm(story.name)) < 0.06


def test_the_nut_is_found_before_three_micrometres(fleet: Fleet) -> None:
    story = machine_with("nut")
    assert 0 < worn(story, fleet.first_alarm(story.name)) < 3e-3


def test_the_collision_is_found_by_the_next_test(fleet: Fleet) -> None:
    story = machine_with("collision")
    assert story.faults[0].after <= fleet.first_alarm(story.name) < story.faults[0].after + EVERY + 1


def test_the_healthy_machine_is_silent(fleet: Fleet) -> None:
    healthy = [story.name for story in FLEET if not story.faults and story.bar != RECALIBRATED]
    assert healthy
    assert ALARM not in {one.state for one in fleet.lived if one.machine in healthy}


def test_machines_that_moved_with_the_recalibrated_bar_are_one_alarm_on_it(fleet: Fleet) -> None:
    with read(fleet.history.store) as connection:
        (of_bar,) = connection.execute(
            select(alarm.c.id, instrument.c.serial).join(instrument, instrument.c.id == alarm.c.instrument)
        ).all()
        held = connection.execute(
            select(machine.c.name)
            .join(series, series.c.machine == machine.c.id)
            .join(alarm, alarm.c.series == series.c.id)
            .where(alarm.c.held_by == of_bar.id)
        ).scalars()
        assert set(held) == {story.name for story in FLEET if story.bar == RECALIBRATED}
    assert of_bar.serial == RECALIBRATED
    assert min(fleet.first_alarm(story.name) for story in FLEET if story.bar == RECALIBRATED) >= RECALIBRATED_AFTER


def test_nobody_is_told_of_tests_that_were_old_when_they_came_in(fleet: Fleet) -> None:
    with read(fleet.history.store) as connection:
        assert connection.scalar(select(func.count()).select_from(alarm)) > 0
        assert connection.scalar(select(func.count()).select_from(outbox)) == 0


def test_every_test_says_that_it_is_simulated(fleet: Fleet) -> None:
    with read(fleet.history.store) as connection:
        told = connection.execute(select(test.c.origin, test.c.from_what).distinct()).all()
    assert [origin for origin, _ in told] == ["simulated"]
    assert all(what for _, what in told)
