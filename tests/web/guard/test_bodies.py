"""Bodies that are too large, say another size than they have, come in pieces, or never end: refused, and told why.

On a server of its own, byte by byte; the limits are small, so that a slow body is one of half a second.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from fastapi import FastAPI, Request, Response

from elastogeo.web import Settings
from elastogeo.web.app import with_errors
from elastogeo.web.asking import ENGINEER, READER
from elastogeo.web.guard import Limits, connections, guarded, lingering
from tests.web.guard.conftest import NAME, Shop
from tests.web.guard.served import answer_on, connected, head_of, served

FORM, UPLOAD = 1024, 300_000
LIMITS = Limits(body=FORM, upload=UPLOAD, patience=0.4, rate=50_000)


@dataclass
class Counting:
    """Where a small application that keeps what it is sent is served.

    Attributes
    ----------
    port : int
    got : list of int
        Bytes of the requests that were whole.
    parts : list of int
        Bytes that were read, of all.
    """

    port: int
    got: list[int] = field(default_factory=list)
    parts: list[int] = field(default_factory=list)


@pytest.fixture
def counting(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> Iterator[Counting]:
    monkeypatch.setattr(connections, "_PATIENCE", 0.4)
    monkeypatch.setattr(lingering, "SECONDS", 0.4)
    found = Counting(0)
    app = FastAPI()

    async def keep(request: Request) -> Response:
        size = 0
        async for part in request.stream():
            size += len(part)
            found.parts.append(len(part))
        found.got.append(size)
        return Response(f"kept {size}")

    app.add_api_route("/upload", keep, methods=["POST"])
    app.add_api_route("/form", keep, methods=["POST"])
    app.add_api_route("/page", lambda: Response("page"), methods=["GET"])
    app.state.settings, app.state.store = Settings(shop.history.store.url), shop.history.store
    with_errors(app)
    with served(guarded(app, Settings(shop.history.store.url, hosts=(NAME,)), shop.history.store, LIMITS)) as found.port:
        yield found


def said(shop: Shop, role: str = ENGINEER, **more: str) -> dict[str, str]:
    return {"Host": NAME, "Authorization": f"Bearer {shop.tokens[role]}", **more}


def sent(counting: Counting, head: bytes, *parts: bytes, pause: float = 0.0) -> tuple[int, str]:
    """What is answered to these bytes; whoever sends stops where the other side closes."""
    with connected(counting.port) as connection:
        try:
            for part in (head, *parts):
                connection.sendall(part)
                time.sleep(pause)
        except OSError:
            pass
        return answer_on(connection)


def chunk(body: bytes) -> bytes:
    return b"%x\r\n%s\r\n" % (len(body), body)


@pytest.mark.parametrize(("path", "most"), [("/form", FORM), ("/upload", UPLOAD), ("/upload/x", UPLOAD), ("/uploads", FORM)])
def test_the_limit_is_that_of_the_address_to_the_byte(counting: Counting, shop: Shop, path: str, most: int) -> None:
    length = {"Connection": "close"}
    at = sent(counting, head_of("POST", path, **said(shop, Content_Length=str(most), **length)), b"x" * most)
    assert at[0] == (200 if path in ("/form", "/upload") else 404)
    over = sent(counting, head_of("POST", path, **said(shop, Content_Length=str(most + 1), **length)), b"x" * (most + 1))
    assert over[0] == 413
    assert "What was sent is larger than" in over[1]
    assert counting.got == ([most] if at[0] == 200 else [])


def test_a_reader_sends_no_more_than_a_form(counting: Counting, shop: Shop) -> None:
    head = head_of("POST", "/upload", **said(shop, READER, Content_Length=str(FORM + 1)))
    assert sent(counting, head, b"x" * (FORM + 1))[0] == 413
    assert counting.parts == []


@pytest.mark.parametrize("path", ["/form", "/upload"])
def test_what_comes_in_pieces_is_counted_as_it_is_read(counting: Counting, shop: Shop, path: str) -> None:
    most = UPLOAD if path == "/upload" else FORM
    head = head_of("POST", path, **said(shop, Transfer_Encoding="chunked", Connection="close"))
    status, text = sent(counting, head, *[chunk(b"x" * 512)] * (most // 512 + 40), b"0\r\n\r\n")
    assert (status, "was thrown away" in text) == (413, True)
    assert counting.got == []
    assert sum(counting.parts) <= most
    within = sent(counting, head, chunk(b"x" * 512), b"0\r\n\r\n")
    assert within == (200, "kept 512")


def test_a_body_that_never_ends_does_not_stay(counting: Counting, shop: Shop) -> None:
    """A gigabyte that is promised in pieces: a limit and a moment later nobody listens."""
    begun = time.monotonic()
    head = head_of("POST", "/upload", **said(shop, Transfer_Encoding="chunked"))
    with connected(counting.port) as connection:
        connection.sendall(head)
        went = 0
        try:
            for _ in range(16_384):
                connection.sendall(chunk(b"x" * 65_536))
                went += 65_536
        except OSError:
            pass
    assert went < 100_000_000
    assert time.monotonic() - begun < 20
    assert counting.got == []


@pytest.mark.parametrize(
    ("declared", "status"), [("-1", 400), ("1e3", 400), ("0x10", 400), ("", 400), ("99999999999999999999", 413)]
)
def test_a_length_that_is_none_is_refused(counting: Counting, shop: Shop, declared: str, status: int) -> None:
    """By the frame, which may break off, or by the guard."""
    assert sent(counting, head_of("POST", "/upload", **said(shop, Content_Length=declared)), b"x")[0] in (status, 0)
    assert counting.parts == []


def test_a_body_that_is_shorter_than_it_says_is_not_kept(counting: Counting, shop: Shop) -> None:
    head = head_of("POST", "/upload", **said(shop, Content_Length="1000"))
    status, text = sent(counting, head, b"x" * 999)
    assert (status, "came too slowly" in text) == (408, True)
    assert counting.got == []


def test_a_body_that_drips_ends(counting: Counting, shop: Shop) -> None:
    """A byte every tenth of a second is within each wait, but not within the whole."""
    begun = time.monotonic()
    head = head_of("POST", "/upload", **said(shop, Content_Length="1000"))
    status, _ = sent(counting, head, *[b"x"] * 60, pause=0.1)
    assert (status, counting.got) == (408, [])
    assert sum(counting.parts) < 60
    assert time.monotonic() - begun < 12


def test_a_body_that_stops_after_a_fast_beginning_ends(counting: Counting, shop: Shop) -> None:
    begun = time.monotonic()
    head = head_of("POST", "/upload", **said(shop, Content_Length="250000"))
    assert sent(counting, head, b"x" * 200_000)[0] == 408
    assert time.monotonic() - begun < 8


def test_a_slow_body_that_is_fast_enough_is_kept(counting: Counting, shop: Shop) -> None:
    """It takes three times the patience, as 300 kB at 100 kB/s do."""
    head = head_of("POST", "/upload", **said(shop, Content_Length=str(UPLOAD), Connection="close"))
    assert sent(counting, head, *[b"x" * 20_000] * 15, pause=0.1) == (200, f"kept {UPLOAD}")


@pytest.mark.parametrize("first", [b"", b"GET /page HT", b"GET /page HTTP/1.1\r\nHost: shop.example\r\nX-"])
def test_a_connection_that_says_nothing_more_is_closed(counting: Counting, first: bytes) -> None:
    begun = time.monotonic()
    assert sent(counting, first)[0] == 0
    assert time.monotonic() - begun < 10


def test_headers_that_drip_end_also_after_a_request(counting: Counting, shop: Shop) -> None:
    begun = time.monotonic()
    whole = head_of("GET", "/page", **said(shop))
    status, text = sent(counting, whole, *[bytes([byte]) for byte in whole[:-4]], pause=0.05)
    assert (status, text.startswith("page"), text.count("page")) == (200, True, 1)
    assert time.monotonic() - begun < 15


def test_several_requests_of_one_connection_are_answered(counting: Counting, shop: Shop) -> None:
    """Also when they come at once, or after a pause that is within the patience."""
    whole = head_of("GET", "/page", **said(shop))
    last = head_of("GET", "/page", **said(shop, Connection="close"))
    status, text = sent(counting, whole + whole, whole, last, pause=0.2)
    assert (status, text.count("page")) == (200, 4)


def test_addresses_and_headers_have_a_length(counting: Counting, shop: Shop) -> None:
    last = said(shop, Connection="close")
    assert sent(counting, head_of("GET", "/page?" + "x" * 9_000, **last))[0] == 414
    assert sent(counting, head_of("GET", "/page", **last, Cookie="x" * 17_000))[0] == 431
    assert sent(counting, head_of("GET", "/page", **last, Cookie="x" * 900_000))[0] in (400, 0)  # by the frame
    assert sent(counting, head_of("GET", "/page", **last).replace(b"Host", b"Host: evil.example\r\nHost"))[0] == 400


def test_who_has_no_account_is_told_so_before_anything_is_read(counting: Counting) -> None:
    for more in ({"Content_Length": "250000"}, {"Transfer_Encoding": "chunked"}):
        status, text = sent(counting, head_of("POST", "/upload", Host=NAME, **more), chunk(b"x" * 100_000), b"0\r\n\r\n")
        assert (status, "Log in first" in text) == (401, True)
    waits = head_of("POST", "/upload", Host=NAME, Content_Length="250000", Expect="100-continue")
    assert sent(counting, waits)[0] == 401  # and is not told to go on
    assert counting.parts == []
