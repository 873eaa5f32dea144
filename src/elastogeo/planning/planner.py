"""Which tests to run: candidates, a goal, a budget; the choice, and what it will tell."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.errors import InputError, several
from elastogeo.identification import reciprocal_sources
from elastogeo.machine import Machine, Point
from elastogeo.observe import Askable, Campaign, campaign_of
from elastogeo.planning.choosing.choice import scores_of
from elastogeo.planning.expectations import expectations, weak_directions
from elastogeo.planning.information import unknowns
from elastogeo.planning.noise import ReadingNoise
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.candidates import candidates
from elastogeo.planning.offers.means import Means
from elastogeo.planning.order import in_order_of_doing
from elastogeo.planning.proposed import out_of_reach, proposed_for, reasons_for
from elastogeo.planning.rank import rank_of
from elastogeo.planning.reasons import Reason
from elastogeo.planning.result import NextBest, Plan, PlannedTest
from elastogeo.planning.study import Study, chosen_of, goals_of, highest_rank, study_of, support_of
from elastogeo.planning.verdict import verdict_of
from elastogeo.sources import select_sources

GOALS = ("workspace", "parameters", "information")


def plan(
    machine: Machine | Means,
    tests: int | None = None,
    minutes: float | None = None,
    goal: str = "workspace",
    parameters: str | Sequence[str] = (),
    made: Askable | None = None,
    instruments: Sequence[str] = ("loaded-ball-bar",),
    tools: Sequence[Point] = (),
    tool_lengths: Sequence[float] = (),
    forces: Sequence[float] = (),
    count: int = 400,
    noise: ReadingNoise | None = None,
    reciprocal: bool = False,
    chosen_from: Sequence[Candidate] = (),
    seed: int = 1,
    progress: Callable[[str], None] | None = None,
) -> Plan:
    """Which tests to run on a machine.

    Parameters
    ----------
    machine : Machine or Means
        Its linear axes have a travel.
    tests : int, optional
        How many; with neither tests nor minutes, as many as it takes to support the compliance everywhere in the volume.
    minutes : float, optional
        That there are.
    goal : {"workspace", "parameters", "information"}
        What the plan is to be good for: the compliance at the tool over the volume; as many parameters as possible, or those
        named; all that the tests can tell.
    parameters : str or sequence of str, optional
        Names, patterns or presets of the parameters to know; the goal is then `parameters`.
    made : MachineTest, Campaign or several tests, optional
        Tests that were made already; the plan adds to them.
    instruments : sequence of str
        That there are, under the names that test files use.
    tools : sequence of 3-vector [mm], optional
        Tool points that will be used, in the frame of the last carriage; the machine's own if none is given.
    tool_lengths : sequence of float [mm], optional
        The same as lengths along -Z of that frame.
    forces : sequence of float [N], optional
        Force levels of every test, two at least.
    count : int
        Candidates to draw.
    noise : ReadingNoise, optional
        With what a test is read.
    reciprocal : bool
        Take each joint as symmetric: C_dfj and C_fdj are one parameter.
    chosen_from : sequence of Candidate, optional
        Tests to choose from, instead of drawing them.
    seed : int
        Of the draws.
    progress : callable
        Told what is going on.

    Returns
    -------
    Plan

    Raises
    ------
    InputError
        If the machine's travel is not known, a number is out of range, or a name is unknown.
    UnsupportedError
        If no test fits into the travel, or none tells anything.
    """
    means = _means(machine, tools, tool_lengths, forces)
    names = _named(means.machine, parameters, reciprocal)
    goal = "parameters" if names else goal
    _check(tests, minutes, goal)
    read, campaign = noise or ReadingNoise(), None if made is None else campaign_of(made)
    progress = progress or _silent
    if campaign is not None:
        known = {test.instrument: test.setup for test in campaign.tests.values()}
        means = replace(means, devices=known | dict(means.devices))
    progress("drawing tests that fit into the travel")
    offered = tuple(chosen_from) or candidates(means, instruments, count, seed)
    progress(f"working out what {len(offered)} tests would tell")
    asked = unknowns(means.machine, reciprocal)
    study = study_of(means, asked, offered, campaign, read, seed)
    reasons: tuple[Reason, ...] = ()
    missing = out_of_reach(asked, names, study.space.basis)
    if missing:
        progress("looking for other instruments")
        reasons = reasons_for(asked, missing, reciprocal)
        more = () if chosen_from else proposed_for(means, asked, missing, reasons, reciprocal, seed)
        study = study_of(means, asked, (*offered, *more), campaign, read, seed) if more else study
    progress(f"choosing for {goal}")
    taken = chosen_of(study, goal, names, tests, minutes, progress)
    progress("working out what the chosen tests will tell")
    return _answer(study, goal, names, taken, campaign, read, len(offered), reasons)


def _answer(
    study: Study,
    goal: str,
    names: Sequence[str],
    taken: Sequence[int],
    made: Campaign | None,
    noise: ReadingNoise,
    offered: int,
    reasons: tuple[Reason, ...],
) -> Plan:
    number = {id(one): k for k, one in enumerate(study.offered)}
    order = [number[id(one)] for one in in_order_of_doing([study.offered[k] for k in taken])]
    tests = [*(made.tests.values() if made else ()), *(study.offered[k].test for k in order)]
    told = study.told(order)
    parameters = expectations(told, study.asked, tests, names)
    support = support_of(study, order)
    weak, rank = weak_directions(told), rank_of(told)
    return Plan(
        means=study.means,
        noise=noise,
        goal=goal,
        asked=tuple(names),
        candidates=len(study.offered),
        proposed=tuple(dict.fromkeys(one.test.instrument for one in study.offered[offered:])),
        tests=tuple(_steps(study, order)),
        made=made,
        parameters=parameters,
        rank=rank,
        highest_rank=highest_rank(study),
        fewest=study.needed[0],
        reasons=reasons,
        weak=weak,
        tools=support,
        supported=float(study.supported(order).mean()),
        next_best=_next_best(study, goal, names, order),
        verdict=verdict_of(goal, [p for p in parameters if p.name in names], support, weak, rank),
    )


def _steps(study: Study, order: Sequence[int]) -> Iterator[PlannedTest]:
    for count, k in enumerate(order, start=1):
        so_far = order[:count]
        yield PlannedTest(
            candidate=study.offered[k],
            rank_so_far=rank_of(study.told(so_far)),
            supported_so_far=float(study.supported(so_far).mean()),
            worst_so_far=study.worst_with_prior(so_far),
        )


def _next_best(study: Study, goal: str, names: Sequence[str], order: Sequence[int]) -> NextBest | None:
    left = [k for k in range(len(study.offered)) if k not in order]
    if not left:
        return None
    scores = scores_of(study.space, goals_of(study, goal, names)[-1], order, np.array(left))
    more = [*order, left[int(np.argmax(scores))]]
    return NextBest(
        candidate=study.offered[more[-1]],
        rank=rank_of(study.told(more)),
        worst=study.worst_with_prior(more),
        supported=float(study.supported(more).mean()),
    )


def _means(machine: Machine | Means, tools: Sequence[Point], lengths: Sequence[float], forces: Sequence[float]) -> Means:
    means = machine if isinstance(machine, Means) else Means(machine)
    x, y, _ = means.machine.tool
    points: list[Point] = [*tools, *((x, y, -float(length)) for length in lengths)]
    means = replace(means, tools=tuple(points)) if points else means
    return replace(means, forces=tuple(forces)) if forces else means


def _named(machine: Machine, parameters: str | Sequence[str], reciprocal: bool) -> tuple[str, ...]:
    """Names of the parameters that are asked for, all of them compliances.

    Raises
    ------
    InputError
        If one is no compliance.
    """
    patterns = (parameters,) if isinstance(parameters, str) else tuple(parameters)
    if not patterns:
        return ()
    sources = select_sources(machine, patterns)
    sources = reciprocal_sources(sources) if reciprocal else sources
    known = set(unknowns(machine, reciprocal).names)
    other = [source.name for source in sources if source.name not in known]
    if other:
        raise InputError(f"tests are planned for compliances of joints and places; {several(other)} is none of them")
    return tuple(source.name for source in sources)


def _check(tests: int | None, minutes: float | None, goal: str) -> None:
    if goal not in GOALS:
        raise InputError(f"there is no goal {goal!r}; there are {', '.join(GOALS)}")
    if tests is not None and tests < 1:
        raise InputError(f"a plan of {tests} tests is none; ask for one or more")
    if minutes is not None and not minutes > 0:
        raise InputError(f"a plan of {minutes:g} minutes is none; give the time there is, in minutes")


def _silent(_: str) -> None:
    """Nobody looks on."""
