"""Current-based force against a dynamometer: the delay, the line and its coverage on simulated records, what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import lfilter

from elastogeo.drive.force_agreement import ForceRecord, SharedError, compare_forces, find_delay
from elastogeo.errors import DegreesOfFreedomError, InputError, UnsupportedError
from elastogeo.machine import Array

Force = Callable[[Array], Array]


def engagement(time: Array) -> Array:
    """A ball-roller test in one axis [N]: contact, two turns at each of three engagements, leaving."""
    level = np.interp(time, [2, 3, 9, 10, 16, 17, 23, 24], [0, 190, 190, 450, 450, 750, 750, 0])
    return np.asarray(level * np.cos(2 * np.pi * time / 3.0))


def record(
    force: Force, rate: float, span: tuple[float, float] = (0.0, 26.0), noise: float = 0.0, seed: int = 0, clock: float = 0.0
) -> ForceRecord:
    """The force as sampled at a rate [Hz] on a clock that reads `clock` seconds more."""
    time = np.arange(span[0], span[1], 1 / rate)
    return ForceRecord(time + clock, force(time) + noise * np.random.default_rng(seed).standard_normal(len(time)))


def correlated(count: int, length: float, random: np.random.Generator) -> Array:
    """Noise of unit variance whose correlation falls by 1/e over `length` samples."""
    keep = np.exp(-1 / length)
    return np.asarray(lfilter([np.sqrt(1 - keep**2)], [1, -keep], random.standard_normal(count + int(10 * length))))[-count:]


@pytest.mark.parametrize("delay", [-0.731, -0.02, 0.0, 0.0137, 0.4, 1.2])
@pytest.mark.parametrize(("current", "dynamometer"), [(100.0, 1000.0), (250.0, 250.0), (200.0, 77.0)])
def test_the_delay_is_found_between_the_samples(delay: float, current: float, dynamometer: float) -> None:
    found = find_delay(
        record(engagement, current, noise=5.0, seed=1, clock=delay),
        record(engagement, dynamometer, (0.5013, 25.0), noise=5.0, seed=2),
        1.4,
    )
    assert found.seconds == pytest.approx(delay, abs=0.15 / max(current, dynamometer))
    assert found.correlation > 0.99
    assert found.rival < found.correlation


def test_the_delay_does_not_mind_gain_and_offset_and_turns_its_sign_with_the_records() -> None:
    late, plain = record(engagement, 200.0, clock=0.123), record(engagement, 333.0)
    found = find_delay(late, plain, 1.0)
    scaled = find_delay(ForceRecord(late.time, 40 + 0.8 * late.force), plain, 1.0)
    assert scaled.seconds == pytest.approx(found.seconds, abs=1e-9)
    assert find_delay(plain, late, 1.0).seconds == pytest.approx(-found.seconds, abs=1e-3)


def test_gain_and_offset_and_the_differences_of_exact_records_are_exact() -> None:
    plain = record(engagement, 200.0)
    other = ForceRecord(plain.time, 12.0 + 1.05 * plain.force)
    found = compare_forces([(other, plain)], 0.0)
    assert (found.gain, found.offset) == (pytest.approx(1.05, rel=1e-12), pytest.approx(12.0, rel=1e-12))
    difference = other.force - plain.force
    assert found.rms_difference == pytest.approx(np.sqrt(np.mean(difference**2)), rel=1e-12)
    assert found.maximum_difference == pytest.approx(np.abs(difference).max(), rel=1e-12)
    assert not found.agrees
    assert "gain 1 and offset 0 lie outside" in found.sentence
    same = compare_forces([(plain, plain)], 0.5)
    assert same.agrees
    assert same.delays[0].seconds == pytest.approx(0.0, abs=1e-9)
    assert "both 1 and 0 lie within" in same.sentence


def test_clocks_of_their_own_are_brought_together() -> None:
    found = compare_forces(
        [(record(lambda t: 20 + 0.9 * engagement(t), 100.0, clock=0.311), record(engagement, 1000.0, (1.0, 24.5)))], 1.0
    )
    assert found.gain == pytest.approx(0.9, abs=1e-3)
    assert found.offset == pytest.approx(20.0, abs=0.1)
    assert found.readings == pytest.approx(2350, abs=2)
    assert found.maximum_difference > 60


def test_the_line_is_ordinary_least_squares_and_the_noise_of_the_reference_is_put_right() -> None:
    random = np.random.default_rng(3)
    time = np.arange(0, 200.0, 0.01)
    truth = 300 + 100 * correlated(len(time), 30, random)
    noisy = ForceRecord(time, truth + 30 * random.standard_normal(len(time)))
    seen = ForceRecord(time, 5 + 1.1 * truth + 10 * random.standard_normal(len(time)))
    plain = compare_forces([(seen, noisy)], 0.0)
    assert_allclose((plain.gain, plain.offset), np.polyfit(noisy.force, seen.force, 1), rtol=1e-10)
    assert plain.gain_interval[1] < 1.1
    right = compare_forces([(seen, noisy)], 0.0, dynamometer_noise=30.0)
    assert right.attenuation == pytest.approx(30**2 / np.var(noisy.force), rel=1e-12)
    assert right.gain == pytest.approx(1.1, abs=4 * right.gain_uncertainty)
    assert right.offset == pytest.approx(5.0, abs=4 * right.offset_uncertainty)
    assert right.gain_uncertainty == pytest.approx(plain.gain_uncertainty / (1 - right.attenuation), rel=1e-12)


@pytest.mark.parametrize("by_run", [False, True], ids=["blocks of one run", "six runs"])
def test_the_intervals_cover_at_their_rate_though_the_residuals_hold_on(by_run: bool) -> None:
    """Simulated: friction left in the current as noise that holds on over 40 readings; 400 trials, tolerance 4 sigma."""
    random, trials = np.random.default_rng(11), 400
    time = np.arange(0.0, 120.0, 0.02)
    force = 200 * np.sin(2 * np.pi * time / 7.0) + 100
    runs = 6 if by_run else 1
    inside = np.zeros(2)
    naive = 0
    for _ in range(trials):
        pairs = []
        for _ in range(runs):
            left = 15 * correlated(len(time), 40, random)
            pairs.append((ForceRecord(time, 3 + 0.97 * force + left), ForceRecord(time, force)))
        found = compare_forces(pairs, 0.0)
        assert found.by_run == by_run
        inside += [
            found.gain_interval[0] <= 0.97 <= found.gain_interval[1],
            found.offset_interval[0] <= 3.0 <= found.offset_interval[1],
        ]
        simple = found.residual_std / np.sqrt(found.readings)
        naive += abs(found.offset - 3.0) <= 1.96 * np.sqrt(1.5) * simple  # sqrt(1 + mean^2 / variance) of this force
    assert_allclose(inside / trials, 0.95, atol=4 * np.sqrt(0.95 * 0.05 / trials))
    assert naive / trials < 0.5


def test_a_scale_known_to_a_part_only_widens_the_gain() -> None:
    plain = record(engagement, 200.0)
    other = ForceRecord(plain.time, 1.03 * plain.force + 5 * np.random.default_rng(4).standard_normal(len(plain.time)))
    bare, stated = (compare_forces([(other, plain)], 0.0, scale_uncertainty=u) for u in (0.0, 0.02))
    assert (bare.gain_is_one, stated.gain_is_one) == (False, True)
    assert stated.gain_uncertainty == pytest.approx(np.hypot(bare.gain_uncertainty, 0.02 * bare.gain), rel=1e-12)
    assert stated.offset_interval == bare.offset_interval


def test_what_all_runs_share_moves_gain_and_offset_by_what_it_is() -> None:
    """A zero that is off is offset alone, a force that is 2 % off is gain alone; no scatter shows either."""
    plain = record(engagement, 200.0)
    other = ForceRecord(plain.time, plain.force + 5 * np.random.default_rng(4).standard_normal(len(plain.time)))
    zero = SharedError("zero", 0.5, np.inf, (np.full(len(plain.time), 10.0),))
    part = SharedError("part", 0.02, np.inf, (plain.force,))
    bare, stated = (compare_forces([(other, plain)], 0.0, shared=shared) for shared in ((), (zero, part)))
    assert (stated.gain, stated.offset) == (bare.gain, bare.offset)
    assert stated.offset_uncertainty == pytest.approx(np.hypot(bare.offset_uncertainty, 5.0), rel=1e-9)
    assert stated.gain_uncertainty == pytest.approx(np.hypot(bare.gain_uncertainty, 0.02), rel=1e-9)


def test_directions_of_one_run_are_one_run() -> None:
    plain = record(engagement, 200.0)
    runs = [(ForceRecord(plain.time, plain.force + k), plain) for k in range(8)]
    by_direction = compare_forces(runs, 0.0)
    by_run = compare_forces(runs, 0.0, names=[f"run {k // 2}" for k in range(8)])
    assert (by_direction.units, by_run.units) == (8, 4)
    assert by_run.offset_uncertainty > 1.2 * by_direction.offset_uncertainty


def test_sound_forces_agree_at_their_rate_though_all_runs_share_friction() -> None:
    """Simulated: 4 N of friction identified once, from 4 runs, and 1 N left by each run; 200 trials, tolerance 4 sigma."""
    random, trials = np.random.default_rng(12), 200
    time = np.arange(0.0, 6.0, 0.03)
    force, sense = 200 * np.sin(2 * np.pi * time / 3.0) + 100, np.sign(np.cos(2 * np.pi * time / 3.0))
    plain = ForceRecord(time, force)
    inside, agree = np.zeros(2), 0
    for _ in range(trials):
        drawn = 4 * random.standard_normal(4)
        shared = SharedError("friction", float(drawn.std(ddof=1)) / 2, 3.0, (sense + 1,) * 6)
        off = drawn.mean() * (sense + 1)
        pairs = [(ForceRecord(time, force + off + random.standard_normal()), plain) for _ in range(6)]
        found = compare_forces(pairs, 0.0, shared=[shared])
        inside += [
            abs(found.gain - 1) <= np.ptp(found.gain_interval) / 2,
            abs(found.offset) <= np.ptp(found.offset_interval) / 2,
        ]
        agree += found.agrees
    assert_allclose(inside[1] / trials, 0.95, atol=4 * np.sqrt(0.95 * 0.05 / trials))
    assert agree / trials > 0.95 - 4 * np.sqrt(0.95 * 0.05 / trials)


def test_a_periodic_force_has_no_distinct_delay_beyond_half_a_period() -> None:
    def swing(time: Array) -> Array:
        return np.asarray(300 * np.cos(2 * np.pi * time / 3.0))

    late, plain = record(swing, 100.0, noise=10.0, clock=0.2), record(swing, 100.0, noise=10.0, seed=5)
    with pytest.raises(UnsupportedError, match="no distinct delay within 4 s"):
        find_delay(late, plain, 4.0)
    assert find_delay(late, plain, 1.4).seconds == pytest.approx(0.2, abs=1e-3)


def test_a_delay_at_the_bound_is_refused() -> None:
    with pytest.raises(UnsupportedError, match=r"no distinct delay within 0.3 s"):
        find_delay(record(engagement, 100.0, clock=0.5), record(engagement, 100.0), 0.3)


def test_a_ramp_has_no_feature_to_align_by() -> None:
    def ramp(time: Array) -> Array:
        return 10 * time

    with pytest.raises(UnsupportedError, match="no distinct delay"):
        find_delay(record(ramp, 50.0, clock=0.1), record(ramp, 50.0), 1.0)


def test_a_reaction_of_opposite_sign_is_named() -> None:
    with pytest.raises(UnsupportedError, match=r"opposite signs .* measures the reaction; turn one sign"):
        find_delay(record(lambda t: -engagement(t), 100.0), record(engagement, 100.0), 0.2)


def test_records_that_have_nothing_in_common_are_refused() -> None:
    noise = record(lambda t: 0 * t, 100.0, noise=1.0)
    with pytest.raises(UnsupportedError, match=r"under 0.5; widen the bound"):
        find_delay(noise, record(engagement, 100.0), 1.0)
    for clock in (27.0, 100.0):
        with pytest.raises(UnsupportedError, match="fewer than three delays"):
            find_delay(record(engagement, 100.0, clock=clock), record(engagement, 100.0), 2.0)
    with pytest.raises(UnsupportedError, match="share 0 samples"):
        compare_forces([(record(engagement, 100.0, clock=100.0), record(engagement, 100.0))], 0.0)


@pytest.mark.parametrize("most", [-1.0, np.nan, 14.0])
def test_the_bound_lies_within_half_of_the_record(most: float) -> None:
    with pytest.raises(InputError, match="between 0 and half of that"):
        find_delay(record(engagement, 100.0), record(engagement, 100.0), most)


@pytest.mark.parametrize(
    ("time", "force", "error", "message"),
    [
        (np.arange(9.0), np.arange(8.0), InputError, "one force per time, and 8 at least"),
        (np.arange(1.0), np.arange(1.0), InputError, "8 at least"),
        (np.arange(9.0), np.r_[np.arange(8.0), np.nan], InputError, "1 samples of a force record are NaN"),
        (np.arange(9.0)[::-1], np.arange(9.0), InputError, r"does not rise at sample 1 \(7 s\)"),
        (np.r_[np.arange(8.0), 7.0], np.arange(9.0), InputError, r"does not rise at sample 8 \(7 s\)"),
        (np.arange(9.0), np.full(9, 3.0), UnsupportedError, "is 3 N throughout"),
    ],
)
def test_what_is_no_record_is_refused(time: Array, force: Array, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        ForceRecord(time, force)


def test_too_short_a_record_gives_no_uncertainty() -> None:
    """Residuals that hold on over a good part of the record."""
    plain = record(engagement, 100.0)
    drift = replace(plain, force=plain.force + 30 * np.sin(2 * np.pi * plain.time / 20.0))
    with pytest.raises(DegreesOfFreedomError, match=r"holds on over .* record longer, or 4 runs"):
        compare_forces([(drift, plain)], 0.0)


def test_nothing_and_nonsense_are_refused() -> None:
    plain = record(engagement, 100.0)
    with pytest.raises(InputError, match="no run to compare"):
        compare_forces([], 1.0)
    with pytest.raises(InputError, match="finite and not negative"):
        compare_forces([(plain, plain)], 1.0, dynamometer_noise=-1.0)
    with pytest.raises(UnsupportedError, match="against a noise of 1e\\+03 N"):
        compare_forces([(plain, plain)], 0.0, dynamometer_noise=1000.0)
