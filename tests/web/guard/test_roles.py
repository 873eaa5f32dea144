"""Nobody passes without an account, nobody does what the role does not allow, and nothing is written on the way."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

import pytest
from sqlalchemy import update

from elastogeo.history.people import has_accounts
from elastogeo.history.store import write
from elastogeo.history.store.schema import account
from elastogeo.web import Settings, application
from elastogeo.web.asking import ADMINISTRATOR, ANYBODY, ENGINEER, READER, ROLES
from tests.web.guard.addresses import Address, addresses, shut
from tests.web.guard.conftest import HOST, NAME, PERSONS, Shop

pytestmark = pytest.mark.usefixtures("nothing_written")
FILES = {("GET", "/static/plotly.min.js"), ("GET", "/favicon.ico")}
OPEN = {("GET", "/login"), ("POST", "/login"), ("GET", "/health"), *FILES}


def named(one: Address) -> str:
    return f"{one.method} {one.template}"


def test_what_anybody_may_ask_is_to_log_in_and_whether_we_are_well() -> None:
    assert {(one.method, one.path) for one in addresses() if one.role == ANYBODY} == OPEN
    assert len(shut()) > 20


def test_no_address_is_registered_twice() -> None:
    every = [(one.method, one.template) for one in addresses()]
    assert sorted(every) == sorted(set(every))


@pytest.mark.parametrize("one", shut(), ids=named)
def test_without_an_account_an_address_says_nothing(shop: Shop, one: Address) -> None:
    """A person is sent to log in, a program is told."""
    for browser in (shop.browser(), shop.program(), shop.program("egt_wrong")):
        answer = browser.request(one.method, one.path)
        assert answer.status_code in (303, 401)
        assert answer.headers.get("location", "/login").startswith("/login")
        assert "Mill 3" not in answer.text
    assert "www-authenticate" in answer.headers


@pytest.mark.parametrize("one", [one for one in addresses() if one.method == "POST" and one.role != ANYBODY], ids=named)
def test_what_is_sent_is_not_read_before_it_is_known_by_whom(shop: Shop, one: Address) -> None:
    """Neither without an account, nor with a role that does not do; what is thrown away after the answer is never kept."""
    asked = [f"Bearer {shop.tokens[READER]}"] if one.role != READER else []
    for authorization in ("Bearer egt_wrong", *asked):
        order: list[str] = []

        async def receive(order: list[str] = order) -> dict[str, object]:
            order.append("read")
            return {"type": "http.request", "body": b"x" * 60_000, "more_body": False}

        async def send(message: dict[str, object], order: list[str] = order) -> None:
            order.append(str(message.get("status", "body")))

        headers = {"host": NAME, "authorization": authorization, "content-length": "60000"}
        scope = {
            "type": "http", "method": "POST", "path": one.path, "query_string": b"", "scheme": "http", "root_path": "",
            "headers": [(name.encode(), value.encode()) for name, value in headers.items()], "client": ("192.0.2.1", 1),
        }  # fmt: skip
        asyncio.run(shop.app(scope, receive, send))
        assert order[0] in ("401", "403")


@pytest.mark.parametrize("role", [READER, ENGINEER])
@pytest.mark.parametrize("one", [one for one in addresses() if one.role in (ENGINEER, ADMINISTRATOR)], ids=named)
def test_who_may_not_is_refused_before_anything_is_read(shop: Shop, one: Address, role: str) -> None:
    if ROLES.index(role) >= ROLES.index(one.role):
        return
    program = shop.program(shop.tokens[role])
    answer = program.request(one.method, one.path, content=b"%", headers={"Content-Type": "multipart/form-data; boundary=x"})
    assert answer.status_code == 403
    assert f"this needs the role {one.role}; {PERSONS[role]} is {role}" in answer.text


def test_what_the_guard_lets_in_is_what_a_session_or_a_token_says(shop: Shop) -> None:
    for role, name in PERSONS.items():
        page = shop.program(shop.tokens[role]).get("/tokens", headers={"Accept": "text/html"})
        assert f"Tokens of {name}" in page.text
    assert shop.program("egt_").get("/").status_code == 401
    assert shop.program(shop.tokens[READER] + "x").get("/fleet.json").status_code == 401
    assert shop.program().get("/", headers={"Authorization": "Basic QTpC"}).status_code == 401
    forged = {"Cookie": "elastogeo_session=" + "A" * 43}
    assert shop.program().get("/fleet.json", headers=forged).status_code == 401


def test_a_wrong_token_is_not_mended_by_a_right_cookie(make_shop: Callable[..., Shop]) -> None:
    shop = make_shop()
    browser = shop.browser(READER)
    assert browser.get("/").status_code == 200
    assert browser.get("/", headers={"Authorization": "Bearer egt_wrong"}).status_code == 401


@pytest.mark.usefixtures("quick_passwords")
def test_without_accounts_whoever_sits_here_is_administrator_until_the_first_account(tmp_path) -> None:
    import elastogeo as eg

    with eg.History(tmp_path / "h.db", create=True) as history:
        here = Shop(history, application(Settings(history.store.url, who="D. Here", worker=False), history.store))
        browser = here.browser()
        browser.base_url = "http://localhost:8347"
        browser.headers["Origin"] = "http://localhost:8347"
        assert "D. Here" in browser.get("/").text
        for said in ("Bearer egt_wrong", "Basic QTpC", ""):  # whoever shows something shows the right thing
            assert browser.get("/", headers={"Authorization": said}).status_code == 401
        assert not has_accounts(history.store)
        made = browser.post("/accounts", data={"name": "E", "role": "reader", "password": "", "again": ""})
        assert "make the account of one first, with a password" in made.text
        secret = {"password": "correct horse battery", "again": "correct horse battery"}
        assert browser.post("/accounts", data={"name": "E", "role": "administrator", **secret}).status_code == 303
        assert browser.get("/").headers["location"] == "/login"
        assert history.audit(1).rows[0].who == "D. Here"


@pytest.mark.parametrize(
    ("settings", "opens"),
    [
        ({}, True),
        ({"accounts": True}, False),
        ({"hosts": ("shop.example",)}, False),
        ({"behind_https": True}, False),
        ({"host": "0.0.0.0"}, False),
        ({"host": "192.0.2.7"}, False),
        ({"host": "::"}, False),
        ({"host": "::1"}, True),
        ({"host": "127.0.0.9"}, True),
    ],
)
def test_without_accounts_only_this_computer_is_served(settings, opens, tmp_path) -> None:
    """Whoever serves others without an administrator is told what to do; should the pages run, they open to nobody."""
    import elastogeo as eg
    from elastogeo.errors import StoreError
    from elastogeo.web.guard import check_reach

    with eg.History(tmp_path / "h.db", create=True) as history:
        asked = Settings(history.store.url, worker=False, **settings)
        if opens:
            check_reach(asked, history.store)
        else:
            with pytest.raises(StoreError, match="make the account with: elastogeo history account NAME --role"):
                check_reach(asked, history.store)
        program = Shop(history, application(asked, history.store)).program()
        program.base_url = "http://localhost"
        assert program.get("/fleet.json").status_code == (200 if opens else 401)


def test_an_account_that_is_off_opens_nothing_by_a_token_that_was_left(make_shop: Callable[..., Shop]) -> None:
    """Switching off ends the tokens; should one be left, by whatever way, the account counts."""
    shop = make_shop()
    assert shop.program(shop.tokens[ENGINEER]).get("/fleet.json").status_code == 200
    with write(shop.history.store) as connection:
        connection.execute(update(account).values(active=False))
    for role in (READER, ENGINEER, ADMINISTRATOR):
        assert shop.program(shop.tokens[role]).get("/fleet.json").status_code == 401
        assert shop.browser(role).get("/").headers["location"] == "/login"


def test_a_session_that_ended_opens_nothing(make_shop: Callable[..., Shop]) -> None:
    shop = make_shop()
    browser = shop.browser(ENGINEER)
    assert browser.get("/").status_code == 200
    shop.history.switch_account(PERSONS[ENGINEER], False)
    assert browser.get("/").headers["location"] == "/login"
    assert shop.program(shop.tokens[ENGINEER]).get("/fleet.json").status_code == 401
    assert (
        browser.get("/machines/1?series=%3Cx%3E").headers["location"] == "/login?to=%2Fmachines%2F1%3Fseries%3D%253Cx%253E"
    )
    assert HOST not in browser.get("/").text
