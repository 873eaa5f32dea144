"""Three years of the demo fleet, test by test: imported as they are made, judged, repeated where one is suspect."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
from sqlalchemy import Table, func, select

from elastogeo.changes import NO_BASELINE, SUSPECT
from elastogeo.history.fleets.commissioning import CIRCLES, commission
from elastogeo.history.fleets.folders import write_test
from elastogeo.history.fleets.stories import (
    EVERY,
    FLEET,
    RECALIBRATED,
    RECALIBRATED_AFTER,
    YEAR,
    Story,
    temperature,
    truth,
)
from elastogeo.history.history import History
from elastogeo.history.store import read
from elastogeo.history.store.schema import baseline, event, machine, series, test

YEARS = 3.0
BASELINE = 10
"""Tests after which a person sets the baseline."""
COMMISSIONED = timedelta(days=3)
"""Before the first test of the fleet."""
LAST = timedelta(days=10)
"""Before the day it is lived to, at least: all its tests are old, and nobody is told of what they show."""


@dataclass(frozen=True, slots=True)
class Lived:
    """A test of the fleet that came in.

    Attributes
    ----------
    machine : str
    at : datetime
    state : str
        Of its series after it.
    done, of : int
        Tests so far, and of the whole fleet without repeats.
    """

    machine: str
    at: datetime
    state: str
    done: int
    of: int


def live(history: History, until: datetime, stories: tuple[Story, ...] = FLEET, years: float = YEARS) -> Iterator[Lived]:
    """Live through the years of a fleet, in a history that knows none of its machines.

    In one where that was begun before, until the same day, and broke off at any instant, it goes on: the end is the same.

    Parameters
    ----------
    history : History
    until : datetime
        The day on which it is looked at.
    stories : tuple of Story
    years : float

    Yields
    ------
    Lived
        After each test.
    """
    begin = (until.astimezone(UTC) - LAST - timedelta(days=years * YEAR)).replace(hour=6, minute=0, second=0, microsecond=0)
    keys = {
        story.name: history.add_machine(story.name, kind=story.model, serial=story.serial, place=story.place).key
        for story in stories
    }
    for bar in sorted({story.bar for story in stories}):
        history.add_instrument(bar, kind="loaded-ball-bar", calibrated=f"{begin - timedelta(days=30):%Y-%m-%d}")
    times = [(k * EVERY, number) for k in range(int(years * YEAR / EVERY) + 1) for number in range(len(stories))]
    times = [(day, number) for day, number in times if day <= stories[number].until]
    commissioned = [story for story in stories if story.commissioned]
    before = CIRCLES * len(commissioned)
    of = before + len(times)
    recalibrated = False
    with tempfile.TemporaryDirectory() as folder:
        for k, story in enumerate(commissioned):
            at = begin - COMMISSIONED
            measured = commission(history, story, keys[story.name], at, Path(folder))
            for done, _ in enumerate(measured, CIRCLES * k + 1):
                yield Lived(story.name, at, NO_BASELINE, done, of)
        for done, (day, number) in enumerate(times, before + 1):
            if day >= RECALIBRATED_AFTER and not recalibrated:
                on = begin + timedelta(days=RECALIBRATED_AFTER)
                history.add_instrument(RECALIBRATED, calibrated=f"{on:%Y-%m-%d}", certificate="simulated")
                recalibrated = True
            at = begin + timedelta(days=day, hours=number)
            if _is_past(history, stories[number].name, at):
                continue
            yield Lived(stories[number].name, at, _tested(history, Path(folder), stories[number], day, at), done, of)


def _tested(history: History, folder: Path, story: Story, day: float, at: datetime) -> str:
    """One test of a machine, again on the same day if it is suspect, and what is noted of it; the state then."""
    number = int(day / EVERY)
    seed = [number, *story.serial.encode()]
    chance, warm = np.random.default_rng([1, *seed]), temperature(day, np.random.default_rng([2, *seed]))
    state = monthly = ""
    for attempt in range(2):
        values = truth(story, day, warm, chance.random() >= story.seated_badly, np.random.default_rng([3, *seed]))
        name = folder / f"{story.serial}-{number:02d}-{attempt + 1}"
        write_test(name, story, at + timedelta(minutes=30 * attempt), warm, values, 1000 * number + attempt)
        added = history.add(name)
        assert added.verdict is not None
        assert added.imported is not None
        state, monthly = added.verdict.state, added.imported.series_name
        if not added.verdict.steps or added.verdict.steps[-1].state != SUSPECT:
            break  # of an old test that nobody repeated the alarm is there at once; that day it was suspect
    struck = [fault.after for fault in story.faults if fault.kind == "collision"]
    if any(day - EVERY < after <= day for after in struck) and not _noted(history, story.name, event):
        history.add_event("crash", "the spindle ran into a clamp (simulated)", machine=story.name, at=f"{at:%Y-%m-%d}")
    if number + 1 == BASELINE and not _noted(history, story.name, baseline):
        history.set_interval(story.name, EVERY, monthly, why="tests every four weeks")
        history.set_baseline(story.name, monthly, why="the first ten tests after commissioning", first=BASELINE)
    return state


def _is_past(history: History, name: str, at: datetime) -> bool:
    """Whether a machine has a test of a later day: all that belongs to this one was done then."""
    of = (
        select(func.max(test.c.at))
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
    )
    with read(history.store) as connection:
        last = connection.execute(of.where(machine.c.name == name)).scalar_one()
    return last is not None and last > at + timedelta(days=1)


def _noted(history: History, name: str, table: Table) -> bool:
    """Whether a machine has a row in `event`, or a series of it one in `baseline`: the fleet makes one of each, at most."""
    of = select(table.c.id).select_from(machine)
    if table is baseline:
        found = of.join(series, series.c.machine == machine.c.id).join(baseline, baseline.c.series == series.c.id)
    else:
        found = of.join(table, table.c.machine == machine.c.id)
    with read(history.store) as connection:
        return connection.execute(found.where(machine.c.name == name).limit(1)).first() is not None
