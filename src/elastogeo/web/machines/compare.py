"""Two tests against each other: what changed, and whether it is more than tests of this machine scatter."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.fields import Key, Word
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/compare")
def compare(asked: Ask, a: Key = 0, b: Key = 0, level: Word = "") -> Shown:
    """Two tests, `a` and `b`; without the second one, the tests with which the first may be compared."""
    one = a or b
    choices = asked.history.comparable(one) if one else None
    found = asked.history.compare(a, b) if a and b and a != b else None
    view = view_of(found if found is not None else choices) if one else None
    pictures = view.pictures if view and found is not None else {}
    context = {
        "found": found,
        "choices": None if choices is None else view_of(choices).table("tests"),
        "a": a,
        "b": b,
        "picture": pictures.get(level) or (view.picture if view and found is not None else None),
        "pictures": pictures,
    }
    return Shown("machines/compare.html.j2", view, context=context)
