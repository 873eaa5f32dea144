"""In a browser, by the keyboard alone: log in, work, log out; what a reader does not get; a wrong password."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from elastogeo.history import History
from tests.web.browsing import Site
from tests.web.keyboard import press, send, write

PASSWORD = "a long enough password"


@pytest.fixture
def closed_site(fleet: Path, serve: Any) -> Site:
    """The fleet, where nobody comes in without an account."""
    with History(fleet, who="A. Miller") as history:
        history.add_account("A. Miller", "administrator", PASSWORD)
        history.add_account("R. Eader", "reader", PASSWORD)
    return serve(fleet, "--accounts")


def log_in(page: Any, name: str, password: str = PASSWORD) -> None:
    write(page, page.get_by_label("Name"), name)
    write(page, page.get_by_label("Password"), password)
    send(page, page.get_by_role("button", name="Log in"))


def test_log_in_and_out(closed_site: Site, screens: Any) -> None:
    screen = screens(closed_site.url)
    page = screen.page
    screen.go("/machines/1?span=all")
    assert page.url.startswith(f"{closed_site.url}/login")
    assert "Hermle" not in page.content()
    screen.expected = (403,)
    log_in(page, "A. Miller", "not this one")
    assert "Name or password is wrong" in page.get_by_role("alert").inner_text()
    log_in(page, "A. Miller")
    assert page.url == f"{closed_site.url}/machines/1?span=all"
    (cookie,) = [one for one in page.context.cookies() if "session" in one["name"]]
    assert cookie["httpOnly"]
    assert cookie["sameSite"] in ("Lax", "Strict")
    press(page, page.locator(".menu summary"))
    send(page, page.get_by_role("button", name="Log out"))
    assert page.url.startswith(f"{closed_site.url}/login")
    screen.go("/")
    assert page.url.startswith(f"{closed_site.url}/login")


def test_a_reader_makes_no_accounts(closed_site: Site, screens: Any) -> None:
    screen = screens(closed_site.url)
    screen.go("/login")
    log_in(screen.page, "R. Eader")
    screen.expected = (403,)
    assert screen.go("/accounts").status == 403
    assert "this needs the role administrator" in screen.page.locator("main").inner_text()


def test_a_token_is_made_and_shown_once(closed_site: Site, screens: Any) -> None:
    screen = screens(closed_site.url)
    page = screen.page
    screen.go("/login?to=/tokens")
    log_in(page, "A. Miller")
    write(page, page.get_by_label("What for"), "cell 4")
    send(page, page.get_by_role("button", name="Make a token"))
    secret = page.locator("code.secret").inner_text()
    assert len(secret) > 30
    screen.go("/tokens")
    assert secret not in page.content()
    assert "cell 4" in page.locator("main").inner_text()
