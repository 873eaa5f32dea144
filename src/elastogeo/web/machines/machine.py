"""A machine: whether it has changed, and what that points to."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/machines/{key:int}")
def machine(asked: Ask, key: int) -> Shown:
    """A machine by all its series, the worst first."""
    return Shown("machines/machine.html.j2", view_of(asked.history.machine(asked.machine(key).name)), context={"key": key})
