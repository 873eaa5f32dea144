"""Compliances that change with travel, sign of the load, feed: their columns by hand, what they are confounded with, and
what separates them.

The machine is wFYXt, the circle in XY about the origin, the tool ball at the origin of X's carriage: at the angle t the
axes stand at R cos t and R sin t, and the joints carry F cos t along x and F sin t along y.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.identification import confounding_of, identify, systems_of
from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import Circle, Imperfection, LoadedBallBar, MachineTest, Question, Run
from elastogeo.sources import linear_response, parameter_values, select_sources, simulate

MakeTest = Callable[..., MachineTest]
ANGLE = np.linspace(0.1, 6.2, 90)
C, S, R, F, V = np.cos(ANGLE), np.sin(ANGLE), 150.0, 100.0, 2000.0 / 60.0

BY_HAND: dict[str, Array] = {
    "CQ1_XXX": F * C * (R * C) * C,
    "CQ2_XXX": F * C * (R * C) ** 2 * C,
    "CQ1_YYX": 0 * C + F * S * (R * C) * S,
    "CP_XXX": F * np.maximum(C, 0) * C,
    "CN_XXX": F * np.minimum(C, 0) * C,
    "CP_YYY": F * np.maximum(S, 0) * S,
    "CV_XXX": F * C * (-V * S) * C,
    "CS_XXX": F * C * np.abs(V * S) * C,
    "CV_YYY": F * S * (V * C) * S,
}
"""Radial response per unit of each parameter."""


@pytest.mark.parametrize("name", BY_HAND)
def test_a_column_is_what_it_is_by_hand(name: str, make_test: MakeTest) -> None:
    test = make_test("wFYXt", [F], angle=ANGLE, circle=Circle(R))
    (observed,) = test.observations()
    assert observed.velocity[0] == pytest.approx([V * C[0], -V * S[0]])  # in the order of the axes, Y then X
    response = linear_response(parameter_values(test.machine, {name: 1.0}), test.machine, observed)
    assert_allclose(response, BY_HAND[name], rtol=0, atol=1e-9 * max(1.0, np.abs(BY_HAND[name]).max()))


def with_travel(low: float = -400.0, high: float = 600.0) -> Machine:
    topology = parse_topology("wFYXt")
    return Machine("screws", topology, tuple(Joint(axis, travel=(low, high)) for axis in topology.axes))


def bar(machine: Machine, runs: list[Run], *parameters: str) -> MachineTest:
    return MachineTest("bar", machine, LoadedBallBar(Circle(R), V), tuple(runs), Question(parameters, set_up_per_run=False))


def run(name: str, force: float, feed: float | None = None, sense: int = 1) -> Run:
    return Run(name, {"angle": ANGLE, "radial": np.zeros(len(ANGLE))}, force=force, feed=feed, sense=sense)


def groups_of(test: MachineTest) -> list[set[str]]:
    return [set(group) for group in confounding_of(test, systems_of(test)).groups if len(group) > 1]


def rank_of(test: MachineTest) -> int:
    return confounding_of(test, systems_of(test)).rank


def test_a_screw_is_held_at_one_end_or_at_both() -> None:
    test = bar(with_travel(), [run("a", F)], "CE1_XXX")
    (observed,) = test.observations()
    share = (R * C + 400.0) / 1000.0
    for name, by_hand in {"CE1_XXX": F * C * C * share, "CE2_XXX": F * C * C * 4 * share * (1 - share)}.items():
        response = linear_response(parameter_values(test.machine, {name: 1.0}), test.machine, observed)
        assert_allclose(response, by_hand, atol=1e-9 * F)


def test_a_screw_held_at_one_end_is_a_constant_and_a_gain_with_travel() -> None:
    """So it is not distinguished from these two; a screw held at both ends has a curvature of its own."""
    held = bar(with_travel(), [run("a", F)], "C_XXX", "CQ1_XXX", "CE1_XXX")
    assert rank_of(held) == 2
    assert confounding_of(held, systems_of(held)).stands_for("C_XXX") == pytest.approx({"C_XXX": 1.0, "CE1_XXX": 0.4})
    both = bar(with_travel(), [run("a", F)], "C_XXX", "CQ1_XXX", "CE2_XXX")
    assert rank_of(both) == 3


def test_a_travel_that_is_not_known_has_no_screw() -> None:
    machine = Machine("no travel", parse_topology("wFYXt"))
    names = {source.name for source in select_sources(machine, ["C*"])}
    assert not any(name.startswith("CE") for name in names)
    assert "CQ1_XXX" in names


def test_push_and_pull_are_the_compliance_where_they_are_alike() -> None:
    """`C_XXX = CP_XXX = CN_XXX` together: a circle sees both signs, so two of the three are determined."""
    test = bar(with_travel(), [run("a", F)], "C_XXX", "CP_XXX", "CN_XXX")
    assert rank_of(test) == 2
    truth = {"CP_XXX": 5e-5, "CN_XXX": 8e-5}
    asked = bar(with_travel(), [run("a", 36.0), run("b", F), run("c", 742.0)], "CP_XXX", "CN_XXX", "E_XX1", "E_YY1")
    found = identify(simulate(asked, truth, Imperfection(noise=1e-5), seed=1))
    for name, value in truth.items():
        assert found[name].value == pytest.approx(value, rel=2e-3)


def test_a_joint_that_is_only_pushed_says_nothing_of_pulling() -> None:
    """Half a circle pushes X one way: the other parameter moves no reading, and the compliance is the same column."""
    half = np.linspace(-1.5, 1.5, 60)
    one = Run("half", {"angle": half, "radial": np.zeros(60)}, force=F)
    test = bar(with_travel(), [one], "C_XXX", "CP_XXX", "CN_XXX")
    found = confounding_of(test, systems_of(test))
    assert set(found.null) == {"CN_XXX"}
    assert groups_of(test) == [{"C_XXX", "CP_XXX"}]


LAG = ("C_XXX", "C_CXY", "E_C(0Y)X", "T_X1", "CV_XXX")


def test_one_feed_does_not_distinguish_what_depends_on_it() -> None:
    """At one feed and direction the lag is a squareness, and a compliance times velocity is another compliance."""
    test = bar(with_travel(), [run("a", 100.0), run("b", 742.0)], *LAG)
    assert rank_of(test) == 3
    assert {frozenset(group) for group in groups_of(test)} == {
        frozenset({"C_CXY", "CV_XXX"}),
        frozenset({"E_C(0Y)X", "T_X1"}),
    }


def test_three_feeds_distinguish_it_from_the_lag_of_the_servo() -> None:
    runs = [run(f"{force:g}-{feed:g}", force, feed) for force in (100.0, 490.0, 742.0) for feed in (10.0, 30.0, 90.0)]
    test = bar(with_travel(), runs, *LAG)
    assert rank_of(test) == len(LAG)
    truth = {"C_XXX": 6e-5, "C_CXY": -3e-8, "E_C(0Y)X": 2e-5, "T_X1": 1e-4, "CV_XXX": 1e-7}
    found = identify(simulate(test, truth, Imperfection(noise=1e-5), exact=False, seed=2))
    for name, value in truth.items():
        low, high = found[name].interval
        assert low < value < high
        assert found[name].value == pytest.approx(value, rel=0.02)


def test_two_directions_at_one_feed_distinguish_them_as_well() -> None:
    runs = [run(f"{force:g}{sense}", force, sense=sense) for force in (100.0, 742.0) for sense in (1, -1)]
    assert rank_of(bar(with_travel(), runs, *LAG)) == len(LAG)


def test_a_run_has_the_feed_of_the_set_up_unless_it_says_its_own() -> None:
    test = bar(with_travel(), [run("a", F), run("b", F, feed=2 * V)], "C_XXX")
    slow, fast = test.observations()
    assert_allclose(fast.velocity, 2 * slow.velocity)
    assert_allclose(fast.acceleration, 4 * slow.acceleration)
    assert_allclose(replace(fast, run="a").wrench, slow.wrench)
