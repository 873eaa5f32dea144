"""The job `plan`: a few ways to reach a goal by tests of a machine, to choose among."""

from __future__ import annotations

from typing import Any

from elastogeo.changes import KeptAlternative, NextGoal, NextTests, alternatives
from elastogeo.history.analyses.bases import definition_of
from elastogeo.history.analyses.planned_files import planned_files, program_facts
from elastogeo.history.store import read
from elastogeo.history.store.schema import machine
from elastogeo.history.work import Work, job

PLAN = "plan"


@job(PLAN)
def plan_next(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    """Plan tests of a machine.

    Parameters
    ----------
    work : Work
    asked : mapping
        `machine`: its key; `goal`: the fields of a `NextGoal`; `minutes`, `instruments`.
    """
    work.step("reading the machine", 0, 1)
    definition = definition_of(work.store, int(asked["machine"]))
    with read(work.store) as connection:
        called = connection.execute(machine.select().where(machine.c.id == int(asked["machine"]))).one().name
    said = asked["goal"]
    goal = NextGoal(said["kind"], tuple(said.get("between", ())), said.get("share", 0.05), said.get("compliance"))
    instruments = tuple(asked["instruments"])
    found = alternatives(definition.machine, goal, float(asked["minutes"]), instruments, progress=work.step)
    kept = []
    for number, one in enumerate(found):
        work.step("writing the tests", number, len(found))
        files = planned_files(one.plan.campaign, definition)
        facts = program_facts(files, one.plan.campaign.tests)
        document = one.plan.to_dict() | {"programs": [[p.test, p.blocks, p.minutes, p.error] for p in facts]}
        kept.append(KeptAlternative(one.name, one.resolved, one.ways, document, files))
    return NextTests(called, goal, float(asked["minutes"]), instruments, tuple(kept)).document()
