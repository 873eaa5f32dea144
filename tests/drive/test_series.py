"""Springs in series: round trips, limits, tables, uncertainty against finite differences and random draws, the rig check."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import norm, t

from elastogeo.drive.series import (
    SetupCompliance,
    compliance_from_stiffness,
    engagement_from_force,
    force_from_engagement,
    in_series,
    in_series_uncertainty,
    inverse_uncertainty,
    machine_compliance,
    machine_compliance_uncertainty,
    rig_check,
    setup_compliance,
    stiffness_from_compliance,
    with_rig,
)
from elastogeo.errors import InputError

ENGAGEMENT = np.array([0.04, 0.08, 0.12])
FORCE = np.array([189.0, 450.0, 750.0])


def test_two_equal_springs_in_series_are_half_as_stiff_and_a_rigid_one_changes_nothing() -> None:
    two = in_series(*compliance_from_stiffness([8000.0, 8000.0]))
    assert_allclose(stiffness_from_compliance(two), 4000.0, rtol=1e-15)
    assert_allclose(in_series(two, compliance_from_stiffness(np.inf)), two, rtol=0)
    assert stiffness_from_compliance(0.0) == np.inf


@pytest.mark.parametrize("setup", [5e-5, np.array([5.3e-5, 5.8e-5, 6.1e-5])], ids=["constant", "table"])
def test_the_compensation_undoes_the_set_up(setup: float | np.ndarray) -> None:
    machine = np.array([1.6e-4, 1.2e-4, 1.0e-4])
    engagement = engagement_from_force(FORCE, machine, setup)
    assert_allclose(machine_compliance(engagement, FORCE, setup), machine, rtol=1e-13)
    assert_allclose(force_from_engagement(engagement, machine, setup), FORCE, rtol=1e-14)


def test_the_compliance_scales_with_the_units_and_does_not_mind_the_sign_of_both() -> None:
    plain = machine_compliance(ENGAGEMENT, FORCE, 5e-5)
    assert_allclose(machine_compliance(ENGAGEMENT * 1000, FORCE, 5e-2), plain * 1000, rtol=1e-14)
    assert_allclose(machine_compliance(-ENGAGEMENT, -FORCE, 5e-5), plain, rtol=1e-15)


def test_the_table_is_read_along_straight_lines() -> None:
    over_engagement = SetupCompliance(compliance=(4e-5, 6e-5, 5e-5), engagement=(0.04, 0.08, 0.16))
    assert_allclose(setup_compliance(over_engagement, [0.04, 0.05, 0.12, 0.16], 1.0), [4e-5, 4.5e-5, 5.5e-5, 5e-5])
    over_force = SetupCompliance(compliance=(4e-5, 6e-5), force=(100.0, 300.0))
    assert_allclose(setup_compliance(over_force, 0.1, [100.0, 150.0, 300.0]), [4e-5, 4.5e-5, 6e-5])


@pytest.mark.parametrize(
    "setup",
    [
        SetupCompliance(constant=5e-5),
        SetupCompliance(compliance=(5e-5,)),
        SetupCompliance(compliance=(5e-5,), engagement=(0.1,)),
    ],
)
def test_a_single_point_is_a_constant(setup: SetupCompliance) -> None:
    assert_allclose(setup_compliance(setup, ENGAGEMENT, FORCE), np.full(3, 5e-5), rtol=0)


def test_outside_the_table_is_an_error_that_names_the_readings() -> None:
    setup = SetupCompliance(compliance=(4e-5, 6e-5), engagement=(0.05, 0.1))
    with pytest.raises(InputError, match=r"2 readings have the engagement 0.04 to 0.12 mm, outside the table .* 0.1 mm"):
        setup_compliance(setup, ENGAGEMENT, FORCE)
    with pytest.raises(InputError, match="the engagement of 1 readings is NaN"):
        setup_compliance(setup, [0.06, np.nan], 1.0)
    assert setup_compliance(setup, 0.1 + 1e-17, 1.0) == 6e-5


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({}, "one constant or the values of a table"),
        ({"constant": 1e-5, "compliance": (1e-5,)}, "give one of the two"),
        ({"constant": -1e-5}, "-1e-05 mm/N; each must be finite"),
        ({"constant": 1e-5, "force": (1.0,)}, "goes with no engagement"),
        ({"compliance": (1e-5, 2e-5)}, "over engagement or over force"),
        ({"compliance": (1e-5, 2e-5), "engagement": (1.0, 2.0), "force": (1.0, 2.0)}, "over engagement or over force"),
        ({"compliance": (1e-5, 2e-5), "engagement": (0.1,)}, "2 compliances at 1 points"),
        ({"compliance": (1e-5,), "force": (1.0, 2.0)}, "1 compliances at 2 points"),
        ({"compliance": (1e-5, 2e-5), "force": (200.0, 100.0)}, "must rise, they are 200, 100"),
        ({"compliance": (1e-5, 2e-5), "force": (100.0, 100.0)}, "must rise"),
        ({"compliance": (1e-5, np.nan), "force": (100.0, 200.0)}, "must be finite"),
        ({"constant": 1e-5, "standard_uncertainty": -1.0}, "uncertainty of the set-up is -1 mm/N"),
    ],
)
def test_a_contradictory_set_up_is_refused(fields: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        SetupCompliance(**fields)  # type: ignore[arg-type]


def test_what_is_no_reading_is_refused() -> None:
    with pytest.raises(InputError, match="the force of 1 readings is zero"):
        machine_compliance(ENGAGEMENT, [100.0, 0.0, 300.0], 0.0)
    with pytest.raises(InputError, match="the engagement of a reading is NaN"):
        machine_compliance([np.nan, 0.1, 0.1], FORCE, 0.0)
    with pytest.raises(InputError, match="a stiffness is -3 N/mm"):
        compliance_from_stiffness([1.0, -3.0])
    with pytest.raises(InputError, match="a stiffness is nan"):
        compliance_from_stiffness(np.nan)
    with pytest.raises(InputError, match="a compliance is -1e-06 mm/N"):
        stiffness_from_compliance([-1e-6])
    with pytest.raises(InputError, match="no spring"):
        in_series()
    with pytest.raises(InputError, match="no positive compliance"):
        force_from_engagement(0.1, 0.0, 0.0)


def test_the_uncertainty_of_the_compliance_is_that_of_finite_differences() -> None:
    values = np.array([0.12, 750.0, 6.1e-5])
    uncertainties = np.array([0.4e-3, 20.0, 2e-6])
    steps = 1e-4 * values
    slopes = [
        (machine_compliance(*(values + step)) - machine_compliance(*(values - step))) / (2 * step.max())
        for step in np.diag(steps)
    ]
    stated = machine_compliance_uncertainty(values[0], values[1], *uncertainties)
    assert_allclose(stated, np.linalg.norm(slopes * uncertainties), rtol=1e-7)


def test_the_uncertainty_of_an_inverse_and_of_a_sum_is_that_of_random_draws() -> None:
    random = np.random.default_rng(5)
    draws = 2650.0 + 20.0 * random.standard_normal(200_000)
    # The standard deviation of 2e5 draws is known to 1 / sqrt(4e5) = 0.16 %; 4 sigma, and (u / v)^2 = 6e-5 of higher orders.
    assert inverse_uncertainty(2650.0, 20.0) == pytest.approx(np.std(1 / draws), rel=7e-3)
    other = 1.6e-4 + 3e-6 * random.standard_normal(200_000)
    assert in_series_uncertainty(3e-6, inverse_uncertainty(2650.0, 20.0)) == pytest.approx(
        np.std(other + 1 / draws), rel=7e-3
    )


def test_the_rig_check_is_the_normalised_error_of_iso_13528_when_degrees_of_freedom_are_many() -> None:
    measured, predicted = np.array([5.194e-4, 5.6e-4]), np.array([5.325e-4, 5.325e-4])
    check = rig_check(measured, 6e-6, predicted, 8e-6)
    k = norm.ppf(0.975)
    expected = (measured - predicted) / np.hypot(k * 6e-6, k * 8e-6)
    assert_allclose(check.normalised_error, expected, rtol=1e-9)
    assert check.agrees.tolist() == [True, False]
    assert_allclose(check.expanded_uncertainty, k * 1e-5, rtol=1e-9)


def test_the_rig_check_counts_degrees_of_freedom_by_welch_and_satterthwaite() -> None:
    check = rig_check(5.2e-4, 6e-6, 5.3e-4, 8e-6, freedom=(4, 6))
    freedom = 10.0**4 / (6.0**4 / 4 + 8.0**4 / 6)
    assert_allclose(check.degrees_of_freedom, freedom, rtol=1e-12)
    assert_allclose(check.expanded_uncertainty, t.ppf(0.975, freedom) * 1e-5, rtol=1e-9)
    assert_allclose(rig_check(5.2e-4, 3e-6, 5.3e-4, 0.0, u_shared=4e-6).standard_uncertainty, 5e-6, rtol=1e-12)


def test_the_rig_check_agrees_at_its_stated_rate() -> None:
    """Predicted as machine and rig, each with noise of its own; a force scale of 2 % common to both, in closed form."""
    random = np.random.default_rng(7)
    trials, rig, machine, u_scale = 20_000, 3.77e-4, 1.55e-4, 0.02
    scale = 1 + u_scale * random.standard_normal(trials)
    measured = (rig + machine) / scale + 4e-6 * random.standard_normal(trials)
    predicted = with_rig(
        machine / scale + 3e-6 * random.standard_normal(trials), rig + 2e-6 * random.standard_normal(trials)
    )
    u_predicted = in_series_uncertainty(3e-6, 2e-6)
    check = rig_check(measured, 4e-6, predicted, u_predicted, u_shared=u_scale * rig)
    # 4 sigma of the share of 20 000 trials is 0.6 %.
    assert check.agrees.mean() == pytest.approx(0.95, abs=0.0065)
    assert rig_check(measured, 4e-6, predicted, u_predicted).agrees.mean() < 0.9


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.nan, 1.0, 1.0, 1.0), "NaN or infinite"),
        ((1.0, -1.0, 1.0, 1.0), "is negative"),
        ((1.0, 0.0, 1.0, 0.0), "have no uncertainty"),
    ],
)
def test_the_rig_check_refuses_what_cannot_be_judged(arguments: tuple[float, ...], message: str) -> None:
    with pytest.raises(InputError, match=message):
        rig_check(*arguments)
