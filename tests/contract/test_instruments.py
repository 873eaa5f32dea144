"""The contract of every instrument on every machine: simulate a random truth, measure, identify, equals truth.

Parametrised over the register of instruments and the arrangements of `conftest.py`; columns are judged by finite
differences of the exact products of transforms, over the whole register of error sources.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.errors import RankError, UnsupportedError
from elastogeo.estimate import factor_blocks, solve
from elastogeo.identification import Identification, confounding_of, identify, merged, noise_of, systems_of
from elastogeo.machine import Array
from elastogeo.observe import Imperfection, MachineTest, Observations, instruments
from elastogeo.planning import ceiling
from elastogeo.report import sentence_of
from elastogeo.sources import (
    Situation,
    Source,
    catalogue,
    design_rows,
    exact_response,
    linear_response,
    parameter_values,
    select_sources,
    simulate,
)

TYPICAL_SIZE = {"mm/N": 1e-5, "rad/N": 3e-8, "mm/(N mm)": 3e-8, "rad/(N mm)": 1e-10}
"""Of a compliance, by unit: each then moves the readings by micrometres."""
GEOMETRIC_SIZE = {"mm/mm": 3e-5, "mm/mm^2": 2e-7, "rad/mm": 2e-7, "rad/mm^2": 1e-9, "rad": 2e-5, "mm": 5e-3}
"""The same of error motions and location errors."""

DRAWS = 1000
SHORT_DRAWS = 400
"""For what is drawn in every arrangement, after a few have had all draws."""
READINGS = 12
NOISE = 1e-4
STEPS = np.array([1.0, -1.0, 0.5, -0.5])
"""Of a difference quotient, in units of the longer step."""
Case = Any


def random_truth(test: MachineTest, seed: int = 0) -> dict[str, float]:
    """Random values of all 36 n compliances; of the geometry, where no load is applied."""
    random = np.random.default_rng(seed)
    sources = select_sources(test.machine, ["C_*"] if test.setup.loads else test.question.parameters)
    sizes = {**TYPICAL_SIZE, **GEOMETRIC_SIZE}
    return {source.name: sizes[source.unit] * float(random.standard_normal()) for source in sources}


def difference_quotients(sources: list[Source], test: MachineTest, observed: Observations) -> Array:
    """Derivatives of the exact response by each source's parameter: central differences, extrapolated (Richardson).

    All at once, on a copy of the readings for each of four steps of each source: a copy sees that step alone.
    """
    situation, m = Situation(test.machine, observed), len(observed)
    drive = np.array([linear_drive(source, situation) for source in sources])
    step = np.array([0.1 if source.component < 3 else 3e-4 for source in sources]) / np.where(drive > 0, drive, 1.0)
    values = np.zeros((len(sources), len(sources), len(STEPS), m))
    for k in range(len(sources)):
        values[k, k] = step[k] * STEPS[:, np.newaxis]
    copies = np.tile(np.arange(m), len(sources) * len(STEPS))
    at_copies = {source: value.ravel() for source, value in zip(sources, values, strict=True)}
    exact = exact_response(at_copies, test.machine, observed.at(copies))  # type: ignore[arg-type]
    up, down, half_up, half_down = np.moveaxis(exact.reshape(len(sources), len(STEPS), m), 1, 0)
    central, half = ((a - b).T / (2 * h) for a, b, h in ((up, down, step), (half_up, half_down, step / 2)))
    return np.asarray((4 * half - central) / 3)


def linear_drive(source: Source, situation: Situation) -> float:
    """Greatest absolute value of a source's driver."""
    return float(np.max(np.abs(source.driver(situation))))


def is_known(source: Source, situation: Situation) -> bool:
    """Whether what drives the source is known at all: accelerations are not where a rotary axis turns along."""
    try:
        linear_drive(source, situation)
    except UnsupportedError:
        return False
    return True


def worst_by_unit(sources: list[Source], analytic: Array, numeric: Array) -> dict[str, float]:
    """Greatest difference of two sets of columns, relative to the greatest column of the same unit."""
    by_unit: dict[str, list[int]] = defaultdict(list)
    for k, source in enumerate(sources):
        by_unit[source.unit].append(k)
    return {
        unit: float(np.abs(analytic[:, k] - numeric[:, k]).max() / max(np.abs(analytic[:, k]).max(), 1e-9))
        for unit, k in by_unit.items()
    }


def test_every_registered_instrument_is_held_to_the_contract(setups: Mapping[str, Callable[..., Any]]) -> None:
    assert set(instruments()) == set(setups)


def test_columns_are_the_derivatives_of_the_exact_response(any_case: Case) -> None:
    """On all 36 n compliances, and on every other source of the catalogue: error motions, location errors, offsets."""
    test = any_case.test(forces=(300.0,), readings=12)
    observed = test.observations()[0].rows(0, 12)
    compliances = select_sources(test.machine, ["C_*"])
    assert len(compliances) == 36 * len(test.machine.compliant)
    others = [source for name, source in catalogue(test.machine).items() if not name.startswith("C_")]
    situation = Situation(test.machine, observed)
    sources = [*compliances, *(source for source in others if is_known(source, situation))]
    assert len(sources) == len(compliances) + len(others) or any_case.arrangement.rotary_turn
    analytic = design_rows(sources, test.machine, observed)[:, :-1]
    parts = [sources[k : k + 16] for k in range(0, len(sources), 16)]
    numeric = np.hstack([difference_quotients(part, test, observed) for part in parts])
    worst = worst_by_unit(sources, analytic, numeric)
    print(any_case, max(worst.values()))
    assert max(worst.values()) < 1e-6, worst


def test_the_exact_response_tends_to_the_linear_one_with_the_square(any_case: Case) -> None:
    test = any_case.test(forces=(300.0,), readings=12)
    observed = test.observations()[0].rows(0, 12)
    truth = random_truth(test)
    errors = []
    for factor in (1.0, 0.1):
        values = parameter_values(test.machine, {name: factor * value for name, value in truth.items()})
        exact, linear = (response(values, test.machine, observed) for response in (exact_response, linear_response))
        errors.append(np.abs(exact - linear).max() / factor**2)
        assert np.abs(exact - linear).max() < 1e-3 * np.abs(linear).max()
    assert errors[1] == pytest.approx(errors[0], rel=0.05)


@pytest.fixture(scope="module")
def identified(case: Case) -> tuple[MachineTest, dict[str, float], Identification]:
    test = case.test()
    truth = random_truth(test)
    simulated = simulate(test, truth, exact=False)
    return simulated, truth, identify(simulated)


def test_what_is_identified_is_the_truth(identified: tuple[MachineTest, dict[str, float], Identification]) -> None:
    """Each retained parameter is exactly the combination of true values that it says it stands for."""
    test, truth, result = identified
    norms = merged(systems_of(test).runs).column_norms
    scale = np.array([norms[result.confounding.labels.index(p.name)] for p in result.parameters])
    values = np.array([p.value for p in result.parameters]) * scale
    stated = np.array([sum(c * truth[name] for name, c in p.stands_for.items()) for p in result.parameters]) * scale
    assert len(result.parameters) == result.confounding.rank
    assert np.abs(values).max() > 1e-3
    # a weak direction amplifies the rounding of the readings, and says so by its condition number
    tolerance = max(1e-9, 1e-15 * result.confounding.condition_scaled)
    print(result.test.name, np.abs(values - stated).max() / np.abs(values).max(), result.confounding.condition_scaled)
    assert_allclose(values, stated, rtol=0, atol=tolerance * np.abs(values).max())


def test_prediction_equals_the_readings(identified: tuple[MachineTest, dict[str, float], Identification]) -> None:
    test, _, result = identified
    for run, trace, system in zip(test.observations(), result.traces, systems_of(test).runs, strict=True):
        readings = system.without_own((run.reading + run.correction)[:, np.newaxis])[:, 0]
        assert np.ptp(readings) > 1e-3
        assert_allclose(trace.measured, readings, atol=1e-15)
        assert_allclose(trace.predicted, readings, rtol=0, atol=1e-9 * np.ptp(readings))
    everything = [result.minimum_norm[name] for name in result.confounding.labels]
    for system, trace in zip(systems_of(test).runs, result.traces, strict=True):
        # directions weaker than the stated tolerance are left out of the minimum norm
        assert_allclose(system.design @ everything, trace.measured, rtol=0, atol=1e-8 * np.ptp(trace.measured))
    assert all(level.fitness == pytest.approx(100.0, abs=1e-6) for level in result.levels)


def test_the_retained_columns_combine_to_all_others(
    identified: tuple[MachineTest, dict[str, float], Identification],
) -> None:
    test, _, result = identified
    systems, found = systems_of(test), result.confounding
    A = np.vstack([run.design for run in systems.runs])
    norms = np.linalg.norm(A, axis=0)
    unit = np.array([source.unit for source in systems.sources])
    is_null = np.isin(found.labels, found.null)
    for one in set(unit):
        assert np.all(norms[is_null & (unit == one)] <= 1e-12 * norms[unit == one].max(initial=0.0))
    A, norms = A[:, ~is_null], norms[~is_null]
    retained = np.isin(found.labels, found.retained)[~is_null]
    combined = A[:, retained] @ found.combinations[:, ~is_null]
    assert not found.combinations[:, is_null].any()
    assert_allclose(combined / norms, A / norms, atol=1e-9 if found.condition_scaled < 1e6 else 2e-8)
    # a second opinion on the rank: singular values of all scaled columns, between the tolerance and rounding error
    singular = np.linalg.svd(A / norms, compute_uv=False)
    assert np.sum(singular > 1e-7 * singular[0]) <= found.rank <= np.sum(singular > 1e-13 * singular[0])


def test_a_purely_radial_force_cannot_tell_mirrored_terms(any_case: Case) -> None:
    """No test of a ball bar shows C_df without C_fd; an instrument that pushes elsewhere than it reads may."""
    test = any_case.test()
    observed = test.observations()[0].rows(0, 36)
    if not np.allclose(observed.wrench, observed.force * observed.direction):
        return
    sources = {source.name: source for source in select_sources(test.machine, ["C_*"])}
    rows = design_rows(list(sources.values()), test.machine, observed)
    column = dict(zip(sources, rows.T, strict=False))
    scale = {unit: max(np.abs(column[s.name]).max() for s in sources.values() if s.unit == unit) for unit in TYPICAL_SIZE}
    for name, source in sources.items():
        twin = f"C_{name[3]}{name[2]}{name[4]}"
        assert_allclose(column[name], column[twin], rtol=0, atol=1e-10 * scale[source.unit])


def test_no_instrument_sees_what_neighbours_exchange_unseen(any_case: Case) -> None:
    """The closed form of `planning.ceilings`: only what reads across one of two neighbours tells them apart."""
    test = any_case.test(forces=(300.0,), readings=12)
    observed = test.observations()[0]
    bound = ceiling(test.machine)
    columns = design_rows(bound.sources, test.machine, observed)[:, :-1]
    size = np.abs(columns * bound.scales).max()
    for pair in bound.pairs:
        changed = columns @ pair.exchanges.T / np.abs(pair.exchanges / bound.scales).max(axis=1)
        unseen = np.abs(changed).max(initial=0.0) <= 1e-9 * size
        assert unseen or observed.sees(pair.first) != observed.sees(pair.second)


def test_a_deficient_question_is_refused_and_named(
    identified: tuple[MachineTest, dict[str, float], Identification],
) -> None:
    test, _, result = identified
    found = result.confounding
    assert found.rank < len(found.labels)
    with pytest.raises(RankError, match=r"changes no reading of this test|are not independent in this test"):
        solve(merged(systems_of(test).runs))
    told = {check.name: check for check in result.verdict}["identifiable"]
    assert not told.passed
    assert f"determines {found.rank} combinations" in sentence_of(told)
    # nothing is lost in silence: every parameter is null, or part of what a retained one stands for
    spoken = set(found.null).union(*(found.stands_for(name) for name in found.retained))
    assert spoken == set(found.labels)


def bounds(draws: int, comparisons: int) -> tuple[float, float]:
    """Between which rates a true 95 % is seen, at 99.9 % over all comparisons together (Bonferroni)."""
    tail = 0.001 / 2 / comparisons
    return stats.binom.ppf(tail, draws, 0.95) / draws, stats.binom.ppf(1 - tail, draws, 0.95) / draws


def check_coverage(inside: Array, draws: int, what: str) -> None:
    """Whether each parameter's intervals held the truth in 95 % of the draws."""
    rates = inside / draws
    low, high = bounds(draws, len(rates))
    print(f"{what}: coverage {rates.min():.4f} to {rates.max():.4f}, mean {rates.mean():.4f}; bounds {low:.4f} {high:.4f}")
    assert np.all((low <= rates) & (rates <= high)), rates


FORCE_PLANS = {
    "no reference": ((112.0, 490.0), None, 1),
    "one reference run": ((36.0, 112.0, 238.0, 364.0, 490.0), 36.0, 1),
    "three reference runs": ((36.0, 112.0, 490.0), 36.0, 3),
}
"""Force levels, the reference among them, runs per level."""


@pytest.mark.parametrize("plan", FORCE_PLANS)
def test_intervals_cover_at_their_rate(case: Case, plan: str) -> None:
    """Noise is drawn per run, at every reading; the reference's mean is subtracted, so its noise is shared by all."""
    forces, reference, repeats = FORCE_PLANS[plan]
    draws = DRAWS if case.is_typical else SHORT_DRAWS
    test = case.test(
        forces, readings=READINGS, parameters=("C_XX*", "C_YY*", "C_ZZ*", "C_CC*"), reference=reference, repeats=repeats
    )
    systems = systems_of(test)
    found = confounding_of(test, systems)
    labels, noise = systems.runs[0].factor.labels, noise_of(systems.runs, systems.references)
    random = np.random.default_rng(95)
    readings = len(systems.runs[0].rows)
    inside = np.zeros(found.rank)
    for _ in range(draws):
        shared = NOISE * random.standard_normal((systems.references, readings)).mean(axis=0) if systems.references else 0.0
        blocks = []
        for run in systems.runs:  # the truth is zero: least squares is linear
            block = run.rows.copy(order="F")
            block[:, -1] = NOISE * random.standard_normal(readings) - shared
            blocks.append(block)
        low, high = solve(factor_blocks(labels, blocks), found.retained, noise).interval().T
        inside += (low <= 0) & (high >= 0)
    check_coverage(inside, draws, f"{case}, {plan}")


def test_intervals_cover_at_their_rate_from_simulation_to_result(case_of: Callable[[str], Case]) -> None:
    """The whole way, from true parameters through simulated runs and the reference subtracted to intervals by readings."""
    test = case_of("wFYXt-XY").test((36.0, 112.0, 490.0), readings=12, parameters=["planar-xy"], reference=36.0)
    truth = {name: value for name, value in random_truth(test).items() if name in names_of(test)}
    inside: Array = np.zeros(6)
    draws = SHORT_DRAWS // 2
    for seed in range(draws):
        result = identify(simulate(test, truth, Imperfection(noise=NOISE), seed=seed, exact=False))
        assert all(parameter.interval is None for parameter in result.parameters)
        for k, (parameter, (low, high)) in enumerate(zip(result.parameters, result.naive.interval(), strict=True)):
            stated = sum(c * truth[name] for name, c in parameter.stands_for.items())
            inside[k] += low <= stated <= high
    check_coverage(inside, draws, "simulation to result")


def names_of(test: MachineTest) -> set[str]:
    return {source.name for source in select_sources(test.machine, test.question.parameters)}


def rearranged(test: MachineTest, order: Array) -> MachineTest:
    runs = [replace(run, columns={name: column[order] for name, column in run.columns.items()}) for run in test.runs]
    return replace(test, runs=tuple(runs))


def with_stronger_forces(test: MachineTest, factor: float) -> MachineTest:
    """The same readings at forces counted in a smaller unit."""
    runs = [
        replace(
            run,
            force=None if run.force is None else run.force * factor,
            columns={name: values * (factor if "force" in name else 1.0) for name, values in run.columns.items()},
        )
        for run in test.runs
    ]
    question = test.question
    if question.reference_force is not None:
        question = replace(question, reference_force=question.reference_force * factor)
    return replace(test, runs=tuple(runs), question=question)


def assert_same_answer(one: Identification, other: Identification, per_newton: float = 1.0) -> None:
    assert one.confounding.retained == other.confounding.retained
    assert one.confounding.null == other.confounding.null
    assert one.confounding.condition_scaled == pytest.approx(other.confounding.condition_scaled, rel=1e-10)
    uncertainties = zip(one.solution.standard_uncertainty, other.solution.standard_uncertainty, strict=True)
    for a, b, (u, v) in zip(one.parameters, other.parameters, uncertainties, strict=True):
        size = max(abs(a.value), u)
        assert b.value * per_newton == pytest.approx(a.value, abs=1e-10 * size)
        assert v * per_newton == pytest.approx(u, rel=1e-9)
        assert b.peak_to_peak == pytest.approx(a.peak_to_peak, rel=1e-8)
    assert one.rmse == pytest.approx(other.rmse, rel=1e-10)


@pytest.mark.parametrize("reference", [None, 36.0], ids=["raw", "reference subtracted"])
def test_the_answer_depends_on_no_convention(typical: Case, reference: float | None) -> None:
    """Start angle, direction, row order, order of the runs, unit of force."""
    forces = (36.0, 112.0, 490.0)
    test = typical.test(forces, parameters=("C_XX*", "C_YY*", "C_ZZ*", "C_CX*", "C_CC*"), reference=reference)
    names = names_of(test)
    truth = {name: value for name, value in random_truth(test).items() if name in names}
    test = simulate(test, truth, Imperfection(noise=NOISE), seed=5, exact=False)
    plain = identify(test)
    rows = np.arange(36)
    for order in (np.roll(rows, 7), rows[::-1], np.random.default_rng(1).permutation(rows)):
        assert_same_answer(plain, identify(rearranged(test, order)))
    clockwise = rearranged(test, rows[::-1])
    clockwise = replace(clockwise, runs=tuple(replace(run, sense=-1) for run in clockwise.runs))
    assert_same_answer(plain, identify(clockwise))
    assert_same_answer(plain, identify(replace(test, runs=test.runs[::-1])))
    if typical.loads:
        assert_same_answer(plain, identify(with_stronger_forces(test, 1000.0)), per_newton=1000.0)


def test_a_run_read_twice_has_the_weight_of_two(typical: Case) -> None:
    """Two runs alike: the same values, and all covariances halved but for the degrees of freedom."""
    truth = {"C_XXX" if typical.loads else "E_XX1": 1e-5}
    test = simulate(typical.test(parameters=("C_XX*", "C_YY*")), truth, Imperfection(noise=NOISE), exact=False)
    again = tuple(replace(run, name=f"{run.name} again") for run in test.runs)
    systems = systems_of(test)
    retained = confounding_of(test, systems).retained
    one = solve(merged(systems.runs), retained)
    two = solve(merged(systems_of(replace(test, runs=test.runs + again)).runs), retained)
    assert_allclose(two.values, one.values, rtol=1e-9, atol=1e-10 * np.abs(one.values).max())
    m, p = sum(run.factor.rows for run in systems.runs), len(retained)
    ratio = (two.standard_uncertainty / one.standard_uncertainty) ** 2
    assert_allclose(ratio, (m - p) / (2 * m - p), rtol=1e-9)
