"""Plans on the pages: a goal in words, ways as cards, one is chosen, its checklist, its programs, done."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import pytest
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.cli import main
from elastogeo.history.jobs import Worker
from elastogeo.report import view_of
from elastogeo.web import Settings, application
from tests.web.ahead import HOST, shop_in

ORIGIN = {"Origin": HOST}


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    url, made = shop_in(tmp_path_factory.mktemp("plans") / "shop")
    return {"url": url, **made}


@pytest.fixture(scope="module")
def history(keys: dict[str, object]) -> Iterator[eg.History]:
    with eg.History(str(keys["url"]), who="A. Miller") as found:
        yield found


@pytest.fixture(scope="module")
def pages(history: eg.History) -> TestClient:
    return TestClient(application(Settings(history.store.url, who="A. Miller"), history.store), HOST)


def test_ways_are_cards_with_what_they_resolve_and_cannot(pages: TestClient, keys: dict[str, object]) -> None:
    page = pages.get(f"/machines/1/plan?job={keys['ways']}").text
    assert "Resolves: the X drive from the Y guideway." in page
    assert "Cannot tell: C_XXX of the X drive looks like the Y guideway" in page
    assert "min, with the" in page
    assert page.count('action="/machines/1/plan/choose"') == page.count('class="card way')
    assert "Mill &lt;3&gt;" in page


def test_a_way_says_which_instrument_it_needs_that_is_not_there(history: eg.History, keys: dict[str, object]) -> None:
    found = history.next_tests_of(history.job(int(str(keys["ways"]))))
    with_it = [section.paragraphs for section in view_of(replace(found, instruments=("loaded-ball-bar",))).sections]
    without = [section.paragraphs for section in view_of(replace(found, instruments=("ball-bar",))).sections]
    said = "It needs the loaded ball bar: not among the instruments available."
    assert any(said in paragraphs for paragraphs in without)
    assert not any(said in paragraphs for paragraphs in with_it)


@pytest.mark.parametrize(("entry", "value"), [("percent", "nan"), ("percent", "0"), ("percent", "100"), ("minutes", "nan")])
def test_a_number_that_is_none_is_refused_before_a_job_is_made(
    pages: TestClient, history: eg.History, entry: str, value: str
) -> None:
    form = {"goal": "stiffness", "percent": "5", "minutes": "15", "instrument": "loaded-ball-bar", entry: value}
    before = len(history.jobs().jobs)
    answer = pages.post("/machines/1/plan", data=form, headers=ORIGIN, follow_redirects=False)
    assert answer.status_code == 422
    assert f"What was sent does not fit: {entry}." in answer.text
    assert len(history.jobs().jobs) == before


def test_a_goal_is_asked_for_and_a_way_is_kept(pages: TestClient, history: eg.History) -> None:
    form = {"goal": "between", "one": "drive X", "other": "drive Y", "minutes": "15", "instrument": "loaded-ball-bar"}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("elastogeo.changes.next_tests.ways.CANDIDATES", 24)
        answer = pages.post("/machines/1/plan", data=form, headers=ORIGIN, follow_redirects=False)
        assert answer.status_code == 303
        at = answer.headers["location"]
        assert "being worked out" in pages.get(at).text
        Worker(history.store).run(once=True)
    assert "the X drive from the Y drive" in pages.get(at).text
    number = at.rpartition("=")[2]
    chosen = {"job": number, "way": "0", "name": "Drives <1>", "due": "2020-01-01", "grace": "2"}
    kept = pages.post("/machines/1/plan/choose", data=chosen, headers=ORIGIN, follow_redirects=False)
    assert kept.status_code == 303
    assert "Drives &lt;1&gt;" in pages.get(kept.headers["location"]).text
    again = pages.post("/machines/1/plan/choose", data=chosen, headers=ORIGIN)
    assert again.status_code == 400
    assert "already" in again.text
    plans = pages.get("/plans").text
    assert plans.index("Drives &lt;1&gt;") < plans.index("the first")
    assert "overdue" in plans
    assert f'<a href="{kept.headers["location"]}">' in plans
    assert [one["name"] for one in pages.get("/plans.json").json()["plans"]] == ["Drives <1>", "the first"]
    assert "Drives" not in pages.get("/plans?machine=2").text
    assert pages.post("/machines/2/plan/choose", data=chosen | {"name": "x"}, headers=ORIGIN).status_code == 404


def test_a_plan_that_cannot_be_made_says_why(pages: TestClient, history: eg.History) -> None:
    form = {"goal": "between", "one": "drive X", "other": "drive X", "minutes": "60", "instrument": "loaded-ball-bar"}
    at = pages.post("/machines/1/plan", data=form, headers=ORIGIN, follow_redirects=False).headers["location"]
    Worker(history.store).run(once=True)
    assert "it takes two components to be told apart" in pages.get(at).text


def test_programs_are_those_of_nc_byte_for_byte(
    pages: TestClient, keys: dict[str, object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    packed = pages.get(f"/plans/{keys['plan']}/folder.zip")
    assert packed.headers["content-disposition"] == f'attachment; filename="plan-{keys["plan"]}.zip"'
    with ZipFile(BytesIO(packed.content)) as whole:
        whole.extractall(tmp_path)
    (name,) = [one["test"] for one in pages.get(f"/plans/{keys['plan']}.json").json()["programs"]]
    for flavour, suffix in {"iso": "nc", "linuxcnc": "ngc", "sinumerik": "mpf", "heidenhain": "h"}.items():
        out = tmp_path / f"{flavour}.{suffix}"
        asked = ["elastogeo", "nc", str(tmp_path / "campaign" / name), "--flavour", flavour, "-o", str(out), "--json"]
        monkeypatch.setattr(sys, "argv", asked)
        assert main() == 0
        found = pages.get(f"/plans/{keys['plan']}/programs/{name}.{suffix}")
        assert found.content == out.read_bytes()
        assert f'filename="{name}.{suffix}"' in found.headers["content-disposition"]
        assert (tmp_path / "campaign" / "programs" / flavour / f"{name}.{suffix}").read_bytes() == found.content


@pytest.mark.parametrize("path", ["/plans/99", "/plans/1/programs/x.exe", "/plans/1/programs/x.nc", "/plans/99/folder.zip"])
def test_what_is_not_there_is_said(pages: TestClient, path: str) -> None:
    assert pages.get(path).status_code == 404


def test_a_plan_is_done_when_somebody_says_so(pages: TestClient, history: eg.History, keys: dict[str, object]) -> None:
    number = history.choose_plan(int(str(keys["ways"])), 0, "to be done")
    page = pages.get(f"/plans/{number}")
    assert "Checklist" in page.text
    assert "Mark as done" in page.text
    pages.post(f"/plans/{number}/done", data={"why": "on Sunday"}, headers=ORIGIN)
    assert "Mark as done" not in pages.get(f"/plans/{number}").text


def test_a_machine_without_tests_is_planned_by_its_kind(pages: TestClient) -> None:
    page = pages.get("/machines/2/plan")
    assert "rotary axis A" in page.text
    assert "Know the stiffness" not in page.text
