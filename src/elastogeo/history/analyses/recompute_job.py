"""The kind of job that computes a series again from its raw records."""

from __future__ import annotations

from typing import Any

from elastogeo.history.work import Work, job
from elastogeo.report import view_of


@job("recompute")
def recompute_series(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Compute every test of `series` again; a new version of the software takes it over. What was interrupted goes on."""
    from elastogeo.history.history import History

    found = History.of(work.store, work.who).recompute([int(asked["series"])], progress=work.step)
    said = view_of(found).sentence
    work.step(said, 1, 1)
    return {
        "said": said,
        "computed": len(found.tests),
        "same_bits": sum(one.same_bits for one in found.tests),
        "differing": sum(bool(one.differing) for one in found.tests),
        **({"at": f"/tests/{asked['test']}"} if "test" in asked else {}),
    }
