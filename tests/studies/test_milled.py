"""Virtual parts: the error before and after, as a coordinate measuring machine would find it, against what was predicted."""

import numpy as np
import pytest

from elastogeo.identification import Identification
from studies.milled import PARTS, known, milled, off_the_contour, off_the_slot


@pytest.fixture(scope="module")
def result() -> Identification:
    return known()


def test_the_gauges_measure_shapes() -> None:
    """Points 5 um inside the shapes: of the circle, of a straight side, of a round corner."""
    inside = 0.005
    at = np.array([[10.0, -20.0, 0.0]]) + (60 - inside) * np.array([[0.6, 0.8, 0.0]])
    assert off_the_slot(at) == pytest.approx([inside])
    corner = np.array([60.0, 30.0, 0.0]) + (20 - inside) * np.array([0.6, 0.8, 0.0])
    assert off_the_contour(np.array([[0.0, -50 + inside, 0], [-80 + inside, 10, 0], corner])) == pytest.approx([inside] * 3)


@pytest.mark.parametrize("name", list(PARTS))
def test_a_milled_part_is_off_as_predicted_before_and_after(result: Identification, name: str) -> None:
    """The force is 7 % greater and the tool 10 % stiffer than stated (10 %, 15 %): the intervals hold both."""
    part = milled(name, result)
    assert np.abs(part.before).max() > 0.05
    assert np.abs(part.after).max() < 0.2 * np.abs(part.before).max()
    assert part.held_before > 0.95
    assert part.held_after > 0.95
    assert np.nanmax(np.abs(part.found.value[:, 3])) < 0.0025  # the tolerance of its lines is 2 um
    assert part.found.components == ("x", "y")


def test_what_nobody_identified_is_not_made_good(result: Identification) -> None:
    """The machine climbs along X; no parameter that was asked for moves the tool in z."""
    part = milled("circular slot", result)
    assert [(one.names, one.reason) for one in part.found.left_out] == [(("z",), "not asked")]
    assert not part.found.shift[:, 2].any()
