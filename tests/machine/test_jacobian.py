"""The geometric Jacobian against an independent library, the thesis, and what physics demands whatever the machine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from elastogeo.errors import MachineError
from elastogeo.machine import (
    AXIS_ORDER,
    COMPONENTS,
    Array,
    Joint,
    Machine,
    Topology,
    jacobian,
    loop_frames,
    parse_topology,
    rotation_matrix,
)
from elastogeo.observe import MachineTest, Observations
from elastogeo.sources import Situation, exact_response, linear_response, parameter_values, select_sources
from tests.machine.pinocchio_loop import TOPOLOGIES, pinocchio_jacobian


@pytest.mark.parametrize("angle", [0.0, 1e-300, 1e-9, 1e-5, 0.3, np.pi, 2 * np.pi - 1e-9, 7.0])
def test_a_rotation_vector_of_any_size_is_turned_exactly(angle: float) -> None:
    axes = np.random.default_rng(3).standard_normal((20, 3))
    vectors = angle * axes / np.linalg.norm(axes, axis=1)[:, np.newaxis]
    assert_allclose(rotation_matrix(vectors), [pin.exp3(vector) for vector in vectors], rtol=0, atol=2e-15)


@pytest.mark.parametrize("topology", TOPOLOGIES)
def test_jacobian_agrees_with_pinocchio(topology: str, make_machine: Callable[..., Machine]) -> None:
    machine = make_machine(topology, tool=(12.0, -30.0, -250.0), seed=len(topology))
    random = np.random.default_rng(1)
    scale = np.array([2.0 if joint.is_rotary else 400.0 for joint in machine.joints])
    commands = random.uniform(-1, 1, (5, len(machine.axes))) * scale
    J = jacobian(machine, commands)
    points = loop_frames(machine, commands).point
    assert J.shape == (5, 6, 6 * len(machine.axes))
    for i, pose in enumerate(commands):
        expected, tool = pinocchio_jacobian(machine, pose)
        assert_allclose(J[i], expected, atol=1e-9)
        assert_allclose(np.broadcast_to(points, (5, 3))[i], tool, atol=1e-9)


def test_jacobian_is_eq_4_21_for_the_two_axes_of_the_thesis(make_machine: Callable[..., Machine]) -> None:
    tx, ty = -35.0, -71.0
    machine = make_machine("wFYXt", tool=(tx, ty, 0.0))
    for x, y in ((0.0, 0.0), (120.0, -88.0), (-149.0, 3.0)):
        J = jacobian(machine, np.array([[y, x]]))[0]
        planar = [COMPONENTS.index(c) for c in "XYC"]
        of_x, of_y = ([6 * machine.index(axis) + k for k in planar] for axis in "XY")
        expected = [[1, 0, -ty, 1, 0, -ty], [0, 1, tx, 0, 1, x + tx], [0, 0, 1, 0, 0, 1]]
        assert_allclose(J[np.ix_(planar, of_x + of_y)], expected, atol=1e-12)


@pytest.fixture(scope="module")
def some_observed(make_test: Callable[..., MachineTest]) -> Observations:
    return make_test("wFYXt").observations()[0]


@given(
    axes=st.permutations(list(AXIS_ORDER)),
    count=st.integers(1, 6),
    cut=st.integers(0, 6),
    seed=st.integers(0, 10**6),
)
def test_virtual_work(
    axes: list[str],
    count: int,
    cut: int,
    seed: int,
    make_machine: Callable[..., Machine],
    some_observed: Observations,
) -> None:
    """The work of the wrench on what the joints' twists do at the tool is that of the joint loads on the twists."""
    topology = Topology(tuple(axes[: min(cut, count)]), tuple(axes[min(cut, count) : count]))
    machine = make_machine(topology.compact, tool=(5.0, 6.0, -7.0), seed=seed)
    random = np.random.default_rng(seed)
    commands = random.uniform(-2, 2, (3, count))
    wrench, twists = random.standard_normal((3, 6)), random.standard_normal((3, 6 * count))
    J = jacobian(machine, commands)
    loads = np.hstack([loads_at(machine, commands, wrench, some_observed).load(axis) for axis in machine.axes])
    at_tool = np.einsum("mi,mij,mj->m", wrench, J, twists)
    at_joints = np.einsum("mj,mj->m", loads, twists)
    assert_allclose(at_tool, at_joints, rtol=1e-9, atol=1e-9 * np.abs(loads).max())


def loads_at(machine: Machine, commands: Array, wrench: Array, any_observed: Observations) -> Situation:
    """The situation of a wrench at some poses; nothing else of the observations matters to the loads."""
    observed = replace(
        any_observed,
        commands=commands,
        direction=wrench,
        wrench=wrench,
        reading=np.zeros(len(commands)),
        tool=np.array(machine.tool),
    )
    return Situation(machine, observed)


@pytest.mark.parametrize("topology", ["wCAFYXZSt", "wCAYfXZt", "wCBXFYZt"])
def test_response_is_b_J_C_Jt_W(
    topology: str, make_machine: Callable[..., Machine], make_test: Callable[..., MachineTest]
) -> None:
    """Eq. 4.13 written out with full matrices; springs in series add: the sum runs over the joints."""
    machine = make_machine(topology, tool=(3.0, -4.0, -120.0), seed=4)
    test = make_test(machine, [250.0], readings=12)
    (observed,) = test.observations()
    random = np.random.default_rng(2)
    blocks = {joint.name: random.standard_normal((6, 6)) for joint in machine.compliant}
    J = jacobian(machine, observed.commands)
    b, W = observed.direction, observed.wrench
    expected = np.zeros(len(observed))
    for axis, block in blocks.items():
        k = 6 * machine.index(axis)
        joint = J[:, :, k : k + 6]
        expected += np.einsum("ma,maj,jk,mbk,mb->m", b, joint, block, joint, W)
    values = {
        f"C_{d}{f}{axis}": block[i, j]
        for axis, block in blocks.items()
        for i, d in enumerate(COMPONENTS)
        for j, f in enumerate(COMPONENTS)
    }
    assert_allclose(linear_response(parameter_values(machine, values), machine, observed), expected, rtol=1e-11)


def test_two_springs_in_series_are_one_of_their_sum(
    make_machine: Callable[..., Machine], make_test: Callable[..., MachineTest]
) -> None:
    """Joints whose frames coincide: C_t = J C J^T adds them up, in whichever joint each is."""
    machine = make_machine("wFBYXZCt", tool=(20.0, 10.0, -90.0))
    test = make_test(machine, [300.0], readings=16)
    (observed,) = test.observations()
    # Z and C stand still at the tool's carriage: their motion frames coincide with that of X.
    one = linear_response(parameter_values(machine, {"C_XYX": 3e-5, "C_CXX": 4e-8}), machine, observed)
    split = {"C_XYX": 1e-5, "C_XYZ": 1.5e-5, "C_XYC": 0.5e-5, "C_CXX": 1e-8, "C_CXC": 3e-8}
    assert np.ptp(one) > 1e-3
    assert_allclose(linear_response(parameter_values(machine, split), machine, observed), one, rtol=1e-12)


def test_a_rigid_machine_reads_nothing_and_a_stiff_one_little(make_test: Callable[..., MachineTest]) -> None:
    test = make_test("wCAFYXZSt", [700.0])
    (observed,) = test.observations()
    sources = select_sources(test.machine, ["C_*"])
    rigid = dict.fromkeys(sources, 0.0)
    assert not linear_response(rigid, test.machine, observed).any()
    assert np.abs(exact_response(rigid, test.machine, observed)).max() < 1e-12
    # Towards the rigid limit the exact response becomes the linear one, with an error that falls with the square.
    errors = []
    for softness in (1e-6, 1e-7):
        values = dict.fromkeys(sources, softness * 1e-2)
        exact, linear = (r(values, test.machine, observed) for r in (exact_response, linear_response))
        errors.append(np.abs(exact - linear).max() / softness**2)
        assert np.abs(exact - linear).max() < 0.01 * np.abs(linear).max()
    assert errors[1] == pytest.approx(errors[0], rel=0.1)


def test_both_spellings_make_the_same_machine() -> None:
    commands = np.array([[0.3, -0.2, 10.0, -20.0, 30.0, 0.0]])
    compact, iso = (Machine("m", parse_topology(text)) for text in ("wCAFYXZSt", "[w C' A' b Y X Z (C1) t]"))
    assert compact == iso
    np.testing.assert_array_equal(jacobian(compact, commands), jacobian(iso, commands))


def test_a_pure_change_of_link_frames_changes_no_response(make_test: Callable[..., MachineTest]) -> None:
    """The offset of a linear axis along its own travel, or a shifted centre, is no physics: the tool sees the same."""
    plain = make_test("wFYXt", [100.0]).machine
    moved = Machine("moved", plain.topology, (Joint("Y", offset=(70.0, 80.0, 90.0)), Joint("X")))
    responses = []
    for machine in (plain, moved):
        test = make_test(machine, [100.0])
        (observed,) = test.observations()
        values = parameter_values(machine, {"C_XXX": 1e-4, "C_CCY": 1e-8, "C_CXY": 1e-6})
        responses.append(linear_response(values, machine, observed))
    assert_allclose(responses[0], responses[1], atol=1e-15)


@pytest.mark.parametrize(
    ("commands", "message"),
    [
        (np.zeros((3, 3)), r"must have the shape \(m, 2\).*got \(3, 3\)"),
        (np.zeros((0, 2)), r"got \(0, 2\)"),
        (np.array([[0.0, 0.0], [0.0, np.nan]]), "the command of axis X at pose 1 is nan"),
        (np.array([[np.inf, 0.0]]), "the command of axis Y at pose 0 is inf"),
    ],
)
def test_commands_that_will_not_do_are_refused(commands: Array, message: str, make_machine: Callable[..., Machine]) -> None:
    with pytest.raises(MachineError, match=message):
        jacobian(make_machine("wFYXt"), commands)
