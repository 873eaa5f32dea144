"""In a browser, by the keyboard: a test is sent, confirmed and opened; sent again; sent with a fault in it."""

from __future__ import annotations

import re
import zipfile
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np

from elastogeo.errors import ElastogeoError
from elastogeo.formats import read_test
from elastogeo.history import History
from elastogeo.history.fleets.folders import write_test
from elastogeo.history.fleets.stories import truth
from tests.web.browsing import Site, Watched
from tests.web.fleets import LATE
from tests.web.journeys.conftest import SOON
from tests.web.keyboard import send


def zipped(folder: Path, to: Path) -> Path:
    with zipfile.ZipFile(to, "w") as archive:
        for file in sorted(folder.rglob("*")):
            archive.write(file, f"{folder.name}/{file.relative_to(folder)}")
    return to


def new_test(folder: Path, days_ago: float) -> Path:
    """One more test of the machine that is overdue."""
    values = truth(LATE, 200.0, 21.0, True, np.random.default_rng(7))
    return write_test(folder, LATE, datetime.now(UTC) - timedelta(days=days_ago), 21.0, values, 7)


def test_an_upload_is_shown_confirmed_and_leads_to_its_test(acting: Watched, acted_on: Site, tmp_path: Path) -> None:
    """Upload, Import, the test: three clicks. Sent again it changes nothing, and the page leads to what is known."""
    page = acting.page
    archive = zipped(new_test(tmp_path / "new", 1.0), tmp_path / "new.zip")
    acting.go("/upload")
    page.locator("#files").set_input_files(archive)
    send(page, page.get_by_role("button", name="Upload"))
    confirm = page.get_by_role("button", name="Import")
    confirm.wait_for(timeout=SOON)
    assert LATE.name in page.locator("main").inner_text()
    send(page, confirm)
    link = page.locator("#job td a[href*='/tests/']").first
    link.wait_for(timeout=SOON)
    send(page, link)
    own = page.url
    assert re.search(r"/tests/\d+$", own)
    assert LATE.name in page.locator("main").inner_text()

    with History(acted_on.database) as history:
        tests = len(history.machine(LATE.name).series[0].series)
    acting.go("/upload")
    page.locator("#files").set_input_files(archive)
    send(page, page.get_by_role("button", name="Upload"))
    page.locator("#job", has_text="One test known already: nothing was changed.").wait_for(timeout=SOON)
    assert page.get_by_role("button", name="Import").count() == 0
    send(page, page.locator("#job td a[href*='/tests/']").first)
    assert page.url == own
    with History(acted_on.database) as history:
        assert len(history.machine(LATE.name).series[0].series) == tests


def test_a_bad_upload_is_told_with_its_line_and_nothing_comes_in(acting: Watched, acted_on: Site, tmp_path: Path) -> None:
    """In the words of the command line, with line and column."""
    page = acting.page
    folder = new_test(tmp_path / "broken", 2.0)
    run = folder / "runs" / "250-cw.csv"
    lines = run.read_text(encoding="utf-8").splitlines()
    lines[5] = "12.5,none"
    run.write_text("\n".join(lines), encoding="utf-8")
    told = ""
    try:
        read_test(folder)
    except ElastogeoError as error:
        told = str(error).partition("250-cw.csv")[2]
    assert "line 6" in told
    with History(acted_on.database) as history:
        before = history.audit(last=1).rows[0].number
    acting.go("/upload")
    page.locator("#files").set_input_files(zipped(folder, tmp_path / "broken.zip"))
    send(page, page.get_by_role("button", name="Upload"))
    page.locator("#job .errors", has_text="250-cw.csv").wait_for(timeout=SOON)
    assert told in page.locator("#job .errors").inner_text()
    assert page.get_by_role("button", name="Import").count() == 0
    with History(acted_on.database) as history:
        since = [row for row in history.audit(last=1000).rows if row.number > before]
    assert not [row for row in since if row.subject.startswith(("test", "series", "machine"))]
