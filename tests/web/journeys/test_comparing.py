"""In a browser, by the keyboard: two tests of a machine are chosen and compared; circles off and on; the numbers as JSON."""

from __future__ import annotations

import json
from typing import Any

from tests.web.browsing import Watched
from tests.web.fleets import ALARMED
from tests.web.keyboard import choose, press, send, tab_to

DRAWN = ".overlay .at-desk svg path"


def test_two_tests_are_chosen_and_compared(screen: Watched) -> None:
    """From a test to its comparison with the one before, from there by the form to another pair."""
    page = screen.page
    screen.go("/tests/8")
    send(page, page.get_by_role("link", name="Compare with the test before"))
    assert page.url.endswith("/compare?a=7&b=8")
    choose(page, page.get_by_label("First test"), "2")
    choose(page, page.get_by_label("Second test"), "8")
    send(page, page.get_by_role("button", name="Compare", exact=True))
    assert page.url.endswith("/compare?a=2&b=8")
    assert page.locator("h1").inner_text() == f"{ALARMED.name}: two tests compared"
    leads = page.locator("main > p a").evaluate_all("all => all.slice(0, 2).map(one => one.getAttribute('href'))")
    assert leads == ["/tests/2", "/tests/8"]
    assert ALARMED.name in page.locator(".verdict .sentence").inner_text()
    assert page.locator("tr.strong th", has_text="Squareness XY").count() == 1  # the machine ran into a clamp

    rows = page.locator("table.judged tbody th").all_inner_texts()
    send(page, page.get_by_role("link", name=".json", exact=True))
    said = json.loads(page.locator("body").inner_text())
    assert (said["schema"], said["before"]["test"], said["after"]["test"]) == ("elastogeo.compare/1", 2, 8)
    assert [one.lower() for one in rows] == [one["name"].lower() for one in said["indicators"]]
    beyond = [abs(one["change"]) / (one["unchanged95"][1] - one["unchanged95"][0]) for one in said["indicators"]]
    assert [one["within"] for one in said["indicators"]] == sorted(one["within"] for one in said["indicators"])
    assert beyond[0] == max(beyond) > 0.5 >= beyond[-1]
    changes = sorted((one["p_value"] for one in said["parameters"]), key=float)
    assert [one["p_value"] for one in said["parameters"]] == changes


def test_each_circle_is_switched_off_and_on_by_the_space_bar(screen: Watched) -> None:
    page = screen.page
    screen.go("/compare?a=7&b=8")
    for box, line in (("earlier", f"{DRAWN}[stroke-dasharray]"), ("later", f'{DRAWN}[stroke-width="2"]')):
        assert shown(page, line)
        tab_to(page, page.locator(f"input[name={box}]"))
        page.keyboard.press("Space")
        assert not shown(page, line)
        page.keyboard.press("Space")
        assert shown(page, line)


def shown(page: Any, line: str) -> bool:
    """Whether a circle can be seen."""
    return bool(page.locator(line).first.is_visible())


def test_a_test_is_not_compared_with_itself(screen: Watched) -> None:
    page = screen.page
    screen.go("/compare?a=8&b=8")
    assert "These are one and the same test." in page.locator(".verdict").inner_text()
    choose(page, page.get_by_label("First test"), "3")
    send(page, page.get_by_role("button", name="Compare", exact=True))
    assert page.url.endswith("/compare?a=3&b=8")
    press(page, page.locator(".skip"))
    assert page.evaluate("document.activeElement.id") == "main"
