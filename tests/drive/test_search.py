"""The parameters outside the linear solve, and prediction of what was left out, on simulated drives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import DriveRecord, TorqueModel, identify_balance, smoothed
from elastogeo.drive.model import PLAIN, usable
from elastogeo.drive.nonlinear import make_search, search_balance
from elastogeo.drive.validation import leave_one_run_out, predict, structure
from elastogeo.errors import InputError, RankError

STEP = 0.01
STRIBECK = TorqueModel((*PLAIN, "stribeck"), least_speed=0.05, stribeck_speed=1.0)


def wander(
    seed: int, smooth: float | None = None, stribeck: float = 0.0, delay: float = 0.0, noise: float = 0.2, samples: int = 500
) -> DriveRecord:
    """A run of many speeds; the effort is that of the motion `delay` before it, by formula and not by interpolation."""
    random = np.random.default_rng(seed)
    time = STEP * np.arange(samples)
    waves = [(random.uniform(0.1, 1.0), random.uniform(0, 2 * np.pi), random.uniform(2, 8)) for _ in range(4)]

    def motion(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return (
            sum(size * np.sin(2 * np.pi * f * at + phase) for f, phase, size in waves),
            sum(size * 2 * np.pi * f * np.cos(2 * np.pi * f * at + phase) for f, phase, size in waves),
        )

    (v, a), (v0, a0) = motion(time), motion(time - delay)
    sense = np.sign(v0) if smooth is None else np.tanh(v0 / smooth)
    effort = 0.02 * a0 + 0.15 * v0 + (4.0 + stribeck * np.exp(-((v0 / 1.5) ** 2))) * sense + 0.5
    effort = effort + noise * random.standard_normal(samples)
    return DriveRecord(f"run {seed}", "X", time, np.cumsum(v) * STEP, v, a, effort)


@pytest.mark.parametrize(
    ("truth", "model", "searched", "expected"),
    [
        ({"smooth": 0.8}, TorqueModel(), ("smooth_speed",), 0.8),
        ({"delay": 0.0035}, TorqueModel(least_speed=0.5), ("delay",), 0.0035),
        ({"stribeck": 2.0}, STRIBECK, ("stribeck_speed",), 1.5),
    ],
)
def test_a_searched_parameter_comes_back_within_its_interval(truth, model, searched, expected) -> None:
    runs = [wander(seed, **truth) for seed in range(6)]
    fit = search_balance(runs, model, searched)
    (found,) = fit.searched
    assert found.value == pytest.approx(expected, rel=0.15)
    assert found.interval[0] is not None
    assert found.interval[1] is not None
    assert found.interval[0] < expected < found.interval[1]
    assert not found.at_bound
    assert fit.rmse == pytest.approx(0.2, rel=0.05)
    masks = make_search(runs, model, searched).masks
    assert fit.rmse < identify_balance(runs, TorqueModel(least_speed=model.least_speed), chosen=masks).rmse


def test_what_is_not_there_is_found_to_be_at_an_end_or_open() -> None:
    """A sharp sign has no smooth speed: the search goes to the smallest, whose interval is open below."""
    (found,) = search_balance([wander(k) for k in range(6)], TorqueModel(), ("smooth_speed",)).searched
    assert found.interval[0] is None
    assert found.value < 0.2


def test_motion_that_is_sampled_beside_the_effort_is_averaged_with_its_neighbours() -> None:
    """Every sample of the motion is taken before or after the effort, by chance: an average predicts better."""
    random = np.random.default_rng(4)
    runs = []
    for seed in range(8):
        run = wander(seed, noise=0.02)
        at = run.time + random.uniform(-STEP, STEP, len(run.time))
        runs.append(
            replace(
                run, velocity=np.interp(at, run.time, run.velocity), acceleration=np.interp(at, run.time, run.acceleration)
            )
        )
    model = TorqueModel(least_speed=1.0)
    fit = search_balance(runs, model, ("neighbours",))
    (found,) = fit.searched
    assert found.value > 0.2
    assert found.interval[0] is not None
    assert found.interval[0] > 0.0
    plain, averaged = (leave_one_run_out(runs, model, searched).rmse for searched in ((), ("neighbours",)))
    assert averaged < 0.95 * plain


def test_two_parameters_are_found_together() -> None:
    runs = [wander(seed, smooth=1.0, delay=0.004) for seed in range(6)]
    fit = search_balance(runs, TorqueModel(), ("smooth_speed", "delay"))
    found = {value.name: value.value for value in fit.searched}
    assert found == pytest.approx({"smooth_speed": 1.0, "delay": 0.004}, rel=0.15)
    assert fit.determined["inertia"] == pytest.approx(0.02, rel=0.05)


def test_what_is_searched_widens_the_intervals_of_the_rest() -> None:
    runs = [wander(seed, smooth=1.0) for seed in range(6)]
    fit = search_balance(runs, TorqueModel(), ("smooth_speed",))
    fixed = identify_balance(runs, fit.model, chosen=make_search(runs, TorqueModel(), ("smooth_speed",)).masks)
    at = fit.solution.labels.index("coulomb")
    assert_allclose(fit.solution.values, fixed.solution.values)
    assert fit.solution.standard_uncertainty[at] > 1.05 * fixed.solution.standard_uncertainty[at]


def test_left_out_runs_are_those_of_plain_refitting() -> None:
    runs = [wander(seed) for seed in range(4)]
    model = TorqueModel(least_speed=0.5)
    left = leave_one_run_out(runs, model)
    for k, score in enumerate(left.scores):
        balance = identify_balance([run for run in runs if run is not runs[k]], model).balance
        mask = usable(runs[k], model)
        error = balance.disturbance(runs[k])[mask]
        assert score.rmse == pytest.approx(np.sqrt(np.mean(error**2)), rel=1e-10)
        assert score.samples == mask.sum()
        effort = runs[k].effort[mask]
        assert score.r2 == pytest.approx(1 - np.sum(error**2) / np.sum((effort - effort.mean()) ** 2), rel=1e-10)
    assert left.rmse == pytest.approx(np.sqrt(np.mean(np.concatenate([np.full(s.samples, s.rmse**2) for s in left.scores]))))


def test_what_is_searched_is_searched_again_without_the_run() -> None:
    odd = wander(9, smooth=4.0)
    runs = [*(wander(seed, smooth=1.0) for seed in range(4)), odd]
    left = leave_one_run_out(runs, TorqueModel(), ("smooth_speed",))
    values = left.searched["smooth_speed"]
    assert values[4] == pytest.approx(1.0, rel=0.1)
    assert min(values[:4]) > values[4]
    assert left.scores[4].rmse > 2 * max(score.rmse for score in left.scores[:4])


def test_a_known_parameter_is_taken_off_and_scores_are_of_the_recorded_effort() -> None:
    runs = [wander(seed) for seed in range(3)]
    free, known = leave_one_run_out(runs, TorqueModel()), leave_one_run_out(runs, TorqueModel(), known={"inertia": 0.02})
    for one, other in zip(free.scores, known.scores, strict=True):
        assert other.rmse == pytest.approx(one.rmse, rel=0.02)
        assert other.r2 == pytest.approx(one.r2, rel=0.02)


def test_prediction_of_an_unknown_load_is_refused() -> None:
    runs = [wander(seed) for seed in range(3)]
    loaded = replace(runs[2], disturbance={"40 um": np.cos(runs[2].time)})
    with pytest.raises(RankError, match="the load 40 um of run run 2 is in no run that was identified"):
        predict(identify_balance(runs[:2]), [loaded])


def test_structure_is_found_where_it_is_and_not_where_it_is_not() -> None:
    runs = [wander(seed) for seed in range(4)]
    clean = structure(identify_balance(runs), runs)
    assert abs(clean.autocorrelation) < 2 * clean.limit
    assert clean.rms == pytest.approx(0.2, rel=0.05)
    assert clean.apart == pytest.approx(STEP)
    slow = [replace(run, effort=run.effort + np.sin(0.5 * run.time)) for run in runs]
    assert structure(identify_balance(slow), slow).autocorrelation > 0.5
    trembling = [replace(run, velocity=0.3 * np.random.default_rng(k).standard_normal(500)) for k, run in enumerate(runs)]
    everything = TorqueModel(least_speed=0.0)
    assert structure(identify_balance(trembling, everything), trembling).flips > 0.1


def test_a_low_pass_alone_is_no_structure() -> None:
    """Noise through a low-pass ties neighbours together; twenty records of it, at most one looks like structure."""
    alarms = 0
    for seed in range(20):
        runs = [wander(10 * seed + k, noise=0.0) for k in range(3)]
        noise = np.random.default_rng(seed).standard_normal((3, 500))
        filtered = [
            replace(run, effort=run.effort + smoothed(run.time, noise[k], 10.0), cutoff=10.0) for k, run in enumerate(runs)
        ]
        model = TorqueModel(("inertia", "viscous"))
        straight = [replace(run, effort=run.effort - 4.0 * np.sign(run.velocity) - 0.5) for run in filtered]
        found = structure(identify_balance(straight, model), straight)
        assert found.apart == pytest.approx(0.2)
        alarms += abs(found.autocorrelation) > found.limit
    assert alarms <= 1


def test_searches_that_are_none_are_refused() -> None:
    runs = [wander(0), wander(1)]
    with pytest.raises(
        InputError, match="cannot search inertia; name some of smooth_speed, stribeck_speed, delay, neighbours"
    ):
        search_balance(runs, TorqueModel(), ("inertia",))
    with pytest.raises(RankError, match="no sample of axis X is faster than 1000"):
        search_balance(runs, TorqueModel(least_speed=1000.0), ("delay",))
    with pytest.raises(RankError, match="one run alone cannot be left out"):
        leave_one_run_out(runs[:1], TorqueModel())
    with pytest.raises(RankError, match="its effort is 0 A in all 1000 samples"):
        search_balance([replace(run, effort=np.zeros(500)) for run in runs], TorqueModel(), ("delay",))
