"""In a browser, by mouse and by keyboard: what if a cause were less; the report; a test set aside and taken back."""

from __future__ import annotations

import re
import zlib
from pathlib import Path
from typing import Any

import pytest

from elastogeo.history import History
from tests.web.browsing import Site, Watched
from tests.web.fleets import ALARMED
from tests.web.journeys.conftest import SOON
from tests.web.keyboard import press, send, tab_to, write

LAST = 8
"""The last test of the machine in alarm."""
DEVIATIONS = ("g", "f")


def said(page: Any) -> dict[str, str]:
    """Circular and radial deviation, counter-clockwise."""
    return {name: page.locator(f"#{name}-ccw").inner_text() for name in DEVIATIONS}


def test_a_report_is_downloaded_and_opens_without_the_server(screen: Watched, tmp_path: Path) -> None:
    """As a page it opens from the disk, with its pictures, and says that it is simulated; as a PDF it has its pages."""
    page = screen.page
    screen.go(f"/tests/{LAST}")
    page.get_by_role("link", name="Report (PDF)").wait_for(timeout=SOON)
    found = {kind: downloaded(page, f"Report ({kind.upper()})", f"test-{LAST}.{kind}") for kind in ("html", "pdf")}
    (tmp_path / "report.html").write_bytes(found["html"])
    opened = page.context.new_page()
    asked: list[str] = []
    opened.on("request", lambda request: asked.append(request.url))
    opened.goto((tmp_path / "report.html").as_uri())
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
    assert "simulated" in opened.locator("body").inner_text().lower()
    assert ALARMED.name in opened.locator("header").inner_text()
    assert "B-101" in opened.locator("body").text_content()
    drawing = opened.locator("svg:visible").first.bounding_box()
    assert min(drawing["width"], drawing["height"]) > 100
    assert opened.locator("svg path").count() > 10
    assert found["pdf"].startswith(b"%PDF-")
    assert b"/Type /Page" in found["pdf"] or b"/Type/Page" in found["pdf"]
    assert len(streams(found["pdf"])) > 20_000  # what is drawn, not only what is written


def downloaded(page: Any, link: str, name: str) -> bytes:
    tab_to(page, page.get_by_role("link", name=link))
    with page.expect_download(timeout=SOON) as found:
        page.keyboard.press("Enter")
    assert found.value.suggested_filename == name
    return Path(found.value.path()).read_bytes()


def streams(pdf: bytes) -> bytes:
    """What the streams of a PDF hold."""
    found = re.findall(rb"stream\r?\n(.*?)endstream", pdf, re.S)
    return b"".join(zlib.decompressobj().decompress(one) for one in found if one[:1] == b"x")


@pytest.mark.parametrize("by", ["keys", "mouse"])
def test_a_cause_made_less_moves_trace_and_both_deviations(screen: Watched, by: str) -> None:
    """Computed in the browser: a slider answers at once, and Reset brings back what was measured."""
    page = screen.page
    screen.go(f"/tests/{LAST}")
    slider = page.locator(".cause input[type=range]").first
    slider.wait_for(state="visible", timeout=SOON)
    before = said(page)
    assert all(re.search(r"\d.* µm", text) for text in before.values())
    if by == "keys":
        tab_to(page, slider)
        page.keyboard.press("Home")
    else:
        slider.scroll_into_view_if_needed()
        box = slider.bounding_box()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.mouse.down()
        page.mouse.move(box["x"] - 20, box["y"] + box["height"] / 2, steps=4)
        page.mouse.up()
    page.locator("#g-ccw-was", has_text="was ").wait_for()
    assert slider.input_value() == "0"
    assert slider.get_attribute("aria-valuetext") == "0 % of what it is"
    after = said(page)
    assert all(after[name] != before[name] for name in DEVIATIONS)
    assert page.locator("#g-ccw-was").inner_text() == f"was {before['g']}"
    assert len(page.locator("path.what-if").first.get_attribute("d")) > 200
    press(page, page.get_by_role("button", name="Reset"))
    page.locator("#g-ccw-was", has_text="as measured").wait_for()
    assert said(page) == before


def test_a_test_is_set_aside_and_taken_back(acting: Watched, acted_on: Site) -> None:
    page = acting.page
    acting.go("/tests/12")
    for word, button, told in (
        ("Set aside", "Set it aside", "is set aside and counts in no chart"),
        ("Take back", "Take it back", "counts again"),
    ):
        press(page, page.locator("summary", has_text=word))
        why = f"{word}: ball not seated <b>"
        write(page, page.get_by_label("Why"), why)
        send(page, page.get_by_role("button", name=button))
        assert told in page.locator(".said").inner_text()
        assert why in page.locator("main").inner_text()
        with History(acted_on.database) as history:
            row = history.audit(last=1, subject="test 12").rows[0]
        assert (row.who, row.why) == ("A. Miller", why)
    assert page.locator("summary", has_text="Set aside").count() == 1
