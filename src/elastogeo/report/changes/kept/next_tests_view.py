"""The views of what comes next: a few ways to reach a goal, each a card; a plan that is kept, as a list to do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import degrees, isfinite
from typing import Any

from elastogeo.changes import KeptAlternative, KeptPlan, NextGoal, NextTests, PlanToDo, ProgramFacts, Way
from elastogeo.changes.records import PARAMETERS, STIFFNESS, TELL
from elastogeo.report.changes.answers import component_said
from elastogeo.report.changes.records_view import plan_standing
from elastogeo.report.days import iso_date, short_date
from elastogeo.report.document import document
from elastogeo.report.numbers import display_unit, pretty, significant, whole_percent
from elastogeo.report.text import listed
from elastogeo.report.view import KeyValue, Section, Table, View, lines, views

NEXT_SCHEMA, TO_DO_SCHEMA = "elastogeo.next_tests/1", "elastogeo.plan_to_do/1"
_PER_NEWTON = "mm/N"
_MOST = 4
_HOUR = 60.0
_STILL = 0.5
"""An axis that moves less [mm or deg] stands."""


@lines(NextGoal)
def goal_line(goal: NextGoal) -> str:
    """`tell the X drive from the Y guideway`."""
    if goal.kind == TELL:
        first, *others = (component_said(name) for name in goal.between)
        return f"tell {first} from {listed(tuple(others))}"
    if goal.kind == STIFFNESS:
        return f"know the stiffness at the tool, everywhere and in every direction, to {significant(100 * goal.share, 2)} %"
    if goal.kind == PARAMETERS:
        return "know as many compliances of the joints as possible"
    return "know the compliance at the tool everywhere"


@views(NextTests)
def next_tests_view(found: NextTests) -> View:
    """A few ways to reach a goal, the cheapest first."""
    rows = [_row(one) for one in found.alternatives]
    return View(
        kind="Next tests",
        title=found.machine,
        subtitle=f"to {goal_line(found.goal)}",
        origin="",
        head=(
            ("Time", f"{found.minutes:.0f} min"),
            ("Instruments", listed(tuple(one.replace("-", " ") for one in found.instruments))),
        ),
        sentence=_answer(found),
        document=document(NEXT_SCHEMA, found.document()),
        rows=rows,
        sections=tuple(_card(found, one) for one in found.alternatives),
        notes=(
            "Expected with 0.1 µm of noise of a reading, and 0.2 µm and 1 % of the force from run to run. A fault counts as "
            "told if a change of a typical size (5 nm/N) stands out of all that the other component can do by twice the "
            "noise.",
        ),
    )


def _answer(found: NextTests) -> str:
    does = next((one for one in found.alternatives if one.resolved), None)
    goal = goal_line(found.goal)
    if does is None:
        return f"No way that was found is enough to {goal}: give more time, or other instruments."
    verb = "is" if len(does.plan["tests"]) == 1 else "are"
    return f"{_title(does.plan)}, {verb} enough to {goal}."


def _card(found: NextTests, one: KeptAlternative) -> Section:
    goal, plan = found.goal, one.plan
    return Section(
        title=_title(plan),
        paragraphs=tuple(map(pretty, (_resolves(goal, one), *_expected(goal, one), *_lacking(found, plan)))),
        tables=(*_ways_table(one.ways), _tests_table(plan)),
    )


def _lacking(found: NextTests, plan: Mapping[str, Any]) -> Iterator[str]:
    """Which of its instruments are not among those that there are."""
    kinds = dict.fromkeys(test["instrument"] for test in plan["tests"])
    if lacking := tuple(kind.replace("-", " ") for kind in kinds if kind not in found.instruments):
        yield f"It needs the {listed(lacking)}: not among the instruments available."


def _title(plan: Mapping[str, Any]) -> str:
    kinds = dict.fromkeys(test["instrument"] for test in plan["tests"])
    count = len(plan["tests"])
    tests = "1 test" if count == 1 else f"{count} tests"
    return f"{tests}, {_duration(plan['minutes'])}, with the {listed(tuple(kind.replace('-', ' ') for kind in kinds))}"


def _resolves(goal: NextGoal, one: KeptAlternative) -> str:
    """What it resolves, or what it cannot."""
    plan = one.plan
    if goal.kind == TELL:
        alike = [way for way in one.ways if way.told is False]
        if one.resolved:
            return f"Resolves: {_told(goal)}."
        if not alike:
            return "Cannot tell: these tests see hardly anything of them."
        named = dict.fromkeys(
            f"{way.name} of {component_said(way.component)} looks like {component_said(way.other)}" for way in alike
        )
        more = len(named) - _MOST
        return f"Cannot tell: {'; '.join(list(named)[:_MOST])}{f'; {more} more' if more > 0 else ''}."
    if goal.kind == PARAMETERS:
        alone = sum(p["known"] == "alone" for p in plan["parameters"])
        return (
            f"{'Resolves' if one.resolved else 'Tells'} {plan['rank']} of at most {plan['highest_rank']} combinations of "
            f"{len(plan['parameters'])} compliances, {alone} of them alone."
        )
    share = sum(tool["share"] for tool in plan["workspace"]) / len(plan["workspace"])
    if share < 1.0:
        return f"Cannot tell: the compliance at the tool in {whole_percent(1 - share)} % of the volume."
    if goal.kind == STIFFNESS and not one.resolved:
        return "Tells it everywhere, but not so surely."
    return f"Resolves: {'the stiffness' if goal.kind == STIFFNESS else 'the compliance'} at the tool, everywhere."


def _told(goal: NextGoal) -> str:
    first, *others = (component_said(name) for name in goal.between)
    return f"{first} from {listed(tuple(others))}"


def _expected(goal: NextGoal, one: KeptAlternative) -> Iterator[str]:
    """The uncertainty that is to be expected."""
    if goal.kind == TELL:
        return
    worst = max((tool["worst"] for tool in one.plan["workspace"] if tool["worst"] is not None), default=None)
    if worst is None:
        return
    unit = display_unit(_PER_NEWTON, 2 * worst)
    said = f"Expected: U = {significant(2 * worst * unit.factor, 2)} {unit.name} at the worst place that it tells"
    if goal.kind == STIFFNESS and goal.compliance is not None:
        said += f"; asked is {significant(goal.share * goal.compliance * unit.factor, 2)} {unit.name}"
    yield f"{said}."


def _ways_table(ways: Sequence[Way]) -> tuple[Table, ...]:
    rows = []
    for way in ways:
        if way.told is None:
            continue
        half = "unlimited"
        if isfinite(way.uncertainty):
            unit = display_unit(way.unit, way.uncertainty)
            half = f"{significant(way.uncertainty * unit.factor, 2)} {unit.name}"
        rows.append((way.name, component_said(way.component), component_said(way.other), "yes" if way.told else "no", half))
    heads = ("compliance", "of", "against", "told", "expected U of a change")
    return (Table(heads, tuple(rows), words=(0, 1, 2, 3, 4), name="ways"),) if rows else ()


def _tests_table(plan: Mapping[str, Any]) -> Table:
    rows = tuple(
        (
            str(k),
            test["name"],
            test["instrument"].replace("-", " "),
            pretty(_where(test["commands"])),
            f"{test['minutes']:.0f}",
        )
        for k, test in enumerate(plan["tests"], 1)
    )
    heads = ("", "test", "instrument", "where [mm, °]", "min")
    return Table(heads, rows, words=(1, 2, 3), title="Tests, in the order of doing", name="tests")


def _where(commands: Mapping[str, Sequence[float]]) -> str:
    """Where the axes go: from and to, or where they stand."""
    parts = []
    for axis, (low, high) in commands.items():
        if axis == "S":
            continue
        rotary = axis in "ABC"
        a, b = (degrees(low), degrees(high)) if rotary else (low, high)
        mark = "°" if rotary else ""
        parts.append(f"{axis} {a:.0f}{mark}" if b - a < _STILL else f"{axis} {a:.0f} to {b:.0f}{mark}")
    return ", ".join(parts)


def _duration(minutes: float) -> str:
    return f"{minutes:.0f} min" if minutes < 2 * _HOUR else f"{minutes / _HOUR:.1f} h"


def _row(one: KeptAlternative) -> dict[str, Any]:
    plan = one.plan
    return {
        "name": one.name,
        "tests": len(plan["tests"]),
        "minutes": plan["minutes"],
        "resolved": one.resolved,
        "instruments": ", ".join(dict.fromkeys(test["instrument"] for test in plan["tests"])),
    }


@views(PlanToDo)
def plan_to_do_view(found: PlanToDo) -> View:
    """A plan that is kept, as a list to do, with its programs."""
    plan = found.plan
    count = len(plan.tests)
    return View(
        kind="Plan",
        title=plan.name,
        subtitle=plan.machine,
        origin="",
        head=tuple(_head(found)),
        sentence=f"{'1 test' if count == 1 else f'{count} tests'}{_takes(plan)}: {plan_standing(plan)}.",
        values=tuple(_values(plan)),
        document=document(
            TO_DO_SCHEMA,
            {
                "number": plan.key,
                "machine": plan.machine,
                "name": plan.name,
                "due": iso_date(plan.due.at),
                "done": iso_date(plan.done_at),
                "goal": None if found.goal is None else goal_line(found.goal),
                "programs": [_program(one) for one in found.programs],
                "plan": {key: value for key, value in plan.document.items() if key not in ("files", "programs", "for")},
            },
        ),
        rows=[_program(one) for one in found.programs],
        tables=(_to_do_table(found),),
        notes=tuple(_notes(found)),
        sections=(Section("Checklist", points=tuple(_checklist(found))),),
    )


def _takes(plan: KeptPlan) -> str:
    return "" if plan.minutes is None else f" in {_duration(plan.minutes)}"


def _head(found: PlanToDo) -> Iterator[tuple[str, str]]:
    if found.goal is not None:
        yield "Goal", goal_line(found.goal)
    yield "Kept", short_date(found.plan.made_at)


def _values(plan: KeptPlan) -> Iterator[KeyValue]:
    yield KeyValue("tests", str(len(plan.tests)))
    if plan.minutes is not None:
        yield KeyValue("time", f"{plan.minutes:.0f}", "min", "set-up and runs")


def _checklist(found: PlanToDo) -> Iterator[str]:
    whole = found.plan.document
    forces = " and ".join(f"{force:g} N" for force in whole.get("forces_N", []))
    yield "Read every program before you run it, and run it first without the instrument, with the feed override low."
    yield "Set the work offset to where all axes of the machine file are zero; warm the machine up as for every test of it."
    for k, test in enumerate(whole["tests"], 1):
        kind = str(test.get("instrument", "")).replace("-", " ")
        where = pretty(_where(test.get("commands", {})))
        minutes = test.get("minutes")
        takes = f", {minutes:.0f} min" if isinstance(minutes, int | float) else ""
        levels = f", at {forces}" if forces else ""
        yield f"{k}. {test['name']}: {kind or 'test'}{f', {where}' if where else ''}{levels}{takes}."
    yield "Put the run files where the tests name them, upload the folder, and mark the plan as done."


def _to_do_table(found: PlanToDo) -> Table:
    known = {one.test: one for one in found.programs}
    rows: list[tuple[str, ...]] = []
    for k, test in enumerate(found.plan.document["tests"], 1):
        one = known.get(test["name"])
        said = ("", "") if one is None or one.error else (str(one.blocks), f"{one.minutes:.1f}")
        why = "" if one is None else one.error
        rows.append((str(k), test["name"], str(test.get("instrument", "")).replace("-", " "), *said, why))
    heads = ("", "test", "instrument", "blocks", "min at feed", "why no program")
    whole = any(row[-1] for row in rows)
    return Table(
        heads if whole else heads[:-1],
        tuple(row if whole else row[:-1] for row in rows),
        words=(1, 2, 5) if whole else (1, 2),
        title="Tests and programs",
        name="programs",
        keys=tuple(test["name"] for test in found.plan.document["tests"]),
    )


def _notes(found: PlanToDo) -> Iterator[str]:
    if not found.programs:
        yield "This plan was kept without the files of its tests: elastogeo plan --write makes them, with programs."


def _program(one: ProgramFacts) -> dict[str, Any]:
    return {"test": one.test, "blocks": one.blocks, "minutes": one.minutes, "error": one.error}
