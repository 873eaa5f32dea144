"""What anybody writes is shown as what it is: no page runs it, no table is a formula, no path leaves its place."""

from __future__ import annotations

import csv
import re
from collections import Counter, deque
from collections.abc import Iterator
from html.parser import HTMLParser
from io import StringIO
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

import elastogeo as eg
from elastogeo.web import Settings, application
from elastogeo.web.asking import ADMINISTRATOR
from tests.web.conftest import copy_of
from tests.web.guard.addresses import addresses, filled
from tests.web.guard.conftest import NAME, PASSWORD, Shop
from tests.web.guard.hostile import ATTACK, hostile

EACH = 3
"""Pages of one address that are visited."""
HEAVY = ("/report.pdf", "/static/", "/logout")


@pytest.fixture(scope="module")
def attacked(
    made_fleet: Path,
    tmp_path_factory: pytest.TempPathFactory,
    quick_passwords: None,  # noqa: ARG001
) -> Iterator[tuple[Shop, int]]:
    """A hostile fleet with its pages, and the key of a test that is drawn."""
    folder = tmp_path_factory.mktemp("attacked")
    database = copy_of(made_fleet, folder / "fleet")
    test = hostile(database, folder)
    with eg.History(database, who="the tests") as history:
        name = "=1+1'\"><img src=x onerror=alert(1)>"
        history.add_account(name, ADMINISTRATOR, PASSWORD)
        token = history.make_token(name, ATTACK[-80:]).secret
        yield Shop(history, application(Settings(str(database), hosts=(NAME,)), history.store), {ADMINISTRATOR: token}), test


class Markup(HTMLParser):
    """What a browser would run of a page, and where it leads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.runs: list[str] = []
        self.leads: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        said = {name: value or "" for name, value in attrs}
        if tag == "script" and "src" not in said and said.get("type") != "application/json":
            self.runs.append("<script>")
        if tag in ("iframe", "object", "embed", "base"):
            self.runs.append(f"<{tag}>")
        for name, value in said.items():
            if name.startswith("on") or name in ("srcdoc", "hx-on"):
                self.runs.append(f"{tag} {name}")
            if name in ("src", "href", "action", "xlink:href", "formaction"):
                if value.strip().lower().startswith(("javascript:", "vbscript:", "data:text")):
                    self.runs.append(f"{tag} {value}")
                if value == "x" or urlsplit(value).netloc:
                    self.runs.append(f"{tag} {name}={value}")
                if tag == "a" and name == "href":
                    self.leads.append(value)


def visited(shop: Shop, test: int) -> Iterator[tuple[str, str, str]]:
    """Address, kind and text of the pages, by their routes and by the links in them, a few of each address."""
    program = shop.program(shop.tokens[ADMINISTRATOR])
    program.headers["Accept"] = "text/html"
    first = [filled(one.template, key=str(test)) for one in addresses() if one.method == "GET"]
    first += [filled(one.template) for one in addresses() if one.method == "GET"]
    first += ["/search?q=zq", "/search?q=" + ATTACK.replace("&", "%26"), "/compare?a=1&b=2", f"/explore?test={test}"]
    ahead, seen, often = deque(first), set[str](), Counter[str]()
    while ahead:
        address = ahead.popleft()
        kind = re.sub(r"\d+", "1", urlsplit(address).path)
        if address in seen or often[kind] >= EACH or any(one in address for one in HEAVY):
            continue
        seen.add(address)
        often[kind] += 1
        answer = program.get(address)
        assert answer.status_code < 500, address
        yield address, answer.headers.get("content-type", ""), answer.text
        if "html" in answer.headers.get("content-type", ""):
            ahead += [lead for lead in Markup(answer.text).leads if lead.startswith("/") and "#" not in lead]


def test_nothing_that_anybody_wrote_runs_or_is_a_formula(attacked: tuple[Shop, int]) -> None:
    shop, test = attacked
    shown: set[str] = set()
    for address, kind, text in visited(shop, test):
        if "html" in kind:
            assert Markup(text).runs == [], address
            assert "<img src=x" not in text, address
            assert "<script>alert" not in text, address
            assert "49zq" not in text, address
        elif "csv" in kind:
            for row in csv.reader(StringIO(text)):
                for cell in row:
                    assert not re.match(r"[=+@\t\r]|-(?!\d)", cell), (address, cell)
        if "onerror=alert" in text:
            shown.add(re.sub(r"\d+", "1", urlsplit(address).path))
    pages = {"/", "/fleet.csv", "/machines/1", "/tests/1", "/accounts", "/accounts.csv", "/tokens"}
    assert pages - shown == set()
    assert len(shown) > 8


def test_a_page_that_runs_what_was_written_would_be_found() -> None:
    for text in (
        "<script>alert(1)</script>", "<p onclick='x'>", "<a href=' JavaScript:alert(1)'>", "<img src=x>", "<iframe>",
        "<a href='//evil.example'>", "<svg onload=x>", "<form action='https://evil.example'>",
    ):  # fmt: skip
        assert Markup(text).runs, text
    assert Markup("<a href='/machines/1'>&lt;img src=x onerror=alert(1)&gt;</a>").runs == []


OUTSIDE = [
    "../../../../etc/passwd",
    "..%2f..%2f..%2f..%2fetc%2fpasswd",
    "%2e%2e/%2e%2e/%2e%2e/etc/passwd",
    "..%5c..%5cwin.ini",
    "....//....//etc/passwd",
    "%00",
    "1%00.json",
    "..%c0%af..%c0%afetc/passwd",
    "%252e%252e%252fetc%252fpasswd",
    "/etc/passwd",
    "C:%5cwindows%5cwin.ini",
    "file:%2f%2f%2fetc%2fpasswd",
    "1;ls",
    "1'--",
    "-1",
    "0",
    "9223372036854775808",
    "1e9",
    "%F0%9F%98%80",
    "1%20OR%201=1",
    "__class__",
    "%7b%7b7*7%7d%7d",
    "~",
    "fleet.db",
    "../fleet.db",
    "..%2ffleet.db",
    "a" * 3000,
]
"""Ways out of a folder, of a number, of a query."""


@pytest.mark.usefixtures("nothing_written")
@pytest.mark.parametrize("place", OUTSIDE)
def test_no_address_leads_outside(shop: Shop, place: str) -> None:
    program = shop.program(shop.tokens[ADMINISTRATOR])
    templates = [one for one in addresses() if "{" in one.template]
    assert len(templates) > 10
    for one in templates:
        for parameter in re.findall(r"\{(\w+)", one.template):
            address = filled(one.template, **{parameter: place})
            answer = program.request(one.method, f"http://{NAME}{address}")
            assert answer.status_code in (303, 307, 400, 403, 404, 405, 414, 422), address
            _check_inside(answer.text, address)
    for address in (f"/static/{place}", f"/static/../{place}", f"/{place}"):
        answer = program.get(f"http://{NAME}{address}")
        assert answer.status_code < 500
        _check_inside(answer.text, address)


def _check_inside(text: str, address: str) -> None:
    assert "root:" not in text, address
    assert "[fonts]" not in text, address
    assert "SQLite format" not in text, address
    assert "Traceback" not in text, address
    assert unquote(address.rpartition("/")[2])[:20] not in text or len(address) < 30 or "{{" not in text, address


def test_no_query_leads_outside_or_breaks(attacked: tuple[Shop, int]) -> None:
    """Every parameter of every page takes every way out, and is at most refused."""
    shop, test = attacked
    program = shop.program(shop.tokens[ADMINISTRATOR])
    paths = program.get("/openapi.json").json()["paths"]
    asked = 0
    for path, methods in paths.items():
        names = [one["name"] for one in methods.get("get", {}).get("parameters", ()) if one["in"] == "query"]
        if not names or path.endswith((".csv", ".pdf")):
            continue
        for place in ("../../../../etc/passwd", "-1", "1'--", ATTACK, "\x00", "9" * 30, "nan", "https://evil.example", ""):
            answer = program.get(filled(path, key=str(test)), params=dict.fromkeys(names, place))
            assert answer.status_code < 500, (path, place)
            assert "root:" not in answer.text
            asked += 1
    assert asked > 10
