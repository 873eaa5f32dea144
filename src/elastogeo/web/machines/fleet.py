"""The fleet: all machines, the worst first."""

from __future__ import annotations

from elastogeo.changes import FleetPart
from elastogeo.report import view_of
from elastogeo.report.changes import MOST_ROWS
from elastogeo.web.answering import Shown, last_page
from elastogeo.web.asking import Ask
from elastogeo.web.fields import Number, Word
from elastogeo.web.pages import Pages

pages = Pages()

SELDOM, OFTEN = 60, 5
"""Seconds after which the page looks again: always, and while the demo fleet is made."""


@pages.shows("/")
def fleet(
    asked: Ask,
    hall: Word = "",
    model: Word = "",
    state: Word = "",
    page: Number = 1,
) -> Shown:
    """All machines, the worst first, or those of a hall, a model, a state; how many are in which state."""
    part = FleetPart(asked.history.fleet(), hall, model, state, MOST_ROWS * (page - 1))
    grows = any(not job.is_over for job in asked.history.jobs(last=1, kind="demo").jobs)
    context = {
        "seconds": OFTEN if grows else SELDOM,
        "filters": {"hall": hall, "model": model, "state": state},
        "page": page,
        "pages": last_page(len(part.machines), MOST_ROWS),
    }
    return Shown("machines/fleet.html.j2", view_of(part), part="machines/fleet_rows.html.j2", context=context)
