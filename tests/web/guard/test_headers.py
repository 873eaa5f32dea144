"""Every answer carries what binds the browser, and no answer echoes what was sent or tells of a fault."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import elastogeo.web
from elastogeo.web.asking import ADMINISTRATOR
from tests.web.guard.addresses import Address, addresses
from tests.web.guard.conftest import Shop

WEB = Path(elastogeo.web.__file__).parent
GETS = [one for one in addresses() if one.method == "GET" and not one.path.startswith("/static/")]


def binding(headers: object) -> dict[str, str]:
    return {str(name): str(value) for name, value in headers.items()}  # type: ignore[attr-defined]


def policy(headers: dict[str, str]) -> dict[str, set[str]]:
    parts = [part.split() for part in headers["content-security-policy"].split(";")]
    return {first: set(rest) for first, *rest in parts}


@pytest.mark.parametrize("one", GETS, ids=lambda one: one.template)
def test_every_answer_binds_the_browser(shop: Shop, one: Address) -> None:
    for browser in (shop.browser(ADMINISTRATOR), shop.browser()):
        answer = browser.get(one.path)
        assert answer.status_code < 500
        check(binding(answer.headers))
        assert "no-store" in answer.headers["cache-control"] or "private" in answer.headers["cache-control"]


@pytest.mark.parametrize("path", ["/static/app.css", "/static/none.css", "/nothing", "/openapi.json", "/machines/x"])
def test_files_and_errors_do_so_too(shop: Shop, path: str) -> None:
    check(binding(shop.browser(ADMINISTRATOR).get(path).headers))
    check(binding(shop.browser(ADMINISTRATOR).get(path, headers={"Host": "evil.example"}).headers))
    check(binding(shop.browser(ADMINISTRATOR).post(path, content=b"x" * 70_000).headers))


def check(headers: dict[str, str]) -> None:
    said = policy(headers)
    assert said["default-src"] in ({"'self'"}, {"'none'"})
    assert said.get("script-src", said["default-src"]) <= {"'self'", "'none'"}  # none in line, none of another host
    assert "sandbox" in said or (said["frame-ancestors"], said["form-action"]) == ({"'none'"}, {"'self'"})
    assert "sandbox" in said or (said["object-src"], said["base-uri"]) == ({"'none'"}, {"'none'"})
    assert said["img-src"] <= {"'self'", "data:", "blob:"}
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "same-origin"
    assert headers["cross-origin-opener-policy"] == headers["cross-origin-resource-policy"] == "same-origin"
    assert "camera=()" in headers["permissions-policy"]
    assert "access-control-allow-origin" not in headers
    assert "server" not in headers


def test_https_is_asked_for_only_where_there_is_https(make_shop: Callable[..., Shop], shop: Shop) -> None:
    assert "strict-transport-security" not in shop.browser().get("/login").headers
    secure = make_shop(behind_https=True).browser().get("/login").headers
    assert secure["strict-transport-security"] == "max-age=31536000"


def test_our_files_are_kept_by_the_browser_while_their_content_is_the_same(shop: Shop) -> None:
    page = shop.browser(ADMINISTRATOR).get("/").text
    asked = re.search(r'href="(/static/app\.css\?v=\w+)"', page)
    assert asked
    assert shop.browser().get(asked[1]).headers["cache-control"] == "public, max-age=31536000, immutable"
    assert shop.browser().get("/static/app.css").headers["cache-control"] == "no-cache"


def templates() -> Iterator[Path]:
    yield from sorted((WEB / "templates").rglob("*.j2"))


def test_no_template_has_a_script_in_line_a_handler_or_an_asset_of_another_host() -> None:
    assert len(list(templates())) > 5
    for path in templates():
        text = path.read_text(encoding="utf-8")
        scripts = re.findall(r"<script\b[^>]*>", text)
        assert [one for one in scripts if "src=" not in one and 'type="application/json"' not in one] == [], path
        assert re.findall(r"<[a-z]+\b[^>]*\son[a-z]+=", text) == [], path
        assert re.findall(r"javascript:|hx-on|hx-vals=['\"]js:", text) == [], path
        drawn = re.sub(r"\{\{ kept\.element\([\w.]+\)\|safe \}\}", "", text)  # SVG that we drew and kept
        assert re.findall(r"\|\s*safe|autoescape|Markup", drawn) == [], path
        assert re.findall(r"(?:src|href|action)=\"(?:https?:)?//", text) == [], path


def test_a_fault_of_a_page_or_the_guard_has_a_number_that_the_log_has(
    make_shop: Callable[..., Shop], monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    shop = make_shop()

    def broken(*_: object) -> None:
        raise ZeroDivisionError("the secret of the house")

    browser = shop.browser(ADMINISTRATOR)
    for place in ("elastogeo.history.History.fleet", "elastogeo.web.guard.visitors._Door.visitor"):
        caplog.clear()
        with monkeypatch.context() as patch, caplog.at_level(logging.ERROR):
            patch.setattr(place, broken)
            answer = browser.get("/")
        assert answer.status_code == 500
        number = re.search(r"number (\w+);", answer.text)
        assert number
        assert caplog.text.count(f"fault {number[1]}") == 1
        assert "the secret of the house" in caplog.text
        assert not re.search(r"secret of the house|Traceback|ZeroDivision|\.py", answer.text)
        check(binding(answer.headers))


def test_a_history_that_cannot_be_read_is_said_in_one_sentence(
    make_shop: Callable[..., Shop], monkeypatch: pytest.MonkeyPatch
) -> None:
    from elastogeo.errors import StoreError

    shop = make_shop()

    def locked(*_: object) -> None:
        raise StoreError("/srv/secret/h.db: is locked")

    browser = shop.browser(ADMINISTRATOR)
    monkeypatch.setattr("elastogeo.web.guard.visitors.person_of_session", locked)
    answer = browser.get("/")
    assert (answer.status_code, "The history cannot be read just now; try again." in answer.text) == (503, True)
    assert "secret" not in answer.text


ECHO = "zq9<img src=x onerror=alert(1)>zq9"


@pytest.mark.usefixtures("nothing_written")
@pytest.mark.parametrize("one", [one for one in addresses() if one.method == "POST"], ids=lambda one: one.template)
def test_what_does_not_fit_is_not_echoed(shop: Shop, one: Address) -> None:
    """A form in which nothing fits: the answer names entries, not what was in them."""
    browser = shop.browser(ADMINISTRATOR)
    before = shop.head()
    for body in ({ECHO: ECHO}, {"key": ECHO, "at": ECHO, "name": ECHO * 400}):
        answer = browser.post(f"{one.path}?{ECHO}={ECHO}", data=body)
        assert answer.status_code < 500
        assert "zq9<" not in answer.text
        assert answer.status_code != 422 or "zq9" not in answer.text  # however it is escaped
    if shop.head() != before:
        pytest.fail(f"{one.path} did something with a form in which nothing fits")
