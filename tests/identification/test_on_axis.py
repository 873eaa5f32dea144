"""Where in the drive: known springs come back, the parts sum to the whole, what a missing channel leaves unsaid is said."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import linregress

from elastogeo.errors import InputError, RankError
from elastogeo.estimate import Estimate
from elastogeo.identification.static_tests.drive_train import (
    SERVO,
    STRUCTURE,
    TRANSMISSION,
    OnAxisRecord,
    where_in_the_drive,
)
from elastogeo.report import sentence_of

SPRINGS = {SERVO: 2e-5, TRANSMISSION: 5e-5, STRUCTURE: 3e-5}
"""Simulated truth [mm/N]."""

WHOLE = 1e-4


def simulated(
    noise: float = 0.0, seed: int = 0, runs: int = 6, feedback: str = "motor", backlash: float = 0.0, drift: float = 0.0
) -> OnAxisRecord:
    """Load ramps up and down about a slow motion to and fro; noise [mm] on each position, drift [mm] of the scale by run."""
    random = np.random.default_rng(seed)
    force = np.tile(np.concatenate([np.linspace(-400, 400, 20), np.linspace(400, -400, 20)]), runs)
    velocity = np.tile(np.repeat([2.0, -2.0, 2.0, -2.0], 10), runs)
    run = np.repeat([f"run {k}" for k in range(runs)], 40)
    command = 100 + 0.02 * np.cumsum(velocity)
    drifts = np.repeat(drift * random.standard_normal(runs), 40)

    def read(position: np.ndarray) -> np.ndarray:
        return position + noise * random.standard_normal(len(position))

    if feedback == "motor":
        motor = command + SPRINGS[SERVO] * force
        scale = motor + SPRINGS[TRANSMISSION] * force - backlash * np.sign(velocity)
    else:
        scale = command + SPRINGS[SERVO] * force
        motor = scale - SPRINGS[TRANSMISSION] * force
    deflection = scale - command + SPRINGS[STRUCTURE] * force
    return OnAxisRecord("X", force, command, read(motor), read(scale + drifts), read(deflection), velocity, tuple(run))


def compliances(found: object) -> dict[tuple[str, ...], float]:
    return {part.names: part.compliance.value for part in found.parts}  # type: ignore[attr-defined]


def test_known_springs_come_back_and_their_shares_sum_to_one() -> None:
    found = where_in_the_drive(simulated())
    assert compliances(found) == {(name,): pytest.approx(value, rel=1e-9) for name, value in SPRINGS.items()}
    assert [part.share for part in found.parts] == pytest.approx([0.2, 0.5, 0.3], rel=1e-9)
    assert found.whole is not None
    assert found.whole.value == pytest.approx(WHOLE, rel=1e-9)
    assert found.limits == ()
    assert [check.passed for check in found.verdict] == [True, True, True]


def test_with_noise_the_parts_still_sum_to_the_whole_in_series() -> None:
    found = where_in_the_drive(simulated(noise=5e-4, drift=1e-3))
    assert found.whole is not None
    assert sum(part.compliance.value for part in found.parts) == pytest.approx(found.whole.value, rel=1e-12)


def test_the_intervals_cover_the_springs_at_their_rate() -> None:
    """400 simulated records of six runs whose scale drifts from run to run; 4 sigma of the rate is 4.4 %."""
    trials, inside = 400, np.zeros(3)
    for seed in range(trials):
        found = where_in_the_drive(simulated(noise=1e-3, seed=seed, drift=2e-3))
        intervals = [part.compliance.interval() for part in found.parts]
        inside += [low <= value <= high for (low, high), value in zip(intervals, SPRINGS.values(), strict=True)]
    assert_allclose(inside / trials, 0.95, atol=0.044)


def test_one_run_gives_values_without_an_interval_and_the_verdict_says_so() -> None:
    record = replace(simulated(noise=1e-3, runs=1), velocity=None, run=None)
    found = where_in_the_drive(record)
    line = linregress(record.force, record.scale - record.motor)  # type: ignore[operator]
    part = found.parts[1].compliance
    assert part.value == pytest.approx(line.slope)
    assert not part.known
    assert [check.passed for check in found.verdict[:2]] == [False, None]
    assert (
        sentence_of(found.verdict[0])
        == "1 run is too few to show how the parts scatter: no interval is given; 3 runs like these give one."
    )
    assert "Not tested: the runs are too few" in sentence_of(found.verdict[1])


def test_backlash_is_told_from_the_transmission_when_the_velocity_is_logged() -> None:
    found = where_in_the_drive(simulated(backlash=4e-3))
    transmission = found.parts[1]
    assert transmission.reversal is not None
    assert transmission.reversal.value == pytest.approx(-4e-3, rel=1e-9)
    assert transmission.compliance.value == pytest.approx(5e-5, rel=1e-9)
    assert where_in_the_drive(replace(simulated(), velocity=None)).parts[1].reversal is None


def test_an_axis_at_rest_keeps_the_side_of_the_backlash_it_came_to() -> None:
    record = simulated(backlash=4e-3)
    stopping = np.array(record.velocity)
    stopping[5::10] = 0.0
    reversal = where_in_the_drive(replace(record, velocity=stopping)).parts[1].reversal
    assert reversal is not None
    assert reversal.value == pytest.approx(-4e-3, rel=1e-9)


@pytest.mark.parametrize(
    ("missing", "expected", "said"),
    [
        ("scale", {(SERVO,): 2e-5, (TRANSMISSION, STRUCTURE): 8e-5}, "transmission and guideway .* takes the linear scale"),
        ("motor", {(SERVO, TRANSMISSION): 7e-5, (STRUCTURE,): 3e-5}, "servo and transmission .* takes the motor encoder"),
        ("command", {(TRANSMISSION,): 5e-5, (SERVO, STRUCTURE): 5e-5}, "servo and guideway .* takes the command"),
    ],
)
@pytest.mark.parametrize("given", [False, True], ids=["deflection logged", "compliance given"])
def test_without_a_channel_two_springs_stay_together_and_are_named(
    missing: str, expected: dict[tuple[str, ...], float], said: str, given: bool
) -> None:
    record, whole = replace(simulated(), **{missing: None}), None
    if given:
        record, whole = replace(record, deflection=None), Estimate(WHOLE, 1e-6, 5)
    found = where_in_the_drive(record, whole=whole)
    assert compliances(found) == {names: pytest.approx(value, rel=1e-9) for names, value in expected.items()}
    assert sum(part.share or 0 for part in found.parts) == pytest.approx(1.0, rel=1e-9)
    assert len(found.limits) == 1
    assert re.search(said, found.limits[0])
    assert not found.verdict[2].passed


def test_a_whole_from_another_test_brings_its_uncertainty_to_the_rest() -> None:
    record = replace(simulated(noise=1e-3), deflection=None)
    found = where_in_the_drive(record, whole=Estimate(WHOLE, 2e-6, 4))
    outer = where_in_the_drive(replace(record, motor=None)).parts[0].compliance
    rest = found.parts[-1].compliance
    assert rest.value == pytest.approx(WHOLE - outer.value, rel=1e-12)
    assert rest.standard_uncertainty == pytest.approx(np.hypot(2e-6, outer.standard_uncertainty), rel=1e-12)
    u = np.array([2e-6, outer.standard_uncertainty])
    freedom = (u**2).sum() ** 2 / (u**4 / [4, outer.degrees_of_freedom]).sum()
    assert rest.degrees_of_freedom == pytest.approx(freedom, rel=1e-12)


def test_without_any_deflection_there_are_parts_but_no_shares() -> None:
    found = where_in_the_drive(replace(simulated(), deflection=None))
    assert [part.name for part in found.parts] == ["servo", "transmission"]
    assert [part.share for part in found.parts] == [None, None]
    assert "neither logged nor given; no shares follow" in found.limits[0]


def test_a_transmission_inside_the_loop_is_stated_but_does_not_act() -> None:
    found = where_in_the_drive(simulated(feedback="scale"), "scale")
    assert compliances(found) == {
        (SERVO,): pytest.approx(2e-5, rel=1e-9),
        (STRUCTURE,): pytest.approx(3e-5, rel=1e-9),
        (TRANSMISSION,): pytest.approx(5e-5, rel=1e-9),
    }
    assert [part.acts for part in found.parts] == [True, True, False]
    assert [part.share for part in found.parts] == pytest.approx([0.4, 0.6, 0.0], rel=1e-9)
    assert found.whole is not None
    assert found.whole.value == pytest.approx(5e-5, rel=1e-9)
    assert "inside the loop and does not move the tool quasi-statically; its compliance is stated" in found.limits[0]
    unseen = where_in_the_drive(replace(simulated(feedback="scale"), motor=None), "scale")
    assert [part.name for part in unseen.parts] == [SERVO, STRUCTURE]
    assert "is not seen without motor encoder and scale" in unseen.limits[0]


def test_motion_in_one_direction_cannot_tell_backlash_and_says_so() -> None:
    record = simulated(backlash=4e-3)
    found = where_in_the_drive(replace(record, velocity=np.abs(record.velocity)))  # type: ignore[arg-type]
    assert found.parts[1].reversal is None
    assert "moves in one direction only" in found.limits[0]


def test_a_force_that_goes_with_the_direction_is_named() -> None:
    record = simulated()
    direction = np.sign(record.velocity)  # type: ignore[arg-type]
    with pytest.raises(RankError, match="force changes exactly as the direction of motion does"):
        where_in_the_drive(replace(record, force=300 * direction))
    with pytest.raises(RankError, match="all 240 readings are at one force"):
        where_in_the_drive(replace(record, force=np.full(240, 300.0)))


def test_a_channel_of_the_wrong_sign_shows_as_a_negative_spring() -> None:
    record = simulated(noise=1e-4)
    wrong = where_in_the_drive(replace(record, motor=2 * record.command - record.motor))  # type: ignore[operator]
    assert [check.name for check in wrong.verdict if not check.passed] == ["springs in series"]
    assert "The compliance of servo is negative" in sentence_of(wrong.verdict[1])
    assert wrong.verdict[1].decisive


def test_a_spring_that_may_be_rigid_is_no_contradiction() -> None:
    found = where_in_the_drive(simulated(noise=0.05))
    assert min(part.compliance.interval()[0] for part in found.parts) < 0
    assert found.verdict[1].passed


def test_what_does_not_fit_together_is_refused() -> None:
    record = simulated()
    with pytest.raises(InputError, match="scale has the shape"):
        replace(record, scale=np.zeros(3))
    with pytest.raises(InputError, match="1 readings of motor are NaN"):
        replace(record, motor=np.r_[np.nan, np.zeros(239)])
    with pytest.raises(InputError, match="2 names of runs beside 240"):
        replace(record, run=("a", "b"))
    with pytest.raises(InputError, match="closed on 'laser'"):
        where_in_the_drive(record, "laser")
    with pytest.raises(InputError, match="the whole twice"):
        where_in_the_drive(record, whole=Estimate(WHOLE, 1e-6))
    with pytest.raises(InputError, match="there is motor; it takes two of command, motor, scale"):
        where_in_the_drive(replace(record, command=None, scale=None))
    with pytest.raises(InputError, match="is no estimate"):
        Estimate(np.nan, 1.0)
    with pytest.raises(InputError, match="needs more than 0"):
        Estimate(1.0, 1.0, 0)
