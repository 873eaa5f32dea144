"""The fleet, a machine, its tests and the search, as they come from the server."""

from __future__ import annotations

import csv
import gzip
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import pytest
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.web import Settings, application
from tests.web.conftest import copy_of
from tests.web.fleets import ALARMED, LATE, SUSPECTED, VARIED

HOST = "http://127.0.0.1:8347"


@pytest.fixture(scope="module")
def history(made_fleet: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[eg.History]:
    with eg.History(copy_of(made_fleet, tmp_path_factory.mktemp("machines") / "fleet"), who="A. Miller") as history:
        yield history


@pytest.fixture(scope="module")
def pages(history: eg.History) -> TestClient:
    return TestClient(application(Settings(history.store.url, who="A. Miller"), history.store), HOST)


@pytest.fixture(scope="module")
def keys(history: eg.History) -> dict[str, int]:
    return {machine.name: machine.key for machine in history.machines()}


def links(text: str, within: str = "") -> list[str]:
    part = text[text.index(within) :] if within else text
    return re.findall(r'href="([^"]+)"', part)


def test_the_fleet_says_its_answer_counts_its_states_and_lists_the_worst_first(
    pages: TestClient, history: eg.History, keys: dict[str, int]
) -> None:
    page = pages.get("/").text
    fleet = history.fleet()
    rows = re.findall(r'<tr class="\w+">\s*<th scope="row" class="who"><a href="/machines/(\d+)">', page)
    assert [int(key) for key in rows] == [keys[row.machine] for row in fleet.machines]
    assert fleet.machines[0].machine == ALARMED.name
    for state, mark in (("alarm", "■"), ("suspect", "◆"), ("overdue", "◷"), ("no baseline", "–")):
        assert re.search(rf"<b>{fleet.counts[state]}</b> <span>{mark} {state.capitalize()}</span>", page), state
    assert page.index('class="sentence"') < page.index("<table")
    assert "Mill &lt;3&gt; &amp; sons" in page
    assert "Simulated" in page


def test_facets_are_in_the_address_and_the_twins_follow_them(pages: TestClient) -> None:
    hall = pages.get("/", params={"hall": "hall 2"}).text
    assert SUSPECTED.name in hall
    assert LATE.name in hall
    assert f">{ALARMED.name}</a>" not in hall
    late = pages.get("/fleet.json", params={"hall": "hall 2", "state": "overdue"}).json()
    assert [row["name"] for row in late["rows"]] == [LATE.name]
    assert late["asked"] == {"hall": "hall 2", "model": "", "state": "overdue"}
    rows = list(csv.DictReader(io.StringIO(pages.get("/fleet.csv", params={"state": "alarm"}).text)))
    assert [row["name"] for row in rows] == [ALARMED.name]
    assert "No machine fits what is asked for" in pages.get("/", params={"hall": "hall 9"}).text


def test_the_fleet_asks_for_itself_each_minute_and_is_told_when_nothing_changed(pages: TestClient) -> None:
    page = pages.get("/", params={"hall": "hall 2"})
    assert 'hx-get="/?hall=hall%202" hx-trigger="every 60s"' in page.text
    part = pages.get("/", params={"hall": "hall 2"}, headers={"HX-Request": "true"})
    assert part.text.lstrip().startswith('<div id="fleet"')
    assert "<html" not in part.text
    again = pages.get("/", params={"hall": "hall 2"}, headers={"HX-Request": "true", "If-None-Match": part.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
    assert part.headers["etag"] != page.headers["etag"]


def test_a_machine_says_its_verdict_draws_its_trend_and_lists_indicators_tests_and_events(
    pages: TestClient, history: eg.History, keys: dict[str, int]
) -> None:
    page = pages.get(f"/machines/{keys[ALARMED.name]}").text
    verdict = history.verdict(ALARMED.name)
    document = pages.get(f"/machines/{keys[ALARMED.name]}.json").json()
    assert document["schema"] == "elastogeo.machine/1"
    assert document["state"] == "alarm"
    assert document["verdict"]["sentence"] in re.sub("</?b>", "", page)
    assert re.search(r'<p class="sentence">[^<]* <b>[^<]+</b>', page)
    figure = page[page.index('<div class="wide"') : page.index('<div class="narrow"')]
    assert figure.count('class="mark"') == len(verdict.series)
    assert set(re.findall(r'data-key="(\d+)"', figure)) == set(verdict.series.tests)
    table = page[page.index('<table class="indicators">') :]
    assert re.findall(r'<th scope="row"><a href="[^"]*indicator=([^"&]+)"', table)[: len(verdict.indicators)] == [
        one.name.replace(" ", "%20") for one in verdict.indicators
    ]
    assert table.count('<svg class="plot"') >= len(verdict.indicators)
    assert f"/tests/{verdict.series.tests[-1]}" in links(page, '<table class="tests">')
    assert "lubrication of X renewed (simulated)" in page


def test_another_indicator_is_another_trend_and_is_swapped_in_alone(
    pages: TestClient, history: eg.History, keys: dict[str, int]
) -> None:
    verdict, at = history.verdict(ALARMED.name), f"/machines/{keys[ALARMED.name]}"
    name = verdict.indicators[-1].name
    whole = pages.get(at, params={"indicator": name}).text
    part = pages.get(at, params={"indicator": name}, headers={"HX-Request": "true"}).text
    title = f"{name[:1].upper()}{name[1:]}"
    assert f'<h2 id="trend" tabindex="-1">{title}</h2>' in whole
    assert f'<h2 id="trend" tabindex="-1">{title}</h2>' in part
    assert part.lstrip().startswith('<div id="charts"')
    assert "<html" not in part
    missing = pages.get(at, params={"indicator": "<script>"})
    assert missing.status_code == 404
    assert "<script>" not in missing.text.split("<main", 1)[1]


def test_the_last_year_leaves_out_what_was_before(pages: TestClient, keys: dict[str, int]) -> None:
    at = f"/machines/{keys[LATE.name]}"
    marks = [pages.get(at, params={"span": span}).text.count('<g class="mark"') for span in ("all", "year", "<b>")]
    assert marks[0] == marks[2]
    assert 0 < marks[1] <= marks[0]


def test_a_machine_of_several_series_shows_the_one_that_is_asked_for(
    pages: TestClient, history: eg.History, keys: dict[str, int]
) -> None:
    at = f"/machines/{keys[VARIED]}"
    every = history.series(VARIED)
    assert len(every) > 2
    page = pages.get(at).text
    for one in every:
        assert f'<option value="{one.key}"' in page
        asked = pages.get(at, params={"series": one.key}).text
        assert re.search(rf'<option value="{one.key}" selected>', asked), one.name
        assert len(re.findall(r"<option value=.* selected>", asked)) == 1
    foreign = history.series(ALARMED.name)[0].key
    assert pages.get(at, params={"series": foreign}).status_code == 400


def test_a_machine_is_as_its_full_judgement_says(pages: TestClient, history: eg.History, keys: dict[str, int]) -> None:
    for name, key in keys.items():
        kept, judged = pages.get(f"/machines/{key}.json").json(), json.loads(history.machine(name).to_json())
        assert kept["state"] == judged["state"]
        assert kept["open_alarms"] == judged["open_alarms"]
        assert {one["name"]: one["state"] for one in kept["series"]} == {
            one["name"]: one["state"] for one in judged["series"]
        }
        assert kept["due"] == judged["due"]


def test_tests_are_listed_with_their_numbers_as_csv(pages: TestClient, history: eg.History, keys: dict[str, int]) -> None:
    at, verdict = f"/machines/{keys[ALARMED.name]}/tests", history.verdict(ALARMED.name)
    page = pages.get(at, params={"indicator": "backlash Y"}).text
    assert "Backlash Y [µm]" in page
    assert [link for link in links(page, '<table class="tests">') if "/tests/" in link] == [
        f"/tests/{test}" for test in verdict.series.tests[::-1]
    ]
    rows = list(csv.DictReader(io.StringIO(pages.get(f"{at}.csv", params={"indicator": "backlash Y"}).text)))
    column = verdict.series.indicators.index("backlash Y")
    assert [float(row["value"]) for row in rows] == list(verdict.series.value[:, column])
    assert pages.get(at, params={"page": 9}).text.count('<a href="/tests/') == 0


@pytest.mark.parametrize("path", ["/", "/machines/1", "/machines/1/tests", "/search?q=hermle"])
def test_pages_are_well_formed_small_and_hold_no_script_style_or_other_host(pages: TestClient, path: str) -> None:
    page = pages.get(path)
    assert page.status_code == 200
    assert len(gzip.compress(page.content)) < 60_000
    assert " style=" not in page.text
    assert not re.search(r"<script(?! src=)", page.text)
    assert not re.search(r'(?:href|src)="(?:https?:)?//', page.text)
    assert len(re.findall("<h1", page.text)) == 1
    for svg in re.findall(r"<svg.*?</svg>", page.text, re.DOTALL):
        ElementTree.fromstring(svg)


def test_a_report_of_a_machine_can_be_taken_along(pages: TestClient, keys: dict[str, int]) -> None:
    answer = pages.get(f"/machines/{keys[SUSPECTED.name]}/report.html")
    assert answer.headers["content-type"] == "text/html; charset=utf-8"
    assert SUSPECTED.name in answer.text
    assert "attachment" in answer.headers["content-disposition"]


def test_search_finds_machines_series_tests_and_events_by_parts_of_words(pages: TestClient, keys: dict[str, int]) -> None:
    found = pages.get("/search.json", params={"q": "HERMLE 5014"}).json()
    assert [(one["kind"], one["id"]) for one in found["entries"]] == [("machines", keys[ALARMED.name])]
    assert {one["kind"] for one in pages.get("/search.json", params={"q": "huron"}).json()["entries"]} >= {
        "machines",
        "tests",
    }
    assert [one["name"] for one in pages.get("/search.json", params={"q": "lubric"}).json()["entries"]] == [
        "lubrication of X renewed (simulated)"
    ]
    page = pages.get("/search", params={"q": "<3>"}).text
    assert f"/machines/{keys[VARIED]}" in links(page, "<main")
    assert "<3>" not in page


@pytest.mark.parametrize("words", ["%", "h_rmle", "\\", "'", "%25", "no such thing", "\x00", "a" * 200])
def test_a_pattern_of_the_database_is_a_letter_here(pages: TestClient, words: str) -> None:
    assert pages.get("/search.json", params={"q": words}).json()["entries"] == []


def test_a_search_for_nothing_says_what_to_write(pages: TestClient) -> None:
    assert pages.get("/search.json").json()["entries"] == []
    assert "Write what a machine" in pages.get("/search").text
    assert pages.get("/search", params={"q": "x" * 201}).status_code == 422


def test_a_history_without_machines_leads_to_a_first_test(tmp_path: Path) -> None:
    with eg.History(tmp_path / "new.db", create=True) as empty:
        page = TestClient(application(Settings(empty.store.url), empty.store), HOST).get("/")
    assert "No machine yet" in page.text
    assert "/first" in links(page.text, "<main")
