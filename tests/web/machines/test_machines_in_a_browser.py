"""The pages of machines in a browser: indicators swapped in, keys, what the trend says where it is pointed at, the phone."""

from __future__ import annotations

import re

import pytest

from tests.web.browsing import Site, Watched
from tests.web.conftest import PHONE, Screens
from tests.web.fleets import ALARMED, LATE, SUSPECTED


def at_machine(screen: Watched, name: str = ALARMED.name) -> None:
    screen.go("/")
    screen.page.get_by_role("link", name=name, exact=True).click()
    screen.page.wait_for_url(re.compile(r"/machines/\d+$"))


def test_another_indicator_is_swapped_in_and_its_heading_takes_the_focus(screen: Watched) -> None:
    at_machine(screen)
    page = screen.page
    page.locator(".indicators").get_by_role("link", name="Backlash Y").click()
    page.locator("#trend:focus", has_text="Backlash Y").wait_for()
    assert "indicator=backlash%20Y" in page.url
    assert page.locator(".indicators .chosen th").inner_text() == "Backlash Y"
    page.go_back()
    page.locator("#trend", has_not_text="Backlash Y").wait_for()


def test_the_trend_says_a_test_where_it_is_pointed_at_and_by_arrow_keys(screen: Watched) -> None:
    at_machine(screen)
    page = screen.page
    marks = page.locator("figure.trend .wide .mark")
    reading = page.locator("figure.trend .reading")
    marks.nth(2).hover()
    assert reading.inner_text() == marks.nth(2).locator("title").text_content()
    page.locator("figure.trend .wide").focus()
    page.keyboard.press("End")
    last = marks.nth(marks.count() - 1)
    assert reading.inner_text() == last.locator("title").text_content()
    page.keyboard.press("ArrowLeft")
    assert reading.inner_text() == marks.nth(marks.count() - 2).locator("title").text_content()
    key = marks.nth(marks.count() - 2).get_attribute("data-key")
    page.keyboard.press("Enter")
    page.wait_for_url(re.compile(rf"/tests/{key}$"))


def test_every_key_does_what_the_list_of_keys_says(screen: Watched) -> None:
    page = screen.page
    screen.go("/")
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Keys")
    assert "next row" in dialog.inner_text()
    page.keyboard.press("Escape")
    dialog.wait_for(state="hidden")
    page.keyboard.press("/")
    assert page.evaluate("document.activeElement.name") == "q"
    page.keyboard.type("jk?a")
    assert page.locator(".find input").input_value() == "jk?a"
    page.locator("h1").click()
    page.keyboard.press("j")
    assert page.evaluate("document.activeElement.textContent") == ALARMED.name
    page.keyboard.press("j")
    assert page.evaluate("document.activeElement.textContent") == SUSPECTED.name
    page.keyboard.press("k")
    page.keyboard.press("Enter")
    page.wait_for_url(re.compile(r"/machines/\d+$"))
    page.keyboard.press("a")
    assert page.evaluate("document.activeElement.tagName") == "TEXTAREA"
    page.keyboard.press("Escape")
    page.locator("h1").click()
    page.keyboard.press("g")
    page.keyboard.press("f")
    page.wait_for_url(f"{screen.url}/")
    page.keyboard.press("g")
    page.keyboard.press("a")
    page.wait_for_url(f"{screen.url}/alarms")
    page.keyboard.press("j")
    alarm = page.locator("article.alarm:focus-within")
    assert alarm.get_by_role("link").first.inner_text() == page.evaluate("document.activeElement.textContent")
    page.keyboard.press("a")
    assert alarm.locator("textarea:focus").is_visible()


def test_a_facet_is_chosen_without_a_button_and_stays_in_the_address(screen: Watched) -> None:
    page = screen.page
    screen.go("/")
    page.get_by_label("Hall").select_option("hall 2")
    page.wait_for_url(re.compile(r"\?hall=hall\+2"))
    names = page.locator(".cards tbody th").all_inner_texts()
    assert set(names) == {SUSPECTED.name, LATE.name}
    page.get_by_role("navigation", name="Machines by state").get_by_role("link", name="Overdue").click()
    page.wait_for_url(re.compile("state=overdue"))
    assert page.locator(".cards tbody th").all_inner_texts() == [LATE.name]


def test_the_theme_that_is_chosen_stays(screens: Screens, site: Site) -> None:
    screen = screens(site.url, color_scheme="light")
    page = screen.page
    screen.go("/")
    light = page.evaluate("getComputedStyle(document.body).backgroundColor")
    page.locator(".menu summary").click()
    page.get_by_role("button", name="dark").click()
    page.locator("html[data-theme=dark]").wait_for(state="attached")
    screen.go("/search")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") != light


@pytest.mark.parametrize("path", ["/", "/machines/1", "/machines/4", "/machines/1/tests", "/search?q=hermle"])
def test_a_phone_never_scrolls_sideways_and_its_targets_are_large(screens: Screens, site: Site, path: str) -> None:
    screen = screens(site.url, viewport=PHONE)
    screen.go(path)
    assert screen.page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    low = "[...document.querySelectorAll('button, select, .button, .top nav a')].filter((e) => e.getClientRects().length)"
    heights = screen.page.evaluate(f"{low}.map((e) => e.getBoundingClientRect().height)")
    assert heights
    assert min(heights) >= 43.5


def test_without_a_script_every_choice_is_a_link_or_a_form(screens: Screens, site: Site) -> None:
    screen = screens(site.url, java_script_enabled=False)
    page = screen.page
    screen.go("/")
    page.get_by_label("Hall").select_option("hall 2")
    page.get_by_role("button", name="Show").click()
    assert "hall=hall+2" in page.url
    page.get_by_role("link", name=LATE.name, exact=True).click()
    page.locator(".indicators").get_by_role("link", name="Backlash Y").click()
    assert page.locator("#trend").inner_text() == "Backlash Y"
