"""In a browser, by the keyboard: what if, report, set aside, upload and a bad upload, the first run of an empty history."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from elastogeo.history import History
from elastogeo.history.fleets.folders import write_test
from elastogeo.history.fleets.stories import truth
from tests.web.browsing import Site, Watched, serving
from tests.web.conftest import copy_of
from tests.web.fleets import LATE
from tests.web.keyboard import press, send, tab_to, write

LAST = 8
"""The last test of the machine in alarm."""
SOON = 60_000
"""Milliseconds in which the worker must have done a small job, on a computer that does much else."""


@pytest.fixture(scope="module")
def acted_on(made_fleet: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """A fleet that the tests of this file change, each at another place."""
    folder = tmp_path_factory.mktemp("acted on")
    with serving(copy_of(made_fleet, folder / "fleet"), folder / "serve.log") as site:
        yield site


@pytest.fixture
def acting(acted_on: Site, screens: Any) -> Watched:
    found: Watched = screens(acted_on.url)
    return found


def zipped(folder: Path, to: Path) -> Path:
    with zipfile.ZipFile(to, "w") as archive:
        for file in sorted(folder.rglob("*")):
            archive.write(file, f"{folder.name}/{file.relative_to(folder)}")
    return to


def new_test(folder: Path, days_ago: float) -> Path:
    """One more test of the machine that is overdue."""
    values = truth(LATE, 200.0, 21.0, True, np.random.default_rng(7))
    return write_test(folder, LATE, datetime.now(UTC) - timedelta(days=days_ago), 21.0, values, 7)


def test_a_cause_made_less_moves_trace_and_both_deviations(screen: Watched) -> None:
    """Computed in the browser: from the keyboard a slider answers at once, and Reset brings back what was measured."""
    page = screen.page
    screen.go(f"/tests/{LAST}")
    slider = page.locator(".cause input[type=range]").first
    slider.wait_for(state="visible", timeout=SOON)
    shown = {name: page.locator(f"#{name}-ccw") for name in ("g", "f")}
    before = {name: one.inner_text() for name, one in shown.items()}
    assert all(re.search(r"\d.* µm", text) for text in before.values())
    tab_to(page, slider)
    page.keyboard.press("Home")
    page.locator("#g-ccw-was", has_text="was ").wait_for()
    assert slider.get_attribute("aria-valuetext") == "0 % of what it is"
    assert all(one.inner_text() != before[name] for name, one in shown.items())
    assert page.locator("#g-ccw-was").inner_text() == f"was {before['g']}"
    assert len(page.locator("path.what-if").first.get_attribute("d")) > 200
    press(page, page.get_by_role("button", name="Reset"))
    page.locator("#g-ccw-was", has_text="as measured").wait_for()
    assert {name: one.inner_text() for name, one in shown.items()} == before


@pytest.mark.parametrize(("name", "begins"), [("Report (PDF)", b"%PDF-"), ("Report (HTML)", b"<!DOCTYPE html>")])
def test_a_report_is_downloaded(name: str, begins: bytes, screen: Watched) -> None:
    screen.go(f"/tests/{LAST}")
    link = screen.page.get_by_role("link", name=name)
    link.wait_for(timeout=SOON)
    tab_to(screen.page, link)
    with screen.page.expect_download(timeout=SOON) as download:
        screen.page.keyboard.press("Enter")
    content = Path(download.value.path()).read_bytes()
    assert content[: len(begins)].upper() == begins.upper()
    assert len(content) > 10_000


def test_a_test_is_set_aside_and_taken_back(acting: Watched) -> None:
    page = acting.page
    acting.go("/tests/12")
    for word, button in (("Set aside", "Set it aside"), ("Take back", "Take it back")):
        press(page, page.locator("summary", has_text=word))
        write(page, page.get_by_label("Why"), f"{word}: ball not seated <b>")
        send(page, page.get_by_role("button", name=button))
        assert page.locator(".said").inner_text()
        assert f"{word}: ball not seated <b>" in page.locator("main").inner_text()
    assert page.locator("summary", has_text="Set aside").count() == 1


def test_an_upload_is_shown_confirmed_and_leads_to_its_test(acting: Watched, tmp_path: Path) -> None:
    """Upload, Import, the test: three clicks. Sent again it changes nothing."""
    page = acting.page
    archive = zipped(new_test(tmp_path / "new", 1.0), tmp_path / "new.zip")
    for again in (False, True):
        acting.go("/upload")
        page.locator("#files").set_input_files(archive)
        send(page, page.get_by_role("button", name="Upload"))
        if again:
            page.locator("#job", has_text=re.compile("known|already|nothing")).wait_for(timeout=SOON)
            break
        confirm = page.get_by_role("button", name="Import")
        confirm.wait_for(timeout=SOON)
        assert LATE.name in page.locator("main").inner_text()
        send(page, confirm)
        link = page.locator("#job td a[href*='/tests/']").first
        link.wait_for(timeout=SOON)
        send(page, link)
        assert re.search(r"/tests/\d+$", page.url)
        assert LATE.name in page.locator("main").inner_text()


def test_what_is_dropped_is_sent(acting: Watched) -> None:
    """A file dropped as from a folder of the computer."""
    page = acting.page
    acting.go("/upload")
    with page.expect_navigation():
        page.evaluate(
            """() => {
              const data = new DataTransfer();
              data.items.add(new File(["angle_deg,radial_um\\n0,1\\n"], "run.csv"));
              const drop = new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true });
              document.getElementById("drop").dispatchEvent(drop);
            }"""
        )
    page.locator("#job", has_text="no test").wait_for(timeout=SOON)


def test_a_bad_upload_is_told_with_its_line_and_nothing_comes_in(acting: Watched, acted_on: Site, tmp_path: Path) -> None:
    page = acting.page
    folder = new_test(tmp_path / "broken", 2.0)
    run = folder / "runs" / "250-cw.csv"
    lines = run.read_text(encoding="utf-8").splitlines()
    lines[5] = "12.5,none"
    run.write_text("\n".join(lines), encoding="utf-8")
    with History(acted_on.database) as history:
        edition = len(history.audit(last=1000).rows)
    acting.go("/upload")
    page.locator("#files").set_input_files(zipped(folder, tmp_path / "broken.zip"))
    send(page, page.get_by_role("button", name="Upload"))
    told = page.locator("#job", has_text="250-cw.csv")
    told.wait_for(timeout=SOON)
    assert re.search(r"line 6", told.inner_text())
    assert page.get_by_role("button", name="Import").count() == 0
    with History(acted_on.database) as history:
        subjects = {row.subject.partition(" ")[0] for row in history.audit(last=1000).rows[edition:]}
    assert "test" not in subjects


def test_a_first_run_leads_to_a_result_in_three_clicks(serve: Any, screens: Any, tmp_path: Path) -> None:
    """An empty history: the demo fleet, the fleet, a machine; it fills while one looks."""
    site = serve(tmp_path / "new.db")
    screen = screens(site.url)
    page = screen.page
    screen.go("/")
    if not page.url.endswith("/first"):
        screen.go("/first")
    send(page, page.get_by_role("button", name="Try the demo fleet"))
    look = page.get_by_role("link", name="Look at the fleet")
    look.wait_for(timeout=SOON)
    page.locator("#job progress[value]:not([value='0'])").wait_for(timeout=SOON)
    send(page, look)
    machine = page.locator("main a[href*='/machines/']").first
    send(page, machine)
    assert re.search(r"/machines/\d+", page.url)
    assert "simulated" in page.locator("body").inner_text().lower()
