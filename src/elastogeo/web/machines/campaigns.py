"""Campaigns: tests that were asked together, and what they say together."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query

from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask, NotFound
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/campaigns")
def campaigns(asked: Ask, machine: Annotated[int, Query(ge=0, le=2**53)] = 0) -> Shown:
    """The campaigns of all machines, or of one."""
    of = asked.machine(machine).name if machine else None
    machines = asked.history.machines()
    context = {"machine": machine, "machines": machines, "address": lambda key: asked.url(f"/campaigns/{key}")}
    return Shown("machines/campaigns.html.j2", view_of(asked.history.campaigns(of)), context=context)


@pages.shows("/campaigns/{key:int}")
def campaign(asked: Ask, key: int) -> Shown:
    """What the tests of a campaign say together, and what each of them brings."""
    try:
        kept = asked.history.campaign(key)
    except InputError:
        raise NotFound("There is no such campaign.") from None
    return Shown(
        "machines/campaign.html.j2", view_of(kept), context={"key": key, "address": lambda test: asked.url(f"/tests/{test}")}
    )


@pages.acts("/campaigns/{key:int}/recompute", role=ENGINEER)
def recompute(asked: Ask, key: int) -> Done:
    """Ask the tests of a campaign again, from their raw records."""
    try:
        asked.history.campaign(key)
    except InputError:
        raise NotFound("There is no such campaign.") from None
    number = asked.history.put_job("recompute campaign", {"campaign": key})
    return Done(f"/jobs/{number}", "The tests are asked again, from their raw records.", {"job": number})
