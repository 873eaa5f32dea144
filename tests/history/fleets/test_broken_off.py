"""The demo fleet, broken off and begun again: it ends as one that was lived through at once."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import pytest
from sqlalchemy import func, select

from elastogeo.history import History
from elastogeo.history.fleets.living import BASELINE, live
from elastogeo.history.fleets.stories import EVERY, HERMLE, YEAR, Fault, Story
from elastogeo.history.jobs import Worker
from elastogeo.history.store import read
from elastogeo.history.store.schema import analysis, baseline, calibration, event, test

YEARS = 11.5 * EVERY / YEAR
STORY = Story("Mill 3", "hermle_c50", "M-3", "hall 1", "B-1", HERMLE, (Fault("collision", 10.5 * EVERY),))
UNTIL = datetime(2026, 11, 20, tzinfo=UTC)


class PowerCutError(BaseException):
    pass


def counts(history: History) -> dict[str, int]:
    with read(history.store) as connection:
        tables = (test, analysis, baseline, event, calibration)
        return {one.name: connection.execute(select(func.count()).select_from(one)).scalar_one() for one in tables}


def test_it_goes_on_where_it_was_broken_off_and_nothing_is_double(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between two tests, between a test and its event, between the interval and the baseline."""
    cut: list[str] = []

    def cutting(name: str) -> None:
        does = getattr(History, name)

        def once(self: History, *given: object, **how: object) -> object:
            if name not in cut:
                cut.append(name)
                raise PowerCutError
            return does(self, *given, **how)

        monkeypatch.setattr(History, name, once)

    for name in ("add_event", "set_interval", "set_baseline"):
        cutting(name)
    with History(tmp_path / "fleet.db", create=True, who="demo") as history:
        for stop in (2, 5, 99, 99, 99, 99):
            try:
                for number, _ in enumerate(live(history, UNTIL, (STORY,), YEARS)):
                    if number == stop:
                        break
            except PowerCutError:
                pass
        assert sorted(cut) == ["add_event", "set_baseline", "set_interval"]
        found = counts(history)
        assert found["test"] == found["analysis"] >= 12 > BASELINE
        assert (found["baseline"], found["event"], found["calibration"]) == (1, 1, 1)


def test_the_job_fills_an_empty_history_and_tells_how_far_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "elastogeo.history.fleets.living.live", lambda history, until, years: live(history, until, (STORY,), years)
    )
    with History(tmp_path / "fleet.db", create=True, who="A. Nobody") as history:
        key = history.put_job("demo", {"until": UNTIL.isoformat(), "years": 2.5 * EVERY / YEAR})
        Worker(history.store).run(once=True)
        job = history.job(key)
        assert (job.state, job.done, job.total) == ("done", 3, 3)
        assert counts(history)["test"] == 3
