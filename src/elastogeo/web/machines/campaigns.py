"""Campaigns: tests that were asked together, and what they say together."""

from __future__ import annotations

from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask, or_not_found
from elastogeo.web.fields import Key
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/campaigns")
def campaigns(asked: Ask, machine: Key = 0) -> Shown:
    """The campaigns of all machines, or of one."""
    of = asked.machine(machine).name if machine else None
    machines = asked.history.machines()
    context = {"machine": machine, "machines": machines, "address": lambda key: asked.url(f"/campaigns/{key}")}
    return Shown("machines/campaigns.html.j2", view_of(asked.history.campaigns(of)), context=context)


@pages.shows("/campaigns/{key:int}")
def campaign(asked: Ask, key: int) -> Shown:
    """What the tests of a campaign say together, and what each of them brings."""
    with or_not_found("There is no such campaign."):
        kept = asked.history.campaign(key)
    return Shown(
        "machines/campaign.html.j2", view_of(kept), context={"key": key, "address": lambda test: asked.url(f"/tests/{test}")}
    )


@pages.acts("/campaigns/{key:int}/recompute", role=ENGINEER)
def recompute(asked: Ask, key: int) -> Done:
    """Ask the tests of a campaign again, from their raw records."""
    with or_not_found("There is no such campaign."):
        asked.history.campaign(key)
    number = asked.history.put_job("recompute campaign", {"campaign": key})
    return Done(f"/jobs/{number}", "The tests are asked again, from their raw records.", {"job": number})
