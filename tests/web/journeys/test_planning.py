"""In a browser, by the keyboard: a goal in words, ways to reach it, one is kept, its programs are taken, it is done."""

from __future__ import annotations

import re
from io import BytesIO
from itertools import pairwise
from math import dist
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from tests.web.browsing import Watched
from tests.web.fleets import ALARMED
from tests.web.journeys.conftest import SOON
from tests.web.keyboard import choose, send, tab_to, write

RADIUS = re.compile(r"RADIUS ([\d.]+) MM")
CENTRE = re.compile(r"TOOL BALL IS AT [^)]*?Y(?P<Y>-?[\d.]+) X(?P<X>-?[\d.]+) Z(?P<Z>-?[\d.]+)")
AT_FEED = re.compile(r"^G1 X(-?[\d.]+) Y(-?[\d.]+) Z(-?[\d.]+)$", re.M)


def test_from_a_goal_in_words_to_programs_and_done(acting: Watched) -> None:
    page = acting.page
    acting.go("/machines/1")
    send(page, page.get_by_role("link", name="Plan a test"))
    assert ALARMED.name in page.locator("h1").inner_text()
    choose(page, page.get_by_label("One component"), "drive X")
    choose(page, page.get_by_label("Another component"), "drive Y")
    write(page, page.get_by_label("Minutes available"), "30")
    send(page, page.get_by_role("button", name="Work out the ways"))

    way = page.locator(".way.resolved").first
    way.wait_for(timeout=SOON)  # it comes by itself
    words = way.inner_text()
    assert "Resolves: the X drive from the Y drive." in words
    assert re.search(r"\d+ min", way.locator("h2").inner_text())
    assert "expected U of a change" in way.locator("details").first.text_content()
    write(page, way.get_by_label("Name"), "Drives <1>")
    tab_to(page, way.get_by_label("Due"))
    page.keyboard.type("12122099")  # the same day in every country's order
    send(page, way.get_by_role("button", name="Choose"))

    assert page.locator("h1").inner_text() == "Drives <1>"
    assert "due 12 Dec 2099" in page.locator(".verdict .sentence").inner_text()
    (test,) = page.locator(".programs tbody td:first-child").all_inner_texts()
    assert test in page.locator(".checklist").inner_text()
    program = downloaded(page, page.get_by_role("link", name="linuxcnc"), f"{test}.ngc")
    check_circle(program.decode("ascii"))
    folder = downloaded(page, page.get_by_role("link", name="Folder to measure"), f"plan-{page.url.rpartition('/')[2]}.zip")
    with ZipFile(BytesIO(folder)) as whole:
        assert whole.read(f"campaign/programs/linuxcnc/{test}.ngc") == program

    number = page.url.rpartition("/")[2]
    acting.go("/plans")
    row = page.locator("tbody tr", has=page.locator(f"a[href='/plans/{number}']"))
    assert "due 12 Dec 2099" in row.inner_text()
    page.locator("main").focus()
    while not row.get_by_role("link").evaluate("one => one === document.activeElement"):
        before = page.evaluate("document.activeElement.textContent")
        page.keyboard.press("j")
        assert page.evaluate("document.activeElement.textContent") != before, "j does not lead to the plan"
    with page.expect_event("load"):
        page.keyboard.press("Enter")
    write(page, page.get_by_label("Note"), "on Sunday & Monday")
    send(page, page.get_by_role("button", name="Mark as done"))
    assert page.locator(".said").inner_text() == "The plan is done."
    assert page.get_by_role("button", name="Mark as done").count() == 0
    acting.go("/plans")
    assert "done" in row.inner_text()
    assert "2099" not in row.inner_text()


def downloaded(page: Any, link: Any, name: str) -> bytes:
    """What a link gives, by the name that the browser keeps it under."""
    tab_to(page, link)
    with page.expect_download(timeout=SOON) as found:
        page.keyboard.press("Enter")
    assert found.value.suggested_filename == name
    return Path(found.value.path()).read_bytes()


def check_circle(program: str) -> None:
    """Every block at the feed of the test is a place on its circle, and each is near the one before."""
    said, wide = CENTRE.search(program), RADIUS.search(program)
    assert said
    assert wide
    centre, radius = [float(said[axis]) for axis in "XYZ"], float(wide[1])
    places = [[float(one) for one in found.groups()] for found in AT_FEED.finditer(program)]
    assert len(places) > 1000
    assert max(abs(dist(place, centre) - radius) for place in places) < 0.01
    assert max(dist(one, other) for one, other in pairwise(places)) < 2 * radius
    assert "SET THE FORCE TO 100 N" in program
    assert "SET THE FORCE TO 700 N" in program


def test_a_plan_that_cannot_be_made_says_why(acting: Watched) -> None:
    """Two components that are one: the page says so in a sentence, and the goal may be put anew."""
    page = acting.page
    acting.go("/machines/2/plan")
    choose(page, page.get_by_label("One component"), "drive X")
    choose(page, page.get_by_label("Another component"), "drive X")
    send(page, page.get_by_role("button", name="Work out the ways"))
    page.get_by_text("it takes two components to be told apart").wait_for(timeout=SOON)
    tab_to(page, page.get_by_label("Minutes available"))
    assert page.get_by_role("button", name="Work out the ways").is_visible()
