"""Deviation along a path against a cut that is simulated by exact products of transforms, on a machine that is known."""

import json
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import InputError
from elastogeo.identification import Identification
from elastogeo.machine import (
    ConstantForce,
    Cut,
    Line,
    Machine,
    Program,
    Rapid,
    ToolPath,
    Workpiece,
    measured_tool,
    parse_topology,
    path_of_commands,
)
from elastogeo.prediction import DEVIATION_COMPONENTS, Piece, knowledge_of, path_deviation, simulated_points
from tests.prediction.loaded_circle import CONFOUNDED, TRUTH, identified


@pytest.fixture(scope="module")
def result() -> Identification:
    return identified(noise=2e-5)


def pocket(machine: Machine, points: int = 50) -> ToolPath:
    """A square with a plunge at its end, within the tested circle."""
    corners = np.array([[60.0, -60, 0], [60, 60, 0], [-60, 60, 0], [-60, -60, 0], [60, -60, 0], [60, -60, -5]])
    part = np.linspace(0, 1, points, endpoint=False)[:, np.newaxis]
    sides = [start + part * (end - start) for start, end in pairwise(corners)]
    way = np.vstack([*sides, corners[-1:]])
    commands = np.zeros((len(way), len(machine.axes)))
    for letter, column in zip("XYZ", way.T, strict=True):
        commands[:, machine.index(letter)] = column
    return path_of_commands(machine, commands, feed=1000 / 60, block=np.minimum(np.arange(len(way)) // points, 4))


CUT = Cut(ConstantForce((-100.0, 300.0, 0.0), "path", relative_uncertainty=0.05), measured_tool(2e-5, 0.0, 0.1))


def test_it_is_where_the_exact_cut_goes(result: Identification) -> None:
    path = pocket(result.campaign.machine)
    found = path_deviation(result, path, CUT)
    real = simulated_points(TRUTH, path, CUT) - path.points
    assert found.supported[:, :2].all()
    assert found.value[:, :2] == pytest.approx(real[:, :2], abs=5e-5)
    normal = np.einsum("mi,mi->m", np.nan_to_num(path.left), real)
    along = np.isfinite(found.value[:, 3])
    assert along.sum() == 201  # the plunge has no normal
    assert found.value[along, 3] == pytest.approx(normal[along], abs=5e-5)
    assert np.abs(real).max() > 0.02


def test_nothing_is_predicted_where_nothing_was_asked(result: Identification) -> None:
    """The circle asked for nothing that moves z: no value, no interval, and the verdict says so."""
    found = path_deviation(result, pocket(result.campaign.machine), CUT)
    assert np.isnan(found.value[:, 2]).all()
    assert np.isnan(found.expanded[:, 2]).all()
    assert not found.supported[:, 2].any()
    said = {check.name: check for check in found.verdict}
    assert said["path supported"].facts["not_asked"] == ["z"]
    assert said["path supported"].passed


def test_what_the_circle_cannot_tell_has_no_value_and_no_interval() -> None:
    """A purely radial force shows C_XY + C_YX only: what a force does across itself is not known, along itself it is."""
    result = identified(noise=2e-5, parameters=CONFOUNDED)
    found = path_deviation(result, pocket(result.campaign.machine), Cut(ConstantForce((300.0, 0.0, 0.0))))
    assert found.supported[:, 0].all()
    assert not found.supported[:, 1].any()
    assert (found.unsupported[:, 1] > 0.05).all()
    assert np.isnan(found.value[:, 1]).all()
    assert np.isnan(found.expanded[:, 1]).all()
    said = {check.name: check for check in found.verdict}["path supported"]
    assert (said.passed, said.decisive, said.facts["supported"]) == (False, True, 0)
    by_prior = path_deviation(result, found.path, Cut(ConstantForce((300.0, 0.0, 0.0))), prior=True)
    assert np.isfinite(by_prior.expanded[:, 1]).all()
    assert (by_prior.prior_share[:, 1] > 0.5).all()
    assert not by_prior.supported[:, 1].any()


def test_the_parts_add_up_both_ways(result: Identification) -> None:
    found = path_deviation(result, pocket(result.campaign.machine), CUT)
    xy = np.s_[:, :2]
    parts = {name: part.value[xy] for name, part in found.parts.items()}
    assert parts["geometry"] + parts["compliance"] + parts["tool"] == pytest.approx(found.value[xy], abs=1e-12)
    assert parts["spindle side"] + parts["workpiece side"] + parts["tool"] == pytest.approx(found.value[xy], abs=1e-12)
    unloaded = path_deviation(result, found.path, split=False)
    assert parts["geometry"] == pytest.approx(unloaded.value[xy], abs=1e-12)
    assert unloaded.parts == {}


def test_force_and_tool_widen_the_interval_by_their_own_uncertainty(result: Identification) -> None:
    path = pocket(result.campaign.machine)
    sure = Cut(replace(CUT.force, relative_uncertainty=0.0), measured_tool(2e-5))
    bare, wide = path_deviation(result, path, sure), path_deviation(result, path, CUT)
    by_force = 0.05 * (wide.parts["compliance"].value + wide.parts["tool"].value)
    by_tool = 0.1 * wide.parts["tool"].value
    expected = np.sqrt(bare.standard_uncertainty**2 + by_force**2 + by_tool**2)[:, :2]
    assert wide.standard_uncertainty[:, :2] == pytest.approx(expected)


def test_a_heavy_workpiece_loads_the_table_and_no_more(result: Identification) -> None:
    """No compliance of the table was asked for: its weight does nothing that is predicted."""
    path = pocket(result.campaign.machine)
    heavy = path_deviation(result, path, Cut(workpiece=Workpiece(0.5)), split=False)
    assert heavy.value[:, :2] == pytest.approx(path_deviation(result, path, split=False).value[:, :2])


def test_the_doors_take_programs_arrays_and_three_numbers(result: Identification) -> None:
    machine = result.campaign.machine
    program = Program("edge", [Rapid({"X": -50.0, "Y": 0.0}), Line({"X": 50.0}, 10.0)])
    by_program = eg.predict(result, program, force=(0.0, 200.0, 0.0), along="path", step=10.0)
    commands = np.zeros((10, len(machine.axes)))
    commands[:, machine.index("X")] = np.linspace(-40, 50, 10)
    by_array = eg.predict(result, commands, force=ConstantForce((0.0, 200.0, 0.0)), feed=10.0)
    assert by_program.value[:, [0, 1, 3]] == pytest.approx(by_array.value[:, [0, 1, 3]])
    with pytest.raises(InputError, match="three numbers in N, along x, y and z; 2 arrived"):
        eg.predict(result, commands, force=(0.0, 200.0))
    other = path_of_commands(Machine("three", parse_topology("wFXYZt")), np.eye(3))
    with pytest.raises(InputError, match="the path is of machine 'three', the tests are of 'Hermle C50'"):
        eg.predict(result, other)


def test_what_is_shown_is_the_result(result: Identification) -> None:
    found = path_deviation(result, pocket(result.campaign.machine, 20), CUT)
    shown = str(found)
    assert "normal to the path" in shown
    document = json.loads(found.to_json())
    assert document["schema"] == "elastogeo.path-prediction/1"
    first = document["points"][0]
    assert first["deviation_um"][:2] == pytest.approx((found.value[0, :2] * 1e3).tolist())
    assert first["deviation_um"][2] is None
    assert first["interval95_um"][2] is None
    assert len(first["deviation_um"]) == len(DEVIATION_COMPONENTS)
    assert all(check["sentence"] for check in document["verdict"])


def test_a_probed_workpiece_takes_off_a_rigid_motion_and_no_load(result: Identification) -> None:
    """The exact cut less the turn and shift that fit the exact unloaded machine best, by singular values."""
    path = pocket(result.campaign.machine)
    found = path_deviation(result, path, CUT, datum="probed")
    off = simulated_points(TRUTH, path) - path.points
    before = path.points - path.points.mean(axis=0)
    left, _, right = np.linalg.svd(before.T @ (before + off - off.mean(axis=0)))
    rigid = before @ (left @ right) - before + off.mean(axis=0)
    real = simulated_points(TRUTH, path, CUT) - path.points - rigid
    assert found.value[:, :2] == pytest.approx(real[:, :2], abs=1e-4)
    assert found.parts["geometry"].value[:, :2].mean(axis=0) == pytest.approx([0.0, 0.0], abs=1e-9)
    absolute = path_deviation(result, path, CUT)
    assert np.abs(absolute.value[:, :2] - found.value[:, :2]).max() > 2e-3
    assert absolute.parts["compliance"].value[:, :2] == pytest.approx(found.parts["compliance"].value[:, :2])
    with pytest.raises(InputError, match="the workpiece sits as 'table' says; write machine or probed"):
        path_deviation(result, path, datum="table")  # type: ignore[arg-type]


def test_a_dense_path_is_predicted_as_each_of_its_points(result: Identification) -> None:
    """Where many points are found of a few, and degrees of freedom between knots, they are those of each point by itself."""
    machine = result.campaign.machine
    turn = np.linspace(0, 3.0, 4001)
    commands = np.zeros((len(turn), len(machine.axes)))
    commands[:, machine.index("X")] = 80 * np.cos(turn) + 20 * np.sign(np.sin(9 * turn))
    commands[:, machine.index("Y")] = 90 * np.sin(turn)
    path = path_of_commands(machine, commands, feed=10.0)
    found = path_deviation(result, path, CUT, split=False)
    some = np.arange(1, 4000, 37)
    knowledge = knowledge_of(result)
    asked = Piece(path, CUT, some).functionals(knowledge)
    alone = knowledge.predict(asked.reshape(-1, asked.shape[2]))
    tool = Piece(path, CUT, some).tool_deflection()
    each = {name: getattr(alone, name).reshape(4, -1).T[:, :2] for name in ("value", "supported", "standard_uncertainty")}
    assert found.supported[some, :2].tolist() == each["supported"].tolist()
    assert found.value[some, :2] == pytest.approx(each["value"] + tool[:, :2], rel=1e-9)
    bare = path_deviation(result, path, Cut(CUT.force and replace(CUT.force, relative_uncertainty=0.0)), split=False)
    assert bare.standard_uncertainty[some, :2] == pytest.approx(each["standard_uncertainty"], rel=1e-7)
    assert bare.degrees_of_freedom[some, :2] == pytest.approx(alone.degrees_of_freedom.reshape(4, -1).T[:, :2], rel=5e-3)
