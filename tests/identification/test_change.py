"""Has something changed? False alarms at their stated rate, real changes found: within one test and between two."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.errors import DegreesOfFreedomError, UnsupportedError
from elastogeo.estimate import Solution, solve, solve_by_run
from elastogeo.identification import (
    Change,
    Systems,
    adjacent,
    compare,
    difference,
    identify,
    local_change,
    local_estimates,
    merged,
    run_dispersion,
    systems_of,
)
from elastogeo.machine import Array
from elastogeo.observe import Imperfection, MachineTest
from elastogeo.report import sentence_of
from elastogeo.sources import simulate
from tests.identification.drawn_readings import NOISE, Shape, autocorrelated, of_the_run, white, with_readings

MakeTest = Callable[..., MachineTest]
READINGS, DRAWS = 48, 400
THIRTEEN = ["elasto-geometric-xy"]
GEOMETRIC = ("E_XX1", "E_YX2", "E_XY2", "E_YY1", "E_C(0Y)X", "E_Xt0", "E_Yt0")
REPEATS = {"once": 1, "twice": 2}


def upper(rate: float, draws: int, comparisons: int) -> float:
    """Above which a rate is seen once in a thousand, over all comparisons together (Bonferroni)."""
    return float(stats.binom.ppf(1 - 0.001 / comparisons, draws, rate)) / draws


def lower(rate: float, draws: int, comparisons: int) -> float:
    return float(stats.binom.ppf(0.001 / comparisons, draws, rate)) / draws


@pytest.fixture(scope="module", params=REPEATS)
def systems(request: pytest.FixtureRequest, make_test: MakeTest, thesis_forces: tuple[float, ...]) -> Systems:
    test = make_test("wFYXt", thesis_forces, parameters=THIRTEEN, repeats=REPEATS[request.param], readings=READINGS)
    return systems_of(test)


def eccentric(random: np.random.Generator, shape: Shape) -> Array:
    """A set-up that moves from run to run, ten times the noise: all the scatter is in two shapes."""
    runs, readings = shape
    angle = np.arange(readings) * 2 * np.pi / readings
    return white(random, shape) + 10 * NOISE * random.standard_normal((runs, 2)) @ np.vstack([np.cos(angle), np.sin(angle)])


NOISES = {"white": white, "of the run": of_the_run}
UNLIKE = {**NOISES, "autocorrelated": autocorrelated, "eccentric": eccentric}


def pairs_of(systems: Systems) -> list[list[int]]:
    return [[k for k, run in enumerate(systems.runs) if run in systems.at(*pair)] for pair in adjacent(systems.levels)]


def products_of(systems: Systems) -> list[float]:
    return [low * high for low, high in adjacent(systems.levels)]


def changes(systems: Systems, noise: str, draws: int, added: Array | float = 0.0) -> list[Change]:
    random = np.random.default_rng([11, len(noise), len(systems.runs)])
    labels = systems.runs[0].factor.labels
    found = []
    for _ in range(draws):
        drawn = with_readings(systems, UNLIKE[noise](random, (len(systems.runs), READINGS)) + added)
        found.append(local_change([run.factor for run in drawn.runs], labels, pairs_of(systems), products_of(systems)))
    return found


def test_a_geometry_that_does_not_change_alarms_at_the_stated_rate(systems: Systems) -> None:
    """5 % by each parameter: exact for readings that scatter alike. Together 5 % at most (Bonferroni)."""
    found = changes(systems, "white", DRAWS)
    joint = np.mean([change.significant for change in found])
    each = np.mean([[p < 0.05 for p in change.each.values()] for change in found], axis=0)
    print(f"{len(systems.runs)} runs: together {joint:.3f}, each {each.min():.3f} to {each.max():.3f}")
    assert 0.005 <= joint <= upper(0.05, DRAWS, 2)
    assert np.all((lower(0.05, DRAWS, 26) <= each) & (each <= upper(0.05, DRAWS, 26)))


@pytest.fixture(scope="module")
def repeated(make_test: MakeTest, thesis_forces: tuple[float, ...]) -> Systems:
    return systems_of(make_test("wFYXt", thesis_forces, parameters=THIRTEEN, repeats=2, readings=READINGS))


@pytest.mark.parametrize("noise", UNLIKE)
def test_with_repeats_no_shape_of_the_scatter_alarms_more(noise: str, repeated: Systems) -> None:
    """Each parameter is judged by its own scatter between repeats: 5 %, and 5 % at most by all together."""
    found = changes(repeated, noise, DRAWS)
    joint = np.mean([change.significant for change in found])
    each = np.mean([[p < 0.05 for p in change.each.values()] for change in found], axis=0)
    print(f"{noise}: together {joint:.3f}, each {each.min():.3f} to {each.max():.3f}, mean {each.mean():.3f}")
    assert found[0].q == 5
    assert found[0].degrees_of_freedom == 7
    assert 0.005 <= joint <= upper(0.05, DRAWS, 4)
    assert np.all(each <= upper(0.05, DRAWS, 52))
    assert each.mean() == pytest.approx(0.05, abs=0.015)


@pytest.mark.parametrize("noise", UNLIKE)
def test_without_repeats_no_shape_of_the_scatter_alarms_more(noise: str, make_test: MakeTest, thesis_forces) -> None:
    """Each parameter is judged by its own scatter about the trend: five numbers of seven runs, one of them the trend."""
    systems = systems_of(make_test("wFYXt", thesis_forces, parameters=THIRTEEN, readings=READINGS))
    found = changes(systems, noise, DRAWS)
    joint = np.mean([change.significant for change in found])
    each = np.mean([[p < 0.05 for p in change.each.values()] for change in found], axis=0)
    print(f"{noise}: together {joint:.3f}, each {each.min():.3f} to {each.max():.3f}")
    assert found[0].q == 1
    assert found[0].degrees_of_freedom in (4, 5)
    assert 0.005 <= joint <= upper(0.05, DRAWS, 4)
    assert np.all(each <= upper(0.05, DRAWS, 52))
    assert each.mean() == pytest.approx(0.05, abs=0.015)


def test_runs_of_other_designs_are_no_repeats(make_test: MakeTest) -> None:
    """Four levels with one run each, and another arc at one of them: nothing is repeated, only a trend can be judged."""
    test = make_test("wFYXt", [36.0, 238.0, 490.0, 742.0], parameters=THIRTEEN, readings=READINGS)
    half = make_test("wFYXt", [36.0], parameters=THIRTEEN, angle=np.linspace(0.2, 4.0, READINGS))
    both = replace(test, runs=(*test.runs, *(replace(run, name="arc") for run in half.runs)))
    systems = systems_of(simulate(both, {"C_XXX": 6e-5}, Imperfection(noise=NOISE), exact=False))
    labels = systems.runs[0].factor.labels
    change = local_change([run.factor for run in systems.runs], labels, pairs_of(systems), products_of(systems))
    assert (change.q, change.degrees_of_freedom) == (1, 1)
    twice = make_test("wFYXt", [36.0, 364.0, 742.0], parameters=THIRTEEN, readings=READINGS, repeats=2)
    systems = systems_of(simulate(twice, {"C_XXX": 6e-5}, Imperfection(noise=NOISE), exact=False))
    change = local_change([run.factor for run in systems.runs], labels, pairs_of(systems), products_of(systems))
    assert (change.q, change.degrees_of_freedom) == (1, 3)


def test_repeats_without_any_scatter_alarm_by_a_change_alone(repeated: Systems) -> None:
    """Readings without noise: rounding error is no change, a gain that grows with the force is one."""
    labels = repeated.runs[0].factor.labels
    x = np.array([run.design_of(["E_XX1"])[:, 0] for run in repeated.runs])
    force = np.array([[run.force] for run in repeated.runs])
    for readings, alarm in ((1e-4 * x, False), (1e-4 * x * (1 + (force / 742) ** 3), True)):
        drawn = with_readings(repeated, readings)
        change = local_change([run.factor for run in drawn.runs], labels, pairs_of(repeated), products_of(repeated))
        assert change.significant == alarm


def test_a_geometry_that_changes_with_the_force_is_found(systems: Systems) -> None:
    """A gain of X that grows with the force, as a compliance that is not constant makes it seem."""
    x = np.array([run.design_of(["E_XX1"])[:, 0] for run in systems.runs])
    force = np.array([[run.force] for run in systems.runs])
    found = changes(systems, "white", 50, added=1e-5 * (force / 742) ** 3 * x)
    assert np.mean([change.significant for change in found]) > (0.5 if len(systems.runs) < 8 else 0.95)
    assert np.mean([change.each["E_XX1"] < 0.05 / 7 for change in found]) > 0.95
    assert np.mean([change.each["E_Yt0"] < 0.05 / 7 for change in found]) < 0.1


def test_the_dispersion_between_runs_is_that_of_the_readings_if_runs_are_alike(systems: Systems) -> None:
    """Unbiased; with harmonics of the runs it is theirs."""
    labels = systems.runs[0].factor.labels
    random = np.random.default_rng(8)
    found = []
    for _ in range(200):
        drawn = with_readings(systems, white(random, (len(systems.runs), READINGS)))
        variance, freedom = run_dispersion([run.factor for run in drawn.runs], labels)
        found.append(variance / NOISE**2)
    assert freedom == 8 * len(systems.runs) - 13
    assert np.mean(found) == pytest.approx(1.0, abs=4 * np.sqrt(2 / freedom / 200))


def test_local_intervals_cover(systems: Systems) -> None:
    """Of every pair of adjacent levels, of every parameter: 95 % of white noise."""
    random = np.random.default_rng(9)
    labels = systems.runs[0].factor.labels
    choices = adjacent(systems.levels)
    inside = np.zeros((len(choices), 13))
    draws = DRAWS // 2
    for _ in range(draws):
        drawn = with_readings(systems, white(random, (len(systems.runs), READINGS)))
        for k, local in enumerate(local_estimates(drawn, labels, choices)):
            low, high = local.solution.interval().T
            inside[k] += (low <= 0) & (high >= 0)
    rates = inside / draws
    print(f"{len(systems.runs)} runs: local {rates.min():.3f} to {rates.max():.3f}, mean {rates.mean():.4f}")
    assert np.all(rates >= lower(0.95, draws, rates.size))
    assert np.all(rates <= upper(0.95, draws, rates.size))
    assert rates.mean() == pytest.approx(0.95, abs=0.01)


def test_two_levels_have_nothing_to_compare(make_test: MakeTest) -> None:
    systems = systems_of(make_test("wFYXt", [36.0, 742.0], parameters=THIRTEEN))
    labels = systems.runs[0].factor.labels
    with pytest.raises(UnsupportedError, match="to say whether local estimates differ takes two of them"):
        local_change([run.factor for run in systems.runs], labels, [[0, 1]], [1.0])
    with pytest.raises(DegreesOfFreedomError, match="1 runs leave no degree of freedom for 2 parameters"):
        run_dispersion([systems.runs[0].factor], ["C_XXX", "C_YYY"])


@pytest.mark.parametrize(("levels", "repeats", "compared"), [(3, 1, False), (3, 2, True), (4, 1, True)])
def test_how_many_levels_can_be_compared(levels: int, repeats: int, compared: bool, make_test: MakeTest) -> None:
    """Two local estimates tell no trend from scatter, unless repeats show the scatter."""
    forces = np.linspace(36.0, 742.0, levels)
    test = make_test("wFYXt", forces, parameters=THIRTEEN, readings=READINGS, repeats=repeats)
    change = identify(simulate(test, {"C_XXX": 6e-5}, Imperfection(noise=NOISE), exact=False)).local_change
    assert (change is not None) == compared
    if change is not None:
        assert 0 < change.p_value < 1


TRUTH = {"C_XXX": 6.19e-5, "C_YYY": 4.61e-5, "C_CCY": 2e-9, "E_XX1": -1.3e-4, "E_YY1": -9.86e-5, "E_Xt0": 0.0039}


def solved(systems: Systems, readings: Array, by_run: bool) -> Solution:
    drawn = with_readings(systems, readings)
    labels = systems.runs[0].factor.labels
    return solve_by_run([run.factor for run in drawn.runs], labels) if by_run else solve(merged(drawn.runs), labels)


@pytest.mark.parametrize("noise", NOISES)
def test_two_tests_of_an_unchanged_machine_alarm_at_the_stated_rate(noise: str, systems: Systems) -> None:
    """By run: each parameter at 5 %, all together at 5 % at most, however few the runs."""
    random = np.random.default_rng([12, len(noise), len(systems.runs)])
    found = []
    for _ in range(DRAWS):
        one, other = (solved(systems, NOISES[noise](random, (len(systems.runs), READINGS)), True) for _ in range(2))
        found.append(difference(one, other))
    joint = np.mean([change.significant for change in found])
    each = np.mean([[p < 0.05 for p in change.each.values()] for change in found], axis=0)
    print(f"{len(systems.runs)} runs, {noise}: together {joint:.3f}, each {each.min():.3f} to {each.max():.3f}")
    assert 0.005 <= joint <= upper(0.05, DRAWS, 4)
    assert np.all(each <= upper(0.05, DRAWS, 52))
    assert each.mean() == pytest.approx(0.05, abs=0.015)


def test_with_the_scatter_of_readings_all_differences_are_judged_together(systems: Systems) -> None:
    """White noise, counted by reading: Hotelling's statistic, 5 % of alarms; of runs that have a structure, nearly all."""
    random = np.random.default_rng(13)
    for noise, low, high in (("white", lower(0.05, DRAWS, 2), upper(0.05, DRAWS, 2)), ("of the run", 0.9, 1.0)):
        found = []
        for _ in range(DRAWS):
            one, other = (solved(systems, NOISES[noise](random, (len(systems.runs), READINGS)), False) for _ in range(2))
            found.append(difference(one, other))
        joint = np.mean([change.significant for change in found])
        assert low <= joint <= high
        assert found[0].q == 13


def test_a_shared_covariance_cancels() -> None:
    """Two estimates with the same gauge differ by the scatter alone."""
    random = np.random.default_rng(3)
    root = np.diag([1.0, 2.0])
    gauge = np.outer([5.0, -3.0], [5.0, -3.0])
    found = []
    for _ in range(DRAWS):
        common = np.array([5.0, -3.0]) * random.standard_normal()
        one, other = (
            Solution(("a", "b"), common + root @ random.standard_normal(2), root @ root + gauge, np.full(2, np.inf), 1.0)
            for _ in range(2)
        )
        found.append([difference(one, other, shared).significant for shared in (gauge, None)])
    right, cautious = np.mean(found, axis=0)
    assert lower(0.05, DRAWS, 1) <= right <= upper(0.05, DRAWS, 1)
    assert cautious < right


def test_differences_of_known_covariance_are_chi_squared() -> None:
    one = Solution(("a", "b"), np.array([1.0, 2.0]), np.diag([1.0, 4.0]), np.full(2, np.inf), 1.0)
    other = replace(one, values=np.array([4.0, 0.0]))
    change = difference(one, other)
    assert change.statistic == pytest.approx((9 / 2 + 4 / 8) / 2)
    assert change.p_value == pytest.approx(stats.chi2.sf(5.0, 2), rel=1e-6)
    assert change.each == pytest.approx({"a": stats.chi2.sf(4.5, 1), "b": stats.chi2.sf(0.5, 1)}, rel=1e-6)


def test_other_parameters_cannot_be_compared() -> None:
    one = Solution(("a",), np.zeros(1), np.eye(1), np.full(1, 9.0), 1.0)
    with pytest.raises(UnsupportedError, match="the tests determine different parameters, a and b; ask both for the same"):
        difference(one, replace(one, labels=("b",)))


@pytest.fixture(scope="module")
def before_after(make_test: MakeTest, thesis_forces: tuple[float, ...]) -> Callable[..., tuple[MachineTest, MachineTest]]:
    blank = make_test("wFYXt", thesis_forces, parameters=THIRTEEN, repeats=2, readings=READINGS)

    def make(seed: int, **changed: float) -> tuple[MachineTest, MachineTest]:
        imperfection = Imperfection(noise=NOISE, eccentricity=2e-4)
        after = {name: value + changed.get(name, 0.0) for name, value in TRUTH.items()}
        one, other = (
            simulate(blank, truth, imperfection, seed=s, exact=False) for truth, s in ((TRUTH, seed), (after, seed + 1000))
        )
        return one, other

    return make


def test_compare_tests_says_what_changed(before_after: Callable[..., tuple[MachineTest, MachineTest]]) -> None:
    one, other = before_after(1, C_XXX=1e-5, E_YY1=4e-5)
    found = compare(identify(one), identify(other))
    (check,) = found.verdict
    assert not check.passed
    assert {d.name for d in found.differences[:2]} == {"C_XXX", "E_YY1"}
    assert "C_XXX" in sentence_of(check)
    assert "E_YY1" in sentence_of(check)
    assert "changed by more than the uncertainty of the two tests" in sentence_of(check)
    for d in found.differences:
        true = {"C_XXX": 1e-5, "E_YY1": 4e-5}.get(d.name, 0.0)
        assert d.change.value == pytest.approx(d.after - d.before, rel=1e-12)
        assert abs(d.change.value - true) < 5 * d.change.standard_uncertainty
        assert np.mean(d.change.interval()) == pytest.approx(d.change.value, rel=1e-9)
        excluded = d.change.interval()[0] > 0 or d.change.interval()[1] < 0
        assert excluded == (d.p_value < 0.05), d.name  # the interval and the p-value say the same


def test_compare_tests_stays_calm(before_after: Callable[..., tuple[MachineTest, MachineTest]]) -> None:
    """Through `identify`, two tests of one machine. The rate: the tests above, and `studies.checks.unchanged`."""
    calm = 0
    draws = 10
    for seed in range(draws):
        found = compare(*map(identify, before_after(seed)))
        assert len(found.differences) == 13
        calm += found.verdict[0].passed
    assert draws - calm <= stats.binom.ppf(0.999, draws, 0.05)


def test_a_test_does_not_differ_from_itself(before_after: Callable[..., tuple[MachineTest, MachineTest]]) -> None:
    result = identify(before_after(5)[0])
    found = compare(result, result)
    assert found.verdict[0].passed
    assert found.joint.p_value == 1.0
    assert_allclose([d.change.value for d in found.differences], 0.0)


def test_tests_of_different_machines_cannot_be_compared(make_test: MakeTest) -> None:
    results = [
        identify(simulate(make_test(topology, [100.0]), {"C_XXX": 6e-5}, Imperfection(noise=NOISE), exact=False))
        for topology in ("wFYXt", "wFXYt")
    ]
    with pytest.raises(UnsupportedError, match="the tests are of different machines, wFYXt and wFXYt"):
        compare(*results)


def test_tests_without_a_common_parameter_cannot_be_compared(make_test: MakeTest) -> None:
    results = [
        identify(simulate(make_test("wFYXt", [100.0, 200.0], parameters=asked), {asked[0]: 1e-5}, Imperfection(noise=NOISE)))
        for asked in (["C_XXX", "C_YYY"], ["E_XX1"])
    ]
    with pytest.raises(UnsupportedError, match="the tests determine no parameter in common"):
        compare(*results)
