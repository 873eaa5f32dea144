"""A contour and a circular slot milled in simulation on a machine with known faults, compensated by identified ones: error
before, after, and predicted after, with intervals. The judge is the exact model, which shares no linear column with it."""

from dataclasses import replace

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import InputError
from elastogeo.formats import example_test, program_text, read_program_bytes
from elastogeo.identification import Identification
from elastogeo.machine import Arc, ConstantForce, Cut, Line, Machine, Program, Rapid, parse_topology, path_of_program
from elastogeo.observe import Imperfection
from elastogeo.prediction import simulated_points
from elastogeo.prediction.compensation import PathCompensation
from elastogeo.sources import simulate
from tests.prediction.loaded_circle import CONFOUNDED, TRUTH, identified

CUT = Cut(ConstantForce((-100.0, 300.0, 0.0), "path"))


MILLING = """\
schema = "elastogeo.cut/1"

[milling]
diameter_mm = 12
teeth = 4
helix_deg = 30
depth_mm = 2
width_mm = 3
speed_rpm = 3000
material = "Al7075-T6"
relative_uncertainty = 0.05

[tool]
relative_uncertainty = 0.1
sections = [
    { length_mm = 26, diameter_mm = 9.6, modulus_GPa = 600 },
    { length_mm = 19, diameter_mm = 12, modulus_GPa = 600 },
]
"""


@pytest.fixture(scope="module")
def result() -> Identification:
    return identified(noise=2e-4)


def slot(radius: float = 50.0) -> Program:
    """A circular slot, both ways round."""
    ring = [Arc("XY", {"X": radius, "Y": 0.0}, (0.0, 0.0), sense, 10.0) for sense in (1, -1)]
    return Program("slot", [Rapid({"X": radius, "Y": 0.0}), *ring])


def contour() -> Program:
    """A square with two rounded corners."""
    moves = [
        Rapid({"X": -60.0, "Y": -60.0}),
        Line({"X": 40.0}, 15.0),
        Arc("XY", {"X": 60.0, "Y": -40.0}, (40.0, -40.0), 1, 8.0),
        Line({"Y": 60.0}, 15.0),
        Line({"X": -40.0}, 15.0),
        Arc("XY", {"X": -60.0, "Y": 40.0}, (-40.0, 40.0), 1, 8.0),
        Line({"Y": -60.0}, 15.0),
    ]
    return Program("contour", moves)


def off(found: PathCompensation, cut: Cut) -> tuple[np.ndarray, np.ndarray]:
    """What the exact model is off the meant path, along x and y, before and after, at the points of the path."""
    path = found.before.path
    before = simulated_points(TRUTH, path, cut) - path.points
    after = simulated_points(TRUTH, replace(path, commands=found.commands), cut) - path.points
    return before[:, :2], after[:, :2]


@pytest.mark.parametrize("program", [slot(), contour()], ids=lambda program: program.name)
@pytest.mark.parametrize("cut", [CUT, Cut()], ids=["cutting", "without force"])
def test_the_error_falls_as_predicted(result, program, cut):
    found = eg.compensate_path(result, program, cut)
    assert found.components == ("x", "y")
    before, after = off(found, cut)
    assert found.before.value[:, :2] == pytest.approx(before, abs=4e-4)
    assert np.abs(after).max() < 0.1 * np.abs(before).max()
    within = np.abs(after - found.value[:, :2]) <= found.expanded[:, :2] + 2e-5  # second order of the exact model
    assert within.mean() > 0.9
    checks = {check.name: check.passed for check in found.verdict}
    assert checks["path corrected"]
    assert checks["deviation falls for sure"]


def test_a_milled_contour_is_nearer_with_the_force_of_a_milling_model_and_a_tool_that_bends(result, tmp_path):
    """Force of a four-fluted cutter in Al7075-T6, a stepped tool: geometry, compliance and tool are compensated together."""
    (tmp_path / "cut.toml").write_text(MILLING, encoding="ascii")
    cut = eg.read_cut(tmp_path / "cut.toml")
    found = eg.compensate_path(result, contour(), cut)
    before, after = off(found, cut)
    stiff, _ = off(found, replace(cut, tool=None))
    assert np.abs(before - stiff).max() > 1e-3  # the tool counts
    assert found.before.value[:, :2] == pytest.approx(before, abs=6e-4)
    assert np.abs(after).max() < 0.1 * np.abs(before).max()
    within = np.abs(after - found.value[:, :2]) <= found.expanded[:, :2] + 2e-5
    assert within.mean() > 0.9


def test_the_new_program_makes_the_commands_that_were_predicted(result):
    """Written as a control has it and read again, its path goes through the corrected points: within its decimals, and the
    tolerance of its lines."""
    found = eg.compensate_path(result, contour(), CUT)
    machine = result.campaign.machine
    again = read_program_bytes(program_text(found.program, "linuxcnc").encode(), "again")
    made = path_of_program(again, machine, 0.05).commands
    xy = [machine.index(axis) for axis in "XY"]
    points = found.commands[:, xy][:: max(len(found.commands) // 200, 1)]
    nearest = np.sqrt(((made[:, np.newaxis, xy] - points) ** 2).sum(axis=2)).min(axis=0)
    assert nearest.max() < 0.026  # half of 0.05 mm along the path
    assert not any(isinstance(block, Arc) for block in found.program.blocks)
    assert len(found.program.blocks) < 400


def test_lines_stay_within_the_tolerance_and_a_straight_error_takes_few(result):
    coarse, fine = (eg.compensate_path(result, slot(), CUT, tolerance=tolerance) for tolerance in (0.005, 0.0005))
    assert len(coarse.program.blocks) < len(fine.program.blocks)
    xy = [result.campaign.machine.index(axis) for axis in "XY"]
    for found in (coarse, fine):
        ideal = found.before.path.commands[:, xy] - found.before.value[:, :2]
        assert np.linalg.norm(found.commands[:, xy] - ideal, axis=1).max() <= found.tolerance * 1.001


def test_what_was_not_asked_or_not_determined_is_not_moved(result):
    """The circle asked for nothing that moves z; a purely radial force leaves C_XY and C_YX in their sum."""
    found = eg.compensate_path(result, slot(), CUT)
    assert [(out.names, out.reason) for out in found.left_out] == [(("z",), "not asked")]
    assert np.ptp(found.commands[:, result.campaign.machine.index("Z")]) == 0
    confounded = identified(noise=2e-4, parameters=CONFOUNDED)
    left = eg.compensate_path(confounded, slot(), Cut(ConstantForce((300.0, 0.0, 0.0))))
    assert ("y",) in [out.names for out in left.left_out if out.reason == "not determined"]
    assert left.components == ("x",)
    y = result.campaign.machine.index("Y")
    assert left.commands[:, y] == pytest.approx(left.before.path.commands[:, y], abs=left.tolerance)  # an arc in lines


def test_nothing_is_moved_by_what_is_not_greater_than_its_uncertainty():
    """A machine without faults, read with noise: the program is as it was, and the verdict says that nothing was moved."""
    test = eg.read_test(example_test())
    none = eg.identify(simulate(test, {"E_XX1": 0.0}, Imperfection(noise=1e-3), seed=1))
    found = eg.compensate_path(none, slot(), Cut())
    assert found.components == ()
    assert {out.reason for out in found.left_out} == {"uncertainty", "not asked"}
    assert found.program == slot()
    assert found.commands == pytest.approx(found.before.path.commands)
    assert {check.name: check.passed for check in found.verdict}["path corrected"] is False


def test_offset_and_other_blocks_stay(result):
    """The zero of the program is where it was; comments, stops and rapid moves are in the new program as they were."""
    placed = eg.compensate_path(result, slot(20.0), CUT, zero={"X": 30.0})
    assert placed.before.path.commands[:, result.campaign.machine.index("X")].max() == pytest.approx(50.0)
    assert placed.program.blocks[0] == Rapid({"X": 20.0, "Y": 0.0})
    ends = [block.to["X"] for block in placed.program.blocks if isinstance(block, Line)]
    assert max(ends) == pytest.approx(20.0, abs=0.05)


def test_a_machine_without_an_axis_along_the_deviation_says_so(result):
    with pytest.raises(InputError, match="the tolerance is 0 mm; it must be positive"):
        eg.compensate_path(result, slot(), CUT, tolerance=0.0)
    assert Machine("m", parse_topology("wFXYZt")).axes == ("X", "Y", "Z")


def test_a_rapid_move_says_from_which_side_an_axis_came(result):
    """Behind `G0 X50 Y30` from X0 the nut of X lies as it came, in +, all along a line of Y; Y as it goes."""
    blocks = [
        Rapid({"X": -10.0, "Y": 0.0}),
        Line({"X": 0.0}, 10.0),
        Rapid({"X": 50.0, "Y": 30.0}),
        Line({"Y": -20.0}, 10.0),
    ]
    path = eg.compensate_path(result, Program("two", blocks)).before.path
    x, y = (path.machine.index(axis) for axis in "XY")
    second = path.commands[:, x] == 50.0
    assert (path.sense[second][:, x] == 1).all()
    assert (path.sense[second][:, y] == -1).all()
    assert path.tangent[second][0] == pytest.approx([0.0, -1.0, 0.0], abs=1e-5)
    assert path.sense[0, y] == 0  # nothing says how Y came to its first place
