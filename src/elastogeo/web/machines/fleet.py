"""The fleet: all machines, the worst first."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/")
def fleet(asked: Ask) -> Shown:
    """All machines, the worst first, and how many are in which state."""
    return Shown("machines/fleet.html.j2", view_of(asked.history.fleet()))
