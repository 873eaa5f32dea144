"""The stiffness map against runs made by hand: a machine that stiffens, drives that are driven back."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import FeedDrive, SetupCompliance
from elastogeo.identification import StiffnessMap, map_stiffness
from elastogeo.identification.rollers.curves import curves_of
from elastogeo.identification.rollers.laws import choose_law
from elastogeo.observe import MachineTest
from elastogeo.report import view_of
from studies.ball_roller import (
    COULOMB,
    EFFICIENCY,
    ENGAGEMENT,
    FEED,
    FORCE,
    MACHINE,
    RATIO,
    VISCOUS,
    make_roller_test,
    table_6_6,
)

SPRING, SETUP = 7e-5, 1 / 15e3
"""Compliance of a constant machine and of the set-up [mm/N]."""


def holds(found: StiffnessMap, kind: str, true: np.ndarray) -> float:
    """Share of intervals of a kind that hold the true compliances, one a level, the same in all directions."""
    inside = [
        (level.interval[:, 0] <= c) & (c <= level.interval[:, 1])
        for level, c in zip(getattr(found, kind), true, strict=True)
    ]
    return float(np.mean(inside))


def passed(found: StiffnessMap) -> dict[str, bool | None]:
    return {check.name: check.passed for check in found.verdict}


def deflecting(law, seed: int = 1, **options) -> MachineTest:
    """A test of a machine whose deflection is a law of the force [N -> mm], by bisection at each engagement."""

    def force(n: int):
        low, high = 0.0, 5000.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if law(middle) + SETUP * middle < ENGAGEMENT[n] else (low, middle)
        return lambda angle: np.full(len(angle), low)

    return make_roller_test(ENGAGEMENT, force, SetupCompliance(constant=SETUP), seed=seed, **options)


@pytest.fixture(scope="module")
def thesis() -> StiffnessMap:
    return map_stiffness(table_6_6())


def test_the_machine_of_table_6_6_gives_its_secants_and_its_increments(thesis: StiffnessMap) -> None:
    """Printed secants 6.3, 8.3, 10.1, 11.1, 11.6 N/um; their increments are 10.9, 15.0, 14.7, 14.6 N/um."""
    secants, increments = MACHINE / FORCE, np.diff(MACHINE) / np.diff(FORCE)
    assert_allclose(1e-3 / secants, [6.3, 8.3, 10.1, 11.1, 11.6], atol=0.05)
    assert_allclose(1e-3 / increments, [10.9, 15.0, 14.7, 14.6], atol=0.06)
    assert holds(thesis, "secants", secants) >= 0.9
    assert holds(thesis, "increments", increments) >= 0.9
    for level, true in zip(thesis.secants, secants, strict=True):
        assert_allclose(level.compliance.mean(), true, rtol=0.01)


def test_it_is_said_that_no_law_holds_and_that_the_rise_is_an_offset(thesis: StiffnessMap) -> None:
    checks = passed(thesis)
    assert not checks["one stiffness at every engagement"]
    assert not checks["engagements follow the law"]
    assert not checks["secants free of an offset"]
    assert thesis.overall is thesis.increments[-1], "what stands for the machine is no law that does not hold"
    assert (thesis.overall.interval[:, 0] <= 17e-3 / 247.7).mean() >= 0.9
    facts = next(check.facts for check in thesis.verdict if check.name == "secants free of an offset")
    assert facts["share"] == pytest.approx(0.6, abs=0.1), "18 of 30 um at the least engagement"


def test_a_law_that_does_not_hold_is_shown_as_such(thesis: StiffnessMap) -> None:
    """On the page: secants 6.3 to 11.6 N/um, increments 10.9 to 14.6; the last increment stands for the machine."""
    view = view_of(thesis)
    assert view.tables[0].headings[-1] == "modelled, does not hold [N/µm]"
    increments, secants = ([float(word) for word in value.value.split(" to ")] for value in view.values[2:])
    assert_allclose(secants, [6.3, 11.6], atol=0.1)
    assert_allclose(increments, [10.9, 14.6], atol=0.3)
    assert "increment, 1041 to 1291 N" in view.picture.caption


def test_the_torque_of_a_motor_is_that_of_its_parts(thesis: StiffnessMap) -> None:
    """Figure 6.5 by hand: at 1000 mm/min the friction that was put in, and the ball's force through the screw."""
    assert [motor.axis for motor in thesis.torques] == ["X", "Y"]
    for motor in thesis.torques:
        assert (motor.engagement, motor.unit) == (pytest.approx(0.2), "N mm")
        assert motor.run == "200um-1-1"
        assert_allclose(motor.peak("coulomb"), COULOMB[motor.axis], rtol=0.01)
        assert_allclose(motor.peak("viscous"), VISCOUS[motor.axis] * FEED / RATIO, rtol=0.02)
        # the motor drives the roller against the ball, so the screw's losses are its own
        assert_allclose(motor.peak("load"), FORCE[-1] * RATIO / EFFICIENCY, rtol=0.02)
        noise = 0.03 * 1650
        assert np.sqrt(np.mean(motor.residual[motor.counts] ** 2)) < 1.3 * noise
        assert not motor.counts.all()
        turn = motor.angle[motor.counts]
        along = np.cos(turn) if motor.axis == "X" else np.sin(turn)
        assert_allclose(np.corrcoef(motor.parts["load"][motor.counts], -along)[0, 1], 1.0, atol=0.01)


def test_every_level_knows_the_engagement_that_was_commanded(thesis: StiffnessMap) -> None:
    assert_allclose(thesis.engagements, ENGAGEMENT)


@pytest.mark.parametrize(
    ("law", "supported"),
    [
        (lambda force: SPRING * force, {"constant"}),
        (lambda force: SPRING * force * (1 - 0.1 * force / 1300), {"linear", "contact"}),
        (lambda force: SPRING * (0.7 * force + 0.3 * 1300 ** (1 / 3) * force ** (2 / 3)), {"contact", "linear"}),
    ],
    ids=["one spring", "falls by 20 %", "contact of 30 %"],
)
def test_the_law_of_the_machine_is_found(law, supported: set[str]) -> None:
    test = deflecting(law)
    _, choice = choose_law(curves_of(test.observations()))
    assert choice.supported in supported
    assert choice.supported == "constant" or {choice.supported, *choice.alike} & supported == {
        choice.supported,
        *choice.alike,
    }
    assert choice.follows


def test_the_slope_of_a_law_is_the_machine_at_each_engagement() -> None:
    found = map_stiffness(deflecting(lambda force: SPRING * force * (1 - 0.1 * force / 1300)))
    forces = np.array([level.force[0] for level in found.modelled])
    assert len(forces) == 5
    assert holds(found, "modelled", SPRING * (1 - 0.2 * forces / 1300)) >= 0.9
    assert_allclose([level.compliance.mean() for level in found.modelled], SPRING * (1 - 0.2 * forces / 1300), rtol=0.03)


@pytest.mark.parametrize("back", [2 - 1 / 0.9, 0.9, 0.85])
def test_drives_that_are_driven_back_do_not_leave_the_interval(back: float) -> None:
    """Screw friction in proportion to the load, the same efficiency both ways, and a worse one: none is stated."""
    found = map_stiffness(deflecting(lambda force: SPRING * force, back=back))
    assert holds(found, "modelled", np.array([SPRING])) >= 0.9
    assert_allclose(found.overall.compliance, SPRING, rtol=0.07)
    assert passed(found)["losses when driven back known"] is None


def test_losses_that_are_not_stated_are_off_together() -> None:
    """One rule gives the losses of all drives: where two share the force, what it puts wrong adds up, not its squares."""
    found = map_stiffness(deflecting(lambda force: SPRING * force))
    alone, both = found.overall.contribution("losses when driven back")[[0, 3]]
    share = found.overall.contribution("force per current of X")[3] / found.overall.contribution("force per current of X")[0]
    # At 45 degrees each drive holds half of the force along the line of centres; in quadrature the two would give 0.71.
    assert share == pytest.approx(0.5, abs=0.05)
    assert both / alone == pytest.approx(1.0, abs=0.15)


def test_a_stated_efficiency_back_is_used_and_brings_no_doubt_of_its_own() -> None:
    found = map_stiffness(deflecting(lambda force: SPRING * force, back=0.8, back_efficiency=0.8))
    assert_allclose(found.overall.compliance, SPRING, rtol=0.04)
    assert "losses when driven back" not in found.overall.labels
    assert passed(found)["losses when driven back known"]


def test_one_efficiency_for_both_directions_would_be_a_fifth_off() -> None:
    """What the audit found: the force of a drive that is driven back is 1 / (eta eta_back) of what one efficiency says."""
    drive = FeedDrive("X", torque_constant=1650.0, pitch=10.0, efficiency=0.9, back_efficiency=0.9)
    ahead, back = drive.force_per_effort(np.array([True, False]))
    assert back / ahead == pytest.approx(1 / 0.81)
    assert drive.force_per_effort() == ahead
