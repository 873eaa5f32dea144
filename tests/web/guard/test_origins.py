"""No other site acts or looks in a visitor's name, by whatever name it calls us."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import pytest

from elastogeo.web import Settings
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER
from elastogeo.web.guard.hosts import name_of
from elastogeo.web.guard.origins import is_own_origin
from tests.web.guard.addresses import Address, addresses
from tests.web.guard.conftest import HOST, NAME, Shop

ACTS = [one for one in addresses() if one.method != "GET"]
FOREIGN = [
    {"Origin": "https://evil.example", "Sec-Fetch-Site": "cross-site"},
    {"Origin": "https://evil.example"},
    {"Origin": "null"},
    {"Sec-Fetch-Site": "cross-site"},
    {"Sec-Fetch-Site": "same-site"},
    {"Sec-Fetch-Site": "none"},
    {"Origin": HOST, "Sec-Fetch-Site": "cross-site"},
    {"Origin": f"{HOST}.evil.example", "Sec-Fetch-Site": "same-origin"},
    {"Origin": f"http://{NAME}:81"},
    {"Origin": f"http://{NAME}@evil.example"},
    {},
]


@pytest.mark.usefixtures("nothing_written")
@pytest.mark.parametrize("one", ACTS, ids=lambda one: one.template)
def test_no_act_is_done_for_another_site(shop: Shop, one: Address) -> None:
    browser = shop.browser(ADMINISTRATOR)
    before = shop.head()
    for headers in FOREIGN:
        browser.headers.pop("Origin", None)
        browser.headers.pop("Sec-Fetch-Site", None)
        answer = browser.request(one.method, one.path, headers=headers)
        assert (answer.status_code, "came from another site" in answer.text) == (403, True), headers
    assert shop.head() == before


def test_our_own_pages_act(make_shop: Callable[..., Shop]) -> None:
    shop = make_shop()
    for headers in ({"Origin": HOST, "Sec-Fetch-Site": "same-origin"}, {"Origin": HOST}, {"Sec-Fetch-Site": "same-origin"}):
        browser = shop.browser(ADMINISTRATOR)
        for name in ("Origin", "Sec-Fetch-Site"):
            del browser.headers[name]
        assert browser.post("/theme", data={"theme": "dark"}, headers=headers).status_code == 303


def test_a_program_with_a_token_acts_without_an_origin_but_not_with_a_cookie_beside(make_shop: Callable[..., Shop]) -> None:
    shop = make_shop()
    program = shop.program(shop.tokens[ENGINEER])
    assert program.post("/theme", data={"theme": "dark"}).status_code == 303
    assert program.post("/theme", data={"theme": "dark"}, headers={"Origin": "https://evil.example"}).status_code == 303
    browser = shop.browser(ENGINEER)
    browser.headers["Authorization"] = f"Bearer {shop.tokens[ENGINEER]}"
    assert browser.post("/theme", data={"theme": "dark"}, headers={"Sec-Fetch-Site": "cross-site"}).status_code == 403


@pytest.mark.parametrize(
    ("said", "status"),
    [
        ({"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}, 200),  # a link
        ({"Sec-Fetch-Site": "none", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}, 200),  # a bookmark
        ({"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "iframe"}, 403),
        ({"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "script"}, 403),
        ({"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "cors", "Sec-Fetch-Dest": "empty"}, 403),
        ({"Sec-Fetch-Site": "same-site", "Sec-Fetch-Mode": "cors", "Sec-Fetch-Dest": "empty"}, 403),
        ({"Sec-Fetch-Site": "same-origin", "Sec-Fetch-Mode": "cors", "Sec-Fetch-Dest": "empty"}, 200),
    ],
)
def test_another_site_may_link_to_a_page_but_not_read_or_embed_one(shop: Shop, said: dict[str, str], status: int) -> None:
    assert shop.browser(ADMINISTRATOR).get("/", headers=said).status_code == status


@pytest.mark.parametrize(
    ("origin", "host", "hosts", "ours"),
    [
        ("http://127.0.0.1:8347", "127.0.0.1:8347", (), True),
        ("http://localhost:3000", "localhost:8347", (), False),  # another program of this computer
        ("http://[::1]:8347", "[::1]:8347", (), True),
        ("https://shop.example", "shop.example", ("shop.example",), True),
        ("https://shop.example", "127.0.0.1:8347", ("shop.example",), True),  # the proxy says its own address
        ("https://shop.example:8443", "127.0.0.1:8347", ("shop.example",), False),
        ("https://shop.example:8443", "127.0.0.1:8347", ("shop.example:8443",), True),
        ("HTTP://SHOP.EXAMPLE", "shop.example", (), True),
        ("http://shop.example/", "shop.example", (), False),
        ("file://", "127.0.0.1:8347", (), False),
        ("http://shop.example:x", "shop.example", (), False),
        ("", "shop.example", (), False),
    ],
)
def test_which_origin_is_ours(origin: str, host: str, hosts: tuple[str, ...], ours: bool) -> None:
    assert is_own_origin(origin, host, Settings("h.db", hosts=hosts)) is ours


def test_behind_https_a_page_that_came_without_it_is_not_ours() -> None:
    settings = Settings("h.db", hosts=("shop.example",), behind_https=True)
    assert is_own_origin("https://shop.example", "shop.example", settings)
    assert not is_own_origin("http://shop.example", "shop.example", settings)
    assert is_own_origin("http://127.0.0.1:8347", "127.0.0.1:8347", settings)  # on the server itself


@pytest.mark.usefixtures("nothing_written")
@pytest.mark.parametrize(
    "host",
    [
        "evil.example", "evil.example:8347", "shop.example.evil.example", "127.0.0.1.evil.example", "localhost.evil.example",
        "evil.example@shop.example", "shop.example/", "shop.example:x", "0.0.0.0", "[::2]", "", "2130706433", "127.1",
        "shop.example, evil.example",
    ],
)  # fmt: skip
def test_a_name_that_is_not_ours_is_refused_whatever_is_asked(shop: Shop, host: str) -> None:
    """DNS rebinding: the page of another site lets its name point to this computer."""
    for method, path in product(("GET", "POST"), ("/", "/fleet.json", "/login", "/health", "/static/app.css")):
        answer = shop.browser(ADMINISTRATOR).request(method, path, headers={"Host": host, "Origin": f"http://{host}"})
        assert answer.status_code == 421
        assert "start them with --allow-host" in answer.text
        assert "evil" not in answer.text


@pytest.mark.parametrize(
    "host", ["shop.example", "SHOP.example:80", "shop.example.", "localhost:1", "127.0.0.1", "[::1]:8347"]
)
def test_our_names_are_answered(shop: Shop, host: str) -> None:
    assert shop.browser(ADMINISTRATOR).get("/", headers={"Host": host}).status_code == 200


@pytest.mark.parametrize(
    ("authority", "name"),
    [("Shop.Example:443", "shop.example"), ("[::1]:80", "[::1]"), ("[::1]", "[::1]"), ("::1", ""), ("a b", ""), ("a:", "")],
)
def test_the_name_in_an_authority(authority: str, name: str) -> None:
    assert name_of(authority) == name
