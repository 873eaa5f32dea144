"""The alarm of an instrument: machines that move alike with it are one alarm, and theirs are held back. Simulated values."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from sqlalchemy import select

from elastogeo.changes import ALARM, STEADY
from elastogeo.history.alarms import instruments
from elastogeo.history.alarms.acts import close
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.alarms.open_ones import standing, unknown
from elastogeo.history.alarms.states import fleet
from elastogeo.history.store import Store, read
from elastogeo.history.store.schema import series_state
from elastogeo.report import view_of
from elastogeo.report.alarms.words import since_said
from tests.history.alarms.shop import (
    DAY,
    START,
    add_log,
    make_instrument,
    make_series,
    make_test,
    messages,
    set_baseline,
    steps,
)

SCATTER = 0.004


class Shop:
    """Machines that one bar measures: by name the series, with a baseline of ten tests each."""

    def __init__(self, store: Store, clock: Any, number: int) -> None:
        self.store, self.clock = store, clock
        self.rng = np.random.default_rng(3)
        self.bar = make_instrument(store)
        self.series: dict[str, int] = {}
        for k in range(number):
            name = f"C50 no. {k}"
            self.series[name] = make_series(store, name)
            tests = [self._test(name, 0.0, START + n * DAY) for n in range(10)]
            set_baseline(store, self.series[name], tests, START + 10 * DAY)
            assess(store, self.series[name])
        clock.time = START + 20 * DAY

    def _test(self, name: str, loss: float, at: Any, repeats: int | None = None, by: int | None = None) -> int:
        value = 50_000 * (1 - loss + SCATTER * self.rng.standard_normal())
        values = {"stiffness X": ("stiffness", float(value))}
        return make_test(self.store, self.series[name], at, values, by=by or self.bar, repeats=repeats)

    def test(self, name: str, loss: float = 0.0, by: int | None = None) -> Any:
        """A test and, where that is suspect, its repeat."""
        first = self._test(name, loss, self.clock.advance(hours=1), by=by)
        verdict = assess(self.store, self.series[name], first)
        if verdict.waiting:
            again = self._test(name, loss, self.clock.advance(hours=1), repeats=first, by=by)
            verdict = assess(self.store, self.series[name], again)
        return verdict


@pytest.fixture
def shop(store: Store, standing_clock: Any) -> Shop:
    add_log(store)
    return Shop(store, standing_clock, 4)


def told(store: Store) -> list[str]:
    return [subject for _, subject, _ in messages(store)]


def waiting(store: Store) -> list[str]:
    return [subject for state, subject, _ in messages(store) if state == "waiting"]


def off(shop: Shop, loss: float = 0.1) -> list[Any]:
    """The bar is off: three machines move alike."""
    return [shop.test(f"C50 no. {k}", loss) for k in range(3)]


def test_three_machines_that_move_alike_are_one_alarm_on_the_instrument(shop: Shop) -> None:
    verdicts = off(shop)
    assert [verdict.state for verdict in verdicts] == [ALARM] * 3
    assert waiting(shop.store) == ["Alarm: instrument LB-1"], "those of the machines were not sent yet: they are held back"
    with read(shop.store) as connection:
        found = standing(connection, shop.clock.time).alarms
        rows = fleet(connection, shop.clock.time).machines
        assert unknown(connection) == 1, "one to acknowledge, not four"
    (bar,) = [row for row in found if row.instrument]
    assert since_said(bar) == "", "when its alarm was opened is not when it changed"
    assert [(row.instrument or row.machine, row.state) for row in found] == [
        ("LB-1", "open"),
        ("C50 no. 0", "held"),
        ("C50 no. 1", "held"),
        ("C50 no. 2", "held"),
    ]
    assert found[0].holds == ("C50 no. 0", "C50 no. 1", "C50 no. 2")
    assert {row.machine: row.held_by for row in rows if row.state == ALARM} == dict.fromkeys(found[0].holds, "LB-1")
    assert verdicts[2].alarm.held_by == "LB-1"


def test_the_fleet_says_the_instrument_before_the_machines(shop: Shop) -> None:
    off(shop)
    with read(shop.store) as connection:
        found = fleet(connection, shop.clock.time)
    assert [(move.instrument, move.machines) for move in found.instruments] == [
        ("LB-1", ("C50 no. 0", "C50 no. 1", "C50 no. 2"))
    ]
    view = view_of(found)
    assert view.alert[0].startswith("3 machines moved alike in stiffness X with instrument LB-1 (C50 no. 0, C50 no. 1 and")
    assert "nan" not in str(view.document["instruments"]).lower()
    with read(shop.store) as connection:
        (number,) = [row.number for row in standing(connection, shop.clock.time).alarms if row.instrument]
    close(shop.store, number, repaired=True, who="A. Miller", why="calibrated anew")
    with read(shop.store) as connection:
        assert fleet(connection, shop.clock.time).instruments == ()


def test_a_fourth_machine_joins_without_a_message(shop: Shop) -> None:
    off(shop)
    before = told(shop.store)
    assert shop.test("C50 no. 3", 0.1).alarm.held_by == "LB-1"
    assert told(shop.store) == before


def test_the_fleet_is_judged_only_if_an_alarm_would_join(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    off(shop)
    judged: list[int] = []

    def counted(connection: Any, key: int, at: Any) -> Any:
        judged.append(key)
        return judge(connection, key, at)

    judge = instruments.judged
    monkeypatch.setattr(instruments, "judged", counted)
    assert shop.test("C50 no. 0", 0.1).state == ALARM
    assert judged == [], "its alarm is held already"
    shop.test("C50 no. 3", 0.1)
    assert set(judged) == {shop.series[f"C50 no. {k}"] for k in range(3)}, "the alarm of the fourth joins"


def test_two_machines_are_two_machines(shop: Shop) -> None:
    shop.test("C50 no. 0", 0.1)
    shop.test("C50 no. 1", 0.1)
    assert waiting(shop.store) == ["Alarm: C50 no. 0, XY 200", "Alarm: C50 no. 1, XY 200"]


def test_machines_that_move_differently_are_themselves(shop: Shop) -> None:
    for k, loss in enumerate((0.05, 0.3, -0.15)):
        shop.test(f"C50 no. {k}", loss)
    assert len(waiting(shop.store)) == 3
    assert all(subject.startswith("Alarm: C50") for subject in waiting(shop.store))


def test_machines_of_other_instruments_are_themselves(shop: Shop) -> None:
    for k in range(3):
        shop.test(f"C50 no. {k}", 0.1, by=make_instrument(shop.store, f"LB-{k + 2}"))
    assert len(waiting(shop.store)) == 3
    assert all(subject.startswith("Alarm: C50") for subject in waiting(shop.store))


def test_closed_as_false_lets_the_machines_go(shop: Shop) -> None:
    off(shop)
    number = steps(shop.store)[[state for _, state in steps(shop.store)].index("held") - 1][0]
    shop.clock.advance(hours=1)
    close(shop.store, number, False, "A. Miller", "the bar agrees with its certificate")
    with read(shop.store) as connection:
        found = standing(connection, shop.clock.time).alarms
    assert [(row.machine, row.state) for row in found] == [(f"C50 no. {k}", "open") for k in range(3)]
    assert [subject.split(":")[0] for subject in waiting(shop.store)] == ["Alarm counts again"] * 3
    shop.test("C50 no. 0", 0.1)
    with read(shop.store) as connection:
        assert not any(row.instrument for row in standing(connection, shop.clock.time).alarms), "nothing new since then"


def test_closed_as_repaired_closes_the_machines_as_false(shop: Shop) -> None:
    off(shop)
    with read(shop.store) as connection:
        (number,) = [row.number for row in standing(connection, shop.clock.time).alarms if row.instrument]
    shop.clock.advance(hours=1)
    close(shop.store, number, True, "A. Miller", "recalibrated")
    with read(shop.store) as connection:
        assert standing(connection, shop.clock.time).alarms == ()
        states = set(connection.scalars(select(series_state.c.state)))
    assert states == {STEADY}, "their baselines hold"
    assert shop.test("C50 no. 0").state == STEADY


def test_old_tests_open_it_without_a_message(store: Store, standing_clock: Any) -> None:
    add_log(store)
    shop = Shop(store, standing_clock, 3)
    for k in range(3):
        name = f"C50 no. {k}"
        first = shop._test(name, 0.1, shop.clock.advance(hours=1))
        shop._test(name, 0.1, shop.clock.advance(hours=1), repeats=first)
        assess(store, shop.series[name])
    assert [state for _, state in steps(store)].count("held") == 3
    assert messages(store) == []
