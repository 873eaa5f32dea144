"""Collinear stiffness values against springs made by hand, and against the springs in a simulated machine."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification import collinear_stiffness, identify
from elastogeo.machine import Machine, Place, parse_topology
from elastogeo.observe import Imperfection, MachineTest, Question, Run
from elastogeo.observe.static_loads.static_force import StaticForce
from elastogeo.prediction import collinear_stiffness_of
from elastogeo.report.identification.collinear import collinear_json, collinear_section
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
SOFT, HARD = np.array([6e-5, 4e-5, 2e-5]), np.array([3e-10, 5e-10, 4e-10])


def moved(C: np.ndarray, to: np.ndarray) -> np.ndarray:
    """The compliance at a point, of one that is C about the origin: `t_P = t_O + r x p`, `m_O = m_P + p x f`."""
    x, y, z = to
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    J = np.block([[np.eye(3), -cross], [np.zeros((3, 3)), np.eye(3)]])
    return J @ C @ J.T


def test_a_decoupled_spring_has_its_three_and_three_on_its_axes() -> None:
    found = collinear_stiffness(np.diag([*SOFT, *HARD]))
    for values, diagonal in ((found.translational, SOFT), (found.rotational, HARD)):
        order = np.argsort(diagonal)[::-1]
        assert_allclose([one.compliance.value for one in values], diagonal[order], rtol=1e-12)
        assert_allclose(np.vstack([one.direction for one in values]), np.eye(3)[order], atol=1e-12)
    assert found.translational[0].stiffness().value == pytest.approx(1 / 6e-5)


def test_the_screws_of_a_decoupled_spring_are_its_axes_both_ways() -> None:
    """`c = +-sqrt(a d)`, `h = +-sqrt(a / d)`: along the axis 1/a, about it 1/d, right- and left-handed."""
    screws = collinear_stiffness(np.diag([*SOFT, *HARD])).screws
    assert len(screws) == 6
    for screw in screws:
        axis = int(np.argmax(screw.direction))
        assert_allclose(screw.direction, np.eye(3)[axis], atol=1e-9)
        assert_allclose(screw.point, 0.0, atol=1e-6)
        assert abs(screw.pitch) == pytest.approx(np.sqrt(SOFT[axis] / HARD[axis]))
        assert (screw.along, screw.about) == (pytest.approx(1 / SOFT[axis]), pytest.approx(1 / HARD[axis]))
    assert sorted(np.sign(screw.pitch) for screw in screws) == [-1, -1, -1, 1, 1, 1]


def test_a_screw_spring_yields_more_to_one_hand_than_to_the_other() -> None:
    """A spring that turns as it is pressed, `b` rad/N about z: by hand `c = b +- sqrt(a d)` and `h = +-sqrt(a / d)`."""
    C = np.diag([*SOFT, *HARD])
    a, d = SOFT[2], HARD[2]
    b = 0.4 * np.sqrt(a * d)
    C[2, 5] = C[5, 2] = b
    of_z = [screw for screw in collinear_stiffness(C).screws if screw.direction[2] > 0.9]
    pitch = np.sqrt(a / d)
    by_hand = {sign: 1 / ((b + sign * np.sqrt(a * d)) * sign * pitch) for sign in (1, -1)}
    assert {int(np.sign(s.pitch)): pytest.approx(s.along) for s in of_z} == by_hand
    assert by_hand[1] < 1 / a < by_hand[-1]  # 0.4 of coupling: 1/1.4 and 1/0.6 of the stiffness without it
    assert_allclose([by_hand[1] * a, by_hand[-1] * a], [1 / 1.4, 1 / 0.6])


def test_screws_and_rotations_do_not_depend_on_the_point_where_the_compliance_is_stated() -> None:
    random = np.random.default_rng(3)
    factor = random.standard_normal((6, 6)) * np.sqrt(np.array([*SOFT, *HARD]))[:, np.newaxis]
    C, to = factor @ factor.T, np.array([120.0, -40.0, 300.0])
    here, there = collinear_stiffness(C), collinear_stiffness(moved(C, to))
    for one, other in zip(here.screws, there.screws, strict=True):
        assert [one.pitch, one.along, one.about] == pytest.approx([other.pitch, other.along, other.about], rel=1e-6)
        assert_allclose(np.cross(other.point + to - one.point, one.direction), 0.0, atol=1e-5)  # on the same axis
    assert [r.compliance.value for r in here.rotational] == pytest.approx([r.compliance.value for r in there.rotational])
    for screw in here.screws:  # what it says, said again: its wrench and its twist are collinear
        force = screw.direction
        wrench = np.hstack([force, np.cross(screw.point, force) + screw.pitch * force])
        twist = C @ wrench
        assert_allclose(twist[3:], force * screw.pitch / screw.about, rtol=1e-6, atol=1e-9 * np.abs(twist[3:]).max())
        assert twist[:3] @ force == pytest.approx(1 / screw.along, rel=1e-6)


def test_what_is_rigid_in_a_direction_has_no_screws() -> None:
    found = collinear_stiffness(np.diag([*SOFT, 0.0, 0.0, 0.0]))
    assert found.screws == ()
    assert [one.compliance.value for one in found.rotational] == [0.0] * 3


@pytest.mark.parametrize("wrong", [np.eye(3), np.full((6, 6), np.inf)])
def test_what_is_no_compliance_is_refused(wrong: np.ndarray) -> None:
    with pytest.raises(InputError, match="it must be a 6x6 matrix of finite numbers"):
        collinear_stiffness(wrong)


TRUTH = {"C_XXX": 6e-5, "C_YYY": 4e-5, "C_XXY": 1e-5, "C_YYX": 1.5e-5, "C_XYX": 5e-6, "C_XYY": 3e-6}


def test_a_circle_knows_both_directions_of_its_plane_from_sums(make_test: MakeTest) -> None:
    """XX: 7e-5, YY: 5.5e-5, XY and YX together 8e-6: principal compliances of that 2x2 matrix, each in its interval."""
    test = make_test("wFYXt", [36.0, 238.0, 490.0, 742.0], parameters=["C_[XY][XY]?", "E_XX1", "E_YY1"], repeats=3)
    result = identify(simulate(test, TRUTH, Imperfection(noise=1e-4), seed=3, exact=False))
    assert any(len(p.stands_for) > 1 for p in result.parameters)
    found = collinear_stiffness_of(result)
    truth = np.linalg.eigvalsh([[7e-5, 4e-6], [4e-6, 5.5e-5]])[::-1]
    assert len(found.translational) == 2
    for one, true in zip(found.translational, truth, strict=True):
        low, high = one.compliance.interval()
        assert low < true < high
        assert 0 < one.compliance.standard_uncertainty < 0.02 * true
    assert found.rotational == () == found.screws


def test_the_report_says_the_stiffness_and_the_json_the_compliance(make_test: MakeTest) -> None:
    """Without noise, 1 / 6e-5 mm/N is 16.67 N/um along x, and 1 / 4e-5 is 25 N/um along y."""
    test = make_test("wFYXt", [36.0, 238.0, 490.0, 742.0], parameters=["C_XXX", "C_YYY", "E_XX1"], repeats=2)
    result = identify(simulate(test, {"C_XXX": 6e-5, "C_YYY": 4e-5}, Imperfection(noise=1e-7), seed=2, exact=False))
    (section,) = collinear_section(result)
    (table,) = section.tables
    assert [row[0] for row in table.rows] == ["(1.000, 0.000, 0.000)", "(0.000, 1.000, 0.000)"]
    assert [round(float(row[1].split(" ±")[0].replace("(", "")), 2) for row in table.rows] == [16.67, 25.0]
    entry = collinear_json(result)
    assert entry is not None
    assert [one["compliance_um_per_N"]["value"] for one in entry["translational"]] == pytest.approx([0.06, 0.04], rel=1e-4)
    assert entry["compliance"][2] == [None] * 6
    assert entry["screws"] == entry["rotational"] == []


def test_a_tilt_moves_the_tool_by_its_lever() -> None:
    """X yields 5e-5 mm/N, the holder turns 2e-9 rad/(N mm) at 300 mm: together 5e-5 + 2e-9 * 300^2 along x."""
    machine = Machine("mill", parse_topology("wFYXZt"), places=(Place("holder", "tool"),))
    runs = tuple(Run(f"r{k}", {"force": k * np.arange(1.0, 90.0), "displacement": np.zeros(89)}) for k in range(1, 7))
    setup = StaticForce((1.0, 0.0, 0.0), tool=(0.0, 0.0, -300.0))
    test = MachineTest("pushed", machine, setup, runs, Question(("C_XXX", "CL_BBholder")))
    truth = {"C_XXX": 5e-5, "CL_BBholder": 2e-9}
    found = collinear_stiffness_of(identify(simulate(test, truth, Imperfection(noise=1e-5), seed=1)))
    (along,) = found.translational
    assert along.direction.tolist() == [1.0, 0.0, 0.0]
    assert along.compliance.value == pytest.approx(5e-5 + 2e-9 * 300**2, rel=1e-3)


def test_one_force_level_gives_no_stiffness_where_geometry_looks_the_same(make_test: MakeTest) -> None:
    """Along x compliance and scale are one sum; along y only a compliance was asked for."""
    found = collinear_stiffness_of(identify(make_test("wFYXt", [742.0], parameters=["C_XXX", "E_XX1", "C_YYY"])))
    assert [one.direction.tolist() for one in found.translational] == [[0.0, 1.0, 0.0]]


def test_what_changes_with_the_force_has_no_one_stiffness(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [36.0, 238.0, 742.0], parameters=["C_XXX", "CF1_XXX", "E_XX1"])
    result = identify(simulate(test, {"C_XXX": 6e-5}, Imperfection(noise=1e-5), seed=2))
    with pytest.raises(UnsupportedError, match="CF1_XXX is no constant compliance of a joint"):
        collinear_stiffness_of(result)
