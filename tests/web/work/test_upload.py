"""Uploads, jobs and the first run, page by page without a browser: what is sent, found, confirmed, refused."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.history.jobs import Worker
from elastogeo.history.parcels import staging
from elastogeo.web import Settings, application
from elastogeo.web.work import receiving
from tests.history.intake.small_tests import write_test
from tests.history.parcels.archives import packed
from tests.history.parcels.test_parcels import files_of, parcels

HOST = "http://127.0.0.1:8347"
LONG = b"--B\r\nContent-Disposition: form-data; filename=" + b"a" * 9000 + b"\r\n\r\nx\r\n--B--"
JSON = {"Accept": "application/json"}


@pytest.fixture
def history(tmp_path: Path) -> Iterator[eg.History]:
    with eg.History(tmp_path / "h.db", create=True, who="A. Miller") as history:
        yield history


@pytest.fixture
def browser(history: eg.History) -> TestClient:
    app = application(Settings(history.store.url, who="A. Miller"), history.store)
    return TestClient(app, HOST, raise_server_exceptions=False)


def work(history: eg.History) -> None:
    Worker(history.store).run(once=True)


@pytest.fixture
def sent(tmp_path: Path) -> bytes:
    write_test(tmp_path / "s" / "a", seed=1)
    write_test(tmp_path / "s" / "b", seed=2, date="2026-02-01")
    return packed(files_of(tmp_path / "s"))


def test_from_the_form_to_the_results_without_a_script(browser: TestClient, history: eg.History, sent: bytes) -> None:
    assert 'enctype="multipart/form-data"' in browser.get("/upload").text
    page = browser.post("/upload", files=[("files", ("x.zip", sent)), ("files", ("", b""))])
    assert page.url.path == "/jobs/1"
    assert 'http-equiv="refresh"' in page.text
    work(history)
    page = browser.get("/jobs/1")
    assert "2 tests to import." in page.text
    assert "hx-get" not in page.text
    refused = browser.post("/jobs/1/import", data={"serial": "", "machine": "", "named": "", "date": ""})
    assert refused.status_code == 400
    assert "choose the machine of the tests that do not say their machine, or name a new one" in refused.text
    refused = browser.post("/jobs/1/import", data={"serial": "", "machine": "Mill 9", "named": ""})
    assert "there is no machine &#39;Mill 9&#39;" in refused.text
    page = browser.post("/jobs/1/import", data={"serial": "", "machine": "", "named": "Mill 3", "date": ""})
    assert page.url.path == "/jobs/2"
    work(history)
    page = browser.get("/jobs/2")
    assert "2 new." in page.text
    assert 'href="/tests/2"' in page.text
    assert 'href="/machines/1"' in page.text
    assert browser.post("/jobs/1/import", data={"named": "Mill 4"}).url.path == "/jobs/2"  # sent twice
    assert [one.name for one in history.machines()] == ["Mill 3"]
    browser.post("/upload", files={"files": ("x.zip", sent)})
    work(history)
    assert "2 tests known already: nothing was changed." in browser.get("/jobs/3").text


def test_a_program_sends_one_file_as_it_is_and_reads_the_job(browser: TestClient, history: eg.History, sent: bytes) -> None:
    answer = browser.post("/upload?name=x.zip", content=sent, headers=JSON).json()
    assert answer["at"] == f"/jobs/{answer['job']}"
    work(history)
    found = browser.get(f"{answer['at']}.json").json()
    assert (found["schema"], found["state"], found["errors"]) == ("elastogeo.job/1", "done", [])
    assert [one["path"] for one in found["result"]["tests"]] == ["b", "a"]


def test_a_serial_number_that_no_machine_has_is_asked_for(browser: TestClient, history: eg.History, tmp_path: Path) -> None:
    place = write_test(tmp_path / "a", seed=1)
    text = place.joinpath("test.toml").read_text()
    place.joinpath("test.toml").write_text(text.replace("[about]\n", '[about]\nmachine_serial = "4711"\n'))
    browser.post("/upload", files=[("files", file) for file in files_of(tmp_path / "a")])
    work(history)
    assert "Which machine has the serial number 4711?" in browser.get("/jobs/1").text
    browser.post("/jobs/1/import", data={"serial": "4711", "machine": "", "named": "Mill 3"})
    work(history)
    assert [(one.name, one.serial) for one in history.machines()] == [("Mill 3", "4711")]
    assert "One new." in browser.get("/jobs/2").text or "1 new." in browser.get("/jobs/2").text


def test_a_test_without_a_date_is_imported_on_the_day_that_is_said(
    browser: TestClient, history: eg.History, tmp_path: Path
) -> None:
    write_test(tmp_path / "a", seed=1, date="")
    browser.post("/upload", files=[("files", file) for file in files_of(tmp_path / "a")])
    work(history)
    form = {"serial": "", "named": "Mill 3", "machine": ""}
    assert "give its date" in browser.post("/jobs/1/import", data=form).text
    assert history.machines() == ()  # what is refused makes nothing
    browser.post("/jobs/1/import", data={**form, "date": "2026-03-05"})
    work(history)
    assert browser.get("/jobs/2.json").json()["result"]["tests"][0]["at"].startswith("2026-03-05")


def test_what_is_too_large_is_refused_as_it_comes_and_nothing_is_kept(
    browser: TestClient, history: eg.History, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(staging, "LARGEST", 1000)
    for content in (b"x" * 1001, iter([b"x" * 600] * 2)):
        answer = browser.post("/upload?name=x", content=content, headers=JSON)  # type: ignore[arg-type]
        assert answer.status_code >= 400
        assert "were sent at once; send the tests in several parts" in answer.json()["error"]
    assert browser.post("/upload", files={"files": ("x", b"x" * 1001)}, headers=JSON).status_code >= 400
    monkeypatch.setattr(receiving, "LARGEST", 10)
    monkeypatch.setattr(receiving, "_FORM", 10)
    assert browser.post("/upload", data={"much": "x" * 900}, files={"f": ("", b"")}, headers=JSON).status_code >= 400
    assert parcels(history.store) == []
    assert history.jobs().jobs == ()


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (b"--B\r\nContent-Disposition: form-data; name=f; filename=a\r\n\r\nhalf of it", "multipart/form-data; boundary=B"),
        (b"no form at all", "multipart/form-data; boundary=B"),
        (b"", "multipart/form-data; boundary=B"),
        (b"--B--\r\n", "multipart/form-data; boundary=B"),
        (b"x", "multipart/form-data"),
        (LONG, "multipart/form-data; boundary=B"),
        (b"--B\r\n" + b"A" * 9000 + b": x\r\n\r\nx\r\n--B--\r\n", "multipart/form-data; boundary=B"),
    ],
)  # fmt: skip
def test_what_is_no_form_with_files_leaves_nothing(
    browser: TestClient, history: eg.History, content: bytes, kind: str
) -> None:
    answer = browser.post("/upload", content=content, headers={"Content-Type": kind, **JSON})
    assert answer.status_code == 400
    assert answer.json()["schema"] == "elastogeo.error/1"
    assert parcels(history.store) == []
    assert history.jobs().jobs == ()


def test_a_bad_upload_is_told_in_the_words_of_the_command_line(browser: TestClient, history: eg.History) -> None:
    evil = "<script>alert(1)</script>"
    browser.post("/upload", files=[("files", ("t/test.toml", b'name = "a" b')), ("files", (f"{evil}.csv", b"1"))])
    work(history)
    page = browser.get("/jobs/1").text
    assert "No test was found in what was sent." in page
    assert '<span aria-hidden="true">■</span> Nothing to import' in page, "what holds no test is no success"
    assert 'href="/upload">Send others</a>' in page
    assert "(at line 1, column 12)" in page
    assert evil not in page
    assert "&lt;script&gt;" in page
    assert "Import</button>" not in page


def test_a_job_is_cancelled_and_tried_again(browser: TestClient, history: eg.History) -> None:
    history.put_job("look", {"parcel": "0" * 32})
    assert "Cancel</button>" in browser.get("/jobs/1").text
    assert "Cancelled" in browser.post("/jobs/1/cancel").text
    browser.post("/jobs/1/again")
    work(history)
    page = browser.get("/jobs/1").text
    assert "what was sent is no longer there: it is kept for a day; send it again" in page
    assert "1 failed." in browser.get("/jobs").text
    assert browser.get("/jobs.json").json()["jobs"][0]["state"] == "failed"
    assert browser.get("/jobs/9").status_code == 404
    part = browser.get("/jobs/1", headers={"HX-Request": "true"}).text
    assert part.lstrip().startswith('<div id="job"')


def test_the_first_run_leads_to_the_demo_fleet_an_upload_or_a_machine(browser: TestClient, history: eg.History) -> None:
    page = browser.get("/first").text
    assert [said for said in ("Try the demo fleet", "Upload a test", "Add a machine") if said not in page] == []
    assert browser.post("/first/demo").url.path == "/jobs/1"
    assert history.job(1).kind == "demo"
    assert "Look at the fleet while it grows" in browser.get("/jobs/1").text
    browser.post("/machines", data={"name": "Mill 3", "serial": "4711"})
    assert [one.name for one in history.machines()] == ["Mill 3"]
    assert "there is a machine &#39;Mill 3&#39; already" in browser.post("/machines", data={"name": "Mill 3"}).text
    assert "is made in an empty history only" in browser.post("/first/demo").text
    assert "Try the demo fleet</button>" not in browser.get("/first").text
