"""The machine of the demo fleet that was commissioned: a campaign that its history supports, with a map, made once."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from elastogeo.changes import NO_BASELINE
from elastogeo.formats import Simulation, simulate
from elastogeo.history import History
from elastogeo.history.fleets import FLEET
from elastogeo.history.fleets.commissioning import CIRCLES, NAME, commission
from elastogeo.history.fleets.folders import write_test
from elastogeo.history.fleets.stories import everywhere, truth
from elastogeo.observe import Imperfection

(STORY,) = (story for story in FLEET if story.commissioned)
AT = datetime(2023, 11, 20, 6, tzinfo=UTC)


def test_the_monthly_test_sees_the_same_machine(tmp_path: Path) -> None:
    monthly = truth(STORY, 0.0, 21.0, True, np.random.default_rng(1))
    folder = write_test(tmp_path / "one", STORY, AT, 21.0, monthly, 1)
    said = [
        simulate(folder, Simulation("elastogeo.simulation/1", values, 1, 90, exact=True, imperfection=Imperfection()))
        for values in (monthly, everywhere(monthly))
    ]
    for one, other in zip(*(test.runs for test in said), strict=True):
        assert one.columns["radial"] == pytest.approx(other.columns["radial"], abs=1e-7)


def test_a_campaign_comes_in_once_and_is_supported_and_its_map_is_asked_for(tmp_path: Path) -> None:
    with History(tmp_path / "h.db", create=True, who="demo") as history:
        key = history.add_machine(STORY.name, kind=STORY.model, serial=STORY.serial, place=STORY.place).key
        assert [added.new for added in commission(history, STORY, key, AT, tmp_path)] == [True] * CIRCLES
        assert list(commission(history, STORY, key, AT, tmp_path)) == []
        (kept,) = history.campaigns(STORY.name).campaigns
        assert (kept.name, kept.supported, len(kept.tests)) == (NAME, True, CIRCLES)
        assert [job.kind for job in history.jobs().jobs] == ["map"]
        assert [row.state for row in history.fleet().machines] == [NO_BASELINE]
