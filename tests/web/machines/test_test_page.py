"""The page of a test: what it says first, of every instrument, before and after it is drawn, and what is done on it."""

from __future__ import annotations

import gzip
import hashlib
import re
from collections.abc import Iterator

import pytest
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.errors import FormatError
from elastogeo.history.analyses import computation
from elastogeo.history.work import Work, kind_named
from elastogeo.web import Settings, application
from tests.history.analyses.kept import EXAMPLES

HOST = "http://127.0.0.1:8347"
SENT = {"Origin": HOST, "Sec-Fetch-Site": "same-origin"}
HTMX = {"HX-Request": "true"}
WHY = "<script>alert(1)</script> ball not seated"


@pytest.fixture(scope="module")
def history(tmp_path_factory: pytest.TempPathFactory) -> Iterator[eg.History]:
    """A circle, which is drawn, and a static test, which is not yet."""
    folder = tmp_path_factory.mktemp("tests")
    with eg.History(folder / "h.db", create=True, who="A. Miller") as history:
        history.add_machine("Mill <3>", place="hall 1")
        history.add(EXAMPLES / "ball-bar-diagnosis", machine="Mill <3>", date="2026-03-01")
        history.add(EXAMPLES / "static-probes", machine="Mill <3>", date="2026-03-03")
        history.draw(1)
        yield history


@pytest.fixture(scope="module")
def browser(history: eg.History) -> TestClient:
    app = application(Settings(history.store.url, who="A. Miller"), history.store)
    return TestClient(app, HOST, raise_server_exceptions=False)


def test_the_page_answers_first_then_what_failed_then_the_trace(browser: TestClient) -> None:
    page, verdict = browser.get("/tests/1").text, browser.get("/tests/1.json").json()["verdict"]
    attention = [f"<b>{check['name']}</b>" for check in verdict if check["passed"] is not True]
    passed = sum(check["passed"] is True for check in verdict)
    assert attention
    order = ["Test of 1 March 2026", " makes ", *sorted(attention, key=page.index), f"<summary>{passed} checks passed"]
    places = [page.index(one) for one in (*order, "Trace at", "What causes it", "Where it comes from")]
    assert places == sorted(places)
    assert page.count("<h1") == 1
    assert "Mill &lt;3&gt;" in page
    assert "Mill <3>" not in page


def test_the_page_is_small_and_needs_no_script(browser: TestClient) -> None:
    page = browser.get("/tests/1")
    assert len(gzip.compress(page.content)) < 60_000
    assert 'type="range"' in page.text
    assert all("hidden" in one for one in re.findall(r'<input type="range"[^>]*>', page.text))
    assert not re.search(r"<script(?![^>]*\bsrc=)|\son\w+=|\sstyle=", page.text)
    whole = browser.get("/tests/1?part=0").text
    assert whole.count("<figure ") >= 1
    assert not re.search(r"\sstyle=|<style", whole)


def test_cw_and_ccw_have_two_colours_and_the_model_a_third(browser: TestClient) -> None:
    drawing = re.search(r'<div class="polar">(.*?)</div>', browser.get("/tests/1").text, re.DOTALL)
    assert drawing
    for kind in ("p-blue", "p-orange", "p-ink"):
        assert f'<path class="{kind}"' in drawing[1]
    assert "magnified" in drawing[1]


def test_the_set_up_is_no_cause(browser: TestClient, history: eg.History) -> None:
    page, twin = browser.get("/tests/1").text, browser.get("/tests/1.json").json()
    causes = [name for cause in twin["causes"] for name in cause["names"]]
    assert causes
    assert not {"E_Xt0", "E_Yt0"} & set(causes)
    assert page.count('<li class="cause') == len(twin["causes"])
    assert twin["schema"] == "elastogeo.test/1"
    kept = history.test(1).analysis
    assert kept is not None
    assert kept.document is not None
    assert twin["result"] == kept.document["schema"]
    assert twin["verdict"] == kept.document["verdict"]
    for run in twin["columns"].values():
        assert len(run["columns"]) == len(twin["causes"])


def test_sliders_get_the_columns_of_one_force_level(browser: TestClient) -> None:
    answer = browser.get("/tests/1/columns")
    found = answer.json()
    assert {run["force_N"] for run in found["runs"].values()} == {found["drawing"]["force_N"]}
    assert {run["direction"] for run in found["runs"].values()} == {"ccw", "cw"}
    again = browser.get("/tests/1/columns", headers={"If-None-Match": answer.headers["etag"]})
    assert again.status_code == 304


def test_what_is_folded_comes_when_it_is_opened(browser: TestClient) -> None:
    page = browser.get("/tests/1").text
    parts = re.findall(r'<details class="section" id="part-(\d+)" hx-get="([^"]+)"', page)
    assert parts
    inside = browser.get(parts[0][1].replace("&amp;", "&"), headers=HTMX).text
    assert inside.lstrip().startswith("<")
    assert "<html" not in inside
    assert "<svg" in inside
    assert browser.get("/tests/1?part=98", headers=HTMX).status_code == 404


def test_a_test_that_is_not_drawn_says_what_it_says_and_asks_for_the_rest_once(
    browser: TestClient, history: eg.History
) -> None:
    page = browser.get("/tests/2").text
    assert "checks passed" in page or 'class="failed"' in page
    assert 'hx-trigger="every 1s"' in page
    assert "look again" in page
    before = len(history.jobs().jobs)
    assert 'hx-trigger="every 1s"' in browser.get("/tests/2/drawn", headers=HTMX).text
    assert len(history.jobs().jobs) == before
    history.draw(2)
    drawn = browser.get("/tests/2/drawn", headers=HTMX).text
    assert "every 1s" not in drawn
    assert "<html" not in drawn
    assert '<span id="reports" hx-swap-oob="true"><a class="button" href="/tests/2/report.pdf"' in drawn


def test_what_is_no_circle_shows_its_own_view(browser: TestClient, history: eg.History) -> None:
    history.draw(2)
    page = browser.get("/tests/2").text
    assert "Trace at" not in page
    assert 'type="range"' not in page
    assert re.search("<figure [^>]*><svg", page)
    assert browser.get("/tests/2/columns").status_code == 404


def test_an_error_comes_first_then_the_raw_files(
    browser: TestClient, history: eg.History, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise FormatError("runs/<x>.csv, line 3: no number")

    monkeypatch.setattr(computation, "asked_of", refuse)
    added = history.add(EXAMPLES / "one-level", machine="Mill <3>", date="2026-03-04")
    assert added.imported is not None
    page = browser.get(f"/tests/{added.imported.test}").text
    assert page.index("could not be evaluated: runs/&lt;x&gt;.csv, line 3: no number") < page.index(
        "Raw files, as they came in"
    )
    assert "every 1s" not in page
    assert browser.get(f"/tests/{added.imported.test}.json").json()["analysis"]["error"].startswith("runs/<x>.csv")


def test_raw_files_come_back_bit_for_bit(browser: TestClient, history: eg.History) -> None:
    page = browser.get("/tests/1").text
    for number, file in enumerate(history.test(1).files, 1):
        assert f'/tests/1/files/{number}" download' in page
        answer = browser.get(f"/tests/1/files/{number}")
        assert hashlib.sha256(answer.content).hexdigest() == file.sha256
        assert answer.headers["content-disposition"].startswith("attachment; filename=")
        assert file.sha256 in page
    assert browser.get("/tests/1/files/99").status_code == 404
    assert browser.get("/tests/1/files/0").status_code == 404


def test_the_report_is_downloaded_as_a_page_and_as_a_pdf(browser: TestClient) -> None:
    page = browser.get("/tests/1/report.html")
    assert page.text.startswith("<!DOCTYPE html>")
    assert "attachment" in page.headers["content-disposition"]
    assert browser.get("/tests/1/report.pdf").content.startswith(b"%PDF-")


def test_a_test_is_set_aside_with_a_reason_and_taken_back(browser: TestClient, history: eg.History) -> None:
    def send(**form: str) -> str:
        return browser.post("/tests/1/aside", data=form, headers=SENT).text

    told = send(why=WHY)
    assert "The test is set aside and counts in no chart" in told
    assert history.test(1).is_aside
    page = browser.get("/tests/1").text
    assert "It counts in no chart." in page
    assert "&lt;script&gt;alert(1)&lt;/script&gt; ball not seated" in page
    assert "<script>alert(1)" not in page
    assert "set aside already" in send(why="again")
    assert "counts again" in send(why="it was seated", back="true")
    assert not history.test(1).is_aside
    assert "is set aside for a reason" in send(why=" ")


def test_drawing_again_is_a_job(browser: TestClient, history: eg.History) -> None:
    done = browser.post("/tests/1/draw", headers=SENT | {"Accept": "application/json"}).json()
    job = history.job(done["job"])
    assert (job.kind, job.asked) == ("draw", {"test": 1, "again": True})


def test_recomputing_the_series_is_a_job_that_says_what_came_of_it(browser: TestClient, history: eg.History) -> None:
    asked = {"series": history.test(2).series_key, "test": 2}
    done = browser.post("/tests/2/recompute", headers=SENT | {"Accept": "application/json"}).json()
    assert history.job(done["job"]).asked == asked
    said: list[str] = []
    work = Work(history.store, "A. Miller", lambda text, *_: said.append(text), lambda: False)
    found = kind_named("recompute")(work, asked)
    assert found is not None
    assert (found["computed"], found["differing"], found["at"]) == (1, 0, "/tests/2")
    assert said[-1] == found["said"]


@pytest.mark.parametrize(
    "path", ["/tests/99", "/tests/99.json", "/tests/99/drawn", "/tests/99/report.pdf", "/tests/99/columns"]
)
def test_what_is_not_there_is_said(browser: TestClient, path: str) -> None:
    answer = browser.get(path)
    assert answer.status_code == 404
    assert "There is no such test." in answer.text
