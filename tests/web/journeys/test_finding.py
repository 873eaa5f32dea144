"""In a browser: what is searched is found, and filters are in the address: they survive paging, reloading and going back."""

from __future__ import annotations

import re
from typing import Any

from tests.web.browsing import Site, Watched
from tests.web.fleets import ALARMED
from tests.web.journeys.conftest import ROWS
from tests.web.keyboard import send, tab_to


def test_what_is_searched_is_found(screen: Watched) -> None:
    page = screen.page
    screen.go("/plans")
    page.keyboard.press("/")
    page.keyboard.type("hermle")
    with page.expect_navigation():
        page.keyboard.press("Enter")
    assert page.url.endswith("/search?q=hermle")
    page.locator("main").focus()
    page.keyboard.press("j")
    assert page.evaluate("document.activeElement.textContent") == ALARMED.name
    with page.expect_navigation():
        page.keyboard.press("Enter")
    assert page.locator("h1").inner_text() == ALARMED.name
    screen.go("/search?q=nothing+of+this+kind")
    assert "nothing" in page.locator(".verdict").inner_text().lower()


def test_filters_survive_paging_reloading_and_going_back(shop: Site, screens: Any) -> None:
    page = screens(shop.url).page
    page.goto(f"{shop.url}/")
    with page.expect_navigation():
        page.get_by_label("Hall").select_option("hall 7")
    seen = set(names(page))
    assert len(seen) == ROWS - 1
    send(page, page.get_by_role("link", name="Next"))
    assert re.search(r"\?page=2&hall=hall%207$|\?hall=hall(%20|\+)7&page=2$", page.url)
    for _ in range(2):
        (last,) = names(page)
        assert last.startswith("Press")
        assert last not in seen
        assert page.get_by_label("Hall").input_value() == "hall 7"
        assert "page 2 of 2" in page.locator(".paging").inner_text()
        page.reload()
    page.go_back()
    assert set(names(page)) == seen
    tab_to(page, page.get_by_role("link", name=".json"))
    with page.expect_navigation() as found:
        page.keyboard.press("Enter")
    assert {one["place"] if "place" in one else one["hall"] for one in found.value.json()["rows"]} == {"hall 7"}


def names(page: Any) -> list[str]:
    """The machines of the page."""
    return list(page.locator(".cards tbody th").all_inner_texts())


def test_what_was_typed_is_there_again_after_a_refusal(screen: Watched) -> None:
    screen.expected = (400,)
    page = screen.page
    screen.go("/machines/1/events")
    page.fill("textarea[name=note]", "carriage 2 of X replaced")
    page.fill("input[name=at]", "2026-13-40")
    with page.expect_navigation():
        page.get_by_role("button", name="Add the event").click()
    assert "write it as 2026-03-01" in page.locator("main").inner_text()
    page.go_back()
    assert page.input_value("textarea[name=note]") == "carriage 2 of X replaced"
    assert page.input_value("input[name=at]") == "2026-13-40"
