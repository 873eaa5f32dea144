"""Cutting forces against printed values, against an integration that shares no formula with them, and against reasoning."""

import numpy as np
import pytest

from elastogeo.errors import InputError
from elastogeo.machine import (
    COEFFICIENTS,
    CuttingCoefficients,
    Engagement,
    Mill,
    MillingForce,
    coefficients_of,
    engagement_of,
    forces_over_a_turn,
    mean_force,
)

AL7075 = COEFFICIENTS["Al7075-T6"]
SLOT = Engagement(2.0)
QUARTER = Engagement(2.0, np.pi / 2, np.pi)


def test_mean_forces_are_the_printed_ones() -> None:
    """Al7075-T6, four teeth, 2 mm deep, 0.1 mm per tooth: computed apart from this program."""
    assert mean_force(AL7075, 4, SLOT, 0.1) == pytest.approx([-101.4963, 223.9395, 59.3318], abs=5e-5)
    assert mean_force(AL7075, 4, QUARTER, 0.1) == pytest.approx([33.34994, 156.58405, 29.66592], abs=5e-6)


def test_the_mean_of_a_slot_is_its_short_form() -> None:
    """Altintas: Fx = -(N a c/4 Krc + N a/pi Kre), Fy = N a c/4 Ktc + N a/pi Kte, Fz = N a c/pi Kac + N a/2 Kae."""
    teeth, depth, c = 3, 1.5, 0.07
    expected = [
        -(teeth * depth * c / 4 * AL7075.radial + teeth * depth / np.pi * AL7075.radial_edge),
        teeth * depth * c / 4 * AL7075.tangential + teeth * depth / np.pi * AL7075.tangential_edge,
        teeth * depth * c / np.pi * AL7075.axial + teeth * depth / 2 * AL7075.axial_edge,
    ]
    assert mean_force(AL7075, teeth, Engagement(depth), c) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("engagement", [SLOT, QUARTER, Engagement(2.0, 0.0, 1.1)])
@pytest.mark.parametrize("helix", [0.0, 30.0, 45.0])
def test_a_turn_adds_up_to_the_mean_whatever_the_helix(engagement: Engagement, helix: float) -> None:
    angles = (np.arange(720) + 0.5) / 720 * 2 * np.pi
    mill = Mill(12.0, 4, np.radians(helix))
    turn = forces_over_a_turn(AL7075, mill, engagement, 0.1, angles, slices=100)
    mean = mean_force(AL7075, 4, engagement, 0.1)
    assert turn.mean(axis=0) == pytest.approx(mean, abs=2e-3 * np.linalg.norm(mean))


def test_one_straight_edge_pushes_back_along_its_motion_and_in_towards_the_axis() -> None:
    """At 90 degrees the edge stands ahead and moves to the right: the force is to the left (+y) and backwards (-x)."""
    edge = CuttingCoefficients(1000.0, 0.0, 300.0, 0.0, 100.0)
    force = forces_over_a_turn(edge, Mill(10.0, 1), SLOT, 0.1, np.array([np.pi / 2, 3 * np.pi / 2]))
    assert force[0] == pytest.approx([-300.0 * 0.1 * 2, 1000.0 * 0.1 * 2, 100.0 * 0.1 * 2])
    assert force[1] == pytest.approx([0.0, 0.0, 0.0])


def test_run_out_gives_the_chip_of_one_tooth_to_another() -> None:
    """Both teeth together still cut what is fed in a turn; one cuts more by twice the run-out, the other less."""
    edge = CuttingCoefficients(1000.0, 0.0, 0.0, 0.0)
    ahead = np.array([np.pi / 2, 3 * np.pi / 2])
    off = forces_over_a_turn(edge, Mill(10.0, 2, run_out=0.02), Engagement(1.0), 0.1, ahead)[:, 1]
    true = forces_over_a_turn(edge, Mill(10.0, 2), Engagement(1.0), 0.1, ahead)[:, 1]
    assert off - true == pytest.approx([1000.0 * 0.04, -1000.0 * 0.04])
    only_one = forces_over_a_turn(edge, Mill(10.0, 2, run_out=0.08), Engagement(1.0), 0.1, ahead)[:, 1]
    assert only_one == pytest.approx([1000.0 * 0.2, 0.0])


def test_material_on_the_right_climbs_and_on_the_left_does_not() -> None:
    climb, against = engagement_of(2.0, 3.0, 12.0, "right"), engagement_of(2.0, 3.0, 12.0, "left")
    assert (climb.entry, climb.exit) == pytest.approx((np.radians(120), np.pi))
    assert (against.entry, against.exit) == pytest.approx((0.0, np.radians(60)))
    assert engagement_of(2.0, 12.0, 12.0) == SLOT


def test_the_force_when_an_edge_makes_the_surface_is_not_the_mean() -> None:
    """A straight edge leaves a climbed wall with no chip: what rubs is left, across the wall its radial edge force."""
    cut = MillingForce(AL7075, Mill(12.0, 4), engagement_of(2.0, 3.0, 12.0), speed=300.0, moment="surface")
    force = cut.of_feed(0.1)
    assert force[1] == pytest.approx(AL7075.radial_edge * 2.0)
    assert force[0] == pytest.approx(AL7075.tangential_edge * 2.0)


def test_a_right_hand_helix_draws_the_mill_out() -> None:
    drawn = MillingForce(AL7075, Mill(12.0, 4), SLOT, speed=300.0).of_feed(0.1)
    pushed = MillingForce(AL7075, Mill(12.0, 4), SLOT, speed=300.0, draws_out=False).of_feed(0.1)
    assert drawn[2] == -pushed[2] < 0


def test_what_is_no_cut_is_refused() -> None:
    with pytest.raises(InputError, match=r"no cutting force coefficients of 'steel'; there are Al6061-T6, .* Give your own"):
        coefficients_of("steel")
    with pytest.raises(InputError, match="radial depth of cut is 14 mm; it lies above 0 and up to the diameter, 12 mm"):
        engagement_of(2.0, 14.0, 12.0)
    with pytest.raises(InputError, match="the side 'up'; write left or right"):
        engagement_of(2.0, 3.0, 12.0, "up")
    with pytest.raises(InputError, match="axial depth of cut is 0 mm"):
        Engagement(0.0)
    with pytest.raises(InputError, match="helix is 90 degrees"):
        Mill(12.0, 4, np.pi / 2)
    with pytest.raises(InputError, match="spindle turns at 0 1/min; it must turn"):
        MillingForce(AL7075, Mill(12.0, 4), SLOT, speed=0.0)
