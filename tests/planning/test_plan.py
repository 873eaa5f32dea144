"""A plan: what it promises, that it keeps its budget, that no unit decides it, and the traps of planning.md."""

from dataclasses import replace

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.planning import Candidate, Means, Plan, ReadingNoise, candidates, unknowns, whitened

HERMLE = eg.read_machine("hermle_c50")


@pytest.fixture(scope="module")
def some() -> tuple[Candidate, ...]:
    return candidates(Means(HERMLE, readings=18), count=80)


@pytest.fixture(scope="module")
def planned(some: tuple[Candidate, ...]) -> Plan:
    return eg.plan(Means(HERMLE, readings=18), tests=8, chosen_from=some)


def test_a_plan_of_eight_circles_supports_the_volume(planned: Plan) -> None:
    """Golden: all bar tests of five axes and one tool tell 56 combinations; eight well-chosen circles tell them all."""
    assert planned.rank == planned.highest_rank == 56
    assert planned.supported == 1.0
    assert len(planned.tests) == 8
    assert planned.minutes == sum(one.candidate.minutes for one in planned.tests)
    assert [one.rank_so_far for one in planned.tests][-1] == 56
    assert planned.next_best is not None
    assert planned.next_best.worst <= planned.tests[-1].worst_so_far


def test_one_force_level_tells_nothing(some: tuple[Candidate, ...]) -> None:
    asked, noise = unknowns(HERMLE), ReadingNoise()
    one = some[0].test
    alone = replace(one, runs=one.runs[:1])
    assert len(whitened([alone], asked, noise)[0]) == 0
    again = replace(one, runs=(one.runs[0], replace(one.runs[0], name="again")))
    assert np.abs(whitened([again], asked, noise)[0]).max(initial=0.0) < 1e-9
    with pytest.raises(InputError, match=r"force levels are 600, 600 N; it takes two different ones"):
        Means(HERMLE, forces=(600.0, 600.0))


def test_a_budget_of_minutes_is_kept(some: tuple[Candidate, ...]) -> None:
    found = eg.plan(Means(HERMLE, readings=18), minutes=50, chosen_from=some)
    assert 30 < found.minutes <= 50
    with pytest.raises(UnsupportedError, match="no test fits into 2 minutes; the shortest takes 1"):
        eg.plan(Means(HERMLE, readings=18), minutes=2, chosen_from=some)


def test_what_cannot_be_planned_is_refused() -> None:
    endless = replace(HERMLE, joints=tuple(replace(j, travel=(-np.inf, np.inf)) for j in HERMLE.joints))
    with pytest.raises(InputError, match=r"the travel of Y X Z of machine 'Hermle C50' is not known; state travel_mm"):
        eg.plan(endless, tests=3)
    with pytest.raises(InputError, match="there is no goal 'volume'; there are workspace, parameters, information"):
        eg.plan(HERMLE, tests=3, goal="volume")
    with pytest.raises(InputError, match="E_XX1 is none of them"):
        eg.plan(HERMLE, tests=3, parameters="E_XX1")
    with pytest.raises(InputError, match=r"no test of 'ball-barr' can be planned; instruments that can: ball-bar"):
        candidates(Means(HERMLE), ["ball-barr"], 4)
