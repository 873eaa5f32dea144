"""Dwells: where a record shows that the axis stands, its samples say nothing of the friction of a motion."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import (
    DriveRecord,
    TorqueModel,
    differentiate,
    identify_balance,
    smoothed,
    standing,
    standstill,
    usable,
    window_of,
)
from elastogeo.errors import InputError, RankError

STEP, COULOMB, VISCOUS, CONSTANT, INERTIA = 0.002, 3.0, 0.02, 0.4, 0.002
TRUTH = {"inertia": INERTIA, "viscous": VISCOUS, "coulomb": COULOMB, "constant": CONSTANT}


def moves(seed: int, one_way: bool = False) -> np.ndarray:
    """Velocity of eight moves of 40 mm with rests of half a second between them; speeds of 5 to 100 mm/s, 500 mm/s^2."""
    random = np.random.default_rng(seed)
    rest = np.zeros(int(0.5 / STEP))
    parts = [rest]
    for k, speed in enumerate(random.uniform(5, 100, 8)):
        ramp = speed * np.arange(1, int(speed / 500 / STEP) + 1) / int(speed / 500 / STEP)
        at_speed = np.full(int((40 / speed - speed / 500) / STEP), speed)
        parts += [(1 if one_way or k % 2 == 0 else -1) * np.concatenate([ramp, at_speed, ramp[::-1]]), rest]
    return np.concatenate(parts)


def dwelling(seed: int, noise: float = 0.0, one_way: bool = False, held: bool = True) -> DriveRecord:
    """A record with rests, its motion derived from the position; at rest the drive holds any part of its friction."""
    random = np.random.default_rng(1000 + seed)
    v = moves(seed, one_way)
    time = STEP * np.arange(len(v))
    x = np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * STEP)])
    rests = np.cumsum(np.diff(np.concatenate([[0], (v == 0).astype(int)])) == 1)
    at_rest = random.uniform(-1, 1, rests.max() + 1)[rests] if held else 0.0
    friction = COULOMB * np.where(v == 0, at_rest, np.sign(v))
    current = INERTIA * np.gradient(v, STEP) + VISCOUS * v + friction + CONSTANT + 0.1 * random.standard_normal(len(v))
    return recorded(f"run {seed}", time, np.round(x + noise * random.standard_normal(len(v)), 6), current)


def recorded(run: str, time: np.ndarray, x: np.ndarray, current: np.ndarray, cutoff: float = 30.0) -> DriveRecord:
    made, effort = differentiate(time, x, cutoff), smoothed(time, current, cutoff)
    rest = standing(time, x, made.velocity, window_of(STEP, cutoff))
    keep = ~made.edge
    columns = (time, made.position, made.velocity, made.acceleration, effort)
    return DriveRecord(run, "X", *(c[keep] for c in columns), cutoff=cutoff, standing=rest[keep])


@pytest.mark.parametrize("noise", [0.0, 5e-4])
@pytest.mark.parametrize("held", [False, True])
def test_coulomb_friction_of_a_record_with_dwells_is_right_by_default(noise: float, held: bool) -> None:
    fit = identify_balance([dwelling(seed, noise, held=held) for seed in range(4)])
    assert fit.determined["coulomb"] == pytest.approx(COULOMB, rel=0.02)
    for (name, true), (low, high) in zip(TRUTH.items(), fit.solution.interval(), strict=True):
        assert low - 0.002 * true < true < high + 0.002 * true, name
    wrong = identify_balance([dwelling(seed, noise, held=held) for seed in range(4)], TorqueModel(least_speed=0.0))
    assert abs(wrong.determined["coulomb"] - COULOMB) > 0.5, "without it the dwells ruin the fit: the test has a bite"


@pytest.mark.parametrize("noise", [0.0, 5e-4])
def test_a_record_in_one_direction_names_the_combination_and_has_no_number_for_its_parts(noise: float) -> None:
    fit = identify_balance([dwelling(seed, noise, one_way=True) for seed in range(4)])
    assert fit.mixed == {"coulomb": {"coulomb": pytest.approx(1.0), "constant": pytest.approx(1.0, rel=0.01)}}
    assert "coulomb" not in fit.determined
    assert "constant" not in fit.determined
    assert "coulomb + constant is determined as one number only" in fit.sentence
    assert "runs in both directions would separate them" in fit.sentence
    at = fit.solution.labels.index("coulomb")
    assert fit.solution.values[at] == pytest.approx(COULOMB + CONSTANT, rel=0.01)


def test_the_rests_are_found_where_they_are_and_nowhere_else() -> None:
    v = moves(3)
    time = STEP * np.arange(len(v))
    x = np.cumsum(v) * STEP + 5e-4 * np.random.default_rng(1).standard_normal(len(v))
    found = standing(time, x, differentiate(time, x, 30.0).velocity, window_of(STEP, 30.0))
    truly = v == 0
    assert (found & truly).sum() > 0.9 * truly.sum()
    nearly = np.convolve(truly, np.ones(7), "same") > 0
    assert not (found & ~nearly).any()


def test_a_reversal_without_a_dwell_is_no_rest() -> None:
    time = STEP * np.arange(4000)
    x = 20 * np.sin(2 * np.pi * 0.5 * time)
    record = recorded("sine", time, x, np.cos(2 * np.pi * 0.5 * time))
    assert not standstill(record).near.any()
    assert standstill(record).speed == 0.0


def test_the_speed_of_the_noise_at_rest_is_the_least_speed() -> None:
    """White noise s of the position, low-passed and differentiated: u(v) by Parseval from the gain of both."""
    noise = 5e-4
    rest = standstill(dwelling(1, noise))
    frequency = np.linspace(0, 250, 20001)
    low_pass = 1 / (1 + (np.tan(np.pi * frequency * STEP) / np.tan(np.pi * 30 * STEP)) ** 4)
    per_hertz = noise**2 * 2 * STEP
    deviation = np.sqrt(np.trapezoid(per_hertz * (2 * np.pi * frequency * low_pass) ** 2, frequency))
    assert 2.0 * deviation < rest.speed < 4.0 * deviation


def test_a_rest_that_only_the_sign_of_a_recorded_velocity_shows() -> None:
    """A control's own velocity, with noise at rest: its mean is zero there, its signs are noise."""
    random = np.random.default_rng(4)
    v = moves(2)
    noisy = v + 0.3 * random.standard_normal(len(v))
    time = STEP * np.arange(len(v))
    effort = VISCOUS * v + COULOMB * np.sign(v) + 0.1 * random.standard_normal(len(v))
    record = DriveRecord("r", "X", time, np.cumsum(v) * STEP, noisy, np.gradient(v, STEP), effort)
    rest = standstill(record)
    assert (rest.near & (v == 0)).sum() > 0.9 * (v == 0).sum()
    assert usable(record, TorqueModel())[v == 0].mean() < 0.01
    assert usable(record, TorqueModel())[np.abs(v) > 2].mean() > 0.99
    assert 0.5 < rest.speed < 1.2
    assert identify_balance([record]).determined["coulomb"] == pytest.approx(COULOMB, rel=0.01)


def test_a_motion_that_is_sampled_too_slowly_is_no_rest() -> None:
    """3 Hz at five samples a second: the sign changes from sample to sample, and the axis does not stand."""
    time = 0.2 * np.arange(400)
    v = 50 * np.cos(2 * np.pi * 3 * time)
    record = DriveRecord("r", "X", time, np.sin(time), v, v, np.sign(v))
    assert not standstill(record).near.any()


def test_a_stated_least_speed_is_kept_as_stated() -> None:
    record = dwelling(1)
    fit = identify_balance([record], TorqueModel(least_speed=1.0))
    assert fit.samples["run 1"] == int((np.abs(record.velocity) > 1.0).sum())


def test_an_axis_that_stands_in_the_whole_record_is_refused() -> None:
    time = STEP * np.arange(2000)
    x = 5e-4 * np.random.default_rng(1).standard_normal(2000)
    with pytest.raises(RankError, match=r"none of its \d+ samples shows a motion: the axis stands still"):
        identify_balance([recorded("still", time, x, np.sin(time))])


def test_a_mask_of_another_length_is_refused() -> None:
    record = dwelling(1)
    with pytest.raises(InputError, match="standing has 3 values"):
        DriveRecord("r", "X", *([record.time] * 5), standing=np.zeros(3, dtype=bool))


def test_the_window_is_a_period_of_the_low_pass() -> None:
    assert window_of(0.002, 25.0) == 20
    assert window_of(0.1, None) == 8
    assert_allclose(standing(np.arange(4.0), np.zeros(4), np.zeros(4), 8), np.zeros(4))
