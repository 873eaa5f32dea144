"""Which tests to run next on a machine that is watched: a goal in words, and a few ways to reach it, each with its cost.

A goal is one of those of `plan`, or to tell components apart that a series of tests cannot tell. Components are told apart
by a plan if no fault of the one looks like faults of the other: what a fault of a typical size does to the readings must
stand out of all that the other component can do, by more than twice the noise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations
from math import inf
from typing import Any

import numpy as np

from elastogeo.changes.indicators import faults_of
from elastogeo.changes.records import (
    ENOUGH,
    GOALS,
    MORE,
    ONE,
    PARAMETERS,
    STIFFNESS,
    TELL,
    WAYS,
    WITHIN,
    WORKSPACE,
    NextGoal,
    Way,
)
from elastogeo.equality import ByValue
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.machine import Array, Machine
from elastogeo.planning import Candidate, Means, Plan, ReadingNoise, candidates, plan, unknowns, whitened

CANDIDATES = 80
"""Tests that are drawn to choose from."""

_ROUNDING = 1e-9
"""Share of a column below which what is left of it is the arithmetic's."""


@dataclass(frozen=True, slots=True, eq=False)
class Alternative(ByValue):
    """One way to reach a goal.

    Attributes
    ----------
    name : str
        One of `WAYS`.
    plan : Plan
    resolved : bool
        Whether it reaches the goal.
    ways : tuple of Way
        Of a goal that tells components apart.
    """

    name: str
    plan: Plan
    resolved: bool
    ways: tuple[Way, ...] = ()


def planned_components(machine: Machine) -> dict[str, tuple[str, ...]]:
    """The components of a machine whose faults are compliances, with the names of these."""
    known = set(unknowns(machine).names)
    found: dict[str, list[str]] = {}
    for component, _, changes in faults_of(machine):
        found.setdefault(component, []).extend(source.name for source, _ in changes if source.name in known)
    return {component: tuple(names) for component, names in found.items() if names}


def alternatives(
    machine: Machine,
    goal: NextGoal,
    minutes: float,
    instruments: Sequence[str] = ("loaded-ball-bar",),
    seed: int = 1,
    progress: Callable[[str, int, int], None] | None = None,
) -> tuple[Alternative, ...]:
    """A few ways to reach a goal, the cheapest first.

    Parameters
    ----------
    machine : Machine
        Its linear axes have a travel.
    goal : NextGoal
    minutes : float
        That there are.
    instruments : sequence of str
        That there are.
    seed : int
        Of the draws of tests.
    progress : callable, optional
        `progress(step, done, total)`.

    Raises
    ------
    InputError
        If the goal is none, names a component that no compliance is of, or there is no time.
    UnsupportedError
        If no test fits into the travel, or into the time.
    """
    _check(machine, goal, minutes)
    tell = progress or (lambda _step, _done, _total: None)
    tell("drawing tests that fit into the travel", 0, len(WAYS) + 1)
    means = Means(machine)
    offered = candidates(means, instruments, CANDIDATES, seed)
    shortest = min(one.minutes for one in offered)
    if shortest > minutes:
        raise UnsupportedError(f"no test fits into {minutes:g} minutes; the shortest takes {shortest:.0f}: plan more time")
    apart = _Apart(machine, goal, offered) if goal.kind == TELL else None
    found: list[Alternative] = []
    for number, name in enumerate(WAYS, 1):
        tell(f"choosing: {name}", number, len(WAYS) + 1)
        made = _plan(means, goal, name, minutes, instruments, offered, seed, apart)
        if made is not None and not any(_same(made, one.plan) for one in found):
            ways = () if apart is None else apart.ways_of([one.candidate for one in made.tests])
            found.append(Alternative(name, made, _resolves(goal, made, ways), ways))
    return tuple(sorted(found, key=lambda one: one.plan.minutes))


def _check(machine: Machine, goal: NextGoal, minutes: float) -> None:
    if goal.kind not in GOALS:
        raise InputError(f"there is no goal {goal.kind!r}; there are {', '.join(GOALS)}")
    if not 0 < minutes < float("inf"):
        raise InputError(f"a plan of {minutes:g} minutes is none; give the time there is, in minutes")
    if goal.kind == STIFFNESS and not 0 < goal.share < 1:
        raise InputError(f"the stiffness is to be known to {100 * goal.share:g} %; give a number above 0 and below 100")
    if goal.kind == STIFFNESS and not (goal.compliance is not None and goal.compliance > 0):
        raise InputError("no test of this machine shows its stiffness yet, so that a share of it is no goal; choose another")
    if goal.kind == TELL:
        known = planned_components(machine)
        strange = [name for name in goal.between if name not in known]
        if strange:
            raise InputError(f"no compliance is of {strange[0][:40]!r}; this machine has {', '.join(known)}")
        if len(set(goal.between)) < len("AB"):
            raise InputError("it takes two components to be told apart; choose two different ones")


def _plan(
    means: Means,
    goal: NextGoal,
    name: str,
    minutes: float,
    instruments: Sequence[str],
    offered: Sequence[Candidate],
    seed: int,
    apart: _Apart | None,
) -> Plan | None:
    """The plan of a way; None where there is none."""
    if (name == ENOUGH and goal.kind in (TELL, PARAMETERS)) or (name == MORE and goal.kind != TELL):
        return None
    asked: dict[str, Any] = {"goal": "workspace" if goal.kind in (STIFFNESS, WORKSPACE) else "parameters", "seed": seed}
    asked |= {"parameters": () if apart is None else apart.names, "instruments": instruments, "count": CANDIDATES}
    asked |= {ONE: {"tests": 1, "minutes": minutes}, WITHIN: {"minutes": minutes}, ENOUGH: {}, MORE: {"minutes": minutes}}[
        name
    ]
    chosen_from = () if name == MORE else (apart.best,) if name == ONE and apart is not None else offered
    try:
        found = plan(means, chosen_from=chosen_from, **asked)
    except UnsupportedError:
        return None
    return found if name != MORE or found.proposed else None


def _same(one: Plan, other: Plan) -> bool:
    return [test.candidate.name for test in one.tests] == [test.candidate.name for test in other.tests]


class _Apart:
    """How well tests tell components of a machine apart.

    Attributes
    ----------
    names : tuple of str
        The compliances to look at: those that no test at hand tells from the other component, else all of them.
    best : Candidate
        The test that does it best by itself.
    """

    def __init__(self, machine: Machine, goal: NextGoal, offered: Sequence[Candidate]) -> None:
        self._asked, self._between = unknowns(machine), goal.between
        self._known = planned_components(machine)
        rows = whitened([one.test for one in offered], self._asked, ReadingNoise())
        alike = [way.name for way in self._ways(np.vstack(rows)) if way.told is False]
        every = [name for component in goal.between for name in self._known[component]]
        self.names = tuple(dict.fromkeys(alike or every))
        self.best = offered[max(range(len(offered)), key=lambda k: self._worth(tuple(self._ways(rows[k]))))]

    def ways_of(self, tests: Sequence[Candidate]) -> tuple[Way, ...]:
        """Each fault of each component against each other component, by these tests."""
        return tuple(self._ways(np.vstack(whitened([one.test for one in tests], self._asked, ReadingNoise()))))

    def _worth(self, ways: Sequence[Way]) -> tuple[bool, float]:
        """Whether tests tell them apart, and by how much the component that stands out least does."""
        most = dict.fromkeys(self._between, 0.0)
        for way in ways:
            most[way.component] = max(most[way.component], way.apart)
        return _are_told(ways, self._between), min(most.values())

    def _ways(self, rows: Array) -> Iterator[Way]:
        """The ways, by rows whose errors have unit standard deviation."""
        names, scales = self._asked.names, self._asked.scales
        for one, other in permutations(self._between, 2):
            basis = _span(rows[:, [names.index(name) for name in self._known[other] if name not in self._known[one]]])
            for name in self._known[one]:
                k = names.index(name)
                seen = float(np.linalg.norm(rows[:, k]))
                apart = float(np.linalg.norm(rows[:, k] - basis @ (basis.T @ rows[:, k])))
                distinct = apart > _ROUNDING * max(seen, 1.0)
                half = 2 * float(scales[k]) / apart if distinct else inf
                yield Way(one, other, name, self._asked.sources[k].unit, seen, apart if distinct else 0.0, half)


def _span(columns: Array) -> Array:
    """An orthonormal basis of columns, by their lengths scaled."""
    lengths = np.linalg.norm(columns, axis=0)
    kept = columns[:, lengths > _ROUNDING * lengths.max(initial=1.0)]
    left, values, _ = np.linalg.svd(kept / np.linalg.norm(kept, axis=0), full_matrices=False)
    return np.asarray(left[:, values > _ROUNDING * values.max(initial=1.0)])


def _resolves(goal: NextGoal, made: Plan, ways: Sequence[Way]) -> bool:
    """Whether a plan reaches the goal."""
    if goal.kind == TELL:
        return _are_told(ways, goal.between)
    if goal.kind == PARAMETERS:
        return made.rank == made.highest_rank
    worst = max((tool.worst for tool in made.tools if tool.worst is not None), default=float("inf"))
    whole = made.supported == 1.0
    if goal.kind == STIFFNESS and goal.compliance is not None:
        return whole and 2 * worst <= goal.share * goal.compliance
    return whole


def _are_told(ways: Sequence[Way], between: Sequence[str]) -> bool:
    """Whether each component is seen, and nothing that is seen of it looks like another one."""
    seen = {way.component for way in ways if way.told is not None}
    return seen == set(between) and all(way.told is not False for way in ways)
