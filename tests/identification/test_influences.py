"""Systematic influences: their first order against re-identified tests, draws against first order, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Solution, solve, solve_by_run
from elastogeo.identification import (
    Effect,
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
from elastogeo.machine import Array
from elastogeo.observe import Calibration, Imperfection, KnownInfluence, MachineTest
from elastogeo.report import sentence_of
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
RADIUS, FORCES = 150.0, (36.0, 238.0, 490.0, 742.0)
TRUTH = {
    "C_XXX": 6.19e-5,
    "C_YYY": 4.61e-5,
    "C_CCY": 2e-9,
    "C_CXY": -2.69e-8,
    "E_XX1": -1.3e-4,
    "E_YY1": -9.86e-5,
    "E_Xt0": 0.0039,
    "E_XY2": -7e-7,
    "CF1_XXX": 1e-8,
    "H0.8_YYY": 1e-5,
}
"""Some of each power of the force: 0, 0.8, 1 and 2."""

SIZES = {
    "force-scale": {"relative": 0.01},
    "force-offset": {"force": 2.0},
    "force-level": {"relative": 0.01},
    "bar-length": {"length": 0.002},
    "sensor-scale": {"relative": 0.01},
    "ball-form": {"length": 0.003},
    "setup-deflection": {"relative": 0.1},
    "thermal-drift": {"length": 0.002},
}


def influence(kind: str, distribution: str = "normal") -> KnownInfluence:
    return KnownInfluence(kind, f"the {kind}", distribution=distribution, **SIZES[kind])


@pytest.fixture(scope="module")
def test(make_test: MakeTest) -> MachineTest:
    """Four levels twice, simulated with noise, with pressures and the set-up's deflection corrected."""
    blank = make_test("wFYXt", FORCES, parameters=list(TRUTH), repeats=2, readings=72)
    setup = replace(blank.setup, setup_deflection=0.00233)
    runs = tuple(replace(run, pressure=(run.force + 14) / 126) for run in blank.runs)
    return simulate(replace(blank, setup=setup, runs=runs), TRUTH, Imperfection(noise=1e-3), seed=3, exact=False)


def test_an_uncertain_calibration_moves_the_estimate_as_the_calibration_itself_does(test: MachineTest) -> None:
    """Each part of it, against an estimate with the calibration changed by that part; the load cell is a force scale."""
    runs = tuple(replace(run, force=None) for run in test.runs)
    gauge = Calibration((1.0, 6.0), (112.0, 742.0), (1.5, 2.5), -0.4, 12.0, relative=0.004, relative_degrees_of_freedom=30.0)
    setup = replace(
        test.setup, calibration=gauge, setup_deflection_uncertainty=5e-5, setup_deflection_degrees_of_freedom=8.0
    )
    stated = replace(test, runs=runs, setup=setup)
    found = effects_of(stated, systems_of(stated))
    assert [(e.influence.label, e.influence.degrees_of_freedom) for e in found] == [
        *[("force calibration", 12.0)] * 2,
        ("load cell", 30.0),
        ("set-up deflection", 8.0),
    ]
    truth = np.array([[1.5**2, -0.4 * 1.5 * 2.5], [-0.4 * 1.5 * 2.5, 2.5**2]])
    ends = np.array([[e.force for e in gauge.influences(p)[:2]] for p in gauge.pressure])
    np.testing.assert_allclose(ends @ ends.T, truth, rtol=1e-12)
    systems = systems_of(stated)
    solution = solve(merged(systems.runs), list(TRUTH))
    budget = uncertainty_budget(systems, solution, found)
    sizes = {line.label: line.contribution for line in budget.lines[0]}

    def with_gauge(**changes: object) -> Array:
        return estimate(replace(stated, setup=replace(setup, **changes)))

    def derivative(up: dict[str, object], down: dict[str, object]) -> float:
        return float((with_gauge(**up)[0] - with_gauge(**down)[0]) / 2)

    moved = [
        derivative(*({"calibration": replace(gauge, force=tuple(np.add(gauge.force, h * ends[:, k])))} for h in (1.0, -1.0)))
        for k in (0, 1)
    ]
    assert sizes["force calibration"] == pytest.approx(np.hypot(*moved), rel=1e-3)
    scaled = derivative(
        *({"calibration": replace(gauge, force=tuple(np.multiply(gauge.force, 1 + h)))} for h in (0.004, -0.004))
    )
    assert sizes["load cell"] == pytest.approx(abs(scaled), rel=1e-3)
    bent = derivative(*({"setup_deflection": 0.00233 + h} for h in (5e-5, -5e-5)))
    assert sizes["set-up deflection"] == pytest.approx(abs(bent), rel=1e-3)


def estimate(test: MachineTest) -> Array:
    systems = systems_of(test)
    return solve(merged(systems.runs), list(TRUTH)).values


def with_forces(test: MachineTest, forces: Array) -> MachineTest:
    runs = tuple(replace(run, force=float(force)) for run, force in zip(test.runs, forces, strict=True))
    return replace(test, runs=runs)


def with_radial(test: MachineTest, shifts: list[Array]) -> MachineTest:
    runs = tuple(
        replace(run, columns={**run.columns, "radial": run.columns["radial"] + shift})
        for run, shift in zip(test.runs, shifts, strict=True)
    )
    return replace(test, runs=runs)


def changed(test: MachineTest, kind: str, part: int, amount: float) -> MachineTest:
    """The test as it would be believed if the influence were that large: other forces, or other readings."""
    forces = np.array([run.force for run in test.runs])
    radial = [run.columns["radial"] for run in test.runs]
    angle = [run.columns["angle"] for run in test.runs]
    match kind:
        case "force-scale":
            return with_forces(test, forces * (1 + amount))
        case "force-offset":
            return with_forces(test, forces + amount)
        case "force-level":
            return with_forces(test, np.where(forces == FORCES[part], forces * (1 + amount), forces))
        case "bar-length":
            return with_radial(test, [np.full(72, -amount)] * len(forces))
        case "sensor-scale":
            taken = [2.33e-3 * (force + 14) / 126 for force in forces]  # what the set-up correction takes off
            return with_radial(test, [-amount * (r - d) for r, d in zip(radial, taken, strict=True)])
        case "ball-form":
            wave, order = (np.cos, np.sin)[part % 2], 2 + part // 2
            return with_radial(test, [-amount * wave(order * a) for a in angle])
        case "setup-deflection":
            setup = replace(test.setup, setup_deflection=test.setup.setup_deflection * (1 + amount))
            return replace(test, setup=setup)
        case _:
            ramp = np.arange(72 * len(forces)).reshape(len(forces), 72) / (72 * len(forces)) - 0.5
            return with_radial(test, list(-amount * ramp))


STEPS = {"relative": 1e-4, "length": 1e-3, "force": 1e-2}
PARTS = {"force-level": len(FORCES), "ball-form": 8}


@pytest.mark.parametrize("kind", SIZES)
def test_the_sensitivity_is_that_of_the_identified_test(kind: str, test: MachineTest) -> None:
    """The contribution in closed form against differences of the estimate, re-identified with other forces or readings."""
    known = influence(kind)
    stated = replace(test, influences=(known,))
    systems = systems_of(stated)
    solution = solve(merged(systems.runs), list(TRUTH))
    effects = effects_of(stated, systems)
    assert len(effects) == PARTS.get(kind, 1)
    apart, largest = [], []
    for part, effect in enumerate(effects):
        budget = uncertainty_budget(systems, solution, [effect])
        analytic = np.array([next(b.contribution for b in line if "scatter" not in b.label) for line in budget.lines])
        analytic /= effect.influence.standard_uncertainty
        h = STEPS[next(iter(SIZES[kind]))]

        def central(h: float, part: int = part) -> Array:
            up, down = (estimate(changed(test, kind, part, sign * h)) for sign in (1, -1))
            return np.asarray((up - down) / (2 * h))

        numeric = np.abs((4 * central(h / 2) - central(h)) / 3)
        norms = merged(systems.runs).column_norms
        scale = np.array([norms[merged(systems.runs).labels.index(name)] for name in TRUTH])
        apart.append(float(np.abs((analytic - numeric) * scale).max()))
        largest.append(float((numeric * scale).max()))
    worst = max(apart) / max(largest)  # of the harmonics of a ball's form, some move nothing
    print(f"{kind}: worst {worst:.1e}")
    assert worst < 1e-6


@pytest.mark.parametrize("kind", SIZES)
def test_signs_cancel_as_they_should(kind: str, test: MachineTest) -> None:
    """The covariance of two parameters under one influence has the sign of their common change."""
    stated = replace(test, influences=(influence(kind),))
    systems = systems_of(stated)
    solution = solve(merged(systems.runs), list(TRUTH))
    effect = effects_of(stated, systems)[0]
    budget = uncertainty_budget(systems, solution, [effect])
    added = budget.covariance - solution.covariance
    h = STEPS[next(iter(SIZES[kind]))]
    move = (estimate(changed(test, kind, 0, h)) - estimate(changed(test, kind, 0, -h))) / (2 * h)
    expected = np.outer(move, move) * effect.influence.standard_uncertainty**2
    scale = np.sqrt(np.outer(np.diag(budget.covariance), np.diag(budget.covariance)))
    assert_allclose(added / scale, expected / scale, rtol=0, atol=1e-5)


def test_draws_need_no_more_runs_than_the_uncertainty_by_run_does(make_test: MakeTest) -> None:
    """Eleven runs, thirteen parameters: a covariance by run of rank eleven, drawn from all the same."""
    forces = tuple(36.0 + 70.6 * k for k in range(11))
    blank = make_test("wFYXt", forces, parameters=["elasto-geometric-xy"])
    noisy = simulate(blank, {"C_XXX": 6e-5}, Imperfection(noise=1e-4, eccentricity=2e-4), exact=False)
    systems = systems_of(noisy)
    solution = solve_by_run([run.factor for run in systems.runs], confounding_of(noisy, systems).retained)
    assert np.linalg.matrix_rank(solution.covariance / np.outer(*[solution.standard_uncertainty] * 2), tol=1e-9) == 11
    effects = effects_of(replace(noisy, influences=(influence("bar-length"),)), systems)
    found = agreement(solution, moments_of(systems, solution, effects), uncertainty_budget(systems, solution, effects))
    half = np.ptp(found.interval, axis=1) / 2
    scatter = np.ptp(solution.interval(), axis=1) / 2
    assert np.all(half > 0.95 * scatter)


def certain(solution: Solution) -> Solution:
    """The solution with a scatter that is known: what is left of the budget is linear and normal."""
    return replace(solution, degrees_of_freedom=np.full(len(solution.labels), np.inf))


@pytest.mark.parametrize("kind", ["bar-length", "sensor-scale", "ball-form", "setup-deflection", "thermal-drift"])
def test_draws_agree_with_first_order_where_all_is_linear_and_normal(kind: str, test: MachineTest) -> None:
    stated = replace(test, influences=(influence(kind),))
    systems = systems_of(stated)
    solution = certain(solve(merged(systems.runs), list(TRUTH)))
    effects = effects_of(stated, systems)
    budget = uncertainty_budget(systems, solution, effects)
    found = agreement(solution, moments_of(systems, solution, effects), budget)
    assert found.agrees.all()
    trials = found.draws.trials
    assert_allclose(found.draws.standard_uncertainty / budget.standard_uncertainty, 1.0, atol=5 / np.sqrt(2 * trials))
    off = (found.draws.mean - solution.values) / budget.standard_uncertainty
    assert_allclose(off, 0.0, atol=5 / np.sqrt(trials))


def test_draws_agree_with_first_order_for_small_errors_of_the_force(test: MachineTest) -> None:
    known = tuple(KnownInfluence(kind, kind, relative=1e-4) for kind in ("force-scale", "force-level"))
    stated = replace(test, influences=known)
    systems = systems_of(stated)
    solution = certain(solve(merged(systems.runs), list(TRUTH)))
    effects = effects_of(stated, systems)
    budget = uncertainty_budget(systems, solution, effects)
    assert agreement(solution, moments_of(systems, solution, effects), budget).agrees.all()


def test_draws_do_not_agree_where_one_rectangular_influence_rules(test: MachineTest) -> None:
    """1.96 u of a rectangular distribution lies 13 % beyond its limits; the draws keep within (JCGM 101, 9.2.3)."""
    stated = replace(test, influences=(replace(influence("bar-length", "rectangular"), length=0.1),))
    systems = systems_of(stated)
    solution = certain(solve(merged(systems.runs), list(TRUTH)))
    effects = effects_of(stated, systems)
    budget = uncertainty_budget(systems, solution, effects)
    found = agreement(solution, moments_of(systems, solution, effects), budget)
    gain = solution.labels.index("E_XX1")
    assert not found.agrees[gain]
    half = np.array([np.ptp(budget.interval[gain]), np.ptp(found.draws.interval[gain])]) / 2
    assert half[0] == pytest.approx(1.96 * 0.1 / np.sqrt(3) / RADIUS, rel=0.02)
    assert half[1] == pytest.approx(0.95 * 0.1 / RADIUS, rel=0.02)


def test_a_large_error_of_the_force_is_drawn_without_linearising(test: MachineTest) -> None:
    """A compliance is inversely proportional to the force: too much of it moves it less far than too little."""
    stated = replace(test, influences=(KnownInfluence("force-scale", relative=0.2),))
    systems = systems_of(stated)
    solution = certain(solve(merged(systems.runs), list(TRUTH)))
    effects = effects_of(stated, systems)
    budget = uncertainty_budget(systems, solution, effects)
    found = agreement(solution, moments_of(systems, solution, effects), budget)
    k = solution.labels.index("C_YYY")
    value = solution.values[k]
    assert not found.agrees[k]
    low, high = found.draws.interval[k] - value
    assert high > 1.5 * -low
    assert abs(value) * 0.2 == pytest.approx(budget.standard_uncertainty[k], rel=0.3)


def test_the_budget_is_sorted_and_labelled(test: MachineTest) -> None:
    known = tuple(influence(kind) for kind in SIZES)
    result = identify(replace(test, influences=known))
    for k, lines in enumerate(result.budget.lines):
        sizes = [line.contribution for line in lines]
        assert sizes == sorted(sizes, reverse=True)
        total = np.sqrt(np.sum(np.square(sizes)))
        assert total == pytest.approx(result.budget.standard_uncertainty[k], rel=1e-9)
        labels = [line.label for line in lines]
        assert len(set(labels)) == len(labels)
        assert labels.count("the bar-length") == 1
        assert labels.count("the ball-form") == 1  # eight harmonics, one line
        assert sum(label.startswith("the force-level at") for label in labels) == len(FORCES)
        (scatter,) = (line for line in lines if line.label == "scatter of the readings")
        assert not scatter.type_b
        assert all(line.type_b for line in lines if line is not scatter)
    gain = next(k for k, p in enumerate(result.parameters) if p.name == "E_YY1")
    bar = next(line for line in result.budget.lines[gain] if line.label == "the bar-length")
    assert bar.contribution == pytest.approx(0.002 / RADIUS, rel=1e-9)


def test_without_influences_the_budget_is_the_scatter(test: MachineTest) -> None:
    result = identify(test)
    assert_allclose(result.budget.covariance, result.solution.covariance)
    assert_allclose(result.budget.interval, result.solution.interval())
    assert all([line.label for line in lines] == ["scatter of the readings"] for lines in result.budget.lines)


def test_two_influences_of_one_kind_add_in_squares(test: MachineTest) -> None:
    one = replace(test, influences=(influence("bar-length"),))
    two = replace(test, influences=(influence("bar-length"), replace(influence("bar-length"), label="another bar")))
    systems = systems_of(test)
    solution = solve(merged(systems.runs), list(TRUTH))
    once, twice = (uncertainty_budget(systems, solution, effects_of(t, systems)) for t in (one, two))
    added = [budget.covariance - solution.covariance for budget in (once, twice)]
    scale = np.sqrt(np.outer(np.diag(twice.covariance), np.diag(twice.covariance)))
    assert_allclose(added[1] / scale, 2 * added[0] / scale, atol=1e-9)


def test_with_a_reference_level_there_is_no_uncertainty_for_influences_to_be_in(make_test: MakeTest) -> None:
    blank = make_test("wFYXt", FORCES, reference=36.0)
    noisy = simulate(blank, {"C_XXX": 6e-5}, Imperfection(noise=1e-4), exact=False)
    result = identify(replace(noisy, influences=(influence("bar-length"),)))
    assert all(parameter.estimate is None and parameter.interval is None for parameter in result.parameters)
    check = next(check for check in result.verdict if check.name == "systematic influences stated")
    assert check.passed is None
    assert "with a reference level subtracted there is no uncertainty" in sentence_of(check)
    asked = replace(with_question(noisy, reference="none"), influences=(influence("bar-length"),))
    assert "the bar-length" in {line.label for lines in identify(asked).budget.lines for line in lines}


def test_few_degrees_of_freedom_are_no_fault_of_the_first_order(make_test: MakeTest) -> None:
    """Four runs, six compliances: a linear model of normal influences, whatever Student's factor of so few runs."""
    noisy = simulate(make_test("wFYXt", FORCES), {"C_XXX": 6e-5}, Imperfection(noise=1e-4), exact=False)
    result = identify(replace(noisy, influences=(influence("bar-length"),)))
    assert result.by_run
    assert result.solution.degrees_of_freedom.min() < 2
    check = next(check for check in result.verdict if check.name == "first order enough")
    assert check.passed
    assert result.agreement is not None
    half = np.ptp(result.budget.interval, axis=1) / 2
    assert_allclose(result.agreement.interval, result.budget.interval, rtol=0, atol=0.05 * half.max(), err_msg="draws")
    assert np.all(np.abs(np.ptp(result.agreement.interval, axis=1) / 2 - half) < 0.05 * half)


def test_the_interval_that_the_verdict_recommends_is_the_one_given(make_test: MakeTest) -> None:
    """A bar whose length is known between two limits only: it rules the gains, whose interval is then no normal one."""
    asked = ["C_XXX", "C_YYY", "E_XX1", "E_YY1"]
    blank = make_test("wFYXt", FORCES, parameters=asked, repeats=4)
    noisy = simulate(blank, {"C_XXX": 6e-5}, Imperfection(noise=1e-5), exact=False)
    wide = replace(influence("bar-length"), length=5e-3, distribution="rectangular")
    result = identify(replace(noisy, influences=(wide,)))
    assert result.agreement is not None
    check = next(check for check in result.verdict if check.name == "first order enough")
    assert not check.passed
    assert set(check.facts["apart"]) == {"E_XX1", "E_YY1"}
    for k, parameter in enumerate(result.parameters):
        chosen = result.agreement if parameter.name in check.facts["apart"] else result.budget
        assert parameter.interval == tuple(chosen.interval[k])
    # 95 % of a rectangular distribution of half-width a lie within 0.95 a; a unit of both gains moves every reading by R.
    low, high = result["E_XX1"].interval
    assert (high - low) / 2 == pytest.approx(0.95 * 5e-3 / 150.0, rel=0.02)


def test_an_unknown_influence_is_refused(test: MachineTest) -> None:
    with pytest.raises(InputError, match=r"there is no influence 'moon'; there are force-scale, .*, thermal-drift"):
        identify(replace(test, influences=(KnownInfluence("moon", length=1.0),)))


MISSING = {
    "force-scale": ("relative", {"force": 1.0}),
    "force-offset": ("force_N", {"relative": 0.1}),
    "force-level": ("relative", {"length": 1.0}),
    "bar-length": ("length_um", {"relative": 0.1}),
    "sensor-scale": ("relative", {}),
    "ball-form": ("length_um", {"force": 1.0}),
    "setup-deflection": ("relative", {"length": 1.0}),
    "thermal-drift": ("length_um", {}),
}


@pytest.mark.parametrize("kind", SIZES)
def test_an_influence_without_its_size_is_refused(kind: str, test: MachineTest) -> None:
    field, others = MISSING[kind]
    with pytest.raises(InputError, match=f"the influence '{kind}' needs its size in {field}"):
        identify(replace(test, influences=(KnownInfluence(kind, **others),)))


@pytest.mark.parametrize("size", [0.0, -1e-3, float("nan"), float("inf")])
def test_a_size_that_is_none_is_refused(size: float, test: MachineTest) -> None:
    with pytest.raises(InputError, match=r"its scale is .*, it must be positive and finite"):
        identify(replace(test, influences=(KnownInfluence("bar-length", length=size),)))


def test_an_unknown_distribution_is_refused(test: MachineTest) -> None:
    with pytest.raises(InputError, match=r"'lognormal' is none of normal, rectangular, triangular, arcsine"):
        identify(replace(test, influences=(replace(influence("bar-length"), distribution="lognormal"),)))


def test_agreement_without_influences_is_refused(test: MachineTest) -> None:
    systems = systems_of(test)
    solution = solve(merged(systems.runs), list(TRUTH))
    with pytest.raises(UnsupportedError, match="the test states no systematic influence"):
        agreement(solution, moments_of(systems, solution, ()), uncertainty_budget(systems, solution, ()))


def test_an_offset_of_the_force_at_no_force_is_refused(make_test: MakeTest) -> None:
    blank = make_test("wFYXt", (0.0, 490.0, 742.0), parameters=["elasto-geometric-xy"])
    noisy = simulate(blank, {"C_XXX": 6e-5}, Imperfection(noise=1e-4), exact=False)
    stated = replace(noisy, influences=(influence("force-offset"),))
    with pytest.raises(
        InputError, match=r"the influence 'force-offset' cannot be stated for run '0 N, 1', which has no force"
    ):
        identify(stated)


def test_an_effect_of_ones_own_goes_through(test: MachineTest) -> None:
    """The budget takes any effect: here a stretch of one run."""
    systems = systems_of(test)
    solution = solve(merged(systems.runs), list(TRUTH))
    (scale,) = effects_of(replace(test, influences=(influence("force-scale"),)), systems)
    one = Effect(scale.influence, np.eye(len(systems.runs))[-1])
    budget = uncertainty_budget(systems, solution, [one])
    assert np.all(budget.standard_uncertainty >= solution.standard_uncertainty)
    assert confounding_of(test, systems).rank == len(TRUTH)
