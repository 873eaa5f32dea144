"""`elastogeo history acknowledge`, `close`, `silence`, `recipient`, `deliver`, `digest`: what a person says and sees."""

import json

import pytest

from elastogeo.changes.alarms import OPEN, AlarmNews
from elastogeo.history.alarms.life import Step
from elastogeo.history.alarms.open_ones import rows_of
from elastogeo.history.alarms.outbox import post
from elastogeo.history.alarms.rows import open_one, take
from elastogeo.history.store import now, open_store, write
from tests.history.alarms.shop import add_log, make_series


@pytest.fixture
def shop(tmp_path, monkeypatch):
    """A history with one open alarm, its message waiting for a file; the path of the history."""
    monkeypatch.setenv("ELASTOGEO_WHO", "A. Miller")
    path = tmp_path / "shop.db"
    with open_store(path, create=True, who="the tests") as store:
        add_log(store, str(tmp_path / "alarms.jsonl"))
        series = make_series(store)
        with write(store) as connection:
            facts = {"over": {"stiffness X": 1.8}, "size": {"stiffness X": 1.2}, "confirmed": True}
            kept = take(connection, open_one(connection, now(), series=series), [Step(OPEN, facts)], now())
            (row,) = rows_of(connection, [kept], now())
            post(connection, kept, kept.keys[-1], AlarmNews(OPEN, row), now())
    return path


def test_the_digest_shows_what_is_open_and_its_json_says_the_same(shop, elastogeo):
    code, out, _ = elastogeo("history", "digest", "--store", shop)
    assert code == 0
    assert "1 alarm is open (1 that nobody has acknowledged), no test is overdue." in out
    assert "stiffness X 1.8 times its limit" in out
    (alarm,) = json.loads(elastogeo("history", "digest", "--json", "--store", shop)[1])["alarms"]
    assert (alarm["number"], alarm["machine"], alarm["state"]) == (1, "C50 no. 3", "open")
    assert alarm["over"] == {"stiffness X": 1.8}


def test_one_alarm_is_shown_with_what_happened_to_it_and_who_was_told(shop, elastogeo):
    out = elastogeo("history", "digest", 1, "--store", shop)[1]
    assert "Open, not acknowledged" in out
    assert "stiffness X 1.8 times its limit" in out
    found = json.loads(elastogeo("history", "digest", 1, "--json", "--store", shop)[1])
    assert (found["schema"], found["alarm"]["number"]) == ("elastogeo.kept-alarm/1", 1)
    assert [message["state"] for message in found["messages"]] == ["waiting"]
    code, _, err = elastogeo("history", "digest", 9, "--store", shop)
    assert code == 2
    assert "there is no alarm 9" in err


def test_instruments_are_listed_by_their_due_dates(shop, elastogeo):
    elastogeo("history", "instrument", "B7", "--calibrated", "2025-03-01", "--due", "2025-09-01", "--store", shop)
    elastogeo("history", "instrument", "A1", "--store", shop)
    assert (
        "2 instruments, 1 out of calibration, 1 without a due date."
        in elastogeo("history", "instrument", "--store", shop)[1]
    )
    found = json.loads(elastogeo("history", "instrument", "--json", "--store", shop)[1])["instruments"]
    assert [one["serial"] for one in found] == ["B7", "A1"]
    code, _, err = elastogeo("history", "instrument", "--kind", "ball-bar", "--store", shop)
    assert code == 2
    assert "is no name for an instrument" in err


def test_acknowledge_and_close_want_a_reason(shop, elastogeo):
    code, _, err = elastogeo("history", "acknowledge", 1, "--store", shop)
    assert code == 2
    assert "say why you acknowledge the alarm" in err
    out = elastogeo("history", "acknowledge", 1, "--why", "nut is ordered", "--store", shop)[1]
    assert "Alarm 1 of C50 no. 3, XY 200 is acknowledged by A. Miller; it stays open." in out
    assert "A. Miller: nut is ordered" in out
    code, _, err = elastogeo("history", "close", 1, "--why", "nut replaced", "--store", shop)
    assert code == 2
    assert "--repaired (a new baseline follows) or --false" in err
    out = elastogeo("history", "close", 1, "--repaired", "--why", "nut replaced", "--store", shop)[1]
    assert "Alarm 1 of C50 no. 3, XY 200 is closed as repaired by A. Miller. The series needs a new baseline." in out
    assert "No alarm is open" in elastogeo("history", "digest", "--store", shop)[1]


def test_deliver_sends_what_waits_once(shop, tmp_path, elastogeo):
    assert "1 message sent." in elastogeo("history", "deliver", "--store", shop)[1]
    assert "No message sent." in elastogeo("history", "deliver", "--store", shop)[1]
    (line,) = (tmp_path / "alarms.jsonl").read_text(encoding="ascii").splitlines()
    assert json.loads(line)["subject"] == "Alarm: C50 no. 3, XY 200"


@pytest.mark.parametrize("until", ["9999-12-31", "9999-12-31T23:30-05:00", "0001-01-01T00:00+02:00"])
def test_a_silence_that_ends_after_the_calendar_is_refused(shop, elastogeo, until):
    words = ("history", "silence", "C50 no. 3", "--store", shop, "--why", "sold")
    code, _, err = elastogeo(*words, "--until", until)
    assert code == 2
    assert f"--until is '{until}'; give a day, as 2026-12-24" in err


def test_a_silence_holds_it(shop, elastogeo):
    words = ("history", "silence", "C50 no. 3", "--store", shop)
    assert elastogeo(*words, "--until", "2999-12-24", "--why", "taken apart")[0] == 0
    assert "No message sent; 1 waiting, 1 of them silenced." in elastogeo("history", "deliver", "--store", shop)[1]
    assert "silent until" in elastogeo("history", "digest", "--store", shop)[1]
    assert elastogeo(*words, "--until", "now", "--why", "runs again")[1] == "C50 no. 3 is not silent any more.\n"
    assert "1 message sent." in elastogeo("history", "deliver", "--store", shop)[1]
    code, _, err = elastogeo(*words, "--until", "christmas", "--why", "x")
    assert code == 2
    assert "--until is 'christmas'; give a day, as 2026-12-24" in err


def test_recipients_are_entered_listed_tried_and_removed(shop, tmp_path, elastogeo):
    box = tmp_path / "other.jsonl"
    words = ("history", "recipient", "--store", shop)
    assert "2 recipients of alarms." in elastogeo(*words, "log", box)[1]
    assert elastogeo(*words, "log", box, "--try")[1] == "A trial message was taken by log.\n"
    assert "This is a trial" in box.read_text(encoding="ascii")
    assert "1 recipient of alarms." in elastogeo(*words, "log", box, "--remove")[1]
    listed = json.loads(elastogeo(*words, "--json")[1])
    assert listed["channels"] == ["log", "mail", "webhook"]
    assert [(one["active"], one["waiting"]) for one in listed["recipients"]] == [(True, 1), (False, 0)]
    code, _, err = elastogeo(*words, "mail")
    assert code == 2
    assert "give a channel and an address" in err
    code, _, err = elastogeo(*words, "webhook", "http://example.com/")
    assert code == 2
    assert "https://" in err
