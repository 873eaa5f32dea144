"""Compliances that change with the force (Eq. 5.39), how well each model fits each level (Table 5.9), and what is drawn."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from elastogeo.identification import gain_of, identify, systems_of
from elastogeo.identification.model_choice.variable_compliance import variable_compliance
from elastogeo.observe import Imperfection, Question
from elastogeo.sources import linear_response, parameter_values, simulate

GEOMETRY = {"E_XX1": -1.3e-4, "E_YX2": 4.3e-7, "E_YY1": -9.9e-5}
FALLING = {"C_XXX": 6.2e-5, "C_YYY": 4.6e-5, "CF1_XXX": -2e-8, "CF1_YYY": 1e-8, **GEOMETRY}


def asked(test, own=False):
    return replace(test, question=Question(("elasto-geometric-xy",), set_up_per_run=own))


@pytest.fixture(scope="module")
def changing(make_test, thesis_forces):
    """Seven levels without noise, of compliances that change."""
    test = asked(make_test("wCAFYXZSt", thesis_forces, readings=60))
    return identify(simulate(test, {**FALLING, "E_Xt0": 0.004}, exact=False))


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("topology", ["wCAFYXZSt", "wFXYt", "wXFYt"])
def test_a_compliance_that_changes_with_the_force_is_found(make_test, topology, own) -> None:
    test = asked(make_test(topology, (50.0, 300.0, 700.0), readings=48, repeats=2), own)
    parameters = ("C_XXX", "C_YYY", "E_XX1", "E_YX2", "E_YY1") if own else ("C_XXX", "C_YYY", "E_XX1", "E_YY1", "E_?t0")
    test = replace(test, question=replace(test.question, parameters=parameters))
    truth = {**{name: value for name, value in FALLING.items() if own or name != "E_YX2"}, "E_Xt0": 0.004}
    found = identify(simulate(test, truth, exact=False)).variable
    assert found.by_run
    assert found.rmse < 1e-12
    for name, value in truth.items():
        if name in found.solution.labels:
            assert found.solution.estimate(name).value == pytest.approx(value, rel=1e-7)
    assert found.at("C_XXX", 700.0).value == pytest.approx(6.2e-5 - 700 * 2e-8, rel=1e-7)
    assert found.change("C_YYY", 400.0).value == pytest.approx(4e-6, rel=1e-6)
    assert found.at("E_XX1", 700.0).value == found.at("E_XX1", 0.0).value


def test_a_force_that_varies_within_a_run_is_taken_reading_by_reading(make_test) -> None:
    """The gain goes with the force at each reading, before the run's own set-up is projected out."""
    test = asked(make_test("wCAFYXZSt", (100.0, 300.0, 700.0), readings=48, repeats=2), own=True)
    test = replace(test, question=replace(test.question, parameters=("C_XXX", "C_YYY", "E_XX1", "E_YY1")))
    truth = parameter_values(test.machine, {**FALLING, "E_YX2": 0.0, "E_Xt0": 0.004})
    observations = []
    for run in test.observations():
        pushed = replace(run, wrench=run.wrench * (1 + 0.3 * np.cos(2 * run.pose) + 0.1 * np.sin(run.pose))[:, np.newaxis])
        observations.append(replace(pushed, reading=linear_response(truth, test.machine, pushed)))
    systems = systems_of(test, observations)
    assert all(run.set_up_names for run in systems.runs)
    found = variable_compliance(systems, ("C_XXX", "C_YYY", "E_XX1", "E_YY1"))
    for name in ("C_XXX", "C_YYY", "CF1_XXX", "CF1_YYY", "E_XX1", "E_YY1"):
        assert found.solution.estimate(name).value == pytest.approx(FALLING[name], rel=1e-7)


def test_its_uncertainty_at_a_force_is_that_of_the_line(make_test) -> None:
    """The uncertainty of C0 + C1 F over many simulated tests is what the model says of it."""
    test = make_test("wFYXt", (50.0, 300.0, 700.0), readings=24, repeats=3, parameters=("C_XXX", "C_YYY"))
    truth = {"C_XXX": 6.2e-5, "C_YYY": 4.6e-5}
    made = (systems_of(simulate(test, truth, Imperfection(noise=1e-3), seed=k, exact=False)) for k in range(50))
    found = [variable_compliance(systems, ("C_XXX", "C_YYY")) for systems in made]
    for force in (50.0, 700.0):
        values = np.array([one.at("C_XXX", force).value for one in found])
        stated = np.sqrt(np.mean([one.at("C_XXX", force).standard_uncertainty ** 2 for one in found]))
        assert values.mean() == pytest.approx(6.2e-5, abs=4 * stated / np.sqrt(len(found)))
        assert values.std(ddof=1) == pytest.approx(stated, rel=0.3)  # 50 draws: 10 % of scatter


def test_what_a_compliance_gains_is_within_its_interval_at_its_rate(make_test, thesis_forces) -> None:
    """Runs that differ by orders 0, 2 and 3, seven of them: what is called 95 % covers."""
    test = asked(make_test("wCAFYXZSt", thesis_forces, readings=36))
    blank, random = simulate(test, FALLING, exact=False), np.random.default_rng(5)
    angle = blank.runs[0].columns["angle"]
    held = []
    for _ in range(50):
        runs = []
        for run in blank.runs:
            waves = (random.normal(0, 5e-4) * np.cos(n * angle + random.uniform(0, 6.3)) for n in (0, 2, 3))
            scatter = sum(waves) + random.normal(0, 1e-4, len(angle))
            runs.append(replace(run, columns={**run.columns, "radial": run.columns["radial"] + scatter}))
        systems = systems_of(replace(blank, runs=tuple(runs)))
        found = variable_compliance(systems, [source.name for source in systems.sources])
        assert found.by_run
        for name in found.elastic:
            gained = found.change(name, 706.0)
            held.append(abs(gained.value - 706.0 * FALLING.get(gain_of(name), 0.0)) <= gained.expanded())
    assert 0.89 < np.mean(held) < 0.99  # 300 intervals, those of one draw hang together


def test_it_takes_three_levels_no_reference_and_a_compliance(make_test, thesis_forces) -> None:
    two = make_test("wFYXt", thesis_forces[:2], readings=24)
    assert identify(simulate(two, FALLING)).variable is None
    three = make_test("wFYXt", thesis_forces[:3], readings=24)
    assert identify(simulate(three, FALLING), reference=36.0).variable is None
    assert identify(simulate(three, FALLING), parameters=["E_XX1", "E_YY1"]).variable is None
    assert identify(simulate(three, FALLING)).variable is not None
    assert gain_of("C_XXX") == "CF1_XXX"


def test_each_level_has_the_fit_of_each_model(changing) -> None:
    """Eqs. 5.40 and 5.41 by hand, the local estimates by a least-squares solution of their own."""
    assert [level.variable.rmse for level in changing.levels] == pytest.approx([0.0] * 7, abs=1e-12)
    assert [level.variable.fitness for level in changing.levels] == pytest.approx([100.0] * 7)
    columns = {one.force: one.columns for one in changing.responses}
    measured = {trace.force: trace.measured for trace in changing.traces}
    forces = sorted(columns)
    left = {force: [] for force in forces}
    for low, high in pairwise(forces):
        design = np.vstack([columns[low], columns[high]])
        scale = np.linalg.norm(design, axis=0)
        readings = np.concatenate([measured[low], measured[high]])
        values = np.linalg.lstsq(design / scale, readings, rcond=None)[0] / scale
        for force in (low, high):
            left[force].append(measured[force] - columns[force] @ values)
    for level in changing.levels:
        error = np.sqrt(np.mean(np.concatenate(left[level.force]) ** 2))
        assert level.local.rmse == pytest.approx(error, rel=1e-6)
        assert level.local.fitness == pytest.approx(100 * (1 - error / np.ptp(measured[level.force])), rel=1e-9)
        assert level.local.rmse < level.rmse


def test_a_response_is_columns_at_the_poses_of_its_run(make_test, thesis_forces) -> None:
    test = asked(make_test("wCAFYXZSt", thesis_forces[:4], readings=500, repeats=2))
    turned = tuple(replace(run, name=f"{run.name} back", sense=-1) for run in test.runs)
    result = identify(simulate(replace(test, runs=(*test.runs, *turned)), FALLING))
    assert [one.force for one in result.responses] == [force for force in thesis_forces[:4] for _ in (1, -1)]
    traces = {trace.run: trace for trace in result.traces}
    for one in result.responses:
        trace = traces[one.run]
        at = np.searchsorted(trace.pose, one.pose)
        assert len(one.pose) == 181
        assert trace.pose[at] == pytest.approx(one.pose, abs=0)
        assert one.columns @ result.solution.values == pytest.approx(trace.predicted[at], abs=1e-12)


def test_the_truth_is_known_of_simulated_runs_only(make_test) -> None:
    test = make_test("wFYXt", (100.0,), readings=36, repeats=2)
    made = simulate(test, FALLING)
    assert made.truth == FALLING
    assert [p.truth for p in identify(test).parameters] == [None] * 6
    assert replace(made, simulated="").truth == {}
    other = replace(made.runs[1], truth={"C_XXX": 1e-5})
    assert replace(made, runs=(made.runs[0], other)).truth == {}
    assert replace(made, runs=(made.runs[0], test.runs[1])).truth == {}


def test_the_interval_holds_the_truth_at_its_rate(make_test, thesis_forces) -> None:
    test = asked(make_test("wCAFYXZSt", thesis_forces[::3], readings=24, repeats=3))
    truth = {**{name: value for name, value in FALLING.items() if not name.startswith("CF1")}, "C_XXY": 1e-5}
    results = [identify(simulate(test, truth, Imperfection(noise=1e-3), seed=k)) for k in range(7)]
    held = [p.holds_truth for result in results for p in result.parameters]
    assert results[0]["C_XXX"].truth == 6.2e-5  # C_XXY was not asked for: it is not in what C_XXX stands for
    assert results[0]["E_XX1"].truth == GEOMETRY["E_XX1"]
    biased = [result["C_XXX"].holds_truth for result in results]
    assert not any(biased)
    assert 0.85 < np.mean([p for p in held if p is not None]) < 0.99
    assert identify(replace(test, runs=test.runs[:3])).parameters[0].holds_truth is None
