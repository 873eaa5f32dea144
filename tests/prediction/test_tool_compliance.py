"""The compliance at the tool: against J C J^T from the Jacobian, what circles support of it, and its inverse."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.formats import read_machine
from elastogeo.identification import identify
from elastogeo.machine import Machine, jacobian
from elastogeo.prediction import Grid, Knowledge, ToolCompliance, compliance_along, entry_rows, knowledge_of, tool_compliance
from elastogeo.prediction.maps.field import quadratic
from elastogeo.prediction.tool_compliances import TRANSLATION, unit_direction
from elastogeo.sources import Source, select_sources
from tests.prediction.circles import MIDDLE, circles, machine, springs

AT = np.array([10.0, -25.0, 40.0])


def truth_at(commands: np.ndarray) -> np.ndarray:
    """C_t of the true springs, by the Jacobian."""
    one = machine()
    C = np.zeros((6 * len(one.axes),) * 2)
    for name, value in springs(one).items():
        k = 6 * one.axes.index(name[-1])
        C[k + "XYZABC".index(name[2]), k + "XYZABC".index(name[3])] = value
    J = jacobian(one, np.atleast_2d(commands))[0]
    return np.asarray(J @ C @ J.T)


def asking(one: Machine, sources: tuple[Source, ...]) -> Knowledge:
    """What is asked for, before anything is known of it."""
    unknown: Any = None
    return Knowledge(one, sources, unknown, unknown, unknown, True, np.ones(len(sources)), np.zeros(len(one.axes)), (), "")


@pytest.fixture(scope="module")
def known() -> Knowledge:
    """Of joints that were asked without reciprocity."""
    return knowledge_of(identify(circles()))


@pytest.fixture(scope="module")
def found(known: Knowledge) -> ToolCompliance:
    return tool_compliance(known, AT)


def test_the_symmetric_part_is_supported_and_a_single_element_is_not(found: ToolCompliance) -> None:
    """planning.md: of joints asked without reciprocity circles close the symmetric part of C_t, no C_ij of i and j apart."""
    assert found.supported[:3, :3].all()
    assert found.alone[:3, :3].tolist() == np.eye(3, dtype=bool).tolist()


def test_what_is_not_supported_has_no_number(found: ToolCompliance) -> None:
    """A force at the end of a bar of one tool does not tell what a moment does."""
    assert not found.supported[3:, 3:].all()
    for numbers in (found.compliance, found.expanded):
        assert np.isnan(numbers[~found.supported]).all()
        assert np.isfinite(numbers[found.supported]).all()
    assert np.isnan(found.stiffness[3:]).all()
    assert found.screws == ()


def test_with_a_prior_everything_has_a_number_and_says_how_much_of_it_is_prior(
    known: Knowledge, found: ToolCompliance
) -> None:
    all_of_it = tool_compliance(known, AT, prior=True)
    assert (all_of_it.supported == found.supported).all()
    assert np.isfinite(all_of_it.expanded).all()
    assert (all_of_it.prior_share[~found.supported] > 0.5).all()
    assert (all_of_it.prior_share[found.supported] == 0).all()
    assert all_of_it.compliance[:3, :3] == pytest.approx(found.compliance[:3, :3], rel=1e-9)


def test_with_reciprocity_each_element_is_supported() -> None:
    known = knowledge_of(identify(circles(reciprocal=True)))
    assert tool_compliance(known, AT).alone[:3, :3].all()


def test_values_are_those_of_the_jacobian_within_their_uncertainty(found: ToolCompliance) -> None:
    off = np.abs(found.compliance - truth_at(AT))[:3, :3]
    assert (off < 2 * found.expanded[:3, :3]).all()
    assert (found.expanded[:3, :3] < 0.1 * truth_at(AT).diagonal()[:3].min()).all()


def test_principal_directions_are_those_of_the_elements(known: Knowledge, found: ToolCompliance) -> None:
    values = np.linalg.eigvalsh(found.compliance[:3, :3])[::-1]
    assert [one.compliance.value for one in found.principal] == pytest.approx(values)
    assert found.softest is found.principal[0]
    along = compliance_along(known, AT, found.principal[0].direction)
    assert along.value[0] == pytest.approx(values[0])
    assert along.standard_uncertainty[0] == pytest.approx(found.principal[0].compliance.standard_uncertainty)


def test_the_stiffness_is_the_inverse_of_what_is_determined(found: ToolCompliance) -> None:
    """Along a principal direction its U is that of the principal stiffness."""
    K = found.stiffness[:3, :3]
    assert np.linalg.inv(found.compliance[:3, :3]) == pytest.approx(K)
    true = np.linalg.inv(truth_at(AT)[:3, :3])
    assert (np.abs(K - true) < 2 * found.stiffness_expanded[:3, :3]).all()
    for one in found.principal:
        stiffness = one.stiffness()
        assert one.direction @ K @ one.direction == pytest.approx(stiffness.value)
        bound = np.abs(one.direction) @ found.stiffness_expanded[:3, :3] @ np.abs(one.direction)
        assert stiffness.expanded() <= bound


def test_a_direction_of_any_length_is_a_direction() -> None:
    assert unit_direction([0.0, 3.0, 4.0]) == pytest.approx([0.0, 0.6, 0.8])
    with pytest.raises(InputError, match="it must be three finite numbers that are not all zero"):
        unit_direction([0.0, 0.0, 0.0])


def test_without_a_compliance_there_is_none_at_the_tool() -> None:
    known = knowledge_of(identify(circles(MIDDLE[:1]), parameters=["E_XX1"]))
    with pytest.raises(UnsupportedError, match="no compliance was asked for"):
        tool_compliance(known, AT)


@pytest.mark.parametrize("name", ["hermle_c50", "huron_kx8"])
def test_elements_ask_for_what_the_jacobian_carries(name: str) -> None:
    """Any values of the parameters: `entry_rows @ values` is the symmetric part of J C J^T, at any pose, with any tool."""
    one, random = read_machine(name), np.random.default_rng(8)
    sources = select_sources(one, ["C_???"])
    values = random.normal(size=len(sources))
    known = asking(one, sources)
    commands = random.uniform(-0.5, 0.5, (4, len(one.axes))) * [1.0 if joint.is_rotary else 400.0 for joint in one.joints]
    tool = np.array([20.0, -10.0, -230.0])
    C = np.zeros((6 * len(one.axes),) * 2)
    for source, value in zip(sources, values, strict=True):
        at = 6 * one.axes.index(source.site[1])
        C[at + source.component, at + (source.load or 0)] = value
    J = jacobian(one, commands, tool)
    expected = J @ C @ J.transpose(0, 2, 1)
    found = entry_rows(known, commands, tool) @ values
    pairs = [(i, j) for i in range(6) for j in range(i, 6)]
    for k, (i, j) in enumerate(pairs):
        assert found[:, k] == pytest.approx((expected[:, i, j] + expected[:, j, i]) / 2, rel=1e-9)


def test_over_linear_axes_with_others_turned_it_is_a_quadratic() -> None:
    """Five axes, the rotary ones turned: ten functionals make every place of a grid, to rounding."""
    one, random = read_machine("hermle_c50"), np.random.default_rng(9)
    sources = select_sources(one, ["C_???"])
    known = asking(one, sources)
    stands = np.array([{"A": 0.4, "C": -0.7}.get(axis, 0.0) for axis in one.axes])
    along = tuple(np.linspace(low, high, n) for low, high, n in ((-300.0, 250.0, 5), (-200.0, 200.0, 4), (-50.0, 350.0, 3)))
    places = Grid(("X", "Y", "Z"), along, stands, tuple(map(one.index, "XYZ")))
    found = quadratic(known, places, np.array(one.tool))
    chosen = random.integers(0, places.size, 6)
    commands = places.commands(chosen)
    rows = np.einsum("mb,bep->mep", found.terms(commands[:, list(places.columns)]), found.rows)
    exact = entry_rows(known, commands, None, TRANSLATION)
    assert found.rows.shape[0] == 10
    assert np.abs(rows - exact).max() < 1e-9 * np.abs(exact).max()
