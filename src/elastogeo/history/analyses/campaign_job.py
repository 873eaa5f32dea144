"""The kind of job that asks the tests of a campaign again."""

from __future__ import annotations

from typing import Any

from elastogeo.history.analyses.kept_campaigns import recompute_campaign
from elastogeo.history.work import Work, job


@job("recompute campaign")
def recompute(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Identify the tests of `campaign` again; a new version of the software replaces what was kept."""
    work.step("asking the tests again, from their raw records", 0, 1)
    found = recompute_campaign(work.store, int(asked["campaign"]), work.who)
    work.step("done", 1, 1)
    return {
        "campaign": found.key,
        "same_bits": found.same_bits,
        "differing": len(found.differing),
        "at": f"/campaigns/{found.key}",
    }
