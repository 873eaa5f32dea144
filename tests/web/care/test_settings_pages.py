"""The pages of settings: baseline, limits, interval, recipients, machines, instruments, audit trail, backup."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from pathlib import Path

import pytest

import elastogeo as eg
from elastogeo.changes import NO_BASELINE
from elastogeo.history.jobs import Worker
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER, READER
from tests.web.care.conftest import Visit
from tests.web.care.shop import NAME, OTHER

MILL = escape(NAME)
PATHS = ("/settings", "/settings/series/1", "/instruments", "/instruments/1", "/recipients", "/audit", "/backup")


@pytest.mark.parametrize("path", PATHS)
def test_a_page_and_its_twins_are_there_for_a_reader_without_forms_of_others(visit: Visit, path: str) -> None:
    browser = visit(READER)
    page = browser.get(path)
    assert page.status_code == 200
    assert page.text.count("<h1") == 1
    forms = page.text.count('<form method="post"') + page.text.count('method="post"')
    assert forms == 2 * page.text.count('action="/theme"') or path == "/audit"
    assert browser.get(f"{path}.json").json()["schema"].startswith("elastogeo.")
    assert browser.get(f"{path}.csv").status_code == 200


def test_the_settings_name_the_series_without_a_baseline_first(visit: Visit) -> None:
    rows = visit(READER).get("/settings.json").json()["series"]
    assert [row["machine"] for row in rows] == [OTHER, NAME]
    assert [row["baseline"] is None for row in rows] == [True, False]
    assert rows[1]["interval_days"] == 28.0
    assert "2 series, 1 without a baseline: nothing is judged there, 1 without a date" in visit(READER).get("/settings").text


def test_a_baseline_of_the_last_tests_is_set_and_the_series_judged(visit: Visit, history: eg.History) -> None:
    done = visit(ENGINEER).post("/settings/series/2/baseline", data={"which": "last", "count": "6", "why": "calm"})
    assert "The baseline is made of 6 tests." in done.text
    assert history.verdict(OTHER).state != NO_BASELINE
    assert "set" in done.text
    assert "by B. Visitor: calm" in done.text


def test_a_baseline_of_chosen_tests_is_set(visit: Visit, history: eg.History) -> None:
    tests = [row["number"] for row in visit().get("/settings/series/2.json").json()["tests"]][2:]
    done = visit(ENGINEER).post("/settings/series/2/baseline", data={"which": "chosen", "tests": tests, "why": "calm"})
    assert "The baseline is made of 6 tests." in done.text
    baseline = history.verdict(OTHER).baseline
    assert baseline is not None
    assert sorted(map(int, baseline.tests)) == sorted(tests)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ({"which": "chosen", "why": "x"}, "no test was chosen"),
        ({"which": "last", "count": "many", "why": "x"}, "give a whole number"),
        ({"which": "first", "count": "99", "why": "x"}, "99 tests were asked for"),
        ({"which": "first", "count": "6", "why": " "}, "give one with --why"),
    ],
)
def test_what_is_no_baseline_is_refused(visit: Visit, history: eg.History, data: dict[str, str], said: str) -> None:
    answer = visit(ENGINEER).post("/settings/series/2/baseline", data=data)
    assert answer.status_code == 400
    assert said in answer.text
    assert history.verdict(OTHER).state == NO_BASELINE


def test_limits_are_entered_in_the_unit_that_is_shown(visit: Visit, history: eg.History) -> None:
    """13,5 N/µm is 13 500 N/mm, 5 % a share of 0.05."""
    data = {"indicator": "stiffness X", "lower": "13,5", "upper": "", "matters": "5", "why": "roughing"}
    done = visit(ENGINEER).post("/settings/series/1/limits", data=data)
    assert done.status_code == 200
    one = history.verdict(NAME)["stiffness X"]
    assert one.lower == pytest.approx(13_500.0)
    assert one.upper == float("inf")
    assert one.relevance == pytest.approx(0.05 * one.mean)
    entry = visit().get("/settings/series/1.json").json()["indicators"][0]
    assert (entry["lower"], entry["matters"], entry["unit"], entry["matters_unit"]) == (13.5, 5.0, "N/µm", "%")
    assert 'name="lower" inputmode="decimal" maxlength="40" value="13.5"' in done.text


def test_limits_that_nothing_can_keep_are_refused(visit: Visit, history: eg.History) -> None:
    for lower, upper in (("20", "10"), ("x", ""), ("nan", "")):
        data = {"indicator": "stiffness X", "lower": lower, "upper": upper, "why": "x"}
        assert visit(ENGINEER).post("/settings/series/1/limits", data=data).status_code == 400
    assert history.verdict(NAME)["stiffness X"].lower == float("-inf")


def test_the_interval_is_set_and_taken_back(visit: Visit, history: eg.History) -> None:
    visit(ENGINEER).post("/settings/series/2/interval", data={"days": "30", "grace": "3", "why": "monthly"})
    due = history.verdict(OTHER).due
    assert due is not None
    assert due.grace == 3.0
    visit(ENGINEER).post("/settings/series/2/interval", data={"days": "", "grace": "3"})
    assert next(row["interval_days"] for row in visit().get("/settings.json").json()["series"]) is None


def test_an_instrument_is_added_and_calibrated(visit: Visit, history: eg.History) -> None:
    browser = visit(ENGINEER)
    done = browser.post(
        "/instruments", data={"serial": "B-9", "kind": "loaded-ball-bar", "calibrated": "2025-03-01", "due": "2025-09-01"}
    )
    assert "Instrument B-9 is kept." in done.text
    assert "Calibration ran out" in done.text
    first = history.instruments().instruments[0]
    assert (first.serial, first.due.state) == ("B-9", "overdue")
    done = browser.post(
        f"/instruments/{first.key}/calibrations",
        data={"calibrated": "2026-03-01", "due": "2099-03-01", "certificate": "C <1>"},
    )
    assert "C &lt;1&gt;" in done.text
    assert next(one.serial for one in history.instruments().instruments) == "B-9", "it has a date; the other has none"
    assert history.instruments().instruments[0].due.state == "not due"


def test_an_instrument_names_the_machines_that_were_tested_with_it(visit: Visit) -> None:
    page = visit(READER).get("/instruments/1").text
    assert MILL in page
    assert visit(READER).get("/instruments/1.json").json()["instrument"]["tests"] == 12
    assert visit(READER).get("/instruments/9").status_code == 404


def test_only_an_administrator_enters_recipients_and_no_file(visit: Visit, history: eg.History, tmp_path: Path) -> None:
    data = {"channel": "mail", "address": "anna@example.com", "digest": "yes"}
    assert visit(ENGINEER).post("/recipients", data=data).status_code == 403
    assert "anna@example.com" in visit(ADMINISTRATOR).post("/recipients", data=data).text
    refused = visit(ADMINISTRATOR).post("/recipients", data={"channel": "log", "address": str(tmp_path / "x.jsonl")})
    assert refused.status_code == 400
    assert "a file is entered on the command line" in refused.text
    assert not (tmp_path / "x.jsonl").exists()
    assert (
        visit(ADMINISTRATOR).post("/recipients", data={"channel": "mail", "address": "a..b@example.com"}).status_code == 400
    )
    assert [one.address for one in history.recipients().recipients] == ["logging", "anna@example.com"]


def test_the_secret_of_a_web_address_is_not_shown(visit: Visit, history: eg.History) -> None:
    history.add_recipient("webhook", "https://hooks.example.com/T0/secret")
    for path in ("/recipients", "/recipients.json", "/recipients.csv", "/settings", "/audit", "/audit.json"):
        assert "T0/" not in visit(ADMINISTRATOR).get(path).text
    assert "https://hooks.example.com/..." in visit(ADMINISTRATOR).get("/recipients").text


def test_a_trial_message_is_sent_and_a_recipient_removed(
    visit: Visit, history: eg.History, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level("WARNING", logger="elastogeo.alarms"):
        done = visit(ADMINISTRATOR).post("/recipients/1/try")
    assert "The trial message was taken by log." in done.text
    assert "This is a trial" in caplog.text
    visit(ADMINISTRATOR).post("/recipients/1/remove")
    assert [one.active for one in history.recipients().recipients] == [False]
    assert visit(ADMINISTRATOR).post("/recipients/9/try").status_code == 400


def test_a_trial_message_that_is_not_taken_says_why(visit: Visit, history: eg.History) -> None:
    history.add_recipient("mail", "anna@example.com")
    answer = visit(ADMINISTRATOR).post("/recipients/2/try")
    assert answer.status_code == 400
    assert "no mail server is known; set ELASTOGEO_SMTP_HOST" in answer.text


def test_a_machine_is_called_otherwise_and_keeps_its_tests(visit: Visit, history: eg.History) -> None:
    data = {"name": "Mill 4", "kind": "hermle_c50", "serial": "4711", "place": "hall 2", "why": "moved"}
    assert visit(READER).post("/machines/1/edit", data=data).status_code == 403
    before = history.verdict(NAME).state
    visit(ENGINEER).post("/machines/1/edit", data=data)
    assert history.verdict("Mill 4").state == before
    assert [row["place"] for row in visit().get("/alarms.json").json()["alarms"]] == ["hall 2"]
    assert visit(ENGINEER).post("/machines/1/edit", data={"name": "lathe 1"}).status_code == 400
    assert visit(ENGINEER).post("/machines", data={"name": "LATHE 1"}).status_code == 400
    assert visit(ENGINEER).get("/machines/9/edit").status_code == 404
    visit(ENGINEER).post("/machines/1/edit", data={"name": "Mill 4"})
    assert {one.name: one.serial for one in history.machines()} == {"Mill 4": "", OTHER: ""}


def test_the_trail_is_searched_by_subject_and_person(visit: Visit, history: eg.History) -> None:
    history.acknowledge(1, "seen")
    for number in range(3):
        history.add_instrument(f"X-{number}")
    rows = visit(READER).get("/audit.json?subject=alarm+1").json()["rows"]
    assert [(row["what"], row["new"]) for row in rows] == [("alarm", "acknowledged"), ("alarm", "open")]
    assert {row["what"] for row in visit(READER).get("/audit.json?subject=instrument").json()["rows"]} == {"add instrument"}
    assert {row["who"] for row in visit(READER).get("/audit.json?who=a.+miller").json()["rows"]} == {"A. Miller"}
    assert visit(READER).get("/audit.json?subject=%25").json()["rows"] == []
    assert "is as it was written" in visit(READER).get("/audit").text
    first = visit(READER).get("/audit.json?before=2").json()["rows"]
    assert [row["number"] for row in first] == [1]


def test_a_backup_and_a_check_are_jobs_and_the_page_knows_them(
    visit: Visit, history: eg.History, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ELASTOGEO_BACKUPS", str(tmp_path / "backups"))
    assert "No backup was made yet. Nothing was checked yet." in visit(READER).get("/backup").text
    assert visit(ENGINEER).post("/backup").status_code == 403
    browser = visit(ADMINISTRATOR)
    for path in ("/backup", "/backup", "/backup/verify"):
        browser.post(path, headers={"Accept": "application/json"})
    assert "Going on" in browser.get("/backup").text
    assert Worker(history.store).run(once=True) == 2, "asked for twice, it is made once"
    page = browser.get("/backup").text
    assert "The last backup is less than a day old. All was checked less than a day ago" in page
    (made,) = (tmp_path / "backups").iterdir()
    assert (made / "manifest.json").is_file()
    assert [row["place"] for row in browser.get("/backup.json").json()["backups"]] == [str(made)]


def test_free_text_is_text_on_every_page(visit: Visit, history: eg.History) -> None:
    nasty = "<script>alert(1)</script>\"'><img src=x onerror=alert(1)>"
    history.add_instrument(nasty, kind=nasty, calibrated="2025-01-01", certificate=nasty)
    history.acknowledge(1, nasty)
    history.silence_until(NAME, "2099-01-01", nasty)
    history.set_baseline(OTHER, last=6, why=nasty)
    history.change_machine(1, name=nasty, kind=nasty, serial=nasty, place=nasty, why=nasty)
    pages: list[Callable[[], str]] = [
        lambda path=path: visit().get(path).text  # type: ignore[misc]
        for path in (
            "/alarms",
            "/alarms/1",
            "/instruments",
            "/instruments/2",
            *PATHS,
            "/settings/series/2",
            "/machines/1/edit",
        )
    ]
    for page in pages:
        text = page()
        assert "<script>alert" not in text
        assert "<img src=x" not in text
