"""Topology strings: both spellings, both branches, and what is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from elastogeo.errors import MachineError
from elastogeo.machine import AXIS_ORDER, Joint, Machine, Topology, parse_topology

axis_orders = st.permutations(list(AXIS_ORDER)).flatmap(
    lambda axes: st.tuples(st.integers(1, 6), st.integers(0, 6)).map(
        lambda cut: Topology(tuple(axes[: min(cut[1], cut[0])]), tuple(axes[min(cut[1], cut[0]) : cut[0]]))
    )
)


@pytest.mark.parametrize(
    ("text", "workpiece", "tool"),
    [
        ("wCAFYXZSt", "CA", "YXZS"),
        ("wCAYfXZt", "CAY", "XZ"),
        ("wFYXt", "", "YX"),
        ("wXYFt", "XY", ""),
        ("[w C' A' b Y X Z (C1) t]", "CA", "YXZS"),
        ("[w C’ A′ F Y X Z (C) t]", "CA", "YXZS"),  # typographic primes, as papers print them
        ("  [w b Y X t]  ", "", "YX"),
        ("[w X' Y' b t]", "XY", ""),
    ],
)
def test_both_spellings_are_read(text: str, workpiece: str, tool: str) -> None:
    assert parse_topology(text) == Topology(tuple(workpiece), tuple(tool))


@given(topology=axis_orders)
def test_both_spellings_round_trip(topology: Topology) -> None:
    assert parse_topology(topology.compact) == topology
    assert parse_topology(topology.iso) == topology


def test_spellings_are_those_of_the_thesis_and_of_iso_10791() -> None:
    topology = parse_topology("wCAbYXZSt")
    assert topology.compact == "wCAFYXZSt"
    assert topology.iso == "[w C' A' b Y X Z (C1) t]"
    assert topology.axes == ("C", "A", "Y", "X", "Z", "S")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "must begin with w"),
        ("CAFYXt", "must begin with w"),
        ("wCAFYXZ", "end with t"),
        ("wt", "must begin with w"),
        ("wCAYXt", "names the foundation .* 0 times"),
        ("wCFAFYXt", "names the foundation .* 2 times"),
        ("[w X' fb Y t]", "names the foundation .* 0 times"),
        ("wFYQt", "'Q' is no axis; axes are X Y Z"),
        ("wFYyt", "'y' is no axis"),
        ("wXFYXt", "names the axis X 2 times"),
        ("wFt", "has no axis"),
        ("[w C' A' b Y X t", "no closing bracket"),
        ("[w b Y' X t]", '"Y\'" is no axis'),
        ("[]", "must begin with w"),
    ],
)
def test_what_is_no_topology_is_refused_with_the_text_that_arrived(text: str, message: str) -> None:
    with pytest.raises(MachineError, match=message) as error:
        parse_topology(text)
    assert repr(text) in str(error.value)


def test_a_machine_has_one_joint_per_axis_and_a_rigid_spindle() -> None:
    machine = Machine("m", parse_topology("wCAFYXZSt"))
    assert [joint.name for joint in machine.compliant] == ["X", "Y", "Z", "A", "C"]
    assert [machine.in_tool_branch(axis) for axis in machine.axes] == [False, False, True, True, True, True]
    assert [joint.is_rotary for joint in machine.joints] == [True, True, False, False, False, True]


@pytest.mark.parametrize(
    ("joints", "tool", "message"),
    [
        ((Joint("Y"), Joint("X")), (0.0, 0.0, 0.0), "wants .*'X', 'Y'.* in this order"),
        ((Joint("X"),), (0.0, 0.0, 0.0), "the joints are"),
        ((Joint("X", offset=(float("nan"), 0.0, 0.0)), Joint("Y")), (0.0, 0.0, 0.0), "axis X: offset and tilt"),
        ((Joint("X"), Joint("Y", tilt=(0.0, float("inf"), 0.0))), (0.0, 0.0, 0.0), "axis Y: offset and tilt"),
        ((Joint("X", travel=(5.0, 5.0)), Joint("Y")), (0.0, 0.0, 0.0), "axis X: travel 5 to 5 is empty"),
        ((Joint("X", travel=(float("nan"), 5.0)), Joint("Y")), (0.0, 0.0, 0.0), "travel nan to 5 is empty"),
        ((Joint("X"), Joint("Y")), (0.0, float("nan"), 0.0), "the tool point must be three finite numbers"),
    ],
)
def test_a_machine_that_contradicts_itself_is_refused(joints: tuple, tool: tuple, message: str) -> None:
    with pytest.raises(MachineError, match=message):
        Machine("m", parse_topology("wFXYt"), joints, tool)


def test_an_unknown_axis_is_named() -> None:
    with pytest.raises(MachineError, match=r"'m' \(wFXYt\) has no axis 'Z'"):
        Machine("m", parse_topology("wFXYt")).index("Z")
