"""The job that draws what the page of a test shows."""

from __future__ import annotations

from typing import Any

from elastogeo.history.analyses.drawings import draw
from elastogeo.history.work import Work, job


@job("draw")
def draw_test(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Evaluate and draw a test: `test`, its key; `again`, whether to draw anew what is drawn already."""
    work.step("evaluating and drawing the test", 0, 1)
    return {"analysis": draw(work.store, int(asked["test"]), work.who, bool(asked.get("again")))}
