"""The fleet: all machines, the worst first."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query

from elastogeo.changes import FleetPart
from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.pages import Pages

pages = Pages()

ON_A_PAGE = 100
SELDOM, OFTEN = 60, 5
"""Seconds after which the page looks again: always, and while the demo fleet is made."""
Facet = Annotated[str, Query(max_length=200)]


@pages.shows("/")
def fleet(
    asked: Ask,
    hall: Facet = "",
    model: Facet = "",
    state: Facet = "",
    page: Annotated[int, Query(ge=1, le=100_000)] = 1,
) -> Shown:
    """All machines, the worst first, or those of a hall, a model, a state; how many are in which state."""
    part = FleetPart(asked.history.fleet(), hall, model, state, ON_A_PAGE * (page - 1))
    grows = any(not job.is_over for job in asked.history.jobs(last=1, kind="demo").jobs)
    context = {
        "seconds": OFTEN if grows else SELDOM,
        "filters": {"hall": hall, "model": model, "state": state},
        "page": page,
        "pages": max(-(-len(part.machines) // ON_A_PAGE), 1),
    }
    return Shown("machines/fleet.html.j2", view_of(part), part="machines/fleet_rows.html.j2", context=context)
