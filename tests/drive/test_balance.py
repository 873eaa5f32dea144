"""The torque balance against simulated drives: truth, uncertainty, what it cannot distinguish and what separates it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import BalanceFit, DriveRecord, TorqueBalance, TorqueModel, identify_balance
from elastogeo.drive.differentiator import differentiate
from elastogeo.drive.model import usable
from elastogeo.errors import InputError, RankError

RATIO = 10 / (2 * np.pi)
"""mm/rad of the screw of thesis table 6.3."""
J, B, TAU, LOAD = 0.006e3 / RATIO, 0.09e3 / RATIO, 1.55e3, 2.64e3
"""Thesis table 6.4, X axis, per travel of the axis [N mm s^2/mm, N mm s/mm], and at the motor [N mm]."""
THESIS = TorqueModel(("inertia", "viscous", "coulomb"))
"""Eq. 6.7: no constant."""


def circle(
    feed: float,
    load: float = 0.0,
    name: str = "load",
    radius: float = 30.0,
    noise: float = 0.0,
    seed: int = 0,
    samples: int = 400,
) -> DriveRecord:
    """X of one turn at a constant feed [mm/s], started off the samples at which the axis stands."""
    rate = feed / radius
    time = (np.arange(samples) + 0.37) * 2 * np.pi / rate / samples
    x, v, a = radius * np.cos(rate * time), -feed * np.sin(rate * time), -feed * rate * np.cos(rate * time)
    effort = J * a + B * v + TAU * np.sign(v) + load * np.cos(rate * time)
    effort = effort + noise * np.random.default_rng(seed).standard_normal(samples)
    pattern = {name: np.cos(rate * time)} if load else {}
    return DriveRecord(f"{feed:g} mm/s, {load:g}, {seed}", "X", time, x, v, a, effort, pattern, "N mm")


def wander(seed: int, samples: int = 600, noise: float = 0.0, constant: float = 0.7, forward: bool = False) -> DriveRecord:
    """A run of many speeds and accelerations, in both directions or forward only; effort in A."""
    random = np.random.default_rng(seed)
    time = 0.01 * np.arange(samples)
    waves = [(random.uniform(0.2, 3.0), random.uniform(0, 2 * np.pi), random.uniform(3, 12)) for _ in range(5)]
    v = sum(size * np.sin(2 * np.pi * f * time + at) for f, at, size in waves)
    a = sum(size * 2 * np.pi * f * np.cos(2 * np.pi * f * time + at) for f, at, size in waves)
    if forward:
        v = v - v.min() + 1.0
    effort = 0.008 * a + 0.15 * v + 4.0 * np.sign(v) + constant + noise * random.standard_normal(samples)
    return DriveRecord(f"run {seed}", "X", time, np.cumsum(v) * 0.01, v, a, effort)


def values(fit: BalanceFit) -> dict[str, float]:
    return dict(zip(fit.solution.labels, fit.solution.values.tolist(), strict=True))


def test_a_balance_without_noise_comes_back_exactly() -> None:
    fit = identify_balance([wander(1), wander(2)], TorqueModel(least_speed=0.5))
    assert fit.separated
    assert_allclose(
        [fit.determined[k] for k in ("inertia", "viscous", "coulomb", "constant")], [0.008, 0.15, 4.0, 0.7], rtol=1e-9
    )
    assert fit.r2 == pytest.approx(1.0)
    assert fit.units == {"inertia": "A s^2/mm", "viscous": "A s/mm", "coulomb": "A", "constant": "A"}


def test_a_known_balance_predicts_the_effort_and_leaves_the_disturbance() -> None:
    balance = identify_balance([wander(1), wander(2)]).balance
    loaded = replace(wander(3), effort=wander(3).effort + 2.5)
    assert_allclose(balance.disturbance(loaded), 2.5, atol=1e-9)
    assert_allclose(balance.effort(wander(3)), wander(3).effort, atol=1e-9)
    with pytest.raises(InputError, match="is of axis Y in A, the balance of axis X in A"):
        balance.effort(replace(loaded, axis="Y"))


def test_intervals_cover_the_truth_as_often_as_they_say() -> None:
    """White noise, 600 draws of 6 runs each: 95 % within what 600 draws can tell (three standard deviations, 2.7 %)."""
    truth = np.array([0.008, 0.15, 4.0, 0.7])
    clean = [wander(seed, samples=80) for seed in range(6)]
    random = np.random.default_rng(5)
    inside = np.zeros(4)
    for _ in range(600):
        noisy = [replace(run, effort=run.effort + random.standard_normal(len(run.time))) for run in clean]
        fit = identify_balance(noisy)
        assert fit.counted == "runs"
        low, high = fit.solution.interval().T
        inside += (low <= truth) & (truth <= high)
    assert np.abs(inside / 600 - 0.95).max() < 0.027


def test_what_the_uncertainty_counts_on_follows_the_number_of_runs() -> None:
    assert identify_balance([wander(k, noise=0.3) for k in range(6)]).counted == "runs"
    assert identify_balance([wander(1, noise=0.3)]).counted == "pieces"
    assert identify_balance([wander(1, samples=60, noise=0.3)]).counted == "samples"


def test_autocorrelated_noise_in_one_run_is_not_taken_for_independent_samples() -> None:
    """Noise that lasts 20 samples: by pieces the constant is three times as uncertain as by samples."""
    random = np.random.default_rng(3)
    run = wander(1, samples=6000)
    slow = np.convolve(random.standard_normal(6019), np.ones(20) / np.sqrt(20), "valid")
    fit = identify_balance([replace(run, effort=run.effort + slow)])
    at = fit.solution.labels.index("constant")
    by_sample = fit.solution.residual_std / np.sqrt(6000)
    assert fit.counted == "pieces"
    assert fit.solution.standard_uncertainty[at] > 2.0 * by_sample


@pytest.mark.parametrize("direction", [1, -1])
def test_one_direction_of_motion_gets_the_named_combination_and_no_number(direction: int) -> None:
    run = wander(1, forward=True)
    if direction < 0:
        v, a = -run.velocity, -run.acceleration
        run = replace(run, velocity=v, acceleration=a, effort=0.008 * a + 0.15 * v - 4.0 + 0.7)
    fit = identify_balance([run])
    assert not fit.separated
    assert fit.mixed == {"coulomb": {"coulomb": 1.0, "constant": pytest.approx(direction)}}
    assert set(fit.determined) == {"inertia", "viscous"}
    assert fit.determined["inertia"] == pytest.approx(0.008)
    assert values(fit)["coulomb"] == pytest.approx(4.0 + direction * 0.7)
    sign = "+" if direction > 0 else "-"
    with pytest.raises(
        RankError, match=rf"coulomb \{sign} constant is determined as one number only, .* one direction only"
    ):
        _ = fit.balance
    assert "runs in both directions would separate them" in fit.sentence


def test_both_directions_separate_what_one_does_not() -> None:
    back = wander(1, forward=True)
    v, a = -back.velocity, -back.acceleration
    back = replace(back, run="back", velocity=v, acceleration=a, effort=0.008 * a + 0.15 * v - 4.0 + 0.7)
    fit = identify_balance([wander(1, forward=True), back])
    assert fit.separated
    assert fit.determined["constant"] == pytest.approx(0.7)


def test_constant_feed_on_a_line_determines_one_number() -> None:
    time = 0.01 * np.arange(200)
    run = DriveRecord("line", "X", time, 20 * time, np.full(200, 20.0), np.zeros(200), np.full(200, 7.7))
    fit = identify_balance([run])
    assert fit.confounding.null == ("inertia",)
    assert list(fit.mixed) == ["viscous"]
    assert set(fit.mixed["viscous"]) == {"viscous", "coulomb", "constant"}
    assert fit.determined == {}
    assert "two speeds or more, in both directions, would separate them" in fit.sentence
    assert "inertia changes no effort in these records" in fit.sentence


def test_the_rounding_of_a_differentiated_ramp_is_no_acceleration() -> None:
    time = 0.01 * np.arange(400)
    made = differentiate(time, 5 * time, 10.0)
    assert made.acceleration.any()
    effort = 1.0 + 0.001 * (np.arange(400) % 7)
    fit = identify_balance([DriveRecord("ramp", "X", time, made.position, made.velocity, made.acceleration, effort)])
    assert fit.confounding.null == ("inertia",)
    assert fit.determined == {}


@pytest.mark.parametrize("value", [0.0, 1.25])
def test_a_dead_effort_is_refused_by_name(value: float) -> None:
    runs = [replace(wander(k), effort=np.full(600, value)) for k in (1, 2)]
    with pytest.raises(
        RankError, match=rf"axis X cannot be identified, because its effort is {value:g} A in all 1200 samples"
    ):
        identify_balance(runs)


def test_an_axis_that_does_not_move_is_refused_by_name() -> None:
    still = replace(wander(1), velocity=np.zeros(600), acceleration=np.zeros(600), position=np.ones(600))
    with pytest.raises(RankError, match="its velocity is zero in all 600 samples: it does not move"):
        identify_balance([still])
    with pytest.raises(RankError, match=r"none of its 600 samples moves at more than 1000 mm/s.* lower least_speed"):
        identify_balance([wander(1)], TorqueModel(least_speed=1000.0))


def test_constant_feed_on_a_circle_has_rank_three_of_four() -> None:
    """Eq. 6.7: the acceleration and the load both go with cos theta."""
    fit = identify_balance([circle(1000 / 60, LOAD)], THESIS)
    assert (fit.confounding.rank, len(fit.confounding.labels)) == (3, 4)
    rate = 1000 / 60 / 30
    assert fit.mixed["inertia"] == {"inertia": 1.0, "load": pytest.approx(-1 / (30 * rate**2))}
    assert set(fit.determined) == {"viscous", "coulomb"}
    assert "two feeds, an unloaded run, or a known inertia would separate them" in fit.sentence
    with pytest.raises(RankError, match="as on a circle at constant feed"):
        _ = fit.balance


def test_noise_does_not_tell_apart_what_the_motion_does_not() -> None:
    """Encoder noise makes the columns differ by rounding-like amounts; a rank by 1e-8 would invent numbers."""
    run = circle(1000 / 60, LOAD, noise=50.0)
    random = np.random.default_rng(2)
    run = replace(run, acceleration=run.acceleration * (1 + 0.005 * random.standard_normal(len(run.time))))
    assert identify_balance([run], THESIS).confounding.rank == 3


def test_two_feeds_an_unloaded_run_or_a_known_inertia_separate_inertia_and_load() -> None:
    slow, fast, bare = circle(1000 / 60, LOAD), circle(4000 / 60, LOAD), circle(1000 / 60)
    truth = {"inertia": J, "viscous": B, "coulomb": TAU, "load": LOAD}
    for runs in ([slow, fast], [slow, bare]):
        fit = identify_balance(runs, THESIS)
        assert fit.separated
        assert fit.determined == pytest.approx(truth, rel=1e-8)
    known = identify_balance([slow], THESIS, known={"inertia": J})
    assert known.separated
    assert known.determined == pytest.approx({k: v for k, v in truth.items() if k != "inertia"}, rel=1e-9)
    assert known.balance.values == pytest.approx([J, B, TAU])
    assert known.balance.covariance[0, 0] == 0.0


def test_friction_of_an_unloaded_run_gives_the_load_of_a_loaded_one() -> None:
    balance = identify_balance(
        [circle(1000 / 60, noise=20.0, seed=1), circle(4000 / 60, noise=20.0, seed=2)], THESIS
    ).balance
    loaded = circle(1000 / 60, LOAD, noise=20.0, seed=3)
    pattern = loaded.disturbance["load"]
    found = pattern @ balance.disturbance(loaded) / (pattern @ pattern)
    assert found == pytest.approx(LOAD, abs=4 * 20 / np.sqrt(200))


def test_levels_of_engagement_are_loads_of_their_own() -> None:
    loads = {"40 um": 500.0, "200 um": LOAD}
    runs = [circle(1000 / 60), circle(4000 / 60)] + [circle(1000 / 60, size, name) for name, size in loads.items()]
    fit = identify_balance(runs, THESIS)
    assert {name: fit.determined[name] for name in loads} == pytest.approx(loads)
    assert fit.units["40 um"] == "N mm"


def test_a_sharp_sign_holds_the_constant_already() -> None:
    fit = identify_balance([wander(1), wander(2)], TorqueModel(("inertia", "viscous", "coulomb asymmetric", "constant")))
    assert not fit.separated
    assert "leave out the constant" in fit.sentence
    free = identify_balance([wander(1), wander(2)], TorqueModel(("inertia", "viscous", "coulomb asymmetric")))
    assert free.determined["coulomb forward"] == pytest.approx(4.7)
    assert free.determined["coulomb backward"] == pytest.approx(3.3)


def test_slow_samples_are_left_out_not_blindly_signed() -> None:
    """Stiction at standstill of either sign: with least_speed it does not reach the friction."""
    run = wander(1)
    stuck = np.abs(run.velocity) < 2.0
    wrong = replace(run, effort=np.where(stuck, -3.0, run.effort))
    fit = identify_balance([wrong, wander(2)], TorqueModel(least_speed=2.0))
    assert fit.determined["coulomb"] == pytest.approx(4.0)
    assert fit.left_out == int(stuck.sum() + (np.abs(wander(2).velocity) <= 2.0).sum())
    assert abs(identify_balance([wrong, wander(2)]).determined["coulomb"] - 4.0) > 0.1
    still = replace(run, velocity=np.where(stuck, 0.0, run.velocity))
    assert not usable(still, TorqueModel())[stuck].any(), "a sample at zero has no sign"
    assert usable(still, TorqueModel(smooth_speed=1.0)).all()


def test_a_delay_shifts_the_motion_and_drops_what_no_motion_belongs_to() -> None:
    run = wander(1)
    late = replace(run, effort=np.concatenate([np.zeros(3), run.effort[:-3]]))
    model = TorqueModel(least_speed=0.5, delay=0.03)
    assert not usable(late, model)[:3].any()
    fit = identify_balance([late], model)
    assert fit.determined["inertia"] == pytest.approx(0.008, rel=1e-6)
    gap = replace(late, time=late.time + np.where(np.arange(600) >= 300, 5.0, 0.0))
    assert not usable(gap, model)[300:303].any()


@pytest.mark.parametrize(("effort_unit", "scale"), [("A", 1.0), ("N mm", 1650.0), ("N", 1e-3)])
def test_the_answer_does_not_depend_on_the_unit_of_the_effort_or_the_order(effort_unit: str, scale: float) -> None:
    runs = [wander(k, noise=0.3) for k in range(4)]
    plain = identify_balance(runs)
    other = identify_balance([replace(r, effort=scale * r.effort, effort_unit=effort_unit) for r in runs[::-1]])
    assert_allclose(other.solution.values, scale * plain.solution.values, rtol=1e-10)
    assert_allclose(other.solution.covariance, scale**2 * plain.solution.covariance, rtol=1e-8)
    assert other.r2 == pytest.approx(plain.r2, rel=1e-12)
    assert other.confounding.condition_scaled == pytest.approx(plain.confounding.condition_scaled)


def test_what_is_no_set_of_records_is_refused() -> None:
    run = wander(1)
    with pytest.raises(InputError, match="there is no record of the drive"):
        identify_balance([])
    with pytest.raises(InputError, match=r"differ in the axis \(X, Y\)"):
        identify_balance([run, replace(run, run="b", axis="Y")])
    with pytest.raises(InputError, match=r"differ in the unit of the effort \(A, N mm\)"):
        identify_balance([run, replace(run, run="b", effort_unit="N mm")])
    with pytest.raises(InputError, match="two records of axis X are called run 1"):
        identify_balance([run, run])
    with pytest.raises(InputError, match="the known parameters mass are none of the model"):
        identify_balance([run], known={"mass": 1.0})
    with pytest.raises(InputError, match="nothing is left to identify"):
        identify_balance([run], TorqueModel(("constant",)), known={"constant": 1.0})
    with pytest.raises(InputError, match="a load is called viscous, as a term of the balance is"):
        identify_balance([replace(run, disturbance={"viscous": run.velocity})])
    with pytest.raises(InputError, match="sample 5 of effort is no finite number"):
        replace(run, effort=np.where(np.arange(600) == 4, np.nan, run.effort))
    with pytest.raises(InputError, match=r"velocity has the shape \(599,\) at 600 times"):
        replace(run, velocity=run.velocity[1:])
    with pytest.raises(InputError, match="the effort is in 'V'; give it in A or N mm or N"):
        replace(run, effort_unit="V")
    with pytest.raises(InputError, match="the clock does not go forward"):
        replace(run, time=run.time[::-1].copy())


def test_a_rotary_axis_has_its_units() -> None:
    fit = identify_balance([replace(wander(1), axis="C", effort_unit="N mm")])
    assert fit.units["inertia"] == "N mm s^2/rad"
    assert isinstance(fit.balance, TorqueBalance)
