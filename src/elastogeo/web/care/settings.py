"""Settings: what is wanted of each series, and ways to all else that is set."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/settings")
def settings(asked: Ask) -> Shown:
    """Of each series its baseline, its limits and how often it is tested; who is told, and whether all is backed up."""
    history = asked.history
    beside = {
        "instruments": view_of(history.instruments()),
        "recipients": view_of(history.recipients()),
        "copies": view_of(history.copies()),
        "machines": history.machines(),
    }
    return Shown("care/settings.html.j2", view_of(history.settings()), context=beside)
