"""A series is assessed: what opens an alarm, who is told, and what tells nobody. Values are simulated."""

from __future__ import annotations

import json
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from threading import Barrier
from typing import Any

import numpy as np
import pytest
from sqlalchemy import insert, select, update

from elastogeo.changes import ALARM, NO_BASELINE, OVERDUE, STEADY, SUSPECT
from elastogeo.history.alarms.acts import acknowledge, close
from elastogeo.history.alarms.assessing import assess, assess_waiting
from elastogeo.history.alarms.open_ones import standing
from elastogeo.history.alarms.rows import open_alarms
from elastogeo.history.alarms.silences import silence_machine
from elastogeo.history.alarms.states import fleet
from elastogeo.history.store import Store, open_store, read, write
from elastogeo.history.store.schema import outbox, series_state, set_aside
from tests.history.alarms.shop import DAY, START, add_log, make_series, make_test, messages, set_baseline, steps

HOUR = timedelta(hours=1)


@dataclass
class Machine:
    """A machine that is tested: its series, and the scatter of its tests."""

    store: Store
    clock: Any
    name: str = "C50 no. 3"
    series: int = 0
    tests: list[int] = field(default_factory=list)
    rng: np.random.Generator = field(default_factory=lambda: np.random.default_rng(7))

    def __post_init__(self) -> None:
        self.series = make_series(self.store, self.name, interval=28.0)

    def test(
        self,
        loss: float = 0.0,
        squareness: float = 0.0,
        age: timedelta = timedelta(),
        repeats: int | None = None,
        live: bool = True,
    ) -> Any:
        """A test with this loss of stiffness [%] and squareness [um/m], imported now; its verdict."""
        made = self.made(loss, squareness, age, repeats)
        return assess(self.store, self.series, made if live else None)

    def made(
        self, loss: float = 0.0, squareness: float = 0.0, age: timedelta = timedelta(), repeats: int | None = None
    ) -> int:
        """The same, not assessed yet."""
        values = {
            "stiffness X": ("stiffness", 50_000 * (1 - loss / 100 + 0.01 * self.rng.standard_normal())),
            "squareness XY": ("squareness", 1e-6 * (squareness + 2 * self.rng.standard_normal())),
        }
        at = self.clock.time
        made = make_test(self.store, self.series, at - age, values, imported=at, repeats=repeats)
        self.tests.append(made)
        return made

    def repeat(self, **shift: float) -> Any:
        self.clock.advance(hours=1)
        return self.test(repeats=self.tests[-1], **shift)

    def month(self) -> datetime:
        return self.clock.advance(days=28)


@pytest.fixture
def machine(store: Store, standing_clock: Any) -> Machine:
    """Ten tests, one a month, then the baseline."""
    add_log(store)
    return based(Machine(store, standing_clock))


def based(made: Machine) -> Machine:
    for _ in range(10):
        made.made()
        made.month()
    set_baseline(made.store, made.series, list(made.tests), made.clock.time)
    assess(made.store, made.series)
    return made


def told(store: Store) -> list[str]:
    return [subject.split(":")[0] for _, subject, _ in messages(store)]


def test_without_a_baseline_nothing_is_said(store: Store, standing_clock: Any) -> None:
    add_log(store)
    made = Machine(store, standing_clock)
    for _ in range(4):
        assert made.test(loss=50.0).state == NO_BASELINE
    assert (steps(store), messages(store)) == ([], [])


def test_a_suspect_test_tells_the_tester_only(machine: Machine) -> None:
    verdict = machine.test(loss=20.0)
    assert verdict.state == SUSPECT
    assert (steps(machine.store), messages(machine.store)) == ([], [])


def test_a_repeat_that_confirms_opens_one_alarm_with_one_message(machine: Machine) -> None:
    machine.test(loss=20.0)
    verdict = machine.repeat(loss=20.0)
    assert verdict.state == ALARM
    assert verdict.alarm is not None
    assert [state for _, state in steps(machine.store)] == ["open"]
    ((_, subject, _),) = messages(machine.store)
    assert subject == "Alarm: C50 no. 3, XY 200"
    with read(machine.store) as connection:
        content = connection.execute(select(outbox.c.content)).scalar_one()
    assert content["text"].startswith("Simulated: numbers\n\nC50 no. 3 is ")
    assert "softer in X than its baseline" in content["text"]
    assert "elastogeo history acknowledge 1 --why" in content["text"]
    assert content["document"]["change"]["state"] == ALARM
    assert len(json.dumps(content)) < 20_000, "the chart does not go by mail"
    for _ in range(3):  # retries, another process, re-analysis
        assess(machine.store, machine.series, machine.tests[-1])
        assess(machine.store, machine.series)
    for _ in range(5):
        machine.month()
        machine.test(loss=20.0)
    assert told(machine.store) == ["Alarm"]


def test_a_repeat_that_does_not_confirm_is_quiet_again(machine: Machine) -> None:
    machine.test(loss=20.0)
    assert machine.repeat().state == STEADY
    machine.clock.advance(days=8)
    assert assess_waiting(machine.store) == ()
    assert (steps(machine.store), messages(machine.store)) == ([], [])


def test_without_a_repeat_the_alarm_comes_by_itself_after_the_wait_and_once(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.clock.advance(days=6)
    assert assess_waiting(machine.store) == ()
    machine.clock.advance(days=2)
    (verdict,) = assess_waiting(machine.store)
    assert verdict.state == ALARM
    assert assess_waiting(machine.store) == ()
    assert told(machine.store) == ["Alarm"]
    with read(machine.store) as connection:
        (row,) = standing(connection, machine.clock.time).alarms
    assert not row.confirmed


def test_a_second_test_that_is_no_repeat_confirms_and_the_list_says_what_the_series_says(machine: Machine) -> None:
    """Two different indicators over their limits in two tests confirm nothing; the same one on the same side does."""
    machine.test(loss=20.0)
    machine.clock.advance(days=1)
    first = machine.test(squareness=60.0)
    assert (first.state, first.is_confirmed) == (SUSPECT, False)
    machine.clock.advance(days=1)
    second = machine.test(squareness=60.0)
    assert (second.state, second.is_confirmed) == (ALARM, True)
    with read(machine.store) as connection:
        (row,) = standing(connection, machine.clock.time).alarms
    assert row.confirmed


def test_an_alarm_that_a_later_test_confirms_is_listed_as_confirmed(machine: Machine) -> None:
    """Nobody repeated the suspect test in time; weeks later the next test shows the same, no larger."""
    machine.test(loss=20.0)
    machine.clock.advance(days=9)
    (late,) = assess_waiting(machine.store)
    assert not late.is_confirmed
    machine.month()
    verdict = machine.test(loss=20.0)
    assert verdict.is_confirmed
    assert [state for _, state in steps(machine.store)] == ["open"], "it is no worse, so it takes no step"
    with read(machine.store) as connection:
        (row,) = standing(connection, machine.clock.time).alarms
    assert row.confirmed


def test_three_years_of_old_tests_open_an_alarm_and_tell_nobody(store: Store, standing_clock: Any) -> None:
    add_log(store)
    made = Machine(store, standing_clock)
    standing_clock.time = START + 1200 * DAY
    for month in range(36):
        import_old = made.made if month < 10 or month % 3 else made.test
        import_old(loss=20.0 if month > 20 else 0.0, age=(1190 - 28 * month) * DAY)
        if month == 9:
            set_baseline(store, made.series, list(made.tests), START + 10 * DAY + 270 * DAY)
    assert [state for _, state in steps(store)] == ["open"]
    assert messages(store) == []
    assert assess_waiting(store) == ()
    standing_clock.advance(days=60)
    made.test(loss=20.0)
    assert told(store) == ["Alarm"], "the first live test that still shows it"


def test_an_old_suspect_is_not_told_when_its_wait_is_over(machine: Machine) -> None:
    machine.month()
    machine.test(loss=20.0, age=8 * DAY)
    assert assess(machine.store, machine.series).state == ALARM, "its wait was over when it came"
    machine.month()
    assert assess_waiting(machine.store) == ()
    assert messages(machine.store) == []


def test_reanalysis_opens_an_alarm_and_tells_nobody(machine: Machine) -> None:
    machine.test(loss=20.0, live=False)
    machine.clock.advance(hours=1)
    machine.test(loss=20.0, repeats=machine.tests[-1], live=False)
    assert [state for _, state in steps(machine.store)] == ["open"]
    assert messages(machine.store) == []


def test_a_test_that_comes_again_is_no_news(machine: Machine) -> None:
    """Re-analysis opened an alarm; then the folder of its live tests is imported again."""
    machine.test()
    first = machine.made(loss=20.0)
    machine.clock.advance(hours=1)
    again = machine.made(loss=20.0, repeats=first)
    with write(machine.store) as connection:
        kept = connection.execute(select(series_state)).one()
        connection.execute(update(series_state).values(verdict=kept.verdict | {"seen": [first, again]}))
    assess(machine.store, machine.series)
    assert [state for _, state in steps(machine.store)] == ["open"]
    for key in (first, again):
        assess(machine.store, machine.series, key)
    assert messages(machine.store) == []


def test_a_suspect_that_reanalysis_found_is_not_told_after_its_wait(machine: Machine) -> None:
    machine.test(loss=20.0, live=False)
    machine.clock.advance(days=8)
    (verdict,) = assess_waiting(machine.store)
    assert verdict.state == ALARM
    assert messages(machine.store) == []


def test_worse_is_told_and_further_indicators_join(machine: Machine) -> None:
    machine.test(loss=6.0)
    machine.repeat(loss=6.0)
    machine.month()
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    assert told(machine.store) == ["Alarm", "Alarm, worse"]
    machine.month()
    machine.test(loss=20.0, squareness=40.0)
    machine.repeat(loss=20.0, squareness=40.0)
    assert told(machine.store) == ["Alarm", "Alarm, worse", "Alarm, worse"]
    assert len({number for number, _ in steps(machine.store)}) == 1


def test_one_bad_test_does_not_make_an_alarm_worse_but_seven_days_without_another_do(machine: Machine) -> None:
    machine.test(loss=8.0)
    machine.repeat(loss=8.0)
    machine.month()
    machine.test(loss=40.0)
    assert told(machine.store) == ["Alarm"]
    machine.clock.advance(days=8)
    assess_waiting(machine.store)
    assert told(machine.store) == ["Alarm", "Alarm, worse"]


def test_quiet_again_closes_nothing(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    for _ in range(3):
        machine.month()
        machine.test()
    assert [state for _, state in steps(machine.store)] == ["open"]
    assert told(machine.store) == ["Alarm"]


def test_closed_as_false_keeps_the_baseline_and_does_not_alarm_at_once(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    (number,) = {alarm for alarm, _ in steps(machine.store)}
    machine.clock.advance(hours=1)
    close(machine.store, number, False, "A. Miller", "coolant on the ball")
    verdict = assess(machine.store, machine.series)
    assert verdict.state == STEADY
    machine.month()
    assert machine.test().state == STEADY
    assert [state for _, state in steps(machine.store)] == ["open", "closed as false"]
    machine.month()
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    assert [state for _, state in steps(machine.store)][2:] == ["open"], "what is true after all comes again"


def test_closed_as_repaired_needs_a_new_baseline(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    close(machine.store, 1, True, "A. Miller", "guideway replaced")
    assert assess(machine.store, machine.series).state == NO_BASELINE
    machine.month()
    assert machine.test(loss=30.0).state == NO_BASELINE
    first = len(machine.tests)
    for _ in range(6):
        machine.month()
        machine.test(loss=-5.0)
    set_baseline(machine.store, machine.series, machine.tests[first:], machine.clock.time)
    machine.month()
    assert machine.test(loss=-5.0).state == STEADY
    assert [state for _, state in steps(machine.store)] == ["open", "closed as repaired"]


def test_a_clock_that_was_ahead_at_a_close_ends_no_baseline_that_follows(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    right = machine.clock.advance(hours=1)
    machine.clock.advance(days=365)
    close(machine.store, 1, True, "A. Miller", "guideway replaced")
    machine.clock.time = right
    first = len(machine.tests)
    for _ in range(6):
        machine.month()
        assert machine.test(loss=-5.0).state == NO_BASELINE
    set_baseline(machine.store, machine.series, machine.tests[first:], machine.clock.time)
    machine.month()
    assert machine.test(loss=-5.0).state == STEADY


@pytest.mark.parametrize("ahead", [365 * DAY, timedelta(), -365 * DAY])
def test_a_test_that_comes_after_a_close_counts_whatever_the_clock_said(machine: Machine, ahead: timedelta) -> None:
    """A retest of the day of an afternoon's close, dated by its day only, lies at noon: before the close, and counts."""
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    right = machine.month()
    machine.clock.time = right + ahead + 4 * HOUR
    close(machine.store, 1, False, "A. Miller", "coolant on the ball")
    machine.clock.time = right
    assert assess(machine.store, machine.series).state == STEADY
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    assert [state for _, state in steps(machine.store)] == ["open", "closed as false", "open"]


def test_a_test_that_is_set_aside_tells_nobody(machine: Machine) -> None:
    machine.test(loss=20.0)
    with write(machine.store) as connection:
        values = {"test": machine.tests[-1], "aside": True, "at": machine.clock.time, "who": "A. Miller", "why": "chips"}
        connection.execute(insert(set_aside).values(**values))
    assert assess(machine.store, machine.series).state == STEADY
    machine.clock.advance(days=8)
    assert assess_waiting(machine.store) == ()
    assert messages(machine.store) == []


def test_an_acknowledged_alarm_is_told_again_only_when_it_is_worse(machine: Machine) -> None:
    machine.test(loss=8.0)
    machine.repeat(loss=8.0)
    verdict = machine.test(loss=8.0)
    assert verdict.alarm.acknowledged is None
    acknowledge(machine.store, 1, "A. Miller", "nut is ordered")
    machine.month()
    verdict = machine.test(loss=8.0)
    assert (verdict.alarm.who, verdict.alarm.why) == ("A. Miller", "nut is ordered")
    assert told(machine.store) == ["Alarm"]
    machine.month()
    machine.test(loss=30.0)
    assert machine.repeat(loss=30.0).alarm.acknowledged is None
    assert told(machine.store) == ["Alarm", "Alarm, worse"]


def test_the_present_does_not_depend_on_a_clock_that_goes_back(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.clock.advance(days=-400)
    assert assess(machine.store, machine.series).state == SUSPECT
    assert assess_waiting(machine.store) == ()
    machine.test(loss=20.0)
    assert messages(machine.store) == [], "a test that is dated before the baseline is not judged"
    machine.clock.advance(days=400, hours=1)
    machine.test(loss=20.0, repeats=machine.tests[-2])
    assert told(machine.store) == ["Alarm"]


def test_a_test_of_the_future_tells_nobody(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.test(loss=20.0, age=-40 * DAY)
    assert [state for _, state in steps(machine.store)] == ["open"]
    assert messages(machine.store) == []


def test_two_tests_of_one_day_in_the_wrong_order_are_both_news(machine: Machine) -> None:
    machine.month()
    machine.test(loss=20.0)
    machine.test(loss=20.0, age=HOUR)
    assert told(machine.store) == ["Alarm"]


def test_the_state_is_kept_and_its_version_grows_with_every_change_only(machine: Machine) -> None:
    def kept() -> Any:
        with read(machine.store) as connection:
            return connection.execute(select(series_state)).one()

    before = kept()
    assess(machine.store, machine.series)
    assert kept().version == before.version
    machine.test(loss=20.0)
    after = kept()
    assert after.version == before.version + 1
    assert (after.state, after.last_test) == (SUSPECT, machine.clock.time)
    assert after.due == machine.clock.time + 28 * DAY
    assert after.verdict["waits"]["live"] is True


def test_the_fleet_is_the_worst_first_without_judging(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    other = Machine(machine.store, machine.clock, "C50 no. 4")
    other.test()
    machine.clock.advance(days=10)
    with read(machine.store) as connection:
        found = fleet(connection, machine.clock.time)
        late = fleet(connection, machine.clock.time + 40 * DAY)
    assert [(row.machine, row.state) for row in found.machines] == [("C50 no. 3", ALARM), ("C50 no. 4", NO_BASELINE)]
    worst = found.machines[0]
    assert worst.indicator == "stiffness X"
    assert -0.25 < worst.change / worst.mean < -0.15
    assert worst.simulated == "numbers"
    assert found.counts[ALARM] == 1
    assert late.counts[OVERDUE] == 2
    assert [row.state for row in late.machines] == [ALARM, OVERDUE]


def test_an_overdue_test_is_in_the_digest_and_no_alarm(machine: Machine) -> None:
    machine.test()
    machine.clock.advance(days=28 + 7, hours=1)
    with read(machine.store) as connection:
        found = standing(connection, machine.clock.time)
    assert found.alarms == ()
    ((name, late),) = [(row.machine, row.overdue) for row in found.overdue]
    assert name == "C50 no. 3"
    assert late == pytest.approx(1 / 24, abs=1e-6)


def test_a_silence_lets_the_alarm_open(machine: Machine) -> None:
    silence_machine(machine.store, "C50 no. 3", machine.clock.time + 90 * DAY, "A. Miller", "taken apart")
    machine.test(loss=20.0)
    machine.repeat(loss=20.0)
    assert [state for _, state in steps(machine.store)] == ["open"]
    assert told(machine.store) == ["Alarm"], "made, and sent when the silence ends"


# what the fleet leads to expect


def test_a_later_baseline_of_another_machine_moves_no_limit(store: Store, standing_clock: Any) -> None:
    machines = [Machine(store, standing_clock, f"C50 no. {k}", rng=np.random.default_rng(k)) for k in range(4)]
    for made in machines[:3]:
        based(made)
    deviation: Callable[[Any], Any] = lambda verdict: [one.deviation for one in verdict.indicators]  # noqa: E731
    first = deviation(assess(store, machines[0].series))
    third = deviation(assess(store, machines[2].series))
    fourth = based(machines[3])
    own = deviation(assess(store, fourth.series))
    assert deviation(assess(store, machines[0].series)) == first
    assert deviation(assess(store, machines[2].series)) == third
    with write(store) as connection:
        connection.execute(series_state.delete())
    assert deviation(assess(store, fourth.series)) == own, "found again as it was"
    assert len({one[0] for one in (first, third, own)}) == 3


def test_the_fleet_says_more_than_the_stated_reproducibility(store: Store) -> None:
    """Three machines that scatter by 0.1 % instead of the stated 1.5 %: the fourth is expected to scatter so too."""
    scatter = [0.001, 0.001, 0.001, 0.001]
    keys = []
    for k, s in enumerate(scatter):
        rng = np.random.default_rng(k)
        key = make_series(store, f"C50 no. {k}")
        values = 50_000 * (1 + s * rng.standard_normal(8))
        tests = [
            make_test(store, key, START + n * DAY, {"stiffness X": ("stiffness", float(x))}) for n, x in enumerate(values)
        ]
        set_baseline(store, key, tests, START + 8 * DAY)
        keys.append(key)
    alone, expected = (assess(store, key).indicators[0].deviation / 50_000 for key in (keys[0], keys[3]))
    assert alone > 0.008, "six degrees of freedom of the stated 1.5 % beside seven of its own"
    assert expected < 0.002


# whatever happens


@pytest.mark.parametrize("seed", range(3))
def test_any_history_has_one_open_alarm_and_tells_nothing_twice(machine: Machine, seed: int) -> None:
    rng = np.random.default_rng(seed)
    store, loss = machine.store, 0.0
    for _ in range(18):
        before = len(messages(store))
        act = rng.choice(["test", "old", "again", "reanalysis", "repeat", "wait", "fault", "acknowledge", "close", "aside"])
        machine.clock.advance(days=int(rng.integers(0, 9)), hours=1)
        numbers = open_numbers(store)
        if act == "fault":
            loss = float(rng.choice([0.0, 8.0, 20.0, 40.0]))
        elif act == "test":
            machine.test(loss=loss)
        elif act == "repeat":
            machine.repeat(loss=loss)
        elif act == "old":
            machine.test(loss=40.0, age=8 * DAY)
        elif act == "again":
            assess(store, machine.series, machine.tests[-1])
        elif act == "reanalysis":
            assess(store, machine.series)
        elif act == "wait":
            assess_waiting(store)
        elif act == "acknowledge" and numbers:
            acknowledge(store, numbers[0], "A. Miller", "seen")
        elif act == "close" and numbers:
            close(store, numbers[0], False, "A. Miller", "chips")
        elif act == "aside":
            with write(store) as connection:
                values = {"test": machine.tests[-1], "aside": True, "at": machine.clock.time, "who": "A", "why": "chips"}
                connection.execute(insert(set_aside).values(**values))
            assess(store, machine.series)
        if act in ("old", "again", "reanalysis", "fault", "acknowledge", "aside"):
            assert len(messages(store)) == before, act
        assert len(open_numbers(store)) <= 1
    by_alarm = {number: [state for own, state in steps(store) if own == number] for number, _ in steps(store)}
    assert all(states[0] == "open" and states.count("open") == 1 for states in by_alarm.values())
    assert len(messages(store)) <= len(steps(store))


def open_numbers(store: Store) -> list[int]:
    with read(store) as connection:
        return [kept.key for kept in open_alarms(connection)]


def test_two_processes_that_assess_at_once_open_one_alarm_with_one_message(machine: Machine, url: str) -> None:
    machine.test(loss=20.0)
    machine.clock.advance(hours=1)
    again = machine.made(loss=20.0, repeats=machine.tests[-1])
    start = Barrier(2)

    def process(_: int) -> str:
        with open_store(url) as own:
            start.wait()
            return str(assess(own, machine.series, again).state)

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(process, range(2))) == [ALARM, ALARM]
    assert [state for _, state in steps(machine.store)] == ["open"]
    assert told(machine.store) == ["Alarm"]


def test_a_crash_between_import_and_assessment_loses_no_alarm(machine: Machine) -> None:
    machine.test(loss=20.0)
    machine.clock.advance(hours=1)
    machine.made(loss=20.0, repeats=machine.tests[-1])
    machine.clock.advance(days=1)
    assess(machine.store, machine.series, machine.tests[-1])
    assert told(machine.store) == ["Alarm"], "the import is repeated, and the test comes for the first time"
