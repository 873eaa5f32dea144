"""Springs in series: the table of the set-up, the rig check."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import norm, t

from elastogeo.drive.series import SetupCompliance, rig_check, setup_compliance, with_rig
from elastogeo.errors import InputError

ENGAGEMENT = np.array([0.04, 0.08, 0.12])
FORCE = np.array([189.0, 450.0, 750.0])


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
    u_predicted = float(np.hypot(3e-6, 2e-6))
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
