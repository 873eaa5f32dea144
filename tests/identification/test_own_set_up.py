"""Each run has its own set-up: where its circle really lies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.estimate import solve, solve_by_run
from elastogeo.identification import identify, merged, systems_of
from elastogeo.observe import Imperfection, MachineTest, Run
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
FORCES = [36.0, 238.0, 490.0, 742.0]
TRUTH = {"C_XXX": 6e-5, "C_YYY": 5e-5, "C_CXY": -3e-8, "E_XX1": -1e-4, "E_YX2": 4e-7}


def asking(make_test: MakeTest, *parameters: str, **more: object) -> MachineTest:
    return make_test("wFYXt", FORCES, parameters=parameters or ("loaded-xy",), set_up_per_run=True, **more)


def moved(test: MachineTest, centres: np.ndarray) -> MachineTest:
    """The same readings from circles whose centres lie elsewhere, shape (runs, 2) [mm]."""
    runs = []
    for run, (x, y) in zip(test.runs, centres, strict=True):
        angle = run.columns["angle"]
        radial = run.columns["radial"] + x * np.cos(angle) + y * np.sin(angle)
        runs.append(Run(run.name, {"angle": angle, "radial": radial}, run.force, sense=run.sense, repeat=run.repeat))
    return replace(test, runs=tuple(runs))


def test_where_the_circles_lie_changes_no_parameter_and_is_found_again(make_test: MakeTest) -> None:
    centres = np.array([[0.05, -0.02], [-0.01, 0.03], [0.0, 0.0], [0.02, 0.02]])
    plain = simulate(asking(make_test), TRUTH, Imperfection(noise=1e-5), exact=False)
    before, after = identify(plain), identify(moved(plain, centres))
    assert_allclose([p.value for p in after.parameters], [p.value for p in before.parameters], rtol=1e-9, atol=1e-15)
    shifts = [
        [after.set_up[run.name][name] - before.set_up[run.name][name] for name in ("E_Xt0", "E_Yt0")] for run in plain.runs
    ]
    assert_allclose(shifts, centres, rtol=0, atol=1e-12)
    assert_allclose([p.standard_uncertainty for p in after.parameters], [p.standard_uncertainty for p in before.parameters])


def test_it_is_what_parameters_of_every_run_would_give(make_test: MakeTest) -> None:
    """Frisch, Waugh and Lovell: projecting columns out is estimating them, in values, residuals and covariance."""
    test = simulate(asking(make_test), TRUTH, Imperfection(noise=1e-4, eccentricity=1e-3), exact=False)
    systems = systems_of(test)
    labels = [p.name for p in identify(test).parameters]
    found = solve(merged(systems.runs), labels)
    designs, readings, own = [], [], []
    shared = systems_of(replace(test, question=replace(test.question, set_up_per_run=False)))
    for k, run in enumerate(shared.runs):
        angle = run.observations.pose
        columns = np.zeros((len(angle), 2 * len(FORCES)))
        columns[:, 2 * k], columns[:, 2 * k + 1] = np.cos(angle), np.sin(angle)
        designs.append(run.design_of(labels))
        own.append(columns)
        readings.append(run.reading)
    whole, reading = np.hstack([np.vstack(designs), np.vstack(own)]), np.concatenate(readings)
    scale = np.linalg.norm(whole, axis=0)
    values, squares, *_ = np.linalg.lstsq(whole / scale, reading, rcond=None)
    variance = float(squares[0]) / (len(reading) - whole.shape[1])
    covariance = variance * np.linalg.inv((whole / scale).T @ (whole / scale)) / np.outer(scale, scale)
    p = len(labels)
    assert_allclose(found.values, (values / scale)[:p], rtol=1e-8)
    assert found.residual_std == pytest.approx(variance**0.5, rel=1e-9)
    assert_allclose(
        found.covariance / np.outer(scale[:p], scale[:p]) ** -1,
        covariance[:p, :p] * np.outer(scale[:p], scale[:p]),
        atol=1e-12,
    )


def test_the_uncertainty_by_run_is_that_of_the_full_model(make_test: MakeTest) -> None:
    """Bell and McCaffrey by hand, on readings and all columns: what belongs to one run alone is absorbed (Pustejovsky)."""
    test = simulate(
        asking(make_test, repeats=2, readings=24), TRUTH, Imperfection(noise=1e-4, eccentricity=1e-3), exact=False
    )
    systems = systems_of(test)
    labels = [p.name for p in identify(test).parameters]
    found = solve_by_run([run.factor for run in systems.runs], labels)
    designs = [run.design_of(labels) for run in systems.runs]
    scale = np.linalg.norm(np.vstack(designs), axis=0)
    X, y = np.vstack(designs) / scale, np.concatenate([run.reading for run in systems.runs])
    m = len(designs[0])
    projector = [np.eye(m) - run.own @ np.linalg.pinv(run.own) for run in systems.runs]
    bread = np.linalg.inv(X.T @ X)
    residual = y - X @ bread @ X.T @ y
    meat = np.zeros((len(labels),) * 2)
    for g, within in enumerate(projector):
        rows = slice(m * g, m * (g + 1))
        leverage = within - X[rows] @ bread @ X[rows].T
        sizes, vectors = np.linalg.eigh((leverage + leverage.T) / 2)
        inverse = np.where(sizes > 1e-8, 1 / np.sqrt(np.where(sizes > 1e-8, sizes, 1.0)), 0.0)
        score = X[rows].T @ ((vectors * inverse) @ vectors.T) @ residual[rows]
        meat += np.outer(score, score)
    expected = bread @ meat @ bread / np.outer(scale, scale)
    assert_allclose(np.sqrt(np.diag(found.covariance)), np.sqrt(np.diag(expected)), rtol=1e-6)


def test_a_robust_estimate_finds_the_set_up_anew(make_test: MakeTest) -> None:
    """Outliers of 50 um at one side pull a centre by micrometres; with their weights it is where it was."""
    plain = simulate(asking(make_test, readings=180), TRUTH, Imperfection(noise=1e-4), exact=False)
    spoilt = []
    for run in plain.runs:
        radial = run.columns["radial"].copy()
        radial[:6] += 0.05
        spoilt.append(replace(run, columns={**run.columns, "radial": radial}))
    test = replace(plain, runs=tuple(spoilt))
    free, robust = identify(test), identify(test, robust=True)
    assert abs(free.set_up[plain.runs[0].name]["E_Xt0"]) > 1e-3
    assert abs(robust.set_up[plain.runs[0].name]["E_Xt0"]) < 1e-4
    assert robust["C_XXX"].value == pytest.approx(TRUTH["C_XXX"], rel=0.01)


def test_a_set_up_that_is_asked_for_is_one_for_all_runs(make_test: MakeTest) -> None:
    test = simulate(asking(make_test, "loaded-xy", "E_Xt0", "E_Yt0"), {**TRUTH, "E_Xt0": 4e-3}, exact=False)
    result = identify(test)
    assert result.set_up == {}
    assert result["E_Xt0"].value == pytest.approx(4e-3, rel=1e-9)


def test_without_a_question_a_test_asks_what_its_instrument_shows(make_test: MakeTest) -> None:
    loaded = replace(asking(make_test), question=replace(asking(make_test).question, parameters=()))
    assert loaded.asked == ("loaded-xy",)
    bare = replace(loaded, runs=tuple(replace(run, force=0.0) for run in loaded.runs))
    assert bare.asked == ("ball-bar-xy",)


@pytest.mark.parametrize(("repeats", "forces", "needed"), [(1, [364.0], 3), (2, [364.0], 4), (1, [36.0, 742.0], 4)])
def test_too_few_runs_give_no_interval_and_say_how_many_it_takes(
    make_test: MakeTest, repeats: int, forces: list[float], needed: int
) -> None:
    def result_of(repeats: int) -> object:
        blank = make_test("wFYXt", forces, parameters=["loaded-xy"], repeats=repeats, set_up_per_run=True)
        return identify(simulate(blank, TRUTH, Imperfection(noise=1e-4), exact=False))

    result = result_of(repeats)
    check = next(check for check in result.verdict if check.name == "uncertainty by run")
    assert not result.by_run
    assert all(p.interval is None and p.estimate is None and p.expanded is None for p in result.parameters)
    assert all(np.isfinite(p.value) for p in result.parameters)
    assert check.passed is False
    assert check.facts["needed"] == needed
    enough = result_of(needed // len(forces))
    assert enough.by_run
    assert all(p.interval is not None for p in enough.parameters)
