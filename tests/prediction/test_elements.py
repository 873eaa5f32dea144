"""Maps in every direction at once: against the map along one direction, kept and read back, and what is refused."""

from __future__ import annotations

import json

import numpy as np
import pytest

from elastogeo.errors import InputError
from elastogeo.identification import Identification, identify
from elastogeo.observe import Question, with_questions
from elastogeo.prediction import ElementMap, map_compliance, map_elements, section_of
from tests.prediction.circles import MIDDLE, circles

ALONG = {"X": (-200.0, 200.0, 5), "Y": (-150.0, 150.0, 4), "Z": (-100.0, 50.0, 3)}


@pytest.fixture(scope="module")
def result() -> Identification:
    return identify(circles(reciprocal=True, gauge=0.01))


@pytest.fixture(scope="module")
def found() -> ElementMap:
    return map_elements(circles(reciprocal=True, gauge=0.01), ALONG)


@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, -2.0, 0.5)])
def test_the_quadratic_form_of_a_place_is_the_map_along_the_direction(
    result: Identification, found: ElementMap, direction: tuple[float, ...]
) -> None:
    one = map_compliance(result, ALONG, direction=direction)
    for height in range(3):
        section = section_of(found, "XY", height, direction)
        assert section.compliance == pytest.approx(one.compliance[:, :, height], rel=1e-9)
        assert section.stiffness == pytest.approx(one.stiffness[:, :, height], rel=1e-9)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_along_an_axis_its_uncertainty_is_that_of_the_map(result: Identification, found: ElementMap, axis: int) -> None:
    one = map_compliance(result, ALONG, direction=np.eye(3)[axis])
    assert section_of(found, "XY", 1, np.eye(3)[axis]).expanded == pytest.approx(one.expanded[:, :, 1], rel=1e-9)


def test_between_the_axes_its_uncertainty_comes_near(result: Identification, found: ElementMap) -> None:
    """u is exact there, the coverage factor is not: within a third here, where it is 2 to 3."""
    direction = (0.6, 0.0, 0.8)
    one, section = map_compliance(result, ALONG, direction=direction), section_of(found, "XY", 1, direction)
    assert section.expanded == pytest.approx(one.expanded[:, :, 1], rel=0.35)


def test_a_section_along_other_axes_is_the_same_places(found: ElementMap) -> None:
    xy, zy = section_of(found, "XY", 2, (1, 1, 0)), section_of(found, "ZY", 0, (1, 1, 0))
    assert (zy.compliance[2] == xy.compliance[0]).all()
    assert zy.height_axis == "X"
    assert zy.compliance.shape == (3, 4)


def test_the_softest_place_is_where_the_compliance_is_greatest(found: ElementMap) -> None:
    section = section_of(found, "XY", 1, (0, 0, 1))
    assert section.softest is not None
    assert section.stiffest is not None
    assert section.softest.stiffness == pytest.approx(1 / section.compliance.max())
    assert section.stiffest.stiffness == pytest.approx(1 / section.compliance.min())
    at = [list(section.along[k]).index(section.softest.commands["XY"[k]]) for k in (0, 1)]
    assert section.compliance[at[0], at[1]] == section.compliance.max()
    assert section.softest.commands["Z"] == -25.0


def test_it_is_kept_as_plain_values_and_read_back(found: ElementMap) -> None:
    assert ElementMap.of_document(json.loads(json.dumps(found.document(), allow_nan=False))) == found


def test_what_one_circle_does_not_tell_has_no_number() -> None:
    """One circle in XY tells nothing of a force along Z, and along X only what the map along X says."""
    campaign = circles(MIDDLE[:1])
    found = map_elements(campaign, ALONG)
    up = section_of(found, "XY", 1, (0, 0, 1))
    assert not up.known.any()
    assert up.softest is None
    one = map_compliance(campaign, ALONG, direction="X", parameters="C_???", reciprocal=True)
    assert (section_of(found, "XY", 1).known == one.supported[:, :, 1]).all()
    assert found.assumed is None


def test_what_rests_on_rigid_joints_is_kept_apart_and_marked() -> None:
    asked = Question(parameters=("C_XXX", "C_YYY"), reciprocal=True)
    campaign = with_questions(circles(MIDDLE[:1]), asked)
    found = map_elements(campaign, ALONG)
    assert "C_XXX" not in found.rigid
    assert "C_ZZZ" in found.rigid
    by_tests, with_more = section_of(found, "XY", 1), section_of(found, "XY", 1, assumed=True)
    assert not by_tests.resting.any()
    one = map_compliance(campaign, ALONG, direction="X")
    assert (with_more.known == one.supported[:, :, 1]).all()
    assert (with_more.resting == with_more.known & ~by_tests.known).all()
    assert with_more.resting.any()
    kept = with_more.resting & one.supported[:, :, 1]
    assert with_more.compliance[kept] == pytest.approx(one.compliance[:, :, 1][kept], rel=1e-9)
    assert with_more.compliance[by_tests.known] == pytest.approx(by_tests.compliance[by_tests.known], rel=0, abs=0)


@pytest.mark.parametrize(
    ("plane", "height", "said"),
    [
        ("XA", 0, "the map goes along X, Y, Z; a section takes two of them"),
        ("XX", 0, "takes two"),
        ("XY", 9, "ask for 0 to 2"),
    ],
)
def test_a_section_that_is_none_is_refused(found: ElementMap, plane: str, height: int, said: str) -> None:
    with pytest.raises(InputError, match=said):
        section_of(found, plane, height)


def test_a_map_of_a_line_has_no_section() -> None:
    line = map_elements(circles(reciprocal=True), {"X": (-200.0, 200.0, 5)})
    with pytest.raises(InputError, match="no section"):
        section_of(line)
