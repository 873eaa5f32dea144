"""The job `map`: the compliance at the tool over the volume of a machine, from what is identified of it."""

from __future__ import annotations

from typing import Any

from elastogeo.history.analyses.bases import map_basis, tests_of
from elastogeo.history.store import read
from elastogeo.history.work import Work, job
from elastogeo.prediction import map_elements

MAP = "map"


@job(MAP)
def map_machine(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Map a machine.

    Parameters
    ----------
    work : Work
    asked : mapping
        `machine`: its key; `kind` and `key` of the basis, or neither for the first.
    """
    work.step("looking for what is identified", 0, 3)
    with read(work.store) as connection:
        basis = map_basis(connection, int(asked["machine"]), str(asked.get("kind", "")), int(asked.get("key", 0)))
    work.step(f"reading {basis.name}", 1, 3)
    with tests_of(work.store, basis.kind, basis.key) as campaign:
        work.step("identifying and mapping", 2, 3)
        found = map_elements(campaign)
    return {
        "machine": int(asked["machine"]),
        "basis": {"kind": basis.kind, "key": basis.key, "name": basis.name, "at": basis.at, "tests": basis.tests},
        "map": found.document(),
    }
