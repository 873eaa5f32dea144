"""Do the stated 95 % intervals cover? By Monte Carlo, through the project's own functions.

Truth, readings and influences are drawn; the test is identified with what the user believes; the interval must hold the
truth at its rate. Noise is white, autocorrelated along the trace, or a random harmonic structure of each run. The path is
that of `identify` (`test_the_path_is_that_of_identify` says so) without what does not touch an interval.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate import repeatability, solve, solve_by_run
from elastogeo.identification import (
    Systems,
    agreement,
    confounding_of,
    effects_of,
    identify,
    merged,
    moments_of,
    systems_of,
    uncertainty_budget,
    with_question,
)
from elastogeo.machine import Array, Machine, parse_topology
from elastogeo.observe import Circle, Imperfection, KnownInfluence, LoadedBallBar, MachineTest, Question, Run
from elastogeo.sources import simulate
from tests.identification.drawn_readings import autocorrelated, of_the_run, white, with_readings

READINGS = 60
DRAWS = 600
REPEAT_DRAWS = 300
INFLUENCE_DRAWS = 300
"""`studies.coverage` draws more, by every default question and kind of noise."""
THIRTEEN = ("elasto-geometric-xy",)
SEVEN = (36.0, 112.0, 238.0, 364.0, 490.0, 616.0, 742.0)
LAYOUTS = {
    "7 levels": SEVEN,
    "7 levels, twice": tuple(force for force in SEVEN for _ in range(2)),
    "2 levels, 5 times": (364.0,) * 5 + (490.0,) * 5,
    "the 15 runs of the example": (36.0, 112.0, 238.0, *(364.0,) * 5, *(490.0,) * 5, 616.0, 742.0),
}
TRUTH = {
    "C_XXX": 6.19e-5,
    "C_XYX": 7.98e-7,
    "C_YYY": 4.61e-5,
    "C_CXY": -2.69e-8,
    "C_CYY": -1.66e-8,
    "C_CCY": -1.10e-9,
    "E_XX1": -1.3e-4,
    "E_YX2": 4.34e-7,
    "E_XY2": -7.26e-7,
    "E_YY1": -9.86e-5,
    "E_C(0Y)X": 1.15e-6,
    "E_Xt0": 0.003891,
    "E_Yt0": -0.00062,
}
"""Tables 5.5 and 5.6 of the thesis."""


@cache
def blank(layout: str, parameters: tuple[str, ...] = THIRTEEN) -> MachineTest:
    """A test of a layout, its pressures known and its set-up deflection corrected (Eq. 5.38)."""
    angle = np.arange(READINGS) * 2 * np.pi / READINGS
    runs = tuple(
        Run(f"run {k}", {"angle": angle, "radial": np.zeros(READINGS)}, force, pressure=(force + 14) / 126, repeat=k + 1)
        for k, force in enumerate(LAYOUTS[layout])
    )
    setup = LoadedBallBar(Circle(150.0), feed=2000 / 60, setup_deflection=0.00233)
    return MachineTest(layout, Machine("wFYXt", parse_topology("wFYXt")), setup, runs, Question(parameters))


@cache
def systems_for(layout: str, parameters: tuple[str, ...] = THIRTEEN) -> Systems:
    return systems_of(blank(layout, parameters))


NOISES = {"white": white, "autocorrelated": autocorrelated, "of the run": of_the_run}


def bounds(draws: int, comparisons: int) -> tuple[float, float]:
    """Between which rates a true 95 % is seen, at 99.9 % over all comparisons together (Bonferroni)."""
    tail = 0.001 / 2 / comparisons
    return stats.binom.ppf(tail, draws, 0.95) / draws, stats.binom.ppf(1 - tail, draws, 0.95) / draws


def covered(interval: Array, truth: Array) -> Array:
    return np.asarray((interval[:, 0] <= truth) & (truth <= interval[:, 1]))


def test_the_path_is_that_of_identify() -> None:
    """Values, intervals and budget of `identify` are those of the functions that are drawn through below."""
    test = replace(blank("7 levels, twice"), influences=(influence("force-scale"), influence("ball-form", "rectangular")))
    test = simulate(test, TRUTH, Imperfection(noise=1e-4), exact=False)
    result = identify(test)
    systems = systems_of(test)
    solution = solve_by_run([run.factor for run in systems.runs], confounding_of(test, systems).retained)
    budget = uncertainty_budget(systems, solution, effects_of(test, systems))
    assert result.by_run
    assert result.agreement is not None
    first_order = np.where(result.agreement.agrees[:, None], budget.interval, result.agreement.interval)
    assert result.agreement.agrees.any()
    assert_allclose([p.interval for p in result.parameters], first_order, rtol=1e-12)
    again = with_readings(systems_for("7 levels, twice"), np.array([run.reading for run in systems.runs]))
    assert_allclose(solve_by_run([run.factor for run in again.runs], solution.labels).covariance, solution.covariance)


@dataclass(frozen=True)
class Rates:
    """Coverage over the draws, by run and naive, and the degrees of freedom of the former."""

    by_run: Array
    naive: Array
    freedom: Array


def rates(layout: str, noise: str) -> Rates:
    systems = systems_for(layout)
    labels = systems.runs[0].factor.labels
    random = np.random.default_rng([95, len(layout), len(noise)])
    inside = np.zeros((2, len(labels)))
    for _ in range(DRAWS):  # the truth is zero: least squares is linear
        drawn = with_readings(systems, NOISES[noise](random, (len(systems.runs), READINGS)))
        solution = solve_by_run([run.factor for run in drawn.runs], labels)
        inside[0] += covered(solution.interval(), np.zeros(len(labels)))
        inside[1] += covered(solve(merged(drawn.runs), labels).interval(), np.zeros(len(labels)))
    return Rates(inside[0] / DRAWS, inside[1] / DRAWS, solution.degrees_of_freedom)


CASES = [(layout, noise) for layout in LAYOUTS for noise in NOISES]


@pytest.mark.parametrize(("layout", "noise"), CASES)
def test_intervals_by_run_cover_where_naive_ones_do_for_white_noise_only(layout: str, noise: str) -> None:
    """By run at their rate; with fewer than five degrees of freedom Satterthwaite's approximation may err to the safe side.

    Counting on independent readings: 95 % of white noise, fewer than 70 % of what real traces show.
    """
    found = rates(layout, noise)
    low, high = bounds(DRAWS, 13 * len(CASES))
    print(
        f"{layout}, {noise}: {found.by_run.min():.3f} to {found.by_run.max():.3f}, mean {found.by_run.mean():.4f}, "
        f"degrees of freedom {found.freedom.min():.1f} to {found.freedom.max():.1f}; bounds {low:.3f} {high:.3f}; "
        f"naive {found.naive.min():.3f} to {found.naive.max():.3f}, mean {found.naive.mean():.3f}"
    )
    assert np.all(found.by_run >= low)
    assert np.all(found.by_run[found.freedom >= 5] <= high)
    assert np.all(found.by_run <= 0.99)
    assert 0.93 < found.by_run.mean() < 0.97
    if noise == "white":
        low, high = bounds(DRAWS, 13 * len(LAYOUTS))
        assert np.all((low <= found.naive) & (found.naive <= high))
    else:
        assert found.naive.mean() < 0.70
        assert found.naive.min() < 0.55
    if noise == "of the run":
        assert found.naive.max() < 0.70


def test_the_naive_interval_is_the_greatest_where_runs_are_unlike() -> None:
    """By run it is wider by what the run's own structure is worth: about the root of the readings that a harmonic joins."""
    systems = systems_for("7 levels, twice")
    random = np.random.default_rng(4)
    ratios = []
    for _ in range(50):
        drawn = with_readings(systems, of_the_run(random, (len(systems.runs), READINGS)))
        by_run = solve_by_run([run.factor for run in drawn.runs], drawn.runs[0].factor.labels)
        ratios.append(by_run.standard_uncertainty / solve(merged(drawn.runs)).standard_uncertainty)
    assert 2.0 < np.sqrt(np.mean(np.square(ratios))) < 6.0


def test_too_few_runs_are_refused_an_uncertainty_by_run() -> None:
    systems = systems_for("7 levels")
    drawn = with_readings(systems, white(np.random.default_rng(0), (7, READINGS)))
    with pytest.raises(DegreesOfFreedomError, match=r"3 runs are too few for an uncertainty of .* by run"):
        solve_by_run([drawn.runs[k].factor for k in (0, 3, 6)], drawn.runs[0].factor.labels)


@pytest.mark.parametrize("noise", NOISES)
def test_run_level_repeats_cover(noise: str) -> None:
    """Five runs at each of two levels (thesis 4.7), by Welch-Satterthwaite; dividing by sqrt(25) pairs does not."""
    systems = systems_for("2 levels, 5 times")
    labels = systems.runs[0].factor.labels
    random = np.random.default_rng([7, len(noise)])
    inside, pairs, freedoms = np.zeros(13), np.zeros(13), []
    for _ in range(REPEAT_DRAWS):
        drawn = with_readings(systems, NOISES[noise](random, (10, READINGS)))
        levels = {f"{force:g} N": [run.factor for run in drawn.at(force)] for force in drawn.levels}
        repeats = repeatability(levels, labels)
        inside += covered(repeats.solution.interval(), np.zeros(13))
        freedoms.append(repeats.solution.degrees_of_freedom)
        pairs += np.abs(repeats.combination_mean) <= stats.t.ppf(0.975, 24) * repeats.combination_std / 5
    low, high = bounds(REPEAT_DRAWS, 13 * len(NOISES))
    inside, pairs = inside / REPEAT_DRAWS, pairs / REPEAT_DRAWS
    print(f"{noise}: {inside.min():.3f} to {inside.max():.3f}; pairs over sqrt(25) {pairs.mean():.2f}")
    assert np.all((low <= inside) & (inside <= high))
    assert np.min(freedoms) >= 4.0
    assert np.max(freedoms) <= 8.0
    assert pairs.mean() == pytest.approx(0.57, abs=0.06)


SIZES = {
    "force-scale": {"relative": 2e-2},
    "force-offset": {"force": 8.0},
    "force-level": {"relative": 2e-2},
    "bar-length": {"length": 5e-4},
    "sensor-scale": {"relative": 2e-2},
    "ball-form": {"length": 5e-4},
    "setup-deflection": {"relative": 0.1},
    "thermal-drift": {"length": 5e-4},
}
"""Each as large as the scatter, or a few times larger, for some of the parameters."""


def influence(kind: str, distribution: str = "normal", times: float = 1.0) -> KnownInfluence:
    sizes = {name: times * size for name, size in SIZES[kind].items()}
    return KnownInfluence(kind, kind, distribution=distribution, **sizes)


def drawn_value(random: np.random.Generator, size: float, distribution: str) -> float:
    """Not by the project's own `Influence.draws`."""
    match distribution:
        case "normal":
            return size * float(random.standard_normal())
        case "rectangular":
            return size * float(random.uniform(-1, 1))
        case "triangular":
            return size * float(random.triangular(-1, 0, 1))
        case _:
            return size * float(np.sin(random.uniform(-np.pi / 2, np.pi / 2)))


def readings_under(systems: Systems, influences: tuple[KnownInfluence, ...], random: np.random.Generator) -> Array:
    """What would be read, shape (runs, m), if each influence had a value drawn from what is known of it."""
    angle = np.arange(READINGS) * 2 * np.pi / READINGS
    force = np.array([run.force for run in systems.runs])
    total = len(force) * READINGS
    stretch, added, scale = np.ones(len(force)), np.zeros((len(force), READINGS)), 1.0
    for known in influences:
        size = known.relative or known.length or known.force
        value = drawn_value(random, size, known.distribution)
        match known.kind:
            case "force-scale":
                stretch = stretch * (1 + value)
            case "force-offset":
                stretch = stretch * (1 + value / force)
            case "force-level":
                of_level = {level: drawn_value(random, size, known.distribution) for level in systems.levels}
                stretch = stretch * np.array([1 + of_level[f] for f in force])
            case "bar-length":
                added = added + value
            case "sensor-scale":
                scale = 1 + value
            case "ball-form":
                for order in (2, 3, 4, 5):
                    for wave in (np.cos, np.sin):
                        added = added + drawn_value(random, size / 2, known.distribution) * wave(order * angle)
            case "setup-deflection":
                added = added + value * np.array([run.observations.correction for run in systems.runs])
            case "thermal-drift":
                added = added + value * (np.arange(total).reshape(added.shape) / total - 0.5)
    return scale * (response_at(systems, stretch) + added)


def response_at(systems: Systems, stretch: Array) -> Array:
    """True readings, shape (runs, m), at forces stretched from those believed: a compliance answers in proportion."""
    labels = systems.runs[0].factor.labels
    values = np.array([TRUTH[name] for name in labels])
    elastic = np.array([name.startswith("C_") for name in labels])
    return np.array(
        [run.design @ (values * np.where(elastic, s, 1.0)) for run, s in zip(systems.runs, stretch, strict=True)]
    )


def influence_rates(
    influences: tuple[KnownInfluence, ...], draws: int, layout: str = "7 levels, twice", noise: str = "of the run"
) -> tuple[Array, Array]:
    """How often the budget's interval, and that of the scatter alone, held the truth."""
    systems, test = systems_for(layout), replace(blank(layout), influences=influences)
    labels = systems.runs[0].factor.labels
    truth = np.array([TRUTH[name] for name in labels])
    random = np.random.default_rng([5, len(influences), *map(ord, influences[0].kind[:8]), len(influences[0].distribution)])
    inside = np.zeros((2, len(labels)))
    for _ in range(draws):
        readings = readings_under(systems, influences, random) + NOISES[noise](random, (len(systems.runs), READINGS))
        drawn = with_readings(systems, readings)
        solution = solve_by_run([run.factor for run in drawn.runs], labels)
        budget = uncertainty_budget(drawn, solution, effects_of(test, drawn))
        inside[0] += covered(budget.interval, truth)
        inside[1] += covered(solution.interval(), truth)
    return inside[0] / draws, inside[1] / draws


@pytest.mark.parametrize("kind", SIZES)
def test_each_influence_is_covered(kind: str) -> None:
    """Normally distributed: at the stated rate, where the scatter alone fails for at least one parameter."""
    found, alone = influence_rates((influence(kind),), INFLUENCE_DRAWS)
    low, high = bounds(INFLUENCE_DRAWS, 13 * len(SIZES))
    print(f"{kind}: {found.min():.3f} to {found.max():.3f}, mean {found.mean():.4f}; scatter alone {alone.min():.3f}")
    assert np.all((low <= found) & (found <= high))
    assert alone.min() < 0.90


BOUNDED = {"rectangular": 0.98, "triangular": 0.92, "arcsine": 0.99}
"""Least rate. By itself +-1.96 u holds all, 96.1 % and all of them; the scatter of the runs adds a normal part."""


@pytest.mark.parametrize("distribution", BOUNDED)
def test_bounded_influences_are_covered_at_least(distribution: str) -> None:
    """JCGM 100 takes the sum for a normal (G.2), so that what one bounded influence dominates is covered more often."""
    found, alone = influence_rates((influence("bar-length", distribution, 10.0),), INFLUENCE_DRAWS)
    low, _ = bounds(INFLUENCE_DRAWS, 13 * 3)
    print(f"{distribution}: {found.min():.3f} to {found.max():.3f}; scatter alone {alone.min():.3f}")
    assert np.all(found >= low)
    gains = found[[systems_for("7 levels, twice").runs[0].factor.labels.index(name) for name in ("E_XX1", "E_YY1")]]
    assert np.all(gains >= stats.binom.ppf(1e-3, INFLUENCE_DRAWS, BOUNDED[distribution]) / INFLUENCE_DRAWS)
    assert alone.min() < 0.5


@pytest.mark.parametrize("noise", ["white", "autocorrelated", "of the run"])
def test_all_influences_together_are_covered(noise: str) -> None:
    found, alone = influence_rates(tuple(influence(kind) for kind in SIZES), INFLUENCE_DRAWS, noise=noise)
    low, high = bounds(INFLUENCE_DRAWS, 13 * 3)
    print(f"all, {noise}: {found.min():.3f} to {found.max():.3f}, mean {found.mean():.4f}; scatter alone {alone.min():.3f}")
    assert np.all((low <= found) & (found <= high))
    assert alone.min() < 0.90


def few(distribution: str) -> Iterator[KnownInfluence]:
    for kind in ("force-scale", "bar-length", "setup-deflection"):
        yield influence(kind, distribution, 3.0)


@pytest.mark.parametrize("distribution", ["normal", "rectangular"])
def test_the_intervals_of_the_draws_cover_at_their_rate(distribution: str) -> None:
    """Whatever the shape of the influences: the draws know it, and cover neither too seldom nor too often (JCGM 101)."""
    asked, draws = ("C_XXX", "C_YYY", "E_XX1", "E_Xt0"), 100
    test = replace(blank("7 levels, twice", asked), influences=tuple(few(distribution)))
    systems = systems_for("7 levels, twice", asked)
    labels = systems.runs[0].factor.labels
    truth = np.array([TRUTH[name] for name in labels])
    random = np.random.default_rng([101, len(distribution)])
    by_draws, first_order = np.zeros(len(labels)), np.zeros(len(labels))
    for seed in range(draws):
        readings = readings_under(systems, test.influences, random) + of_the_run(random, (len(systems.runs), READINGS))
        drawn = with_readings(systems, readings)
        solution = solve_by_run([run.factor for run in drawn.runs], labels)
        effects = effects_of(test, drawn)
        budget = uncertainty_budget(drawn, solution, effects)
        by_draws += covered(agreement(solution, moments_of(drawn, solution, effects), budget, seed=seed).interval, truth)
        first_order += covered(budget.interval, truth)
    low, high = bounds(draws, 2 * len(labels))
    print(f"{distribution}: draws {by_draws / draws}, first order {first_order / draws}; bounds {low:.3f} {high:.3f}")
    assert np.all((low <= by_draws / draws) & (by_draws / draws <= high))
    assert np.all(first_order / draws >= low)


def test_a_question_asked_again_keeps_the_influences() -> None:
    test = replace(blank("7 levels"), influences=(influence("bar-length"),))
    assert with_question(test, ["C_XXX", "E_XX1"]).influences == test.influences
