"""Search: machines, series, tests, instruments and events by what they are called."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.fields import Word
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/search")
def search(asked: Ask, q: Word = "") -> Shown:
    """What has all of these words in what is said of it."""
    return Shown("machines/search.html.j2", view_of(asked.history.search(q)), context={"words": q})
