"""A probe across one joint tells what no test between tool and workpiece can: ranks of `reference/planning.md`.

Those figures were derived twice, by another program and by exact elimination; here the tests are campaigns as they would be
made: forces along X, Y, Z at random places of the travel, three probes at the tool, then a probe across carriage X.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from elastogeo.errors import InputError, MachineError
from elastogeo.estimate import Confounding
from elastogeo.formats import find_machine
from elastogeo.identification import Explanation, explain, identify
from elastogeo.machine import Array, Machine
from elastogeo.observe import Imperfection, JointProbe, MachineTest, Question, Run, Sensor, SensorFrame, Setup
from elastogeo.report import view_of
from elastogeo.sources import exact_response, linear_response, select_sources, simulate

PLACES = 40
FORCE = 500.0
AXES = np.eye(3)
TRAVEL = {"X": (-400, 400), "Y": (-400, 400), "Z": (-300, 300), "A": (-1.5, 1.5), "C": (-3.0, 3.0)}


@cache
def hermle() -> Machine:
    return find_machine("hermle_c50", Path())


def static_test(setup: Setup, seed: int) -> MachineTest:
    """A run at each of some random places: forces along X, Y and Z."""
    random = np.random.default_rng(seed)
    runs = []
    for place in range(PLACES):
        at = {axis.lower(): np.full(3, random.uniform(*TRAVEL[axis])) for axis in TRAVEL}
        forces = {f"force_{axis}": FORCE * row for axis, row in zip("xyz", AXES, strict=True)}
        readings = {name: np.zeros(3) for name in setup.quantities if name.startswith("displacement")}
        runs.append(Run(f"{place}", {**at, **forces, **readings}))
    return MachineTest("static", hermle(), setup, tuple(runs))


@cache
def at_the_tool() -> MachineTest:
    return static_test(SensorFrame(tuple(Sensor((0, 0, 0), tuple(row)) for row in AXES)), 1)


def across_x(direction: Array, point: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> MachineTest:
    return static_test(JointProbe(("X",), tuple(direction), point), 2)


def found(tests: Mapping[str, MachineTest]) -> Confounding:
    return explain(tests, parameters=["C_*"]).confounding


@cache
def with_a_probe() -> Explanation:
    return explain({"tool": at_the_tool(), "x": across_x(AXES[0])}, parameters=["C_*"])


def test_static_forces_and_probes_at_the_tool_see_91_of_180() -> None:
    explained = explain(at_the_tool(), parameters=["C_*"])
    tool = explained.confounding
    assert (len(tool.labels), tool.rank) == (180, 91)
    (group,) = [group for group in tool.groups if "C_XXX" in group]
    assert {"C_XXX", "C_XXY", "C_XXZ"} <= set(group)
    (said,) = [note for note in view_of(explained).notes if note.startswith("No test between tool and workpiece")]
    assert "distinguishes C_XXX, C_XXY, C_XXZ and C_XXA, nor" in said
    assert "what moves between them changes neither a translation in x nor a force in x" in said
    assert "A displacement probe across X, along x of its carriage's frame and at that frame's origin (joint-probe)" in said
    (bounded,) = [note for note in view_of(explained).notes if note.startswith("Of 180 compliances")]
    assert "91 combinations are determined" in bounded
    assert "tell at most 91 (with the tools of these tests), any test between tool and workpiece at most 123" in bounded


def test_a_probe_across_x_at_its_origin_makes_the_compliance_of_x_exact() -> None:
    """96: a column for each of five loads of X; with one tool on the spindle's axis none of them is a moment about z."""
    result = with_a_probe().confounding
    assert result.rank == 96
    assert result.stands_for("C_XXX") == {"C_XXX": 1.0}
    (rest,) = [label for label in result.retained if "C_XXY" in result.stands_for(label)]
    assert {"C_XXY", "C_XXZ", "C_XXA"} <= set(result.stands_for(rest))
    assert "C_XXX" not in result.stands_for(rest)
    (said,) = [note for note in view_of(with_a_probe()).notes if note.startswith("No test between tool and workpiece")]
    assert "distinguishes C_XXY, C_XXZ and C_XXA, nor" in said
    assert not any("at most" in note for note in view_of(with_a_probe()).notes)  # such tests are no longer all at the tool


def test_what_was_not_asked_for_counts_as_rigid_and_is_in_what_was() -> None:
    said = [note for note in view_of(explain(at_the_tool(), parameters=["C_XXX", "C_YYY"])).notes if "not asked for" in note]
    assert said == [
        "C_XXY, C_XXZ and C_XXA were not asked for, and so taken as rigid. No test between tool and workpiece tells them "
        "from C_XXX: what they give is in C_XXX. So with 1 more."
    ]
    across = explain({"tool": at_the_tool(), "x": across_x(AXES[0])}, parameters=["C_XXX", "C_YYY"])
    assert not [note for note in view_of(across).notes if "not asked for" in note]


def test_of_symmetric_joints_fewer_are_unknown_and_the_ceilings_are_theirs() -> None:
    explained = explain(at_the_tool(), parameters=["C_*"], reciprocal=True)
    assert (len(explained.confounding.labels), explained.confounding.rank) == (105, 56)
    notes = view_of(explained).notes
    assert any("105 compliances, 56 combinations are determined" in note and "at most 73" in note for note in notes)
    (said,) = [note for note in notes if note.startswith("No test between tool and workpiece")]
    assert "distinguishes C_XXX, C_XXY, C_XXZ and C_XXA" in said


def test_three_directions_see_106() -> None:
    assert found({"tool": at_the_tool(), **{axis: across_x(row) for axis, row in zip("xyz", AXES, strict=True)}}).rank == 106


def test_at_another_point_the_rotations_of_x_enter() -> None:
    result = found({"tool": at_the_tool(), "x": across_x(AXES[0], (0.0, 70.0, 50.0))})
    assert result.rank > 91
    assert result.stands_for("C_XXX")["C_CXX"] == pytest.approx(-70.0)  # about z, at y = 70 mm


def test_six_readings_across_x_see_its_whole_twist() -> None:
    points = [(0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 90, 0), (0, 0, 90), (90, 0, 0)]
    rows = [AXES[0], AXES[1], AXES[2], AXES[0], AXES[1], AXES[2]]
    # rotation about z moves x at (0, 90, 0), about x y at (0, 0, 90), about y z at (90, 0, 0)
    probes = {f"x{k}": across_x(row, point) for k, (row, point) in enumerate(zip(rows, points, strict=True))}
    assert found({"tool": at_the_tool(), **probes}).rank == 116


def test_one_probe_finds_the_joint_that_a_test_at_the_tool_finds_in_a_sum() -> None:
    """Two heights of Z, so that the lever of the force changes and C_XBX is told from C_XXX."""
    machine = hermle()
    truth = {"C_XXX": 6e-5, "C_XBX": 1e-8, "C_XXY": 4e-5, "C_BBX": 1e-10, "C_XXA": 2e-5}
    ramp = {"force": np.tile(np.linspace(0.0, FORCE, 12), 2)}
    runs = tuple(Run(f"{z} {k}", {**ramp, "z": np.full(24, float(z))}) for z in (-150, 150) for k in range(3))
    question = Question(("C_XXX", "C_XBX", "E_R0"))
    planned = MachineTest("probe", machine, JointProbe(("X",), (1, 0, 0), direction=(1, 0, 0)), runs, question)
    result = identify(simulate(planned, truth, Imperfection(noise=5e-5), seed=4))
    for name in ("C_XXX", "C_XBX"):
        low, high = result[name].interval
        assert low <= truth[name] <= high
        assert high - low < 0.1 * truth[name]


def test_bad_set_ups_are_refused() -> None:
    columns = {"force": np.ones(3), "displacement": np.zeros(3)}
    good = JointProbe(("X",), (1, 0, 0), direction=(1, 0, 0))
    assert good.observe(hermle(), Run("one", columns)).span == ("X",)
    with pytest.raises(InputError, match=r"reads across Y Z; from the first .* has Y X Z: name each of these once"):
        replace(good, across=("Y", "Z")).observe(hermle(), Run("one", columns))
    with pytest.raises(InputError, match="has no axis 'B'"):
        replace(good, across=("B",)).observe(hermle(), Run("one", columns))
    with pytest.raises(InputError, match=r'the probe reads across no joint; say across = \["X"\]'):
        replace(good, across=())
    with pytest.raises(InputError, match="the direction of the sensor is"):
        replace(good, sensor=(0, 0, 0))
    with pytest.raises(InputError, match="the point of the probe is"):
        replace(good, point=(0.0, float("nan"), 0.0))
    with pytest.raises(InputError, match="displacement reaches 60 mm; are they micrometres"):
        good.observe(hermle(), Run("one", {**columns, "displacement": np.full(3, 60.0)}))
    with pytest.raises(MachineError, match="the command of axis Z at pose 1 is nan"):
        good.observe(hermle(), Run("one", {**columns, "z": np.array([0.0, np.nan, 0.0])}))


@pytest.mark.parametrize("across", [("X",), ("X", "Y"), ("A", "Y", "X")], ids="".join)
def test_only_the_joints_of_the_span_move_the_reading(across: tuple[str, ...]) -> None:
    """Both the linear model and the exact one: no other joint, no offset of an end."""
    machine = hermle()
    columns = {"force_x": np.full(2, 200.0), "force_y": np.full(2, -90.0), "force_z": np.full(2, 50.0)}
    setup = JointProbe(across, (1, 2, -1), (40, 10, -30), pose={"A": 0.4, "C": 1.0, "Z": 60.0})
    observed = setup.observe(machine, Run("one", {**columns, "displacement": np.zeros(2)}))
    moving = set()
    for name in ("C_XXX", "C_YXY", "C_YYZ", "C_ZZA", "C_XXC", "E_Xt0", "E_Zw0", "E_B(0)A"):
        (source,) = select_sources(machine, [name])
        linear = linear_response({source: 1e-5}, machine, observed)
        exact = exact_response({source: 1e-5}, machine, observed)
        assert np.abs(linear - exact).max() <= 1e-3 * np.abs(linear).max() + 1e-13
        if linear.any():
            moving.add(source.site[1])
    assert moving == set(across)
