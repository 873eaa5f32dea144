"""A shop for the pages of care: a machine in alarm, one that is steady, an instrument. All values are simulated."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np

import elastogeo as eg
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.store import Store
from tests.history.alarms.shop import add_log, make_instrument, make_series, make_test, set_baseline

DAY = timedelta(days=1)
NAME = "Mill <3> & sons"
"""A name that a page must write as text."""
OTHER = "Lathe 1"


def values(rng: np.random.Generator, loss: float = 0.0) -> dict[str, tuple[str, float]]:
    return {
        "stiffness X": ("stiffness", 50_000 * (1 - loss / 100 + 0.005 * rng.standard_normal())),
        "squareness XY": ("squareness", 2e-6 * rng.standard_normal()),
    }


def fill(store: Store, ills: Sequence[str] = (NAME,)) -> tuple[int, int]:
    """Keys of the series: of the last machine in alarm, and of the steady one, which has no baseline."""
    rng = np.random.default_rng(7)
    now = datetime.now(UTC)
    bar = make_instrument(store, "LB-1")
    add_log(store)
    for name in ills:
        ill = make_series(store, name, interval=28.0)
        tests = [make_test(store, ill, now - (300 - 20 * k) * DAY, values(rng), by=bar) for k in range(10)]
        set_baseline(store, ill, tests, now - 110 * DAY)
        assess(store, ill)
        first = make_test(store, ill, now - 2 * DAY, values(rng, 20.0), imported=now, by=bar)
        assess(store, ill, first)
        assess(store, ill, make_test(store, ill, now - 1 * DAY, values(rng, 20.0), imported=now, by=bar, repeats=first))
    well = make_series(store, OTHER)
    for k in range(8):
        make_test(store, well, now - (200 - 20 * k) * DAY, values(rng))
    assess(store, well)
    return ill, well


def make_shop(folder: Path, ills: Sequence[str] = (NAME,)) -> Path:
    """The database of a shop, in a folder that is there; each of `ills` is in alarm."""
    with eg.History(folder / "shop.db", create=True, who="A. Miller") as history:
        fill(history.store, ills)
    return folder / "shop.db"
