"""The page: self-contained, escaped, and saying what it must."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from elastogeo.report import html_report, parameter_rows, save_html
from elastogeo.report.html import micro, pretty

ATTACK = "<script>alert('x')</script><img src=https://evil.example/x onerror=alert(1)>"


class Page(HTMLParser):
    """The tags, attributes and text of a page."""

    VOID = frozenset({"meta", "br"})

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str]] = []
        self.open: list[str] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag, attrs) -> None:
        self.tags.append(tag)
        self.attributes += [(name, value or "") for name, value in attrs]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag) -> None:
        assert self.open.pop() == tag

    def handle_startendtag(self, tag, attrs) -> None:
        self.tags.append(tag)
        self.attributes += [(name, value or "") for name, value in attrs]

    def handle_data(self, data) -> None:
        self.words += data


@pytest.fixture(scope="module")
def rich_page(rich) -> str:
    return html_report(rich)


def words_of(page: str) -> str:
    return re.sub(r"\s+", " ", Page(page).words)


@pytest.mark.parametrize("name", ["rich", "poor", "geometric"])
def test_it_asks_for_nothing_and_runs_nothing(name, request) -> None:
    text = html_report(request.getfixturevalue(name))
    page = Page(text)
    assert page.open == []
    assert {"script", "link", "iframe", "img", "object", "form"}.isdisjoint(page.tags)
    assert "://" not in text
    assert "@import" not in text
    assert [value for key, value in page.attributes if key in {"href", "xlink:href"} and not value.startswith("#")] == []
    assert [key for key, _ in page.attributes if key == "src" or key.startswith("on")] == []
    assert ("content", "default-src 'none'; style-src 'unsafe-inline'; img-src data:") in page.attributes
    identifiers = [value for key, value in page.attributes if key == "id"]
    assert len(identifiers) == len(set(identifiers))
    assert 30_000 < len(text.encode()) < 3_000_000


def test_names_from_files_are_text(rich) -> None:
    machine = replace(rich.test.machine, name=f"{ATTACK}machine", assumed=(f"{ATTACK}offsets",))
    test = replace(rich.test, name=f"{ATTACK}test", machine=machine, simulated=f"{ATTACK}truth")
    checks = tuple(replace(check, sentence=f"{ATTACK}{check.sentence}") for check in rich.verdict)
    text = html_report(replace(rich, test=test, verdict=checks))
    page = Page(text)
    assert "<script" not in text
    assert {"script", "img"}.isdisjoint(page.tags)
    for what in ("machine", "offsets", "test", "truth"):
        assert f"{ATTACK}{what}" in page.words


def test_simulated_data_say_so_and_measured_do_not(rich_page, poor) -> None:
    assert "Simulated data: the global parameters of Table 5.5" in words_of(rich_page)
    assert "Simulated data" not in words_of(html_report(poor))


def test_the_verdict_comes_first_and_in_words(rich, rich_page) -> None:
    words = words_of(rich_page)
    for check in rich.verdict:
        at = words.index(f"{check.name}{micro(check.sentence)}")
        assert words[:at].rstrip().endswith("Passed" if check.passed else "Attention")
        assert at < words.index("Value ± U")
    assert "One point needs attention; 4 of 5 checks passed." in words


def test_every_parameter_is_in_the_table_with_its_uncertainty(rich, rich_page) -> None:
    words = words_of(rich_page)
    for row in parameter_rows(rich):
        assert pretty(row.value) in words
        assert row.meaning in words
        assert row.stands_for in words
    assert parameter_rows(rich)[0].unit == "nm/N"
    assert parameter_rows(rich)[1].stands_for == "C_XYX + C_YXX + C_XYY + C_YXY"


def test_what_must_be_said_openly(rich_page, poor, geometric) -> None:
    words = words_of(rich_page)
    for said in (
        "Repeatability is not uncertainty",
        "9 combinations of one run per level share runs and are not independent",
        "not contained here",
        "Compliances here are equivalent ones",
        "C_XCX, C_YCX, C_CXX, C_CYX and C_CCX change no reading",
        "C_CCY is negative, and its interval excludes zero",
        "only as traceable as",
        "Eqs. 4.26, 4.27",
    ):
        assert said in words
    assert "E_XX1 and E_YY1 carry the error of the bar's length" in words_of(html_report(geometric))
    assert "E_XX1" not in words
    least = words_of(html_report(poor))
    assert "combinations of one run" not in least
    assert "Eqs. 4.26" not in least
    assert "Local against global" not in least


def test_residuals_with_structure_are_said_beside_the_uncertainties(rich, rich_page) -> None:
    checks = tuple(replace(check, passed=check.name != "residuals without structure") for check in rich.verdict)
    assert "The true uncertainty is larger than U" in words_of(html_report(replace(rich, verdict=checks)))
    assert "The true uncertainty is larger" not in words_of(rich_page)


def test_the_same_result_gives_the_same_page(rich, rich_page, tmp_path) -> None:
    path = save_html(rich, tmp_path / "new" / "report.html")
    assert path.read_text(encoding="utf-8") == rich_page


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("(6.1898 ± 0.0031)e-05", "(6.1898 ± 0.0031) × 10⁻⁵"),
        ("1 nm/N = 1e-06 mm/N", "1 nm/N = 10⁻⁶ mm/N"),
        ("3.01e+06 raw", "3.01 × 10⁶ raw"),
        ("-1.10 ± 0.02", "−1.10 ± 0.02"),
        ("C_XXX - 0.5 C_YYX", "C_XXX − 0.5 C_YYX"),
    ],
)
def test_pretty(text: str, printed: str) -> None:
    assert pretty(text) == printed
