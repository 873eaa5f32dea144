"""The page: self-contained, escaped, and saying what it must."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from elastogeo.identification import Check
from elastogeo.report import html_report, parameter_rows, save_html, sentence_of
from elastogeo.report.numbers import micro, pretty

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
        self.texts: list[str] = []
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
        self.texts.append(data.strip())


@pytest.fixture(scope="module")
def separated_page(separated) -> str:
    return html_report(separated)


@pytest.fixture(scope="module")
def rich_page(rich) -> str:
    return html_report(rich)


def words_of(page: str) -> str:
    return re.sub(r"\s+", " ", Page(page).words)


@pytest.mark.parametrize("name", ["rich", "poor", "geometric", "separated", "mixed"])
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
    checks = tuple(replace(check, facts={"said": f"{ATTACK}{sentence_of(check)}"}) for check in rich.verdict)
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
        at = words.index(f"{check.name}{pretty(micro(sentence_of(check)))}")
        assert words[:at].rstrip().endswith("Passed" if check.passed else "Attention")
        assert at < words.index("Value ± U")
    passed = sum(check.passed for check in rich.verdict)
    assert f"points need attention; {passed} of {len(rich.verdict)} checks passed." in words


def test_every_parameter_is_in_the_table_with_its_uncertainty(rich, rich_page) -> None:
    words = words_of(rich_page)
    for row in parameter_rows(rich):
        assert pretty(row.value) in words
        assert row.meaning in words
        assert row.stands_for in words
    assert parameter_rows(rich)[0].unit == "nm/N"
    assert parameter_rows(rich)[1].stands_for == "C_XYX + C_YXX + C_XYY + C_YXY"


def test_what_must_be_said_openly(rich, rich_page, poor, geometric) -> None:
    words = words_of(rich_page)
    for said in (
        "Repeatability is not uncertainty",
        "9 combinations of one run per level share runs and are not independent",
        "It is added as if the reference scattered like the repeated runs",
        "Compliances here are equivalent ones",
        "C_XCX, C_YCX, C_CXX, C_CYX and C_CCX change no reading",
        pretty(rich.consistency.sentence),
        "a reference level is taken off",
        "only as traceable as",
        "Eqs. 4.26, 4.27",
    ):
        assert said in words
    assert "E_XX1 and E_YY1 carry the error of the bar's length" in words_of(html_report(geometric))
    assert "E_XX1" not in words
    least = words_of(html_report(poor))
    assert "combinations of one run" not in least
    assert "Eqs. 4.26" not in least
    assert "Does anything change with the force" not in least


def test_residuals_with_structure_are_said_beside_the_uncertainties(rich, rich_page) -> None:
    left = {"rmse": 1e-4, "shared": None, "runs": 2, "structured": 1, "run": "r", "order": 5, "amplitude": 1e-4}
    structured = Check("residuals without structure", False, left)
    checks = tuple(structured if check.name == structured.name else check for check in rich.verdict)
    assert "The true uncertainty is larger than U" in words_of(html_report(replace(rich, verdict=checks)))
    assert "The true uncertainty is larger" not in words_of(rich_page)


def test_compliance_and_geometry_are_shown_apart_with_what_the_data_support(separated, separated_page) -> None:
    words = words_of(separated_page)
    for said in (
        "Compliance and geometry apart",
        "The uncertainties come from the scatter of 12 runs, each of which counts once",
        "The budget also holds what the test's file states as known: bar, form of the balls and gauge.",
        f"The data support a {separated.models.supported} compliance",
        "count on independent readings",
        "All differences together: p = ",
        pretty(separated.consistency.sentence),
        "Circular deviations after ISO 230-4",
        "positioning error of X, degree 1",
    ):
        assert said in words, said
    assert "states no systematic influence" not in words


def test_the_budget_is_sorted_and_says_its_types(separated, separated_page) -> None:
    words = words_of(separated_page)
    for parameter, lines in zip(separated.parameters, separated.budget.lines, strict=True):
        table = words[words.index(f"{parameter.name}: u = ") :]
        last = 0
        for line in lines:
            if line.contribution**2 >= 0.01 * parameter.standard_uncertainty**2:
                at = table.index(f"{line.label}{'B' if line.type_b else 'A'}, {line.distribution}")
                assert at > last
                last = at


def test_where_nothing_is_told_apart_no_cause_is_named(mixed) -> None:
    page = html_report(mixed)
    words = words_of(page)
    sums = [row.name for row in parameter_rows(mixed)]
    assert sums[0].startswith("C_XXX + 0.20")
    assert words.index("Compliance and geometry are not told apart") < words.index("Verdict")
    assert all(name in words for name in sums)
    assert "positioning error" not in words
    assert "at joint X" not in words
    assert "Compliance and geometry apart" not in words
    assert "E_XX1 carries" not in words
    assert [name for name in Page(page).texts if name in {"C_XXX", "C_YYY", "C_CXY", "E_XX1", "E_YX2"}] == []


def test_without_what_was_not_computed_the_page_still_stands(separated) -> None:
    words = words_of(
        html_report(replace(separated, models=None, consistency=None, local_change=None, repeats=None, local=()))
    )
    for absent in ("Is the compliance constant?", "Does it agree with physics?", "Does anything change", "Repeats"):
        assert absent not in words


def test_without_runs_enough_it_says_why(separated) -> None:
    budget = replace(separated.budget, lines=tuple(line[:0] for line in separated.budget.lines))
    words = words_of(html_report(replace(separated, by_run=False, verdict=(), budget=budget)))
    assert "The uncertainties count on independent readings" in words
    assert "states no systematic influence" in words


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
