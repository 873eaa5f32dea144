"""Log in and out, the cookie, how often a password may be tried, and what is said, shown and logged of it."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import pytest

from elastogeo.history.people import person_of_session
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER, READER
from elastogeo.web.people.login import WRONG, _ours
from elastogeo.web.people.throttle import FREE_BY_ADDRESS, FREE_BY_NAME, LONGEST, Throttle, TooOften
from tests.web.guard.conftest import NAME, PASSWORD, PERSONS, Shop

ANNA = PERSONS[ADMINISTRATOR]


@pytest.fixture
def own(make_shop: Callable[..., Shop]) -> Iterator[Shop]:
    """A shop of one's own."""
    found = make_shop()
    yield found
    found.history.close()


def form(name: str = ANNA, password: str = PASSWORD, to: str = "/") -> dict[str, str]:
    return {"name": name, "password": password, "to": to}


def test_name_and_password_open_the_pages_and_logging_out_shuts_them(own: Shop) -> None:
    browser = own.browser()
    asked = browser.get("/machines/1?span=2y")
    there = browser.get(asked.headers["location"])
    assert 'value="/machines/1?span=2y"' in there.text
    done = browser.post("/login", data=form(to="/machines/1?span=2y"))
    assert (done.status_code, done.headers["location"]) == (303, "/machines/1?span=2y")
    assert browser.get("/").status_code == 200
    secret = browser.cookies["elastogeo_session"]
    assert browser.get("/login").headers["location"] == "/"
    out = browser.post("/logout")
    assert (out.headers["location"], "elastogeo_session" in browser.cookies) == ("/login", False)
    assert browser.get("/", headers={"Cookie": f"elastogeo_session={secret}"}).headers["location"] == "/login"


def test_logging_in_again_is_another_session_and_ends_the_one_before(own: Shop) -> None:
    browser = own.browser()
    browser.cookies.set("elastogeo_session", "chosen-by-somebody-else", domain="shop.example")
    browser.post("/login", data=form())
    first = {cookie.value for cookie in browser.cookies.jar} - {"chosen-by-somebody-else"}
    assert len(first) == 1
    assert person_of_session(own.history.store, "chosen-by-somebody-else") is None


def test_logging_in_again_shuts_the_session_that_this_browser_had(own: Shop) -> None:
    browser = own.browser()
    browser.post("/login", data=form())
    before = browser.cookies["elastogeo_session"]
    assert person_of_session(own.history.store, before) is not None
    browser.post("/login", data=form(PERSONS[ENGINEER]))
    assert browser.cookies["elastogeo_session"] != before
    assert person_of_session(own.history.store, before) is None


@pytest.mark.parametrize(
    ("settings", "name", "more"),
    [
        ({}, "elastogeo_session", {"Path=/"}),
        ({"prefix": "/eg"}, "elastogeo_session", {"Path=/eg/"}),
        ({"behind_https": True}, "__Host-elastogeo_session", {"Path=/", "Secure"}),
        ({"behind_https": True, "prefix": "/eg"}, "__Secure-elastogeo_session", {"Path=/eg/", "Secure"}),
    ],
)
def test_the_cookie_is_for_this_host_and_no_script(
    make_shop: Callable[..., Shop], settings: dict[str, object], name: str, more: set[str]
) -> None:
    shop = make_shop(**settings)
    prefix = str(settings.get("prefix", ""))
    origin = {"Origin": f"http{'s' if settings.get('behind_https') else ''}://{NAME}"}
    done = shop.browser().post(f"{prefix}/login", data=form(to="/machines"), headers=origin)
    assert done.headers["location"] == f"{prefix}/machines"
    first, *parts = done.headers["set-cookie"].split("; ")
    assert first.partition("=")[0] == name
    assert set(parts) == {"HttpOnly", "SameSite=lax", "Max-Age=604800", *more}
    assert len(first.partition("=")[2]) == 43


def test_nothing_says_whether_a_name_is_known(own: Shop) -> None:
    own.history.switch_account(PERSONS[READER], False)
    said = {
        own.browser().post("/login", data=form(name, password)).text
        for name, password in ((ANNA, "wrong"), ("Nobody", "wrong"), (PERSONS[READER], PASSWORD), ("<b>", PASSWORD))
    }
    assert len(said) == 1
    assert WRONG in said.pop()


@pytest.mark.usefixtures("nothing_written")
def test_a_failure_writes_nothing_and_no_log_holds_what_was_typed(shop: Shop, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    answer = shop.browser().post("/login", data=form("my-secret-as-name", "my-secret-typed"))
    assert answer.status_code == 403
    assert "my-secret" not in answer.text
    told = caplog.text + repr([record.__dict__ for record in caplog.records])
    assert "log-in from" in told
    assert "my-secret" not in told


def test_no_log_holds_a_password_a_session_or_a_token(own: Shop, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    browser = own.browser()
    browser.post("/login", data=form())
    made = browser.post("/tokens", data={"purpose": "cell"}, headers={"Accept": "application/json"}).json()["token"]
    own.program(made).get("/fleet.json")
    own.program("egt_wrong-but-secret").get("/fleet.json?token=egt_in-the-address")
    own.browser().post("/login", data=form(PERSONS[READER], "not-the-password"))
    told = repr([record.__dict__ for record in caplog.records if record.name != "httpx2"])  # that is who asks
    assert "log-in from" in told
    assert "not-the-password" not in told
    for secret in (PASSWORD, browser.cookies["elastogeo_session"], made, "wrong-but-secret", "in-the-address"):
        assert secret not in told


def test_the_page_to_log_in_shows_nothing_of_the_shop(shop: Shop) -> None:
    text = shop.browser().get("/login").text
    for word in ("Mill 3", "hall 1", "Alarms", "Fleet", *PERSONS.values(), shop.history.store.url):
        assert word not in text


@pytest.mark.parametrize(
    "to",
    [
        "//evil.example", "https://evil.example", "/\\evil.example", "\\\\evil.example", "javascript:alert(1)", "/\t/evil",
        "/\n/evil.example", "evil", "", "/%0d%0aSet-Cookie: x", "/login?to=/", "/logout", "/a\r\nLocation: //evil",
    ],
)  # fmt: skip
def test_one_goes_on_to_an_address_of_ours_only(to: str) -> None:
    safe = _ours(to)
    assert safe == "/" or (to == "/%0d%0aSet-Cookie: x" and safe == to)


def test_who_fails_often_must_wait_ever_longer_and_is_told_so() -> None:
    at = [0.0]
    throttle = Throttle(lambda: at[0])
    for _ in range(FREE_BY_NAME):
        throttle.check("Anna", "192.0.2.1")
    for seconds in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 900, 900):
        with pytest.raises(TooOften, match=f"Too many attempts to log in: wait {seconds} s, then try again"):
            throttle.check("Anna", "192.0.2.1")
        at[0] += seconds
        throttle.check("Anna", "192.0.2.1")
    throttle.check("Ben", "192.0.2.2")  # another person elsewhere
    with pytest.raises(TooOften):
        throttle.check(" ANNA ", "192.0.2.3")  # the same name from elsewhere
    at[0] += LONGEST + 1
    throttle.check("anna", "192.0.2.1")


def test_an_address_that_tries_many_names_must_wait_and_a_right_password_frees_the_name() -> None:
    throttle = Throttle(lambda: 0.0)
    for k in range(FREE_BY_ADDRESS):
        throttle.check(f"name {k}", "192.0.2.1")
    with pytest.raises(TooOften):
        throttle.check("another", "192.0.2.1")
    throttle.check("another", "192.0.2.2")
    for _ in range(50):  # a shop behind one address, where all know their passwords
        throttle.check("Anna", "192.0.2.3")
        throttle.succeeded("Anna", "192.0.2.3")


def test_many_attempts_at_once_are_no_way_around(own: Shop) -> None:
    def attempt(_: int) -> int:
        return own.browser().post("/login", data=form(password="wrong of many at once")).status_code

    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(attempt, range(24)))
    assert answers.count(403) <= FREE_BY_NAME + 2  # a second or two may pass meanwhile
    assert answers.count(429) == 24 - answers.count(403)
    late = own.browser().post("/login", data=form())
    assert (late.status_code, "Too many attempts to log in: wait" in late.text) == (429, True)
    assert int(late.headers["retry-after"]) > 0


def test_one_changes_ones_own_password_with_the_present_one(own: Shop) -> None:
    browser, new = own.browser(ENGINEER), "another of my own words"
    wrong = browser.post("/password", data={"present": "wrong", "password": new, "again": new})
    assert (wrong.status_code, "The present password is wrong." in wrong.text) == (400, True)
    other = browser.post("/password", data={"present": PASSWORD, "password": new, "again": "x"})
    assert "The two new passwords differ." in other.text
    done = browser.post("/password", data={"present": PASSWORD, "password": new, "again": new})
    assert done.headers["location"] == "/login"
    assert browser.get("/").headers["location"] == "/login"
    assert own.browser().post("/login", data=form(PERSONS[ENGINEER], new)).status_code == 303
    assert own.browser().post("/login", data=form(PERSONS[ENGINEER])).status_code == 403


def test_an_administrator_keeps_the_accounts(own: Shop) -> None:
    browser, secret = own.browser(ADMINISTRATOR), {"password": "four words to keep", "again": "four words to keep"}
    made = browser.post("/accounts", data={"name": "D. New", "role": "reader", **secret})
    assert made.headers["location"] == "/accounts"
    page = browser.get("/accounts")
    assert "The account is made." in page.text
    rows = {row["name"]: row for row in browser.get("/accounts.json").json()["accounts"]}
    assert (rows["D. New"]["role"], rows["D. New"]["has_password"]) == ("reader", True)
    key = next(one.key for one in own.history.accounts().accounts if one.name == "D. New")
    assert own.browser().post("/login", data=form("D. New", "four words to keep")).status_code == 303
    assert browser.post(f"/accounts/{key}/role", data={"role": "engineer"}).status_code == 303
    assert browser.post(f"/accounts/{key}/password", data=secret | {"again": "other"}).status_code == 400
    assert browser.post(f"/accounts/{key}/switch", data={"to": "off", "why": "left"}).status_code == 303
    assert own.browser().post("/login", data=form("D. New", "four words to keep")).status_code == 403
    assert browser.post("/accounts/99/switch", data={"to": "off"}).status_code == 404
    own_key = next(one.key for one in own.history.accounts().accounts if one.name == ANNA)
    last = browser.post(f"/accounts/{own_key}/switch", data={"to": "off"})
    assert (last.status_code, "is the last administrator who can log in" in last.text) == (400, True)
    (row,) = own.history.audit(1).rows
    assert (row.who, row.what, row.why) == (ANNA, "switch off", "left")
    for held in (page.text, str(browser.get("/accounts.json").json()), browser.get("/accounts.csv").text):
        assert "argon2" not in held


def test_a_token_is_shown_once_and_ends(own: Shop) -> None:
    browser = own.browser(ENGINEER)
    made = browser.post("/tokens", data={"purpose": "cell <4>"})
    token = made.text.partition('class="secret">')[2].partition("<")[0]
    assert made.headers["cache-control"] == "no-store"
    assert own.program(token).get("/fleet.json").status_code == 200
    for path in ("/tokens", "/tokens.json", "/tokens.csv"):
        again = browser.get(path)
        assert token not in again.text
        assert "cell" in again.text
    number = max(one.number for one in own.history.tokens().tokens)
    other = own.browser(READER)
    assert other.post(f"/tokens/{number}/end").status_code == 400  # not theirs
    assert own.program(token).get("/fleet.json").status_code == 200
    assert browser.post(f"/tokens/{number}/end").status_code == 303
    assert own.program(token).get("/fleet.json").status_code == 401
