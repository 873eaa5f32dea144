"""From current to torque to force, and back; what a drive may not be."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import (
    FeedDrive,
    KnownBalance,
    TorqueModel,
    balance_effort,
    current_from_effort,
    effort_from_current,
    effort_from_force,
    force_from_effort,
    identify_balance,
    known_torque_balance,
    motor_parameters,
)
from elastogeo.drive.records import DriveRecord
from elastogeo.errors import InputError

SCREW = FeedDrive("X", torque_constant=1650.0, pitch=10.0, efficiency=0.9)
TABLE_6_4 = {
    "X": KnownBalance("X", inertia=6.0, viscous=90.0, coulomb=1550.0, constant=0.0),
    "Y": KnownBalance("Y", inertia=4.0, viscous=70.0, coulomb=1600.0, constant=0.0),
}
"""In N mm s^2, N mm s/rad, N mm: 0.006 kg m^2, 0.09 N m s/rad, 1.55 N m, ..."""


def test_a_screw_turns_torque_into_force() -> None:
    """Eqs. 6.10 and 6.11: 2.64 N m through a screw of 10 mm at 90 %: 0.9 * 2 pi * 2640 / 10 N."""
    assert_allclose(force_from_effort(SCREW, np.array([2640.0])), 0.9 * 2 * pi * 264.0, rtol=1e-12)


@pytest.mark.parametrize(
    ("drive", "force"),
    [
        (SCREW, 1650.0 * 0.9 * 2 * pi / 10),
        (FeedDrive("X", torque_constant=1650.0, pitch=10.0, gear_ratio=2.0), 1650.0 * 2 * 2 * pi / 10),
        (FeedDrive("Y", torque_constant=1000.0, pinion_radius=20.0, gear_ratio=10.0), 500.0),
        (FeedDrive("Z", force_constant=90.0, sense=-1), -90.0),
        (FeedDrive("C", torque_constant=500.0, gear_ratio=3.0), 1500.0),
    ],
)
def test_every_kind_of_drive_turns_an_ampere_into_force(drive: FeedDrive, force: float) -> None:
    current = np.array([1.0, -2.0])
    effort = effort_from_current(drive, current)
    assert_allclose(force_from_effort(drive, effort), force * current, rtol=1e-12)
    assert_allclose(current_from_effort(drive, effort), current, rtol=1e-12)
    assert_allclose(effort_from_force(drive, force_from_effort(drive, effort)), effort, rtol=1e-12)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"torque_constant": 1.0, "force_constant": 1.0}, "a torque constant and a force constant"),
        ({"force_constant": 1.0, "pitch": 10.0}, "is a linear motor, which turns no screw"),
        ({"pitch": 10.0, "pinion_radius": 3.0}, "a pitch and a pinion radius"),
        ({"pitch": -10.0}, "is not a positive number"),
        ({"torque_constant": float("nan")}, "is not a positive number"),
        ({"efficiency": 90.0}, r"the efficiency 90; it lies between 0 and 1 \(90 % is 0.9\)"),
        ({"sense": 2}, "the sense 2; write 1 or -1"),
        ({"relative_uncertainty": 5.0}, r"the relative uncertainty 5; .*\(5 % is 0.05\)"),
    ],
)
def test_a_drive_that_contradicts_itself_is_refused(settings: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        FeedDrive("X", **settings)


def test_what_is_not_known_of_a_drive_is_asked_for() -> None:
    bare = FeedDrive("X")
    with pytest.raises(InputError, match="neither torque_constant_N_m_per_A nor force_constant_N_per_A"):
        effort_from_current(bare, np.ones(2))
    with pytest.raises(InputError, match="no pitch_mm and no pinion_radius_mm; its torque gives no force"):
        force_from_effort(bare, np.ones(2))


def test_a_known_balance_is_equation_6_6() -> None:
    velocity, acceleration = np.array([20.0, -20.0, 5.0]), np.array([100.0, 0.0, -50.0])
    ratio = 10.0 / (2 * pi)
    expected = 6.0 * acceleration / ratio + 90.0 * velocity / ratio + 1550.0 * np.sign(velocity)
    assert_allclose(balance_effort(TABLE_6_4["X"], SCREW, velocity, acceleration), expected, rtol=1e-12)


def test_a_balance_that_drives_its_motor_is_refused() -> None:
    with pytest.raises(InputError, match="axis X has an inertia or a friction that is negative"):
        KnownBalance("X", coulomb=-1.0)
    with pytest.raises(InputError, match="smooth speed"):
        KnownBalance("X", smooth_speed=0.0)


def test_motor_parameters_are_those_that_were_known() -> None:
    found = motor_parameters(known_torque_balance(TABLE_6_4["Y"], SCREW), SCREW)
    assert [(p.label, p.unit) for p in found] == [
        ("inertia", "kg m²"),
        ("viscous", "N m s/rad"),
        ("coulomb", "N m"),
        ("constant", "N m"),
    ]
    assert_allclose([p.estimate.value for p in found], [0.004, 0.07, 1.60, 0.0], rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize(("axis", "load"), [("X", 2640.0), ("Y", 2590.0)])
def test_table_6_4_comes_back_within_its_intervals(axis: str, load: float) -> None:
    """Simulated circles of 200 um engagement at 1000 mm/min, and unloaded ones: J, B, tau_c and tau_d of Table 6.4."""
    true = TABLE_6_4[axis]
    drive = FeedDrive(axis, torque_constant=1650.0, pitch=10.0, efficiency=0.9)
    random = np.random.default_rng(64)
    records = []
    for k, (feed, loaded) in enumerate([(1000 / 60, 1), (1000 / 60, 1), (1000 / 60, 0), (2000 / 60, 0), (2000 / 60, 0)]):
        time = np.arange(0, 2 * 2 * pi * 56.4 / feed, 0.02)
        theta = feed / 56.4 * time + (axis == "Y") * pi / 2
        velocity, acceleration = -feed * np.sin(theta), -(feed**2) / 56.4 * np.cos(theta)
        effort = balance_effort(true, drive, velocity, acceleration) + loaded * load * np.cos(theta)
        effort += 20.0 * random.standard_normal(len(time))
        pattern = {"load": loaded * np.cos(theta)}
        records.append(
            DriveRecord(str(k), axis, time, 56.4 * np.cos(theta), velocity, acceleration, effort, pattern, "N mm")
        )
    fit = identify_balance(records, TorqueModel(least_speed=0.5))
    at = {label: k for k, label in enumerate(fit.solution.labels)}
    interval = fit.solution.interval(0.99)
    ratio = drive.transmission_ratio
    truth = {"inertia": true.inertia / ratio, "viscous": true.viscous / ratio, "coulomb": true.coulomb, "load": load}
    for label, value in truth.items():
        low, high = interval[at[label]]
        assert low <= value <= high, label
    assert fit.solution.standard_uncertainty[at["load"]] < 0.01 * load
