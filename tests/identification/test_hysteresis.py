"""Static compliance and hysteresis from loops whose numbers are known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.static_tests.by_run import Counted
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis, hysteresis
from elastogeo.identification.static_tests.loading_branches import branches_of, turning_points
from elastogeo.identification.static_tests.straight_line import static_line
from elastogeo.machine import Array
from elastogeo.report import sentence_of

C = 7e-5
H = 5e-9
TOP = 500.0
RISE = np.linspace(0.0, TOP, 41)
WEIGHTS = np.array([11.89, 24.97, 31.90, 56.85, 68.75, 79.77, 91.66, 104.74, 111.68])
"""Of thesis Figure 6.11 [N]."""

RIG = 2.65e3
"""Stiffness of the rig [N/mm] (thesis 6.6.3)."""


def cycle(compliance: float = C, h: float = H, noise: float = 0.0, random: np.random.Generator | None = None) -> Array:
    """One loop 0 to 500 N and back: d = C F - h F (500 - F) going up, + going down; rows are force and displacement.

    Its middle line is C F; its width 2 h F (500 - F) is greatest in the middle, h 500^2 / 2, and 2 h 500^2 / 6 in the mean.
    """
    force = np.concatenate([RISE, RISE[-2::-1]])
    sense = np.concatenate([-np.ones(41), np.ones(40)])
    displacement = compliance * force + sense * h * force * (TOP - force)
    if random is not None:
        displacement += noise * random.standard_normal(len(force))
    return np.array([force, displacement])


def cycles(*each: Array) -> StaticHysteresis:
    """Loops one after the other; where one ends the next begins."""
    force, displacement = np.hstack([each[0], *(one[:, 1:] for one in each[1:])])
    return hysteresis(force, displacement)


def check_loop(found: StaticHysteresis, tolerance: float = 1e-9) -> None:
    assert found.static_compliance.value == pytest.approx(C, rel=tolerance)
    assert found.rising_secant.value == pytest.approx(C, rel=tolerance)
    assert found.tangent_compliance(100.0).value == pytest.approx(C, rel=tolerance)
    assert found.mean_hysteresis.value == pytest.approx(2 * H * TOP**2 / 6, rel=tolerance)
    assert found.greatest_hysteresis.value == pytest.approx(H * TOP**2 / 2, rel=tolerance)
    assert found.greatest_at == pytest.approx(TOP / 2)
    assert found.hysteresis_at(100.0).value == pytest.approx(2 * H * 100 * 400, rel=tolerance)
    assert found.energy_lost.value == pytest.approx(2 * H * TOP**3 / 6, rel=tolerance)


def test_a_loop_gives_its_closed_form() -> None:
    found = cycles(cycle())
    check_loop(found)
    assert found.hysteresis_at_zero is not None
    assert found.hysteresis_at_zero.value == pytest.approx(0.0, abs=1e-12)
    assert found.backlash is None
    assert not found.by_cycle
    area = np.trapezoid(*cycle())  # of the polygon through the readings
    assert found.energy_lost.value == pytest.approx(area, rel=1e-3)


def test_a_pull_is_a_push_seen_from_behind() -> None:
    """The loop -F, -d: rising is unloading then, and all numbers are the same."""
    force, displacement = -cycle()
    found = hysteresis(np.concatenate([force, force[1:]]), np.concatenate([displacement, displacement[1:]]))
    assert found.static_compliance.value == pytest.approx(C)
    assert found.mean_hysteresis.value == pytest.approx(2 * H * TOP**2 / 6)
    assert found.greatest_at == pytest.approx(-TOP / 2)
    assert len(found.cycles) == 2


def test_a_stiffening_middle_line_has_a_tangent_that_is_not_its_secant() -> None:
    force, displacement = cycle()
    q, c = -4e-8, 3e-11
    found = hysteresis(force, displacement + q * force**2 + c * force**3)
    assert found.degree == 3
    for at in (0.0, 120.0, 500.0):
        assert found.tangent_compliance(at).value == pytest.approx(C + 2 * q * at + 3 * c * at**2, rel=1e-8)
    assert found.static_compliance.value == pytest.approx(C + q * TOP + c * TOP**2, rel=1e-9)
    with pytest.raises(InputError, match="the force 501 N lies outside the cycles, 0 to 500 N"):
        found.tangent_compliance(501.0)


def test_loads_of_both_signs_show_backlash_and_hysteresis_at_zero() -> None:
    """d = C F + b/2 sign F, less w/2 (1 - F^2/T^2) going up, plus it going down; the first quarter is left out."""
    up = np.linspace(-TOP, TOP, 50)
    b, w = 0.006, 0.002
    force = np.concatenate([up[25:], up[-2::-1], up[1:], up[-2::-1], up[1:]])
    sense = np.sign(np.diff(force, prepend=-1.0))
    half = w / 2 * (1 - (force / TOP) ** 2)
    found = hysteresis(force, C * force + b / 2 * np.sign(force) - half * sense)
    assert [branch.rising for branch in found.left_out] == [True]
    assert len(found.cycles) == 2
    assert found.range == (-TOP, TOP)
    assert found.backlash is not None
    assert found.hysteresis_at_zero is not None
    assert found.backlash.value == pytest.approx(b)
    assert found.hysteresis_at_zero.value == pytest.approx(w)
    assert found.mean_hysteresis.value == pytest.approx(w * 2 / 3)
    assert found.energy_lost.value == pytest.approx(w * 2 / 3 * 2 * TOP)
    assert found.static_compliance.value == pytest.approx(C + b / (2 * TOP))
    assert found.tangent_compliance(-200.0).value == pytest.approx(C)


def test_the_force_sensor_may_tremble_and_the_load_may_dwell() -> None:
    random = np.random.default_rng(2)
    force, displacement = np.hstack([cycle(), cycle(), cycle()])
    force, displacement = np.repeat(force, 5), np.repeat(displacement, 5)
    trembling = force + 2.0 * random.standard_normal(len(force))
    assert (np.diff(trembling) < 0).sum() > 400
    found = hysteresis(trembling, displacement)
    assert len(found.cycles) == 3
    assert found.static_compliance.value == pytest.approx(C, rel=0.01)
    assert found.mean_hysteresis.value == pytest.approx(2 * H * TOP**2 / 6, rel=0.05)


def test_turning_points() -> None:
    force = np.array([0, 1, 5, 4.8, 9, 10, 9.9, 10, 5, 0, 0.2, 0, 7, 7, 3.0])
    assert turning_points(force, 0.5) == (0, 7, 11, 13, 14)
    assert turning_points(-force, 0.5) == (0, 7, 11, 13, 14)
    assert turning_points(force, 0.05) == (0, 2, 3, 5, 6, 7, 9, 10, 11, 13, 14)
    assert turning_points(np.array([1.0, 0.9, 0.8]), 0.5) == (0, 2)
    assert [(b.first, b.last, b.rising) for b in branches_of(force)] == [
        (0, 8, True),
        (7, 12, False),
        (11, 14, True),
        (13, 15, False),
    ]


def test_intervals_cover_at_their_rate() -> None:
    """Cycles scatter in compliance and width by 2 and 5 percent, readings by 0.1 um; four cycles, 250 tests."""
    random = np.random.default_rng(11)
    draws, inside = 250, np.zeros(4)
    true = [C, 2 * H * TOP**2 / 6, C, 2 * H * 100 * 400]
    for _ in range(draws):
        each = [
            cycle(C * (1 + 0.02 * random.standard_normal()), H * (1 + 0.05 * random.standard_normal()), 1e-4, random)
            for _ in range(4)
        ]
        found = cycles(*each)
        asked = (found.static_compliance, found.mean_hysteresis, found.tangent_compliance(250.0), found.hysteresis_at(100.0))
        for k, (estimate, value) in enumerate(zip(asked, true, strict=True)):
            low, high = estimate.interval()
            inside[k] += low <= value <= high
        assert found.by_cycle
    low, high = stats.binom.ppf([0.0005 / 4, 1 - 0.0005 / 4], draws, 0.95)
    assert (inside >= low).all(), inside / draws
    assert (inside <= high).all(), inside / draws


def test_the_uncertainty_is_that_of_the_mean_of_the_cycles() -> None:
    compliances = C * np.array([0.98, 1.0, 1.03, 1.01])
    found = cycles(*(cycle(compliance) for compliance in compliances)).static_compliance
    assert found.value == pytest.approx(compliances.mean(), rel=1e-3)  # cycles that meet at the top share that reading
    assert found.standard_uncertainty == pytest.approx(compliances.std(ddof=1) / 2, rel=0.02)
    assert found.degrees_of_freedom == 3
    assert found.interval()[1] - found.value == pytest.approx(3.182 * found.standard_uncertainty, rel=1e-3)


@pytest.mark.parametrize("count", [1, 2])
def test_one_cycle_or_two_have_no_interval_and_say_so(count: int) -> None:
    random = np.random.default_rng(12)
    found = cycles(*(cycle(noise=1e-4, random=random) for _ in range(count)))
    assert found.mean_hysteresis.value == pytest.approx(2 * H * TOP**2 / 6, rel=0.2)
    for one in (found.static_compliance, found.mean_hysteresis, found.greatest_hysteresis, found.energy_lost):
        assert not one.known
        assert one.interval() == (-np.inf, np.inf)
    assert found.static_compliance.inverse().value == 1 / found.static_compliance.value
    checks = {check.name: check for check in found.checks}
    assert checks["uncertainty by cycle"].passed is False
    assert "no uncertainty is given; load three times at least in a run" in sentence_of(checks["uncertainty by cycle"])
    assert checks["energy is lost, not gained"].passed is None
    assert "with fewer than three cycles in a run nothing shows" in sentence_of(checks["energy is lost, not gained"])
    assert found.residual_std == pytest.approx(1e-4, rel=0.3)


def test_intervals_of_three_cycles_cover() -> None:
    random = np.random.default_rng(12)
    draws, inside = 300, 0
    for _ in range(draws):
        low, high = cycles(*(cycle(noise=1e-4, random=random) for _ in range(3))).mean_hysteresis.interval()
        inside += low <= 2 * H * TOP**2 / 6 <= high
    low, high = stats.binom.ppf([0.0005, 0.9995], draws, 0.95)
    assert low <= inside <= high


def test_what_remains_after_unloading() -> None:
    force, displacement = np.hstack([cycle(), cycle()[:, 1:]])
    drift = 0.003 * np.arange(len(force)) / (len(force) - 1)
    found = hysteresis(force, displacement + drift)
    assert found.remaining is not None
    assert found.remaining.value == pytest.approx(0.003, abs=1e-12)
    assert not found.remaining.known
    preloaded = hysteresis(force + 100.0, displacement)
    assert preloaded.remaining is None
    assert preloaded.hysteresis_at_zero is None


def test_signs_that_are_wrong_are_named() -> None:
    force, displacement = np.hstack([cycle(), cycle()[:, 1:], cycle()[:, 1:]])
    assert all(check.passed for check in hysteresis(force, displacement).checks)
    turned = {check.name: check for check in hysteresis(force, -displacement).checks}
    assert not turned["displacement with the force"].passed
    assert "turn the sensor's sign" in sentence_of(turned["displacement with the force"])
    swapped = {check.name: check for check in hysteresis(force, 2 * C * force - displacement).checks}
    assert not swapped["energy is lost, not gained"].passed
    assert "shifted in time" in sentence_of(swapped["energy is lost, not gained"])


def test_units_do_not_matter() -> None:
    random = np.random.default_rng(3)
    force, displacement = np.hstack([cycle(noise=1e-4, random=random)] + [cycle(noise=1e-4, random=random)[:, 1:]] * 2)
    one, other = hysteresis(force, displacement), hysteresis(force / 1000, displacement * 1000)
    assert other.degree == one.degree
    assert other.static_compliance.value / 1e6 == pytest.approx(one.static_compliance.value, rel=1e-10)
    assert other.mean_hysteresis.standard_uncertainty / 1e3 == pytest.approx(
        one.mean_hysteresis.standard_uncertainty, rel=1e-8
    )
    assert other.greatest_at * 1000 == pytest.approx(one.greatest_at)


BAD = {
    "loading only": (RISE, C * RISE, UnsupportedError, "only a rising branch covers its range of 500 N.* use static_line"),
    "unloading only": (RISE[::-1], C * RISE[::-1], UnsupportedError, "only a falling branch covers its range"),
    "one level": (
        np.full(9, 250.0),
        np.zeros(9),
        UnsupportedError,
        "the force is 250 N at every reading: one level gives no",
    ),
    "no load": (np.zeros(9), np.zeros(9), UnsupportedError, "the force is 0 N at every reading"),
    "two readings": (np.array([0, 1.0]), np.zeros(2), UnsupportedError, "2 readings are too few"),
    "empty": (np.zeros(0), np.zeros(0), UnsupportedError, "0 readings are too few"),
    "NaN force": (np.array([0, np.nan, 1]), np.zeros(3), InputError, "the force of reading 2 is nan; take the reading out"),
    "inf": (np.arange(3.0), np.array([0, 0, np.inf]), InputError, "the displacement of reading 3 is inf"),
    "shapes": (np.arange(3.0), np.zeros(4), InputError, r"got the shapes \(3,\) and \(4,\)"),
    "few": (np.array([0, 9, 0.0]), np.array([0, 1, 0.0]), UnsupportedError, "a branch has 2 readings, too few"),
    "noise": (
        np.random.default_rng(1).uniform(-1, 1, 60),
        np.zeros(60),
        UnsupportedError,
        "of 42 branches of the force only a falling branch covers",
    ),
}


@pytest.mark.parametrize("wrong", BAD)
def test_what_gives_no_hysteresis_is_refused(wrong: str) -> None:
    force, displacement, error, message = BAD[wrong]
    with pytest.raises(error, match=message):
        hysteresis(force, displacement)


def test_a_dead_band_that_is_none_is_refused() -> None:
    with pytest.raises(InputError, match=r"the dead band is 0\.7 of the force's range"):
        hysteresis(*cycle(), dead_band=0.7)


def test_the_rig_of_figure_6_11_is_a_straight_line() -> None:
    """Simulated displacements at the thesis's weights: 1/2.65 = 0.3774 um/N, which the thesis prints as 0.37."""
    exact = static_line(WEIGHTS, WEIGHTS / RIG)
    assert exact.compliance.value * 1e3 == pytest.approx(0.3774, abs=5e-5)
    assert exact.compliance.value == pytest.approx(1 / 2650, rel=1e-12)
    assert exact.stiffness().value == pytest.approx(2650, rel=1e-12)
    random = np.random.default_rng(7)
    draws, inside, stiff = 600, 0, 0
    for _ in range(draws):
        found = static_line(WEIGHTS, WEIGHTS / RIG + 0.001 + 5e-4 * random.standard_normal(9), range(9))
        low, high = found.compliance.interval()
        inside += low <= 1 / RIG <= high
        low, high = found.stiffness().interval()
        stiff += low <= RIG <= high
    low, high = stats.binom.ppf([0.0005, 0.9995], draws, 0.95)
    assert low <= inside <= high
    assert low <= stiff <= high
    slope = stats.linregress(WEIGHTS, WEIGHTS / RIG + np.sin(WEIGHTS) * 1e-3)
    mine = static_line(WEIGHTS, WEIGHTS / RIG + np.sin(WEIGHTS) * 1e-3)
    assert mine.compliance.value == pytest.approx(slope.slope, rel=1e-12)
    assert mine.offset.value == pytest.approx(slope.intercept, rel=1e-10)
    assert not mine.compliance.known
    assert mine.counted == Counted(1, False, 3)


def test_a_flat_line_has_no_stiffness() -> None:
    random = np.random.default_rng(1)
    found = static_line(WEIGHTS, 1e-3 * random.standard_normal(9), range(9))
    with pytest.raises(UnsupportedError, match="which holds zero: its inverse is unbounded"):
        found.stiffness()
    assert_allclose(found.nonlinearity, 1e-3, atol=2e-3)
