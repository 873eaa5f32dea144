"""In a browser, by the keyboard alone: log in, work, log out; a wrong password; what a reader does not get; a token."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from elastogeo.history import History
from tests.web.browsing import Site, serving
from tests.web.conftest import copy_of
from tests.web.keyboard import press, send, write

PASSWORD = "a long enough password"
POSTED = """async ([path, said]) => {
  const body = new URLSearchParams(said);
  return (await fetch(path, { method: "POST", body, headers: { Accept: "application/json" } })).status;
}"""


@pytest.fixture(scope="module")
def closed_site(made_fleet: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """The fleet, where nobody comes in without an account."""
    folder = tmp_path_factory.mktemp("closed")
    database = copy_of(made_fleet, folder / "fleet")
    with History(database, who="A. Miller") as history:
        history.add_account("A. Miller", "administrator", PASSWORD)
        history.add_account("R. Eader", "reader", PASSWORD)
    with serving(database, folder / "serve.log", "--accounts") as site:
        yield site


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
    page.context.add_cookies([cookie])  # of somebody who kept it
    screen.go("/")
    assert page.url.startswith(f"{closed_site.url}/login")


def test_a_reader_looks_and_changes_nothing(closed_site: Site, screens: Any) -> None:
    screen = screens(closed_site.url)
    page = screen.page
    screen.go("/login")
    log_in(page, "R. Eader")
    for path in ("/", "/machines/1", "/tests/8", "/alarms", "/alarms/1", "/plans", "/plans/1", "/instruments"):
        assert screen.go(path).status == 200
        forms = page.locator("form[method=post]:not([action$='/theme']):not([action$='/logout'])")
        assert forms.count() == 0, path
        assert page.get_by_role("link", name="Upload").count() == 0, path
    with History(closed_site.database) as history:
        before = history.audit(last=1).rows[0].number
    screen.expected = (403,)
    acts = {"/alarms/1/acknowledge": {"why": "x"}, "/tests/8/aside": {"why": "x"}, "/plans/1/done": {}, "/events": {}}
    for path, said in acts.items():
        assert page.evaluate(POSTED, [path, said]) == 403, path
    assert screen.go("/accounts").status == 403
    assert "this needs the role administrator" in page.locator("main").inner_text()
    with History(closed_site.database) as history:
        assert history.audit(last=1).rows[0].number == before


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
