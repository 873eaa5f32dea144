"""Compliant places that are no axis: their columns by hand, what they are confounded with, and what separates them.

The machine is wFYXZt: the holder sits 100 mm below the origin of Z's carriage, and the tool point 250 mm below. A force
along x acts at the tool point, whose displacement along x is read.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import MachineError, SelectionError
from elastogeo.identification import confounding_of, identify, systems_of
from elastogeo.machine import Joint, Machine, Place, Workpiece, loop_frames, parse_topology, weight_loads
from elastogeo.observe import Campaign, Imperfection, MachineTest, Observations, Question, Run
from elastogeo.observe.static_loads.joint_probe import JointProbe
from elastogeo.observe.static_loads.static_force import StaticForce
from elastogeo.planning import ceiling
from elastogeo.sources import (
    design_rows,
    exact_response,
    linear_response,
    parameter_values,
    select_sources,
    simulate,
)

MakeMachine = Callable[..., Machine]
X = (1.0, 0.0, 0.0)
F = np.array([100.0, 200.0, 300.0])
HOLDER = Place("holder", "tool", (0.0, 0.0, -100.0))


def pushed(
    *parameters: str,
    length: float = 250.0,
    machine: Machine | None = None,
    direction: tuple[float, float, float] = X,
    sensor: tuple[float, float, float] | None = None,
    **pose: float,
) -> MachineTest:
    """Forces along a direction at a tool of this length, read along a direction."""
    runs = tuple(Run(f"r{k}", {"force": k * F, "displacement": np.zeros(3)}) for k in (1, 2, 3))
    setup = StaticForce(direction, sensor, pose=pose, tool=(0.0, 0.0, -length))
    return MachineTest("pushed", machine or mill(), setup, runs, Question(parameters or ("C_XXX",)))


def mill(*places: Place) -> Machine:
    return Machine("mill", parse_topology("wFYXZt"), places=places or (HOLDER,))


def rank_of(test: MachineTest | Campaign) -> int:
    return confounding_of(test, systems_of(test)).rank


def campaign(tests: dict[str, MachineTest]) -> Campaign:
    return Campaign("together", tests)


@pytest.mark.parametrize(
    ("name", "per_newton"), {"XX": 1.0, "XB": -150.0, "BX": -150.0, "BB": 150.0**2, "YX": 0.0, "AA": 0.0}.items()
)
def test_a_column_is_what_it_is_by_hand(name: str, per_newton: float) -> None:
    """The lever is (0, 0, -150): the moment is r x F = -150 F about y, and a rotation b about y moves the tool by -150 b."""
    test = pushed()
    observed = test.observations()[0]
    response = linear_response(parameter_values(test.machine, {f"CL_{name}holder": 1.0}), test.machine, observed)
    assert_allclose(response, per_newton * F, rtol=1e-12, atol=1e-9)


def test_a_table_yields_under_the_reaction() -> None:
    """On the workpiece's side both the load and the displacement change sign: a compliance stays positive."""
    machine = Machine("mill", parse_topology("wXFYZt"), places=(Place("table", "workpiece", (0.0, 0.0, -300.0)),))
    test = pushed(machine=machine, length=0.0)
    found = linear_response(parameter_values(machine, {"CL_BBtable": 1.0}), machine, test.observations()[0])
    assert_allclose(found, 300.0**2 * F, rtol=1e-12)


EVERYWHERE = (
    Place("table", "workpiece", (20.0, -30.0, 40.0)),
    Place("trunnion", "A", (0.0, 90.0, -10.0)),
    Place("nose", "Z", (5.0, 0.0, -60.0)),
    Place("holder", "tool", (0.0, 0.0, -120.0)),
)


def posed(machine: Machine) -> MachineTest:
    pose = {"C": 0.7, "A": -0.4, "X": 120.0, "Y": -80.0, "Z": 33.0}
    return pushed(machine=machine, direction=(1.0, -2.0, 0.5), sensor=(0.3, 1.0, -0.8), **pose)


def by_difference(test: MachineTest, observed: Observations, name: str) -> np.ndarray:
    """Derivative of the exact products of transforms."""
    size = 1e-4 / max(
        1e-12, np.abs(linear_response(parameter_values(test.machine, {name: 1.0}), test.machine, observed)).max()
    )
    up, down = (exact_response(parameter_values(test.machine, {name: s * size}), test.machine, observed) for s in (1, -1))
    return (up - down) / (2 * size)


@pytest.mark.parametrize("name", [place.name for place in EVERYWHERE])
def test_columns_are_the_derivatives_of_exact_transforms(name: str, make_machine: MakeMachine) -> None:
    """On either branch, between axes and at the ends, of a machine whose frames stand apart and whose axes are inclined."""
    test = posed(replace(make_machine("wCAFYXZSt", seed=5), places=EVERYWHERE))
    observed = test.observations()[0]
    sources = select_sources(test.machine, [f"CL_*{name}"])
    assert len(sources) == 36
    rows = design_rows(sources, test.machine, observed)
    for k, source in enumerate(sources):
        assert_allclose(by_difference(test, observed, source.name), rows[:, k], rtol=1e-6, atol=1e-9 * np.abs(rows).max())


def test_a_declared_place_that_is_not_asked_for_changes_nothing(make_machine: MakeMachine) -> None:
    rigid = make_machine("wCAFYXZSt", seed=5)
    yielding = replace(rigid, places=EVERYWHERE)
    names = ["C_*", "E_XX1", "E_C(0Y)X", "E_Xw0"]
    one, other = (design_rows(select_sources(m, names), m, posed(m).observations()[0]) for m in (rigid, yielding))
    assert np.array_equal(one, other)


def test_patterns_of_joints_select_no_place() -> None:
    names = [source.name for source in select_sources(mill(), ["compliance", "C_??X", "CQ*", "C[FPNVS]*"])]
    assert not any("holder" in name for name in names)
    assert len([name for name in names if name.startswith("C_")]) == 108
    with pytest.raises(SelectionError, match="'CL_XXholder' selects no error source of wFYXZt"):
        select_sources(Machine("rigid", parse_topology("wFYXZt")), ["CL_XXholder"])


AT = ({}, {"X": 200.0}, {"Y": -150.0, "Z": 90.0}, {"X": -120.0, "Y": 80.0, "A": 0.6}, {"A": -0.5, "C": 0.8, "Z": -70.0})


def columns_of(machine: Machine, *names: str) -> np.ndarray:
    """Columns of unit length for every direction of force and sensor, at five poses, with two tools."""
    blocks = []
    for length, pose, force, sensor in product((250.0, 60.0), AT, np.eye(3), np.eye(3)):
        held = {axis: command for axis, command in pose.items() if axis in machine.axes}
        test = pushed(length=length, machine=machine, direction=tuple(force), sensor=tuple(sensor), **held)
        blocks.append(design_rows(select_sources(machine, names), machine, test.observations()[0])[:1, :-1])
    stacked = np.vstack(blocks)
    return stacked / np.maximum(np.linalg.norm(stacked, axis=0), 1e-300)


def dense_rank(columns: np.ndarray) -> int:
    return int(np.linalg.matrix_rank(columns, tol=1e-9))


def test_no_pose_force_or_tool_distinguishes_a_place_from_the_joint_of_its_carriage() -> None:
    """Between the two is a fixed lever: all 36 of one are sums of the 36 of the other."""
    joint, place = (columns_of(mill(), name) for name in ("C_??Z", "CL_*"))
    assert dense_rank(np.hstack([joint, place])) == dense_rank(joint) == dense_rank(place) > 10
    assert dense_rank(np.hstack([joint, columns_of(mill(), "C_??X")])) > dense_rank(joint)


def test_translations_for_forces_are_those_of_every_joint_with_no_turning_axis_between() -> None:
    """A travelling axis between changes levers, and no force: the holder is then the X carriage. A turning one separates."""
    asked = ("C_XXX", "CL_XXholder")
    joint, place = columns_of(mill(), *asked).T
    assert_allclose(place, joint, atol=1e-15)
    bound = ceiling(mill())
    assert ("C_XXX", "C_XXY", "C_XXZ", "CL_XXholder") in bound.alike(bound.labels)
    assert dense_rank(columns_of(Machine("head", parse_topology("wFYXZCt"), places=(HOLDER,)), *asked)) == 2


def of_lengths(*lengths: float, machine: Machine | None = None) -> Campaign:
    asked = ("C_XXZ", "C_BBZ", "CL_BBholder")
    return campaign({f"{length:.0f}mm": pushed(*asked, length=length, machine=machine) for length in lengths})


def test_tools_of_three_lengths_separate_the_bending_of_a_holder_from_that_of_its_carriage() -> None:
    """`F`, `F L^2` and `F (L - 100)^2` are three functions of the length: one length knows one of them, three all."""
    assert [rank_of(of_lengths(*(250.0, 150.0, 400.0)[:count])) for count in (1, 2, 3)] == [1, 2, 3]
    truth = {"C_XXZ": 5e-5, "C_BBZ": 2e-9, "CL_BBholder": 6e-9}
    tests = of_lengths(250.0, 150.0, 400.0).tests
    noisy = Imperfection(noise=1e-5)
    simulated = {name: simulate(test, truth, noisy, seed=k) for k, (name, test) in enumerate(tests.items())}
    found = identify(campaign(simulated))
    for name, value in truth.items():
        assert found[name].value == pytest.approx(value, rel=0.02)


def test_a_probe_across_the_joint_alone_separates_them() -> None:
    """It sees the joint, and not the place beyond it."""
    runs = tuple(Run(f"r{k}", {"force": k * F, "displacement": np.zeros(3)}) for k in (1, 2))
    probe = MachineTest("probe", mill(), JointProbe(("Z",), X, direction=X), runs, Question(("C_XXZ", "CL_XXholder")))
    alone = confounding_of(probe, systems_of(probe))
    assert alone.null == ("CL_XXholder",)
    assert rank_of(campaign({"probe": probe, "tool": pushed("C_XXZ", "CL_XXholder")})) == 2
    observed = probe.observations()[0]
    seen = exact_response(parameter_values(mill(), {"CL_XXholder": 1e-4}), mill(), observed)
    assert_allclose(seen, 0.0, atol=1e-12)


def test_a_place_between_two_axes_is_seen_by_a_probe_across_the_next() -> None:
    """The nose is on X and carries Z: what spans Z spans it, as one part of the probe stands on the carriage X."""
    machine = mill(Place("nose", "X"))
    runs = (Run("r", {"force": F, "displacement": np.zeros(3)}),)
    for across, sees in ((("Z",), True), (("X",), False)):
        test = MachineTest("probe", machine, JointProbe(across, X, direction=X), runs, Question(("CL_XXnose",)))
        rows = design_rows(select_sources(machine, ["CL_XXnose"]), machine, test.observations()[0])
        assert_allclose(rows[:, 0], F * sees)


def test_weights_load_the_places_that_carry_them() -> None:
    """The carriage Z loads the nose on X, and no holder on itself; a workpiece loads the table, and no post beside it."""
    masses = {"X": 0.05, "Z": 0.02}
    topology = parse_topology("wYFXZt")
    places = (
        Place("nose", "X", (0.0, 0.0, 10.0)),
        HOLDER,
        Place("table", "workpiece", (0.0, 40.0, 0.0)),
        Place("post", "workpiece", carries_workpiece=False),
    )
    joints = tuple(Joint(axis, mass=masses.get(axis, 0.0)) for axis in topology.axes)
    machine = Machine("weighed", topology, joints, places=places)
    loads = weight_loads(machine, loop_frames(machine, np.zeros((1, 3))), Workpiece(0.1, (0.0, 0.0, 0.0)))
    assert set(loads) == {"X", "Z", "Y", "nose", "table"}
    assert_allclose(loads["nose"], [[0, 0, -0.02 * 9806.65, 0, 0, 0]], atol=1e-9)
    # 980.665 N down, at -40 mm along y from the place: M = r x F = (-40 * -980.665, 0, 0)
    assert_allclose(loads["table"], [[0, 0, -980.665, 40 * 980.665, 0, 0]], atol=1e-9)


def test_own_weight_separates_the_joint_from_the_place_on_its_carriage() -> None:
    """The carriage of a tilting head hangs on its joint alone: it sags there, and the place beyond does not feel it."""
    topology = parse_topology("wFAYt")
    asked = ("C_YYY", "CL_YYholder")

    def tilted(mass: float) -> Campaign:
        joints = (Joint("A"), Joint("Y", mass=mass))
        machine = Machine("head", topology, joints, places=(HOLDER,))
        y = (0.0, 1.0, 0.0)
        return campaign({f"{a}": pushed(*asked, machine=machine, direction=y, A=a) for a in (0.0, 0.5)})

    assert [rank_of(tilted(mass)) for mass in (0.0, 0.05)] == [1, 2]


@pytest.mark.parametrize(
    ("places", "said"),
    [
        ((Place("Holder", "tool"),), "place 'Holder': a place is named in small letters"),
        ((Place("tool", "tool"),), "neither tool nor workpiece"),
        ((HOLDER, HOLDER), "declared 2 times"),
        ((Place("nose", "W"),), "it is on 'W', which is no carriage of wFYXZt; write an axis letter, tool or workpiece"),
        ((Place("nose", "Z", (0.0, np.nan, 0.0)),), "the offset must be three finite numbers"),
    ],
)
def test_a_place_that_is_nowhere_is_refused(places: tuple[Place, ...], said: str) -> None:
    with pytest.raises(MachineError, match=said):
        mill(*places)
