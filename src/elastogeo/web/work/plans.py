"""Plans of tests: a goal in words, ways to reach it, the plan that is chosen, its checklist and programs."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form, Query, Response

from elastogeo.changes import KeptJob, NextGoal
from elastogeo.changes.records import STIFFNESS, TELL
from elastogeo.errors import ElastogeoError
from elastogeo.formats import flavours
from elastogeo.report import simulated_said, view_of
from elastogeo.web.answering import Done, Shown, download
from elastogeo.web.asking import ENGINEER, Ask, Asked, NotFound, or_not_found
from elastogeo.web.fields import Why
from elastogeo.web.pages import Pages

pages = Pages()
BETWEEN = "between"
"""A goal of the form alone: two components that are chosen there."""


@pages.shows("/plans")
def plans(asked: Ask, machine: Annotated[int | None, Query(ge=1)] = None) -> Shown:
    """The plans that are kept, overdue first; of one machine or of all."""
    of = None if machine is None else asked.machine(machine)
    view = view_of(asked.history.plans(None if of is None else of.name))
    return Shown("work/plans.html.j2", view, context={"machine": of, "machines": asked.history.machines()})


@pages.shows("/plans/{number:int}")
def one_plan(asked: Ask, number: int) -> Shown:
    """A plan: what is to be done, in which order, with the programs of its tests for each control."""
    with or_not_found():
        found = asked.history.plan_to_do(number)
    key = next((one.key for one in asked.history.machines() if one.name == found.plan.machine), None)
    context = {
        "plan": found.plan,
        "programs": {one.test: one for one in found.programs},
        "flavours": tuple(flavours().values()),
        "machine_key": key,
    }
    return Shown("work/plan.html.j2", view_of(found), context=context)


@pages.gives("/plans/{number:int}/programs/{file}", media="text/plain")
def program(asked: Ask, number: int, file: str) -> Response:
    """The program of a test of a plan for a control: `circle_3.mpf`, the bytes that `elastogeo nc` writes."""
    test, dot, suffix = file.rpartition(".")
    flavour = next((one.name for one in flavours().values() if one.suffix == f".{suffix}" and dot), None)
    if flavour is None:
        raise NotFound("There is no such program.")
    try:
        name, content = asked.history.plan_program(number, test, flavour)
    except ElastogeoError as error:
        raise NotFound(str(error)) from None
    return download(content, name, "text/plain; charset=us-ascii")


@pages.gives("/plans/{number:int}/folder.zip", media="application/zip")
def folder(asked: Ask, number: int) -> Response:
    """The folder to measure of a plan: its tests, and their programs for every control."""
    with or_not_found():
        content = asked.history.plan_folder(number)
    return download(content, f"plan-{number}.zip", "application/zip")


@pages.acts("/plans/{number:int}/done", role=ENGINEER)
def finish(asked: Ask, number: int, why: Why = "") -> Done:
    """Say that a plan was done; from then on it is not due."""
    asked.history.finish_plan(number, why)
    return Done(f"/plans/{number}", "The plan is done.")


@pages.shows("/machines/{key:int}/plan", fresh=True)
def new_plan(asked: Ask, key: int, job: Annotated[int | None, Query(ge=1)] = None) -> Shown:
    """Plan tests of a machine: a goal in words, the time and the instruments there are; then ways to reach it, as cards."""
    found = asked.machine(key)
    verdicts = asked.history.machine(found.name).series
    components, unknown = _components(asked, key)
    goals = asked.history.goals(verdicts, components)
    made = _job(asked, key, job)
    done = made is not None and made.state == "done"
    context = {
        "key": key,
        "machine": found,
        "unknown": unknown,
        "components": components,
        "goals": [(_spelled(one), _capital(str(one))) for one in goals],
        "knows_stiffness": asked.history.least_compliance(verdicts) is not None,
        "instruments": asked.history.instruments_to_plan(),
        "job": made,
        "origin": next((simulated_said(one.series.simulated) for one in verdicts if one.series.simulated), ""),
    }
    if not done or made is None:
        return Shown("work/new_plan.html.j2", document={"job": None if made is None else made.key}, rows=(), context=context)
    ways = asked.history.next_tests_of(made)
    return Shown(
        "work/new_plan.html.j2",
        view_of(ways),
        context={**context, "ways": ways.alternatives, "called": _capital(str(ways.goal))},
    )


@pages.acts("/machines/{key:int}/plan", role=ENGINEER)
def ask_for_ways(
    asked: Ask,
    key: int,
    goal: Annotated[str, Form(max_length=200)],
    minutes: Annotated[float, Form(gt=0, le=100_000)],
    instrument: Annotated[list[str], Form(max_length=20)],
    one: Annotated[str, Form(max_length=60)] = "",
    other: Annotated[str, Form(max_length=60)] = "",
    percent: Annotated[float, Form(gt=0, lt=100)] = 5.0,
) -> Done:
    """Ask for ways to reach a goal: `stiffness`, `workspace`, `parameters`, `between` (two components), or a suggestion."""
    found = asked.machine(key)
    kind, *between = goal.split("|")
    compliance = None
    if kind == BETWEEN:
        kind, between = TELL, [one, other]
    if kind == STIFFNESS:
        compliance = asked.history.least_compliance(asked.history.machine(found.name).series)
    wanted = NextGoal(kind, tuple(between), percent / 100, compliance)
    number = asked.history.put_plan(key, wanted, minutes, instrument)
    return Done(f"/machines/{key}/plan?job={number}", "The tests are being planned.", {"job": number})


@pages.acts("/machines/{key:int}/plan/choose", role=ENGINEER)
def choose(
    asked: Ask,
    key: int,
    job: Annotated[int, Form(ge=1, le=2**53)],
    way: Annotated[int, Form(ge=0, le=10_000)],
    name: Annotated[str, Form(max_length=200)],
    due: Annotated[str, Form(max_length=40)] = "",
    grace: Annotated[float, Form(ge=0, le=36_500)] = 7.0,
) -> Done:
    """Keep one of the ways as a plan of the machine."""
    if _job(asked, key, job) is None:
        raise NotFound("There is no such job.")
    number = asked.history.choose_plan(job, way, name, due, grace)
    return Done(f"/plans/{number}", "The plan is kept.", {"plan": number})


def _components(asked: Asked, key: int) -> tuple[tuple[str, ...], str]:
    """The components that planned tests may tell apart; why there are none."""
    try:
        return asked.history.components(key), ""
    except ElastogeoError as error:
        return (), str(error)


def _job(asked: Asked, key: int, number: int | None) -> KeptJob | None:
    """The job that plans for this machine; None without a number.

    Raises
    ------
    NotFound
        If it is none of this machine.
    """
    if number is None:
        return None
    with or_not_found("There is no such job."):
        found = asked.history.job(number)
    if found.kind != "plan" or found.asked.get("machine") != key:
        raise NotFound("This job plans nothing for this machine.")
    return found


def _spelled(goal: NextGoal) -> str:
    """A suggestion as a form sends it back."""
    return "|".join((goal.kind, *goal.between))


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]
