"""A view that is kept and read again is the same to a reader, and its pictures need no drawing."""

from __future__ import annotations

import json

import pytest

from elastogeo.report import html_page, kept_view, view_kept, view_of


@pytest.fixture(scope="module")
def kept(poor):
    view = view_of(poor)
    return view, kept_view(view)


def test_what_is_kept_is_plain_and_says_all(kept) -> None:
    view, plain = kept
    again = view_kept(json.loads(json.dumps(plain, allow_nan=False)), view.document)
    for name in ("kind", "title", "subtitle", "origin", "head", "sentence", "values", "checks", "alert", "tables", "notes"):
        assert getattr(again.view, name) == getattr(view, name), name
    assert (again.view.attention, again.view.supported) == (view.attention, view.supported)
    assert [(s.title, s.paragraphs, s.tables, s.points, s.note) for s in again.view.sections] == [
        (s.title, s.paragraphs, s.tables, s.points, s.note) for s in view.sections
    ]
    assert list(again.view.pictures) == list(view.pictures)
    assert again.view.picture is not None
    assert again.view.picture.name == view.picture.name


def test_a_report_of_what_is_kept_is_that_of_the_view(kept) -> None:
    view, plain = kept
    again = view_kept(json.loads(json.dumps(plain)), view.document)
    assert html_page(again.view, again.figures) == html_page(view, again.figures)
    name = next(iter(again.figures))
    assert again.element(name).startswith("<svg")
    assert "var(--ink" in again.element(name)


def test_a_kept_picture_is_not_drawn_again(kept) -> None:
    picture = view_kept(kept[1]).view.picture
    assert picture is not None
    with pytest.raises(LookupError, match="cannot be drawn again"):
        picture.draw()
