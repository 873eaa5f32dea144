"""In a browser, by the keyboard: alarms are acknowledged with a reason and closed; what follows, who did it and why."""

from __future__ import annotations

from typing import Any

from tests.web.browsing import Site, Watched
from tests.web.journeys.conftest import MILLS
from tests.web.keyboard import press, send, write

UNKNOWN = "nav[aria-label=Main] .unknown"


def unknown(page: Any) -> str:
    """How many alarms the navigation says that nobody has acknowledged."""
    found = page.locator(UNKNOWN)
    return found.inner_text().split()[0] if found.count() else "none"


def test_alarms_are_acknowledged_and_closed(shop: Site, screens: Any) -> None:
    """One as repaired, so that a new baseline follows, the other as false, so that the old one stays."""
    screen: Watched = screens(shop.url)
    page = screen.page
    screen.go("/")
    assert unknown(page) == "2"
    page.keyboard.press("g")
    with page.expect_navigation():
        page.keyboard.press("a")
    assert page.url == f"{shop.url}/alarms"
    numbers = {MILLS.index(name): page.locator(".alarm", has_text=name).get_attribute("id")[6:] for name in MILLS}
    repaired, false = numbers[0], numbers[1]
    second = page.locator(".alarm").nth(1).get_attribute("id")[6:]
    assert acknowledged(page, "nut is ordered <b>").endswith("is acknowledged by A. Miller; it stays open.")
    assert page.url.rpartition("/")[2] == second
    assert unknown(page) == "1"
    assert "nut is ordered <b>" in page.locator(".steps").inner_text()

    said = closed(screen, repaired, "Repaired", "guideway scraped")
    assert "needs a new baseline" in said
    assert "guideway scraped" in page.locator(".steps").inner_text()
    assert page.locator("summary", has_text="Acknowledge").count() == 0
    new = page.get_by_role("link", name="Set the new baseline")
    assert new.get_attribute("href").startswith("/settings/series/")
    check_audit(page, repaired, "closed as repaired", "guideway scraped")

    said = closed(screen, false, "False", "coolant on the ball")
    assert "keeps its baseline" in said
    assert page.get_by_role("link", name="Set the new baseline").count() == 0
    check_audit(page, false, "closed as false", "coolant on the ball")
    screen.go("/alarms")
    assert unknown(page) == "none"
    assert page.get_by_role("heading", name="Closed lately").count() == 1
    assert page.locator(".alarm .acts").count() == 0


def acknowledged(page: Any, why: str) -> str:
    """Acknowledge the second alarm of the page by the keys j, j and a; what is said then."""
    page.locator("main").focus()
    for key in "jja":
        page.keyboard.press(key)
    assert page.evaluate("document.activeElement.name") == "why"
    page.keyboard.type(why)
    page.keyboard.press("Tab")
    with page.expect_navigation():
        page.keyboard.press("Enter")
    return str(page.locator(".said").inner_text())


def closed(screen: Watched, number: str, as_what: str, why: str) -> str:
    """Close an alarm; what is said then."""
    page = screen.page
    screen.go(f"/alarms/{number}")
    press(page, page.locator("summary", has_text="Close"))
    page.keyboard.press("Tab")
    page.keyboard.press("Space")
    while not page.get_by_role("radio", name=as_what).is_checked():
        page.keyboard.press("ArrowDown")
    write(page, page.locator("details[open] textarea"), why)
    send(page, page.get_by_role("button", name=f"Close alarm {number}"))
    return str(page.locator(".said").inner_text())


def check_audit(page: Any, number: str, state: str, why: str) -> None:
    """The trail says who, what and why, and is whole."""
    send(page, page.get_by_role("link", name="in the audit trail"))
    row = page.locator("tbody tr", has_text=why)
    assert all(word in row.inner_text() for word in ("A. Miller", f"alarm {number}", state))
    assert "seal" in page.locator(".checks .passed").inner_text()
