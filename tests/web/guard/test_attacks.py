"""What an attacker tried from outside and got: numbers and names that no page expects, ways past a limit, much at once."""

from __future__ import annotations

import asyncio
import os
import subprocess
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy.exc import TimeoutError as NoConnection
from starlette.requests import Request

from elastogeo.errors import InputError, StoreError
from elastogeo.history import parcels
from elastogeo.history.parcels import arriving, staging
from elastogeo.history.people import entering
from elastogeo.history.store.refusals import in_words
from elastogeo.web import Settings, serving
from elastogeo.web.asking import ADMINISTRATOR, ENGINEER, READER
from elastogeo.web.guard.hosts import name_of
from elastogeo.web.guard.origins import is_own_origin
from elastogeo.web.people.login import _ours, address_of
from elastogeo.web.people.throttle import _IN_ALL, FREE_BY_NAME, Throttle, TooOften
from elastogeo.web.work import receiving
from tests.web.guard.conftest import HOST, NAME, PASSWORD, PERSONS, Shop
from tests.web.guard.served import connected, served

DIGITS = "9" * 5000
"""More than Python makes a number of."""


@pytest.fixture(scope="module")
def own(make_shop: Callable[..., Shop]) -> Iterator[Shop]:
    found = make_shop()
    yield found
    found.history.close()


@pytest.mark.parametrize(
    "path", [f"/machines/{DIGITS}", f"/tests/{DIGITS}.json", f"/plans?machine={DIGITS}", f"/compare?a={DIGITS}"]
)
def test_a_number_of_thousands_of_digits_is_nothing(shop: Shop, path: str) -> None:
    assert shop.browser(ADMINISTRATOR).get(path).status_code == 404


def test_words_to_search_may_be_a_long_number(shop: Shop) -> None:
    """A serial number of twenty digits is one."""
    assert shop.browser(READER).get("/search?q=12345678901234567890").status_code == 200
    assert shop.browser(READER).get(f"/jobs?x={DIGITS}").status_code == 200  # of which the page asks nothing


@pytest.mark.parametrize("number", ["²", "٣", "9" * 30, "-1", ""])
def test_a_map_rests_on_a_number_of_plain_digits(shop: Shop, number: str) -> None:
    browser = shop.browser(ADMINISTRATOR)
    for answer in (
        browser.get("/machines/1/map", params={"basis": f"test:{number}"}),
        browser.post("/machines/1/map", data={"basis": f"test:{number}"}),
    ):
        assert (answer.status_code, "a map rests on a campaign or a test" in answer.text) == (400, True)


@pytest.mark.parametrize("percent", ["nan", "inf", "-inf", "1e999", "-5", "1e30"])
def test_a_goal_has_a_percentage(shop: Shop, percent: str) -> None:
    asked = {"goal": "stiffness", "minutes": "60", "instrument": "ball_bar", "percent": percent}
    answer = shop.browser(ENGINEER).post("/machines/1/plan", data=asked)
    assert (answer.status_code, "does not fit: percent" in answer.text) == (422, True)


def test_no_form_takes_a_number_that_the_database_cannot_hold(shop: Shop) -> None:
    document = shop.program(shop.tokens[READER]).get("/openapi.json").json()
    forms = {
        name: form
        for name, form in document["components"]["schemas"].items()
        if name.startswith("Body_") and form["type"] == "object"
    }
    numbers = [
        (name, field, said)
        for name, form in forms.items()
        for field, said in form["properties"].items()
        if said.get("type") == "integer"
    ]
    assert len(numbers) >= 3
    assert [(name, field) for name, field, said in numbers if said.get("maximum", 2**64) > 2**53] == []


@pytest.mark.parametrize("host", [f"{NAME}:²", f"{NAME}:¹³", f"{NAME}:٣"])
def test_a_port_is_of_plain_digits(host: str) -> None:
    assert name_of(host) == ""
    assert not is_own_origin(f"http://{NAME}:8347", host, Settings("h.db"))


@pytest.mark.parametrize("path", ["/machines/", "/tests/1/", "/accounts/", "//evil.example/"])
def test_no_address_redirects_by_itself(shop: Shop, path: str) -> None:
    """The frame would build the address of `Host`, without https and without the prefix of a proxy."""
    answer = shop.browser(ADMINISTRATOR).get(f"http://{NAME}{path}")
    assert (answer.status_code, "location" in answer.headers) == (404, False)


@pytest.mark.parametrize(
    "to", ["//[", "///evil.example", "/../other/logout", "/a/..", "/.//evil.example", "/%2f%2fevil.example", "/%2e%2e/other"]
)
def test_one_goes_on_within_the_pages(to: str) -> None:
    assert _ours(to) == "/"


def test_one_goes_on_to_an_address_of_any_letters(own: Shop) -> None:
    name = {"name": PERSONS[READER], "password": PASSWORD}
    done = own.browser().post("/login", data={**name, "to": "/search?q=日本&hall=%C3%BC"})
    assert (done.status_code, done.headers["location"]) == (303, "/search?q=%E6%97%A5%E6%9C%AC&hall=%C3%BC")


def test_a_referer_that_is_no_address_is_none(own: Shop) -> None:
    for said in ("http://[", f"{HOST}/\\evil.example", f"{HOST}//evil.example/"):
        done = own.browser(READER).post("/theme", data={"theme": "dark"}, headers={"Referer": said})
        assert (done.status_code, done.headers["location"]) in ((303, "/"), (303, "/evil.example/"))


def test_a_history_that_is_locked_says_nothing_of_the_server_to_who_is_not_logged_in(
    own: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    def locked(*_: object) -> None:
        raise StoreError("/srv/secret/h.db: another program has held it for half a minute")

    monkeypatch.setattr("elastogeo.history.History.edition", locked)
    monkeypatch.setattr("elastogeo.web.people.login.log_in", locked)
    for answer in (own.program().get("/health"), own.browser().post("/login", data={"name": "A", "password": "b"})):
        assert answer.status_code == 503
        assert "The history cannot be read just now; try again." in answer.text
        assert "secret" not in answer.text
    known = own.program(own.tokens[READER]).get("/health")
    assert (known.status_code, "another program has held it" in known.text) == (503, True)


def test_more_than_the_database_takes_at_once_is_no_fault() -> None:
    with pytest.raises(StoreError, match=r"h\.db: too many ask it at once; wait, then try again"), in_words("h.db", False):
        raise NoConnection("QueuePool limit of size 4 overflow 10 reached")


@pytest.mark.parametrize(
    ("said", "address"),
    [
        ("192.0.2.1", "192.0.2.1"),
        ("2001:db8:0:1::5", "2001:db8:0:1::/64"),
        ("2001:db8:0:1:ffff::6", "2001:db8:0:1::/64"),
        ("::ffff:192.0.2.1", "192.0.2.1"),
        ("\x1b[31mfault 12345", "an unknown address"),
        ("", "an unknown address"),
    ],
)
def test_who_tries_passwords_is_told_by_the_address_that_is_not_free_to_choose(said: str, address: str) -> None:
    assert address_of(Request({"type": "http", "client": (said, 1), "headers": []})) == address


def test_the_proxy_of_the_documentation_says_itself_who_asks() -> None:
    text = (Path(__file__).parents[3] / "docs" / "deploy.md").read_text(encoding="utf-8")
    assert "proxy_set_header X-Forwarded-For $remote_addr;" in text


@pytest.mark.parametrize("dest", ["fencedframe", "IFRAME", "portal"])
def test_no_kind_of_frame_of_another_site_shows_a_page(shop: Shop, dest: str) -> None:
    said = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": dest}
    assert shop.browser(ADMINISTRATOR).get("/", headers=said).status_code == 403


@pytest.mark.parametrize("kind", ["back up", "verify"])
def test_a_job_of_administrators_is_ended_and_repeated_by_them_only(own: Shop, kind: str) -> None:
    job = own.history.put_job(kind, {})
    for what in ("cancel", "again"):
        answer = own.browser(ENGINEER).post(f"/jobs/{job}/{what}")
        assert (answer.status_code, "this needs the role administrator" in answer.text) == (403, True)
    assert own.history.job(job).state == "waiting"
    assert own.browser(ADMINISTRATOR).post(f"/jobs/{job}/cancel").status_code == 303
    assert own.history.job(job).state == "cancelled"


def sent_meanwhile(shop: Shop, meanwhile: Callable[[], object]) -> tuple[int, str]:
    """What is answered to an upload in the middle of which something happens."""
    came: list[Any] = []
    parts = iter([b"a" * 1000, b"b" * 1000])

    async def receive() -> dict[str, object]:
        part = next(parts, None)
        if part is not None and part.startswith(b"b"):
            meanwhile()
        return {"type": "http.request", "body": part or b"", "more_body": part is not None}

    async def send(message: dict[str, object]) -> None:
        came.append(message)

    headers = {"host": NAME, "authorization": f"Bearer {shop.tokens[ENGINEER]}", "transfer-encoding": "chunked"}
    scope = {
        "type": "http", "method": "POST", "path": "/upload", "query_string": b"name=a", "scheme": "http", "root_path": "",
        "headers": [(name.encode(), value.encode()) for name, value in headers.items()], "client": ("192.0.2.1", 1),
    }  # fmt: skip
    asyncio.run(shop.app(scope, receive, send))
    return came[0]["status"], b"".join(one.get("body", b"") for one in came).decode()


def parcels_of(shop: Shop) -> list[Path]:
    folder = shop.history.store.files.folder / "parcels"
    return list(folder.iterdir()) if folder.is_dir() else []


@pytest.mark.parametrize("how", ["switched off", "reader"])
def test_who_may_not_any_more_when_all_has_come_has_sent_nothing(make_shop: Callable[..., Shop], how: str) -> None:
    shop = make_shop()
    name = PERSONS[ENGINEER]
    assert sent_meanwhile(shop, lambda: None)[0] == 303
    before, jobs = parcels_of(shop), len(shop.history.jobs().jobs)
    end = (
        (lambda: shop.history.set_role(name, READER))
        if how == READER
        else (lambda: shop.history.switch_account(name, False))
    )
    status, text = sent_meanwhile(shop, end)
    assert (status, "your account may not do this any more" in text) == (403, True)
    assert (parcels_of(shop), len(shop.history.jobs().jobs)) == (before, jobs)


def test_parcels_that_come_at_once_have_a_number(own: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(staging, "MOST_COMING", 2)
    files = own.history.store.files
    coming = [arriving(files) for _ in range(2)]
    try:
        refused = own.browser(ENGINEER).post("/upload?name=a.csv", content=b"x")
        assert (refused.status_code, "2 uploads are coming in already" in refused.text) == (400, True)
        old = coming[0].folder
        for place in (old / "sent", old):  # its sender went away without a word
            os.utime(place, (0, 0))
        assert own.browser(ENGINEER).post("/upload?name=a.csv", content=b"x").status_code == 303
    finally:
        for one in coming:
            one.drop()


def test_parcels_that_wait_have_a_size_and_leave_room_on_the_disk(own: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    files = own.history.store.files
    assert own.browser(ENGINEER).post("/upload?name=a.csv", content=b"x" * 5000).status_code == 303
    monkeypatch.setattr(staging, "MOST_KEPT", 4000)
    with pytest.raises(InputError, match="that were sent wait to be imported; import them"):
        arriving(files)
    monkeypatch.setattr(staging, "MOST_KEPT", 10**9)
    monkeypatch.setattr(staging, "ROOM", 10**18)
    with pytest.raises(StoreError, match="are free on its disk; free some, then send it again"):
        arriving(files)
    assert parcels.LARGEST < 10**9


def test_a_form_of_very_many_parts_is_refused_at_once(own: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(receiving, "_MOST_PARTS", 50)
    before = parcels_of(own)
    part = b'--q\r\nContent-Disposition: form-data; name="f"\r\n\r\n\r\n'
    kind = {"Content-Type": "multipart/form-data; boundary=q"}
    answer = own.browser(ENGINEER).post("/upload", content=part * 100 + b"--q--\r\n", headers=kind)
    assert (answer.status_code, "too many parts" in answer.text) == (400, True)
    assert parcels_of(own) == before


def test_strangers_who_guess_do_not_shut_out_who_has_logged_in_from_here_before() -> None:
    throttle = Throttle(lambda: 0.0)
    throttle.check("Anna", "192.0.2.1")
    throttle.succeeded("Anna", "192.0.2.1")
    for k in range(FREE_BY_NAME):
        throttle.check(" anna", f"198.51.100.{k}")
    with pytest.raises(TooOften):
        throttle.check("Anna", "198.51.100.99")
    for _ in range(FREE_BY_NAME):  # and there the same limit holds
        throttle.check("Anna", "192.0.2.1")
    with pytest.raises(TooOften):
        throttle.check("Anna", "192.0.2.1")


def test_attempts_that_wait_for_each_other_leave_threads_for_pages() -> None:
    throttle = Throttle()
    with ExitStack() as held:
        for _ in range(_IN_ALL):
            held.enter_context(throttle.attempt())
        with pytest.raises(TooOften, match="wait 2 s, then try again"), throttle.attempt():
            pass
    with throttle.attempt():
        pass


def test_a_full_disk_lets_those_who_are_logged_in_look(own: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    """When somebody was seen last is kept now and then; where it cannot be, the page comes all the same."""

    def full(*_: object) -> None:
        raise StoreError("h.db: there is no room on the disk")

    monkeypatch.setattr(entering, "touch", full)
    monkeypatch.setattr(entering, "TOUCH", timedelta(seconds=-1))
    assert own.browser(READER).get("/").status_code == 200


def test_no_command_says_where_the_history_is_and_with_which_password(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whoever is logged in on the server sees the commands of all programs."""
    started: list[tuple[list[str], dict[str, str]]] = []

    class Process:
        def __init__(self, command: list[str], stdin: int, env: dict[str, str]) -> None:
            del stdin
            started.append((command, env))

        def wait(self, _: float = 0.0) -> None:
            threading.Event().wait()

    monkeypatch.setattr(subprocess, "Popen", Process)
    serving._Worker(Settings("postgresql://elastogeo:hush@server/shop", files="/srv/files"))
    command, given = started[0]
    assert "hush" not in " ".join(command)
    assert (given["ELASTOGEO_STORE"], given["ELASTOGEO_FILES"]) == ("postgresql://elastogeo:hush@server/shop", "/srv/files")


def test_what_is_no_request_is_refused_with_the_headers_of_every_answer(shop: Shop) -> None:
    with served(shop.app) as port, connected(port) as connection:
        connection.sendall(b"GET /\x00 HTTP/1.1\r\nHost: shop.example\r\n\r\n")
        came = connection.recv(65_536).decode()
    assert came.startswith("HTTP/1.1 400 ")
    for name in (
        "content-security-policy: default-src 'none'",
        "x-content-type-options: nosniff",
        "cache-control: no-store",
    ):
        assert name in came


def test_what_is_still_on_its_way_is_read_before_the_answer_ends(shop: Shop) -> None:
    """Closed with bytes that nobody read, the connection would be broken off, and the sender would not see why."""
    order: list[object] = []
    parts = iter([b"x" * 60_000] * 3)

    async def receive() -> dict[str, object]:
        part = next(parts, None)
        order.append("read")
        return {"type": "http.request", "body": part or b"", "more_body": part is not None}

    async def send(message: dict[str, Any]) -> None:
        order.append((message["status"], dict(message["headers"])[b"connection"]) if "status" in message else "part")

    headers = [(b"host", NAME.encode()), (b"authorization", b"Bearer egt_wrong"), (b"content-length", b"180000")]
    scope = {
        "type": "http", "method": "POST", "path": "/upload", "query_string": b"", "scheme": "http", "root_path": "",
        "headers": headers, "client": ("192.0.2.1", 1),
    }  # fmt: skip
    asyncio.run(shop.app(scope, receive, send))
    assert order == [(401, b"close"), "part", "read", "read", "read", "read", "part"]


def test_a_request_that_says_two_things_is_refused(shop: Shop) -> None:
    program = shop.program(shop.tokens[READER])
    for name in ("Origin", "Content-Type", "Sec-Fetch-Site"):
        answer = program.get("/fleet.json", headers=[(name, "same-origin"), (name, "same-origin")])  # type: ignore[arg-type]
        assert (answer.status_code, "contradicts itself" in answer.text) == (400, True), name
    answer = program.get("/fleet.json%00")
    assert (answer.status_code, "contradicts itself" in answer.text) == (400, True)


def test_no_socket_of_the_web_is_opened(shop: Shop) -> None:
    came: list[dict[str, Any]] = []

    async def receive() -> dict[str, object]:
        return {"type": "websocket.connect"}

    async def send(message: dict[str, Any]) -> None:
        came.append(message)

    headers = [(b"host", NAME.encode()), (b"authorization", f"Bearer {shop.tokens[ADMINISTRATOR]}".encode())]
    scope = {"type": "websocket", "path": "/", "query_string": b"", "headers": headers, "state": {}, "root_path": ""}
    asyncio.run(shop.app(scope, receive, send))
    assert came == [{"type": "websocket.close", "code": 1008}]


def test_nothing_in_what_is_downloaded_runs_should_a_browser_show_it(shop: Shop) -> None:
    answer = shop.browser(READER).get("/machines/1/report.html")
    assert (answer.status_code, answer.headers["content-disposition"].partition(";")[0]) == (200, "attachment")
    policy = answer.headers["content-security-policy"]
    assert policy.endswith("sandbox")
    assert "script-src" not in policy
