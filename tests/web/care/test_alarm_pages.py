"""The pages of alarms: what they show, and what a person can do there."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from html import escape

import pytest

import elastogeo as eg
from elastogeo.web.asking import ENGINEER, READER
from tests.web.care.conftest import Visit
from tests.web.care.shop import NAME

MILL = escape(NAME)


def test_an_open_alarm_says_what_since_when_and_how_sure(visit: Visit) -> None:
    page = visit(READER).get("/alarms").text
    assert MILL in page
    assert NAME not in page
    assert "1 alarm is open (1 that nobody has acknowledged)" in page
    assert "20 % softer in X" in page
    assert re.search(r"confirmed by a second test; (1 test|2 tests) since", page)
    assert "Simulated: numbers" in page


def test_a_reader_sees_no_form_and_may_not_post(visit: Visit, history: eg.History) -> None:
    assert "/acknowledge" not in visit(READER).get("/alarms").text
    assert visit(READER).post("/alarms/1/acknowledge", data={"why": "x"}).status_code == 403
    assert visit(READER).post("/alarms/1/close", data={"why": "x", "as_what": "false"}).status_code == 403
    assert visit(READER).post("/machines/1/silence", data={"why": "x", "until": "2999-01-01"}).status_code == 403
    assert [row.state for row in history.alarms().alarms] == ["open"]


def test_an_alarm_is_acknowledged_with_a_reason_that_everybody_sees(visit: Visit, history: eg.History) -> None:
    browser = visit(ENGINEER)
    unknown = '<span class="unknown">1<span class="unseen"> not acknowledged</span>'
    assert unknown in browser.get("/plans").text
    done = browser.post("/alarms/1/acknowledge", data={"why": "nut <ordered>"})
    assert done.status_code == 200
    assert 'class="unknown"' not in browser.get("/plans").text
    assert "is acknowledged by B. Visitor; it stays open." in done.text
    assert "nut &lt;ordered&gt;" in done.text
    assert "nut <ordered>" not in done.text
    (row,) = history.alarms().alarms
    assert (row.state, row.who, row.why) == ("acknowledged", "B. Visitor", "nut <ordered>")
    page = browser.get("/alarms").text
    assert "Acknowledge alarm" not in page
    assert "B. Visitor: nut &lt;ordered&gt;" in page


@pytest.mark.parametrize("act", ["acknowledge", "close"])
def test_an_act_without_a_reason_is_refused_in_one_sentence(visit: Visit, history: eg.History, act: str) -> None:
    answer = visit(ENGINEER).post(f"/alarms/1/{act}", data={"why": " ", "as_what": "false"})
    assert answer.status_code == 400
    assert f"say why you {act} the alarm" in answer.text
    assert [row.state for row in history.alarms().alarms] == ["open"]


@pytest.mark.parametrize(("as_what", "said"), [("repaired", "needs a new baseline"), ("false", "closed as false")])
def test_an_alarm_is_closed_and_the_page_says_what_follows(
    visit: Visit, history: eg.History, as_what: str, said: str
) -> None:
    browser = visit(ENGINEER)
    done = browser.post("/alarms/1/close", data={"why": "coolant on the ball", "as_what": as_what})
    assert said in done.text
    assert "coolant on the ball" in done.text
    assert history.alarms().alarms == ()
    page = browser.get("/alarms").text
    assert "Closed lately" in page
    assert f"closed as {as_what}" in page
    again = browser.post("/alarms/1/close", data={"why": "again", "as_what": as_what})
    assert again.status_code == 400
    assert f"alarm 1 was closed as {as_what} by B. Visitor" in again.text


def test_closed_as_what_must_be_said(visit: Visit, history: eg.History) -> None:
    answer = visit(ENGINEER).post("/alarms/1/close", data={"why": "x", "as_what": "done"})
    assert answer.status_code == 400
    assert "say whether the alarm is closed as repaired or as false" in answer.text
    assert [row.state for row in history.alarms().alarms] == ["open"]


def test_filters_are_in_the_address_and_a_filter_that_finds_nothing_says_so(visit: Visit) -> None:
    browser = visit()
    assert MILL in browser.get("/alarms?state=open").text
    page = browser.get("/alarms?state=acknowledged").text
    assert "No alarm is of what was asked for." in page
    assert "20 % softer" not in page
    assert browser.get("/alarms.json?state=acknowledged").json()["alarms"] == []
    assert [row["number"] for row in browser.get("/alarms.json?state=open").json()["alarms"]] == [1]
    assert browser.get("/alarms.csv").text.splitlines()[0].startswith("number,machine,series")


def test_a_machine_is_silent_until_a_day_and_told_of_again(visit: Visit, history: eg.History) -> None:
    browser = visit(ENGINEER)
    until = f"{datetime.now(UTC) + timedelta(days=10):%Y-%m-%d}"
    done = browser.post("/machines/1/silence", data={"why": "taken apart", "until": until})
    assert "Silent machines" in done.text
    assert "B. Visitor: taken apart" in done.text
    (one,) = history.alarms(90.0).silences
    assert 9 < one.until - history.alarms().now < 12
    browser.post("/machines/1/silence", data={"why": "runs again", "until": "now"})
    assert history.alarms(90.0).silences == ()


@pytest.mark.parametrize(("until", "said"), [("2020-01-01", "is past"), ("christmas", "give a day"), ("", "give a day")])
def test_a_silence_until_no_day_to_come_is_refused(visit: Visit, history: eg.History, until: str, said: str) -> None:
    answer = visit(ENGINEER).post("/machines/1/silence", data={"why": "x", "until": until})
    assert answer.status_code in (400, 422)
    assert said in answer.text or (not until and "until" in answer.text)
    assert history.alarms(90.0).silences == ()


def test_one_alarm_shows_its_steps_and_who_was_told(visit: Visit) -> None:
    page = visit(READER).get("/alarms/1").text
    assert "Open, not acknowledged" in page
    assert "opened" in page
    assert "waits to be sent" in page
    document = visit(READER).get("/alarms/1.json").json()
    assert document["schema"] == "elastogeo.kept-alarm/1"
    assert [step["state"] for step in document["steps"]] == ["open"]
    assert [message["state"] for message in document["messages"]] == ["waiting"]
    assert visit(READER).get("/alarms/9").status_code == 404
