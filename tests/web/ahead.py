"""A history of one machine of which two circles are identified, mapped and planned for: what pages that look ahead show."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import elastogeo as eg
from elastogeo.changes import NextGoal
from elastogeo.changes.records import TELL
from elastogeo.history.jobs import Worker

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
DATABASE = "shop.db"
HOST = "http://127.0.0.1:8347"


_MADE: list[tuple[Path, dict[str, int]]] = []


def shop_in(folder: Path) -> tuple[Path, dict[str, int]]:
    """A copy of the history in a folder that is not there yet, and its keys; it is made once by each process."""
    if not _MADE:
        first = folder.with_name(f"{folder.name}-first")
        first.mkdir(parents=True)
        _MADE.append((first, make_shop(first / DATABASE)))
    made, keys = _MADE[0]
    shutil.copytree(made, folder)
    return folder / DATABASE, keys


def make_shop(url: Path) -> dict[str, int]:
    """Fill a new history; the keys of its machine, the job of its map, that of its ways, and a plan."""
    with pytest.MonkeyPatch.context() as patch, eg.History(url, create=True, who="A. Miller") as history:
        patch.setattr("elastogeo.changes.next_tests.ways.CANDIDATES", 24)
        machine = history.add_machine("Mill <3>", serial="4711").key
        history.add_machine("New one", kind="hermle_c50")
        for day, name in enumerate(("1-xy", "2-yz"), 1):
            history.add(EXAMPLES / "three-axis-campaign" / name, machine="Mill <3>", date=f"2026-03-0{day}")
        found = history.put_map(machine)
        ways = history.put_plan(machine, NextGoal(TELL, ("drive X", "guideway Y")), 60.0, ["loaded-ball-bar"])
        Worker(history.store).run(once=True)
        assert not history.job(found).error
        plan = history.choose_plan(ways, 0, "the first", "2026-12-24")
        return {"machine": machine, "map": found, "ways": ways, "plan": plan}
