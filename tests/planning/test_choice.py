"""The choice against brute force, by measures of its own; the same choice in any unit."""

from dataclasses import replace

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.machine import Joint, Machine
from elastogeo.planning import Means, ReadingNoise, unknowns, whitened
from elastogeo.planning.choosing.choice import extended
from elastogeo.planning.choosing.space import space_of
from elastogeo.prediction import parameter_scales
from elastogeo.sources import Source
from studies.plans import Judge, best_of_random, exhaustive_information, hermle, judge, three_axes

GOALS = ("information", "parameters", "workspace")
OF_TWO_TOOLS = Means(hermle(), readings=16, tools=((0.0, 0.0, -160.0), (0.0, 0.0, -300.0)))


@pytest.fixture(scope="module")
def five() -> Judge:
    return judge(Means(hermle(), readings=16), count=60, poses=200)


@pytest.fixture(scope="module")
def three() -> Judge:
    return judge(Means(three_axes(), readings=12), count=200, poses=300)


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("k", [3, 5])
def test_a_plan_beats_the_best_of_random_sets(three: Judge, goal: str, k: int) -> None:
    """`studies.plans` does it with 10 000 sets of 500 candidates on five axes."""
    plan = eg.plan(three.means, tests=k, goal=goal, chosen_from=three.offered)
    own = three.measures([three.number(plan)])[goal][0]
    assert own >= best_of_random(three, k, 1000)[goal] * (1 - 1e-9 * np.sign(own))


def test_the_plan_for_information_is_the_best_there_is(five: Judge) -> None:
    """All 34220 sets of 3 of 60 in blocks; `studies.plans` does 3 of 80."""
    few = replace(five, offered=five.offered[:40], rows=five.rows[:40])
    plan = eg.plan(five.means, tests=3, goal="information", chosen_from=few.offered)
    assert few.measures([few.number(plan)])["information"][0] == pytest.approx(exhaustive_information(few, 3), abs=1e-6)


def test_eight_circles_support_three_axes(three: Judge) -> None:
    """Golden: 30 combinations, 8 circles, 2.5 nm/N at random poses that the plan has not seen."""
    plan = eg.plan(three.means, tests=8, chosen_from=three.offered)
    taken = three.number(plan)
    assert plan.rank == plan.highest_rank == 30
    assert three.supported(taken).all()
    assert three.data_uncertainty(taken).max() < 2.5


def test_held_rotary_axes_do_not_promise_moving_ones(five: Judge) -> None:
    """Trap: golden 34 combinations with the rotary axes at zero; a plan supports them all, and nothing where they move."""
    means = Means(hermle(), readings=16, rotary=False)
    plan = eg.plan(means, tests=9, count=60)
    assert plan.rank == plan.highest_rank == 34
    assert plan.supported == 1.0
    moving = eg.plan(five.means, tests=9, chosen_from=[one.candidate for one in plan.tests])
    assert moving.supported == 0.0


def test_a_plan_for_one_tool_does_not_promise_another(five: Judge) -> None:
    """Trap: supported at the tool that the tests have, not at one that is longer."""
    plan = eg.plan(OF_TWO_TOOLS, tests=8, chosen_from=five.offered)
    assert plan.tools[0].share == 1.0
    assert plan.tools[1].share < 0.2
    assert [tool.more_needed for tool in plan.tools] == [0, None]


def test_what_each_tool_needs_is_counted_apart(five: Judge) -> None:
    """Test by test, from nothing and beside a plan: the first set that the judge's own measure says supports its tool."""
    plan = eg.plan(OF_TWO_TOOLS, tests=3, chosen_from=five.offered)
    space = space_of(whitened([one.test for one in five.offered], unknowns(hermle()), ReadingNoise()), [])
    minutes = np.array([one.minutes for one in five.offered])
    alone, beside = (
        next(len(sets) for sets in extended(space, start, minutes, 20) if sets and five.supported(sets).all())
        for start in ([], five.number(plan))
    )
    assert [tool.tests_needed for tool in plan.tools] == [alone, None]
    assert [tool.more_needed for tool in plan.tools] == [beside - 3, None]
    assert plan.fewest is None


def in_other_units(machine: Machine, length: float) -> Machine:
    """The same machine with lengths in another unit."""

    def point(values: tuple[float, ...]) -> tuple[float, float, float]:
        x, y, z = (value * length for value in values)
        return x, y, z

    joints = tuple(
        Joint(
            j.name,
            point(j.offset),
            j.tilt,
            j.travel if j.is_rotary else (j.travel[0] * length, j.travel[1] * length),
            compliant=j.compliant,
        )
        for j in machine.joints
    )
    return replace(machine, joints=joints, tool=point(machine.tool))


def turns(source: Source) -> int:
    """How many of displacement and load are a rotation and a moment: lengths that the unit of a compliance is divided by."""
    return (source.component >= 3) + ((source.load or 0) >= 3)


@pytest.mark.parametrize("length", [1e-1, 1e2])
def test_the_plan_is_the_same_in_any_unit_of_length(length: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Lengths in centimetres, or hundredths of a millimetre; forces in other units come with the compliances."""
    plain = Means(three_axes(), readings=12)
    before = eg.plan(plain, tests=4, count=30)
    monkeypatch.setattr(
        "elastogeo.planning.information.parameter_scales",
        lambda sources: parameter_scales(sources) * [length ** (1 - turns(source)) for source in sources],
    )
    means = Means(
        in_other_units(three_axes(), length),
        readings=plain.readings,
        radii=tuple(radius * length for radius in plain.radii),
        feed=plain.feed * length,
        margin=plain.margin * length,
    )
    noise = ReadingNoise(reading=1e-4 * length, set_up=2e-4 * length)
    after = eg.plan(means, tests=4, count=30, noise=noise)
    assert [one.candidate.name for one in after.tests] == [one.candidate.name for one in before.tests]
    assert after.rank == before.rank
    assert [p.known for p in after.parameters] == [p.known for p in before.parameters]
    assert after.tools[0].share == before.tools[0].share
    assert after.tools[0].worst_with_prior == pytest.approx(before.tools[0].worst_with_prior * length, rel=1e-6)


def test_no_unit_of_a_parameter_decides(three: Judge) -> None:
    """Columns in other units with scales in the same units are the same rows."""
    asked = unknowns(three.means.machine)
    names = {name: 2.0 * float(scale) for name, scale in zip(asked.names, asked.scales, strict=True)}
    doubled = unknowns(three.means.machine, scales=names)
    tests = [three.offered[5].test]
    noise = ReadingNoise(force=0.0)
    one, other = (whitened(tests, given, noise)[0] for given in (asked, doubled))
    assert np.allclose(2.0 * one.T @ one * 2.0, other.T @ other, rtol=1e-9)
