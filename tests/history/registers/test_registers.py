"""What a history knows by heart: instruments by their due dates, what is wanted of series, an alarm with its messages."""

from __future__ import annotations

from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import insert, update

from elastogeo.changes import NO_BASELINE, OVERDUE, Tolerance
from elastogeo.errors import InputError
from elastogeo.history import History
from elastogeo.history.alarms.acts import acknowledge, close
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.alarms.open_ones import lately, standing
from elastogeo.history.alarms.rows import Step, open_one, take
from elastogeo.history.alarms.told import kept_alarm
from elastogeo.history.intake.instruments import add_instrument
from elastogeo.history.registers.instruments import instrument_record, instruments
from elastogeo.history.registers.wanted import wanted_of_series
from elastogeo.history.requirements.baselines import set_baseline
from elastogeo.history.requirements.tolerances import set_tolerance
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, now, read, write
from elastogeo.history.store.schema import alarm, outbox
from elastogeo.report import view_of
from tests.history.alarms.shop import DAY, START, add_log, make_instrument, make_series, make_test

WHO = "A. Miller"
STIFFNESS = {"stiffness X": ("stiffness", 50_000.0)}


def filled(store: Store, count: int = 4, by: int | None = None, name: str = "C50 no. 3") -> tuple[int, list[int]]:
    key = make_series(store, name)
    values = [{"stiffness X": ("stiffness", 50_000.0 + 100 * (k % 3))} for k in range(count)]
    return key, [make_test(store, key, START + 7 * k * DAY, values[k], by=by) for k in range(count)]


def test_instruments_come_by_the_day_on_which_their_calibration_runs_out(store: Store, standing_clock: Any) -> None:
    standing_clock.advance(days=400)
    today = standing_clock.time
    for serial, due in (("late", -3), ("soon", 10), ("long", 300), ("open", None)):
        until = "" if due is None else f"{today + timedelta(days=due):%Y-%m-%d}"
        add_instrument(store, serial, who=WHO, calibrated=f"{today - 200 * DAY:%Y-%m-%d}", due=until, certificate=serial)
    make_instrument(store, "bare")
    with read(store) as connection:
        found = instruments(connection, "shop", today)
    assert [one.serial for one in found.instruments] == ["late", "soon", "long", "bare", "open"]
    assert [one.due.state == OVERDUE for one in found.instruments] == [True, False, False, False, False]
    words = [row[2] for row in view_of(found).tables[0].rows]
    assert words[0] == "■ calibration ran out 3 days ago"
    assert words[1].startswith("▲ calibration runs out in 1")
    assert words[2].startswith("● calibrated until")
    assert words[3] == "– no calibration is known"
    assert view_of(found).sentence == (
        "5 instruments, 1 out of calibration, 1 to be calibrated within a month, 2 without a due date."
    )


def test_a_test_after_the_due_date_is_marked_and_a_later_calibration_does_not_heal_it(
    store: Store, standing_clock: Any
) -> None:
    standing_clock.advance(days=60)
    bar = add_instrument(store, "B7", who=WHO, calibrated="2026-01-01", due="2026-03-10").key
    filled(store, 3, by=bar)  # on 2, 9 and 16 March
    add_instrument(store, "B7", who=WHO, calibrated="2026-04-01", due="2027-04-01")
    with read(store) as connection:
        found = instrument_record(connection, bar, standing_clock.time)
    assert [(test.name, test.expired) for test in found.tests] == [("test 2", True), ("test 1", False), ("test 0", False)]
    assert [one.due is not None for one in found.instrument.calibrations] == [True, True]
    assert found.instrument.machines == ("C50 no. 3",)
    assert found.instrument.last_test == days(START + 14 * DAY)
    with read(store) as connection, pytest.raises(InputError, match="there is no instrument 99"):
        instrument_record(connection, 99, standing_clock.time)


def test_an_instrument_names_its_open_alarm_and_the_closed_ones(store: Store, standing_clock: Any) -> None:
    bar = make_instrument(store, "B7")
    with write(store) as connection:
        facts = {"machines": [], "indicators": [], "shifts": []}
        first = take(connection, open_one(connection, now(), instrument=bar), [Step("open", facts)], now()).key
    with read(store) as connection:
        assert [one.alarm for one in instruments(connection, "", now()).instruments] == [first]
    close(store, first, False, WHO, "it was right")
    with read(store) as connection:
        found = instrument_record(connection, bar, standing_clock.time)
    assert found.instrument.alarm is None
    assert [(number, state) for number, state, _ in found.alarms] == [(first, "closed as false")]


def test_what_is_wanted_of_a_series_is_what_was_said_last(store: Store, standing_clock: Any) -> None:
    key, tests = filled(store, 8)
    standing_clock.advance(days=100)
    with read(store) as connection:
        (one,) = wanted_of_series(connection)
    assert (one.baseline, one.limits, one.tests, one.state) == (None, 0, 8, NO_BASELINE)
    set_baseline(store, key, tests[:6], who=WHO, why="new")
    set_tolerance(store, key, "stiffness X", Tolerance(lower=40_000.0), who=WHO, why="roughing")
    assess(store, key)
    with read(store) as connection:
        (one,) = wanted_of_series(connection)
    assert one.baseline is not None
    assert (one.baseline.tests, one.baseline.why, one.baseline.holds, one.limits) == (6, "new", True, 1)
    set_tolerance(store, key, "stiffness X", Tolerance(), who=WHO, why="part is out")
    with read(store) as connection:
        assert wanted_of_series(connection)[0].limits == 0


def test_a_repair_ends_the_baseline_and_the_series_comes_first(store: Store, standing_clock: Any) -> None:
    steady, tests = filled(store, 8, name="A")
    repaired, others = filled(store, 8, name="B")
    standing_clock.advance(days=100)
    for key, own in ((steady, tests), (repaired, others)):
        set_baseline(store, key, own[:6], who=WHO, why="new")
        assess(store, key)
    with write(store) as connection:
        made = take(connection, open_one(connection, now(), series=repaired), [Step("open", {"over": {}})], now()).key
    close(store, made, True, WHO, "nut replaced")
    with read(store) as connection:
        found = wanted_of_series(connection)
    assert [one.machine for one in found] == ["B", "A"]
    assert [one.baseline is not None and one.baseline.holds for one in found] == [False, True]


def test_an_alarm_tells_its_steps_and_its_messages_without_secrets(store: Store, standing_clock: Any) -> None:
    key, _ = filled(store, 2)
    hook = add_log(store, "https://hooks.example.com/T0/token", by="webhook")
    with write(store) as connection:
        kept = take(
            connection, open_one(connection, now(), series=key), [Step("open", {"over": {"stiffness X": 1.5}})], now()
        )
        row = {"recipient": hook, "made_at": now(), "content": {"subject": "x"}, "state": "waiting", "next_at": now()}
        connection.execute(insert(outbox).values(step=kept.keys[0], **row))
    standing_clock.advance(days=1)
    acknowledge(store, kept.key, WHO, "nut is ordered")
    with write(store) as connection:
        connection.execute(update(outbox).values(state="sent", sent_at=now(), tries=1))
    with read(store) as connection:
        found = kept_alarm(connection, kept.key, standing_clock.time)
    assert [(step.state, step.who, step.why) for step in found.steps] == [
        ("open", "", ""),
        ("acknowledged", WHO, "nut is ordered"),
    ]
    assert found.steps[0].over == {"stiffness X": 1.5}
    (message,) = found.messages
    assert (message.address, message.sent) == ("https://hooks.example.com/...", days(standing_clock.time))
    view = view_of(found)
    assert view.badge is not None
    assert view.badge.text == "Open, acknowledged"
    assert "token" not in str(view.document["messages"])
    with read(store) as connection, pytest.raises(InputError, match="there is no alarm 99"):
        kept_alarm(connection, 99, standing_clock.time)


def test_closed_alarms_are_listed_for_as_long_as_asked_and_never_in_the_digest(store: Store, standing_clock: Any) -> None:
    key, _ = filled(store, 2)
    with write(store) as connection:
        made = take(connection, open_one(connection, now(), series=key), [Step("open", {"over": {}})], now()).key
    standing_clock.advance(days=1)
    close(store, made, False, WHO, "coolant")
    standing_clock.advance(days=80)
    with read(store) as connection:
        found = lately(connection, standing_clock.time, timedelta(days=90))
        assert standing(connection, standing_clock.time).closed == ()
    assert [(row.number, row.state) for row in found.closed] == [(made, "closed as false")]
    assert found.only(state="open").closed == ()
    assert found.only(place="hall 9").closed == ()
    standing_clock.advance(days=20)
    with read(store) as connection:
        assert lately(connection, standing_clock.time, timedelta(days=90)).closed == ()
        assert connection.scalar(alarm.select().with_only_columns(alarm.c.id)) == made


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_backup_from_the_command_line_is_known_too(url: str, tmp_path: Path) -> None:
    with History(url, who=WHO) as history:
        assert view_of(history.copies()).sentence == "No backup was made yet. Nothing was checked yet."
        history.back_up(tmp_path / "mine")
        (copy,) = history.copies().copies
    assert (copy.who, copy.place, copy.wrong) == (WHO, str(tmp_path / "mine"), ())


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_backup_that_was_made_when_its_worker_was_killed_is_noted_once(
    url: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The folder has its name, and the job begins again."""
    from elastogeo.history.jobs import Worker
    from elastogeo.history.upkeep.backups import back_up

    monkeypatch.setenv("ELASTOGEO_BACKUPS", str(tmp_path / "all"))
    with History(url, who=WHO) as history:
        place = history.job(history.put_backup()).asked["place"]
        (tmp_path / "all").mkdir()
        back_up(history.store, place)
        Worker(history.store).run(once=True)
        assert [one.place for one in history.copies().copies] == [place]
        assert len(list((tmp_path / "all").iterdir())) == 1
        assert history.jobs().jobs[0].state == "done"
