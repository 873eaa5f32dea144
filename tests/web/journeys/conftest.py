"""Fleets that the journeys change, each at a place of its own: served once for all of them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import elastogeo as eg
from tests.web.browsing import Site, Watched, serving
from tests.web.care.shop import make_shop
from tests.web.conftest import copy_of

SOON = 60_000
"""Milliseconds in which the worker must have done a small job, on a computer that does much else."""
MILLS = ("Mill <1> & sons", "Mill 2")
"""The machines in alarm of the shop."""
ROWS = 101
"""Machines that fill the first page of the fleet, and one more."""


@pytest.fixture(scope="session")
def acted_on(made_fleet: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """The fleet, to upload to, to set tests aside in, to plan for."""
    folder = tmp_path_factory.mktemp("acted on")
    with serving(copy_of(made_fleet, folder / "fleet"), folder / "serve.log") as site:
        yield site


@pytest.fixture
def acting(acted_on: Site, screens: Any) -> Watched:
    found: Watched = screens(acted_on.url)
    return found


@pytest.fixture(scope="session")
def shop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """Two machines in alarm, and a hall with more machines than a page of the fleet holds; nothing works in it."""
    folder = tmp_path_factory.mktemp("shop")
    database = make_shop(folder, MILLS)
    with eg.History(database, who="A. Miller") as history:
        for number in range(ROWS):
            history.add_machine(f"Press {number:03}", place="hall 7")
    with serving(database, folder / "serve.log", "--no-worker") as site:
        yield site
