"""Pages of any view: nothing is asked of another host, names are text, the answer is on the first screen."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from elastogeo.identification import diagnose, what_if
from elastogeo.report import View, html_page, pdf_page, view_of
from elastogeo.report.numbers import pretty

ATTACK = "<script>alert('x')</script><img src=x onerror=alert(1)> #read(\"/etc/passwd\") *[" + "&amp; "
RESULTS = ["rich", "poor", "geometric", "separated", "mixed"]


class Page(HTMLParser):
    """A page's tags, attributes and words; unbalanced tags are an error."""

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


def words_of(page: str) -> str:
    return re.sub(r"\s+", " ", Page(page).words)


@pytest.fixture(scope="module")
def views(request) -> dict[str, View]:
    found = {name: view_of(request.getfixturevalue(name)) for name in RESULTS}
    separated = request.getfixturevalue("separated")
    return {**found, "diagnosis": view_of(diagnose(separated)), "what if": view_of(what_if(separated, ["E_XX1"]))}


@pytest.fixture(scope="module")
def pages(views) -> dict[str, str]:
    return {name: html_page(view) for name, view in views.items()}


def test_a_page_asks_for_nothing_and_runs_nothing(pages) -> None:
    for text in pages.values():
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
        assert len(text.encode()) < 3_000_000


def hostile(view: View) -> View:
    """The view with hostile text wherever text may come from a file."""
    return replace(
        view,
        title=f"{ATTACK}machine",
        subtitle=f"{ATTACK}test",
        origin=f"{ATTACK}truth",
        head=((f"{ATTACK}label", f"{ATTACK}fact"),),
        sentence=f"{ATTACK}answer",
        checks=tuple(replace(check, sentence=f"{ATTACK}{check.sentence}") for check in view.checks),
        alert=(f"{ATTACK}alert",),
    )


def test_names_from_files_are_text(views) -> None:
    text = html_page(hostile(views["poor"]))
    page = Page(text)
    assert "<script" not in text
    assert {"script", "img"}.isdisjoint(page.tags)
    for what in ("machine", "test", "truth", "label", "fact", "answer", "alert"):
        assert f"{ATTACK}{what}" in page.words
    assert pdf_page(hostile(views["poor"])).startswith(b"%PDF")


def test_the_answer_is_before_everything_else(views, pages) -> None:
    for name, view in views.items():
        words = words_of(pages[name])
        first = words.index(view.sentence)
        sections = words.index(view.sections[0].title, first + len(view.sentence))
        for value in view.values:
            assert first < words.index(value.value, first) < sections
        for check in view.checks:
            assert first < words.index(check.sentence, first) < sections
        assert all(
            words.index(check.sentence) < words.index(good.sentence) for check in view.attention for good in view.passed
        )


def test_simulated_data_say_so_and_measured_do_not(views, pages) -> None:
    assert views["rich"].origin == "Simulated: the global parameters of Table 5.5"
    assert "Simulated: the global parameters of Table 5.5" in words_of(pages["rich"])
    assert "imulated" not in words_of(pages["poor"])


def test_every_number_of_a_table_is_on_the_page(views, pages) -> None:
    for name, view in views.items():
        words = words_of(pages[name])
        for table in view.tables:
            assert {len(row) for row in table.rows} <= {len(table.headings)}
            assert all(cell in words for row in table.rows for cell in row)


def test_where_nothing_is_separated_no_cause_is_named(views) -> None:
    view = views["mixed"]
    assert not view.supported
    assert view.alert[0].startswith("Compliance and geometry are not")
    assert "only the sum is known" in " ".join(view.notes)
    assert "separation" not in view.pictures


def test_a_set_up_offset_has_no_share_and_no_place_among_the_key_values(geometric) -> None:
    view = view_of(geometric)
    share = view.tables[0].headings.index("share [%]")
    rows = {row[0]: row for row in view.tables[0].rows}
    assert rows["E_Xt0"][share] == ""
    assert rows["C_XXX"][share] != ""
    assert not any(value.name.startswith("E_Xt") for value in view.values)


def test_key_values_are_few_and_printed_as_in_the_table(views) -> None:
    for name in ("rich", "separated"):
        view = views[name]
        assert 2 <= len(view.values) <= 5
        printed = {(row[0], row[1]) for row in view.tables[0].rows}
        assert {(value.name, value.value) for value in view.values} <= printed


def test_the_same_view_gives_the_same_pages(views, pages) -> None:
    assert html_page(views["poor"]) == pages["poor"]
    once = pdf_page(views["poor"])
    assert once == pdf_page(views["poor"])
    assert once.startswith(b"%PDF-")
    assert b"/CreationDate" not in once


@pytest.mark.parametrize(
    ("text", "printed"), [("-1.2", "−1.2"), ("1.1e-09", "1.1 × 10⁻⁹"), ("1e-06", "10⁻⁶"), ("E_C(0Y)X - 2", "E_C(0Y)X − 2")]
)
def test_pretty(text: str, printed: str) -> None:
    assert pretty(text) == printed
