"""The map of a workspace: the first direction from the server, every other one in the browser, by the same numbers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from fastapi.testclient import TestClient

import elastogeo as eg
from elastogeo.history.jobs import Worker
from elastogeo.report import view_of
from elastogeo.web import Settings, application
from tests.web.ahead import HOST, shop_in
from tests.web.conftest import Screens, Serve

MAP = "/machines/1/map"


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return shop_in(tmp_path_factory.mktemp("map") / "shop")[0]


@pytest.fixture(scope="module")
def history(place: Path) -> Iterator[eg.History]:
    with eg.History(place, who="A. Miller") as found:
        yield found


@pytest.fixture(scope="module")
def pages(history: eg.History) -> TestClient:
    return TestClient(application(Settings(history.store.url, who="A. Miller"), history.store), HOST)


def section(history: eg.History, **asked: object) -> object:
    job = history.map_job(1)
    assert job is not None
    return history.map_section(job, **asked)  # type: ignore[arg-type]


def test_the_page_says_the_softest_and_stiffest_place_and_what_is_not_known(pages: TestClient, history: eg.History) -> None:
    page, view = pages.get(f"{MAP}?azimuth=90&height=3"), view_of(section(history, height=3, azimuth=90.0))
    assert page.status_code == 200
    assert view.sentence in page.text
    assert "what is grey was never tested" in page.text
    assert "Simulated" in page.text
    assert '<svg class="plot"' in page.text
    assert page.text.count("<h1") == 1


def test_its_json_is_the_map_and_its_csv_the_places(pages: TestClient, history: eg.History) -> None:
    document = pages.get(f"{MAP}.json?azimuth=90&height=3").json()
    found = section(history, height=3, azimuth=90.0)
    assert document["schema"] == "elastogeo.map/1"
    assert np.array(document["told"]["compliance_mm_per_N"], dtype=float).shape[1] == 6
    assert document["section"]["known"] == found.known.sum() > 0  # type: ignore[attr-defined]
    lines = pages.get(f"{MAP}.csv?azimuth=90&height=3").text.splitlines()
    assert len(lines) == 1 + found.known.size  # type: ignore[attr-defined]
    assert sum(line.endswith("tests") for line in lines) == found.known.sum()  # type: ignore[attr-defined]


def test_htmx_gets_the_part_that_it_swaps(pages: TestClient) -> None:
    part = pages.get(f"{MAP}?plane=YZ", headers={"HX-Request": "true"})
    assert "<html" not in part.text
    assert "section YZ at X" in part.text


@pytest.mark.parametrize(
    ("query", "said"), [("plane=XA", "a section takes two of them"), ("height=99", "places along Z"), ("basis=x", "listed")]
)
def test_a_section_that_is_none_is_one_clear_error(pages: TestClient, query: str, said: str) -> None:
    answer = pages.get(f"{MAP}?{query}")
    assert 400 <= answer.status_code < 500
    assert said in answer.text


def test_where_nothing_is_identified_there_is_no_map_and_no_number(pages: TestClient) -> None:
    page = pages.get("/machines/2/map")
    assert "Nothing is identified of this machine yet" in page.text
    assert "N/µm" not in page.text
    assert pages.get("/machines/2/map.json").json()["map"] is None


def test_a_map_is_asked_for_and_comes_when_it_is_made(pages: TestClient, history: eg.History) -> None:
    first = history.map_bases(1)[0]
    basis = f"{first.kind}:{first.key}"
    answer = pages.post(MAP, data={"basis": basis}, headers={"Origin": HOST}, follow_redirects=False)
    assert answer.status_code == 303
    waiting = pages.get(f"{MAP}?basis={basis}")
    assert "The map is being made" in waiting.text
    Worker(history.store).run(once=True)
    assert "In numbers" in pages.get(f"{MAP}?basis={basis}").text


def test_the_browser_computes_what_the_map_says(place: Path, serve: Serve, screens: Screens, history: eg.History) -> None:
    """The slider by its keys: 5 degrees a step; C[6] as a quadratic form, against the map along that direction."""
    screen = screens(serve(place).url)
    page = screen.page
    page.goto(f"{screen.url}{MAP}?azimuth=85&height=3")
    page.locator("#map-azimuth").focus()
    page.keyboard.press("ArrowRight")
    found = page.evaluate("window.elastogeoMap")
    expected = section(history, height=3, azimuth=90.0)
    stiffness = np.array(found["stiffness"], dtype=float).reshape(expected.stiffness.shape)  # type: ignore[attr-defined]
    assert np.isfinite(stiffness).any()
    assert stiffness == pytest.approx(expected.stiffness / 1000, rel=1e-9, nan_ok=True)  # type: ignore[attr-defined]
    half = np.array(found["half"], dtype=float).reshape(stiffness.shape)
    assert half == pytest.approx((expected.expanded * expected.stiffness**2) / 1000, rel=1e-9, nan_ok=True)  # type: ignore[attr-defined]
    assert page.locator("#map-answer").inner_text() == view_of(expected).sentence
    assert "azimuth=90" in page.url
    page.get_by_role("link", name="Z", exact=True).click()
    up = view_of(section(history, height=3, elevation=90.0))
    assert page.locator("#map-answer").inner_text() == up.sentence
