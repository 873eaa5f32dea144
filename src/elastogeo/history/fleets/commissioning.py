"""The campaign of a machine of the demo fleet that was commissioned: planned circles over its workspace, and their map."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from elastogeo.formats import read_machine, write_tests
from elastogeo.history.fleets.folders import IMPERFECT, about, read_by_instrument
from elastogeo.history.fleets.stories import FORCE_SCATTER, Story, everywhere, temperature, truth
from elastogeo.history.history import Added, History
from elastogeo.planning import plan

CIRCLES = 8
NAME = "Commissioning"
APART = timedelta(minutes=20)

WITH_CARE = replace(IMPERFECT, force_scatter=0.0, eccentricity=0.0)
"""The force is read at every run, and the bar stays seated between two."""
MONTHLY = dict.fromkeys("XYZAC", 0.0)
"""Centre of the monthly test, from which the polynomials of its true values count."""

_BAR = """
[[instruments]]
serial = "{bar}"

[[instruments.influences]]
kind = "force-scale"
label = "force gauge"
relative = {scatter}
"""


def commission(history: History, story: Story, machine: int, at: datetime, folder: Path) -> Iterator[Added]:
    """Measure the campaign of a machine, once, and ask for its map.

    Parameters
    ----------
    history : History
    story : Story
    machine : int
        Its key in the history.
    at : datetime
        Of the first circle.
    folder : Path
        Where the folder of the campaign is made.

    Yields
    ------
    Added
        Each circle as it comes in.
    """
    if not history.campaigns(story.name).campaigns:
        measured = _measured(story, at, folder / story.serial)
        yield from (added for added in history.add_all(measured, machine=story.name) if added.imported)
    if history.map_job(machine) is None:
        history.put_map(machine)


def _measured(story: Story, at: datetime, folder: Path) -> Path:
    """The campaign as a folder: circles that a plan chose, with the readings of one day."""
    chance = np.random.default_rng([4, *story.serial.encode()])
    warm = temperature(0.0, chance)
    values = everywhere(truth(story, 0.0, warm, True, chance))
    planned = plan(read_machine(story.model), tests=CIRCLES, reciprocal=True)
    campaign, *tests = write_tests(planned.campaign, folder, story.model)
    said = campaign.read_text(encoding="utf-8").replace('name = "plan"', f'name = "{NAME}"')
    said = said.replace("parameters = [", 'parameters = ["B_XX", "B_YY", ')
    campaign.write_text(said + _BAR.format(bar=story.bar, scatter=FORCE_SCATTER), encoding="utf-8")
    for number, test in enumerate(tests):
        measured = about(story, at + number * APART, warm) + "\n[setup]\n"
        test.write_text(test.read_text(encoding="utf-8").replace("[setup]\n", measured, 1), encoding="utf-8")
        read_by_instrument(test.parent, values, number, WITH_CARE, MONTHLY)
    return folder
