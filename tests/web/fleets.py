"""A small fleet to browse: half a year of four machines, every test of them simulated or marked for what it is.

A Hermle ran into a clamp and nobody repeated its test (*alarm*), a Huron's last test of today stands out (*suspect*),
another Huron is *overdue*, and a mill that has no baseline carries one test of each other instrument, a campaign, a plan.
"""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import elastogeo as eg
from elastogeo.history import History
from elastogeo.history.fleets.folders import write_test
from elastogeo.history.fleets.stories import HERMLE, HURON, Fault, Story, temperature, truth

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
DATABASE = "fleet.db"
EVERY = 28
"""Days between two tests."""
BASELINE = 6


@dataclass(frozen=True)
class Tested:
    """A machine and when it is tested: before how many days last, and how often in all."""

    story: Story
    last: float
    tests: int


ALARMED = Story("Hermle C50 no. 4", "hermle_c50", "H-5014", "hall 1", "B-101", HERMLE, (Fault("collision", 0.0),))
SUSPECTED = Story("Huron KX8 no. 1", "huron_kx8", "K-0801", "hall 2", "B-202", HURON, (Fault("collision", 0.0),))
LATE = Story("Huron KX8 no. 3", "huron_kx8", "K-0803", "hall 2", "B-202", HURON)
VARIED = "Mill <3> & sons"
"""A name that a page must write as text."""
FLEET = (Tested(ALARMED, 12.0, 8), Tested(SUSPECTED, 0.0, 8), Tested(LATE, 60.0, 7))


def make_fleet(folder: Path) -> None:
    """Write the fleet into a new folder: `fleet.db` and its files (about twenty seconds)."""
    folder.mkdir()
    today = datetime.now(UTC).replace(minute=0, second=0, microsecond=0)
    with History(folder / DATABASE, create=True, who="A. Miller") as history, TemporaryDirectory() as place:
        work = Path(place)
        for bar in ("B-101", "B-202"):
            history.add_instrument(bar, kind="loaded-ball-bar", calibrated=f"{today - timedelta(days=200):%Y-%m-%d}")
        for one in FLEET:
            _live(history, work, one, today - timedelta(hours=1))
        history.add_event("repair", "lubrication of X renewed (simulated)", machine=ALARMED.name)
        _others(history, work, today)


def _live(history: History, work: Path, tested: Tested, today: datetime) -> None:
    """The tests of one machine; its fault befalls it just before the last one."""
    story = tested.story
    history.add_machine(story.name, kind=story.model, serial=story.serial, place=story.place)
    faults = tuple(Fault(fault.kind, EVERY * (tested.tests - 1) - 1.0) for fault in story.faults)
    story = Story(story.name, story.model, story.serial, story.place, story.bar, story.squareness, faults)
    for number in range(tested.tests):
        day = EVERY * number
        at = today - timedelta(days=tested.last + EVERY * (tested.tests - 1 - number))
        seed = [number, *story.serial.encode()]
        warm = temperature(day, np.random.default_rng([2, *seed]))
        values = truth(story, day, warm, True, np.random.default_rng([3, *seed]))
        name = work / f"{story.serial}-{number}"
        write_test(name, story, at, warm, values, number)
        history.add(name)
        if number + 1 == BASELINE:
            history.set_baseline(story.name, why="the first tests after commissioning", first=BASELINE)
            history.set_interval(story.name, float(EVERY), why="tests every four weeks")


def _others(history: History, work: Path, today: datetime) -> None:
    """A machine with one test of each other kind, a campaign and a plan."""
    key = history.add_machine(VARIED, kind="hermle_c50", serial="M-3", place="hall 1").key
    for number, name in enumerate(("static-force", "ball-bar-diagnosis", "ball-roller")):
        history.add(EXAMPLES / name, machine=VARIED, date=f"{today - timedelta(days=40 - number):%Y-%m-%d}")
    _ = list(history.add_all(_campaign(work), machine=VARIED, date=f"{today - timedelta(days=20):%Y-%m-%d}"))
    history.put_map(key)  # made by the worker of whoever serves it
    plan = eg.plan(eg.read_machine("hermle_c50"), tests=2, count=10)
    history.keep_plan(plan, machine=VARIED, name="spring", due=f"{today + timedelta(days=30):%Y-%m-%d}")


def _campaign(work: Path) -> Path:
    """The campaign of the examples with two of its four tests."""
    whole = EXAMPLES / "hermle-c50-campaign"
    folder = work / "campaign"
    for name in ("xy", "yz"):
        shutil.copytree(whole / name, folder / name)
    said = (whole / "campaign.toml").read_text(encoding="utf-8").replace(', "zx", "tilted"', "")
    (folder / "campaign.toml").write_text(said.replace("Four loaded", "Two loaded"), encoding="utf-8")
    return folder
