"""Uploads in a browser: chosen, dropped, refused, stopped."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import elastogeo as eg
from tests.history.intake.small_tests import write_test
from tests.history.parcels.archives import packed
from tests.history.parcels.test_parcels import files_of, parcels
from tests.web.browsing import Site, Watched
from tests.web.conftest import DESKTOP, PHONE
from tests.web.test_every_page import faults_on_a_phone, found_by

WORKED = 60_000
"""Milliseconds in which the worker must have done a short job, on a computer that does much else."""

DROP = """async (files) => {
  const given = new DataTransfer();
  for (const [name, text] of files) given.items.add(new File([text], name));
  const event = new DragEvent("drop", {dataTransfer: given, bubbles: true, cancelable: true});
  document.getElementById("drop").dispatchEvent(event);
}"""


def nobody_is_shut_out(page: Any) -> None:
    """The checks of every page, of one that stands only for a while."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-core, for its package is not there").Axe()
    assert found_by(axe, page) == []
    page.set_viewport_size(PHONE)
    assert faults_on_a_phone(page) == []
    page.set_viewport_size(DESKTOP)


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A history without a machine."""
    database = tmp_path_factory.mktemp("empty") / "shop.db"
    eg.History(database, create=True, who="A. Miller").close()
    return database


@pytest.fixture
def own(empty: Path, serve: Callable[..., Site]) -> Site:
    return serve(empty)


def test_from_nothing_to_a_result_by_upload(own: Site, screens: Any, tmp_path: Path) -> None:
    """First run, upload, bad upload, the same again: what done-when 1 asks of these pages."""
    write_test(tmp_path / "s" / "a", seed=1)
    screen: Watched = screens(own.url)
    page = screen.page
    screen.go("/")
    page.get_by_role("link", name="Begin").click()
    page.get_by_label("Its name, of this very machine").fill("Mill 3")
    page.get_by_role("button", name="Add the machine").click()
    page.get_by_text("Mill 3 was added.").wait_for()

    screen.go("/upload")
    page.get_by_role("button", name="Upload").click()
    page.get_by_text("Choose files or a folder first").wait_for()
    (tmp_path / "x.zip").write_bytes(packed([*files_of(tmp_path / "s"), ("bad/test.toml", b"name = 1 2\n")]))
    page.get_by_label("Files or zip archives").set_input_files(tmp_path / "x.zip")
    page.get_by_role("button", name="Upload").click()
    page.get_by_role("button", name="Import").wait_for(timeout=WORKED)  # it comes by itself
    assert "at line 1, column 10" in page.locator(".errors").inner_text()
    nobody_is_shut_out(page)
    page.locator("select[name=machine]").select_option("Mill 3")
    page.get_by_role("button", name="Import").click()
    page.get_by_text("1 new, 1 refused.").first.wait_for(timeout=WORKED)
    assert page.get_by_role("link", name="Monthly").get_attribute("href") == "/tests/1"
    nobody_is_shut_out(page)
    assert page.locator("#job-said").inner_text() == "1 new, 1 refused."
    page.get_by_role("link", name="Mill 3").click()
    page.wait_for_url("**/machines/1")

    screen.go("/upload")
    page.evaluate(DROP, [[name.rpartition("/")[2], content.decode()] for name, content in files_of(tmp_path / "s" / "a")])
    page.get_by_text("One test known already: nothing was changed.").first.wait_for(timeout=WORKED)
    with eg.History(own.database) as history:
        assert len(history.series("Mill 3")) == 1


def test_an_upload_that_is_stopped_leaves_nothing(own: Site, screens: Any) -> None:
    screen: Watched = screens(own.url)
    page = screen.page
    page.context.new_cdp_session(page).send(
        "Network.emulateNetworkConditions",
        {"offline": False, "latency": 0, "downloadThroughput": -1, "uploadThroughput": 200_000},
    )
    with eg.History(own.database) as history:
        before = parcels(history.store)
    screen.go("/upload")
    page.evaluate(DROP, [["big.csv", "1,2\n" * 1_000_000]])
    page.get_by_role("button", name="Stop").wait_for()
    page.locator("#how-much", has_text="of 4.0 MB").wait_for()
    page.get_by_role("button", name="Stop").click()
    page.get_by_text("Stopped; nothing was kept.").wait_for()
    with eg.History(own.database) as history:
        for _ in range(100):
            if parcels(history.store) == before:
                break
            page.wait_for_timeout(50)
        assert parcels(history.store) == before
