"""The job `demo`: the simulated fleet, in a history that knows no other machine."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from elastogeo.history.work import Work, job

BY = "demo"
"""In whose name the years are lived through: no person did it."""


@job("demo")
def demo(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Live through the years of the fleet until the day `until`, or on from where that broke off."""
    from elastogeo.history.fleets.living import live
    from elastogeo.history.fleets.stories import FLEET
    from elastogeo.history.history import History

    work.step("beginning")
    for one in live(History.of(work.store, BY), datetime.fromisoformat(asked["until"]), years=asked.get("years", 3.0)):
        work.step(f"{one.machine}, {one.at:%Y-%m-%d}: {one.state}", one.done, one.of)
    return {"machines": len(FLEET)}
