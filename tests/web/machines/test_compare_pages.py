"""Compare, campaigns, events and explore: what they show, what they refuse, and that adding an event needs a role."""

from __future__ import annotations

import gzip
import json
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.web import Settings, application
from tests.web.conftest import copy_of

HOST = "http://127.0.0.1:8347"
POSTED = {"Origin": HOST, "Sec-Fetch-Site": "same-origin"}
PAGE = 60_000
"""Bytes that a page may have when it is packed."""


@pytest.fixture(scope="module")
def history(made_fleet: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[eg.History]:
    database = copy_of(made_fleet, tmp_path_factory.mktemp("compare") / "fleet")
    with eg.History(database, who="A. Miller") as history:
        yield history


@pytest.fixture(scope="module")
def client(history: eg.History) -> TestClient:
    app = application(Settings(history.store.url, who="A. Miller"), history.store)
    return TestClient(app, HOST, raise_server_exceptions=False, follow_redirects=False)


def _known(history: eg.History, number: int) -> tuple[Any, ...]:
    try:
        return history.comparable(number).tests
    except eg.InputError:
        return ()


def test_the_page_of_two_tests_says_what_changed_and_shows_both_circles(client: TestClient, history: eg.History) -> None:
    found = history.comparable(1)
    last, first = found.tests[0].key, found.tests[-1].key
    page = client.get(f"/compare?a={last}&b={first}")
    assert page.status_code == 200
    kept = history.compare(first, last)
    document = client.get(f"/compare.json?a={last}&b={first}").json()
    assert document["schema"] == "elastogeo.compare/1"
    assert (document["before"]["test"], document["after"]["test"]) == (first, last)
    assert document["joint"]["p_value"] == kept.joint.p_value  # type: ignore[union-attr]
    assert document["sentence"].split(" ")[0] in page.text
    assert page.text.count('class="bar"') == len(kept.indicators) + len(kept.parameters)
    assert "stroke-dasharray" in page.text
    assert {"p-blue", "p-orange"} <= set(re.findall(r"p-(?:blue|orange)", page.text))
    assert "SIMULATED" in page.text.upper()
    assert len(gzip.compress(page.content)) < PAGE
    assert client.get(f"/compare.csv?a={last}&b={first}").text.splitlines()[0].startswith("name,unit,before,after,change")


def test_a_grey_row_is_within_the_scatter_and_a_bold_one_beyond(client: TestClient, history: eg.History) -> None:
    found = history.comparable(1)
    kept = history.compare(found.tests[-1].key, found.tests[0].key)
    beyond = sum(one.within is False for one in kept.indicators)
    page = client.get(f"/compare?a={kept.before.key}&b={kept.after.key}").text
    table = page[page.index('class="bars judged"') :]
    table = table[: table.index("</table>")]
    assert beyond >= 1
    assert table.count('<tr class="strong">') == beyond
    assert table.count('<tr class="within">') == len(kept.indicators) - beyond


def test_a_level_is_chosen_in_the_address(client: TestClient, history: eg.History) -> None:
    found = history.comparable(1)
    pair = f"a={found.tests[0].key}&b={found.tests[1].key}"
    forces = sorted({trace.force for trace in history.compare(*(t.key for t in found.tests[:2])).traces})
    low = client.get(f"/compare?{pair}&level=circles-{forces[0]:g}").text
    assert f"Measured at {forces[0]:g} N" in low
    assert f"Measured at {forces[-1]:g} N" in client.get(f"/compare?{pair}").text
    assert f"Measured at {forces[-1]:g} N" in client.get(f"/compare?{pair}&level=nonsense").text


def test_what_does_not_compare_says_why(client: TestClient, history: eg.History) -> None:
    machines = {history.comparable(number).machine: number for number in range(1, 24)}
    one, other = list(machines.values())[:2]
    page = client.get(f"/compare?a={one}&b={other}")
    assert page.status_code == 200
    assert "Not comparable" in page.text
    assert "These tests are of two machines" in page.text
    assert client.get(f"/compare.json?a={one}&b={other}").json()["comparable"] is False
    assert "Choose two tests to compare" in client.get("/compare?a=1").text
    assert "Open a test and press" in client.get("/compare").text
    assert "one and the same test" in client.get("/compare?a=1&b=1").text
    assert client.get("/compare?a=1&b=99999").status_code == 400
    assert client.get("/compare?a=x&b=1").status_code == 422


def test_tests_of_other_instruments_compare_too(history: eg.History, client: TestClient) -> None:
    """Whatever the instrument, every pair of tests of a machine is answered: with numbers, or with the reason."""
    varied = next(one for number in range(1, 40) for one in _known(history, number) if one.machine.startswith("Mill"))
    keys = [one.key for one in history.comparable(varied.key).tests]
    assert len(keys) >= 4
    for one, other in pairwise(keys):
        document = client.get(f"/compare.json?a={one}&b={other}").json()
        assert document["comparable"] or document["sentence"].startswith("These tests determine nothing in common")


def test_a_campaign_shows_its_tests_and_what_they_say_together(client: TestClient, history: eg.History) -> None:
    (kept,) = history.campaigns().campaigns
    assert f'href="/campaigns/{kept.key}"' in client.get("/campaigns").text
    page = client.get(f"/campaigns/{kept.key}").text
    for test in kept.tests.values():
        assert f'href="/tests/{test}"' in page
    assert kept.document is not None
    assert all(one["name"] in page for one in kept.document["parameters"] if one["separated"])
    assert client.get(f"/campaigns/{kept.key}.json").json()["schema"] == "elastogeo.campaign-kept/1"
    assert client.get("/campaigns/99").status_code == 404
    asked = client.post(f"/campaigns/{kept.key}/recompute", headers=POSTED | {"Accept": "application/json"}).json()
    assert history.job(asked["job"]).kind == "recompute campaign"
    assert client.post("/campaigns/99/recompute", headers=POSTED).status_code == 404


def test_an_event_is_added_listed_and_filtered_and_no_note_is_a_script(client: TestClient, history: eg.History) -> None:
    machine = history.machines()[0]
    note = "<script>alert(1)</script> nut of X"
    form = {"kind": "repair", "note": note, "at": "2026-03-01"}
    done = client.post(f"/machines/{machine.key}/events", data=form, headers=POSTED)
    assert (done.status_code, done.headers["location"]) == (303, f"/machines/{machine.key}/events")
    page = client.get(f"/machines/{machine.key}/events").text
    assert "&lt;script&gt;alert(1)&lt;/script&gt; nut of X" in page
    assert "<script>alert" not in page
    listed = client.get("/events.json?kind=repair&year=2026").json()
    assert note in [one["note"] for one in listed["events"] if one["machine"] == machine.name]
    assert {one["kind"] for one in listed["events"]} == {"repair"}
    assert client.get("/events.json?year=1999").json()["events"] == []
    assert {one["kind"] for one in client.get("/events.json?kind=calibration").json()["events"]} == {"calibration"}
    tool = client.post("/events", data={"kind": "calibration", "note": "balls", "instrument": "B-101"}, headers=POSTED)
    assert tool.status_code == 303
    for wrong in (
        {"kind": "party", "note": "x"},
        {"kind": "note", "note": " "},
        {"kind": "note", "note": "x", "at": "soon"},
    ):
        assert client.post(f"/machines/{machine.key}/events", data=wrong, headers=POSTED).status_code == 400
    assert client.post("/events", data={"kind": "note", "note": "x"}, headers=POSTED).status_code == 400
    assert client.post("/machines/99/events", data=form, headers=POSTED).status_code == 404
    assert client.get("/events?kind=party").status_code == 400


def test_the_readings_of_every_run_and_what_the_model_leaves(client: TestClient, history: eg.History) -> None:
    document = client.get("/explore.json?test=1").json()
    page = client.get("/explore?test=1").text
    kept = history.explore(1)
    assert document["schema"] == "elastogeo.explore/1"
    assert [run["run"] for run in document["runs"]] == [run.run for run in kept.runs]
    assert page.count('name="run"') == len(kept.runs)
    for run in document["runs"]:
        assert len(run["along"]) == len(run["measured"]) == len(run["predicted"]) == run["readings"]
    assert "/static/plotly.min.js?v=" in page
    assert "<script>" not in page
    assert len(gzip.compress(page.encode())) < PAGE
    assert client.get("/explore?test=9999").status_code == 404
    assert "plotly" not in client.get("/compare").text


def test_plotly_comes_from_here_and_sends_nothing(client: TestClient) -> None:
    page = client.get("/explore?test=1").text
    config = json.loads(re.search(r'data-config="([^"]*)"', page)[1].replace("&#34;", '"'))  # type: ignore[index]
    assert config["plotlyServerURL"] == ""
    assert config["showSendToCloud"] is False
    assert {"sendChartToCloud", "sendDataToCloud"} <= set(config["modeBarButtonsToRemove"])
    packed = client.get("/static/plotly.min.js", headers={"Accept-Encoding": "gzip"})
    assert packed.headers["content-encoding"] == "gzip"
    assert packed.content.startswith(b"/**")
    assert b"plotly.js v" in packed.content[:200]
