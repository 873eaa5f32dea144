"""A covariance that comes with the readings, as columns beside them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose

from elastogeo.identification import identify
from elastogeo.observe import Imperfection, MachineTest
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]
FORCES = [36.0, 238.0, 490.0, 742.0]


def with_columns(test: MachineTest, **columns: float) -> MachineTest:
    """Columns that shift every reading of a run by one amount [mm], times the run's number."""
    runs = [
        replace(
            run,
            columns={
                **run.columns,
                **{name: np.full(len(run.columns["angle"]), size * k) for name, size in columns.items()},
            },
        )
        for k, run in enumerate(test.runs, 1)
    ]
    return replace(test, runs=tuple(runs))


def simulated(make_test: MakeTest) -> MachineTest:
    test = make_test("wFYXt", FORCES, parameters=("C_XXX", "C_YYY", "E_XX1", "E_YY1"))
    return simulate(test, {"C_XXX": 6e-5, "C_YYY": 5e-5}, Imperfection(noise=1e-4), seed=1)


def test_a_column_is_one_quantity_in_all_runs(make_test: MakeTest) -> None:
    test = simulated(make_test)
    size = 2e-3
    budget = identify(with_columns(test, u_drift=size)).budget
    shifted = replace(
        test,
        runs=tuple(
            replace(run, columns={**run.columns, "radial": run.columns["radial"] + size * k})
            for k, run in enumerate(test.runs, 1)
        ),
    )
    plain, moved = identify(test), identify(shifted)
    stated = {
        name: line.contribution
        for name, lines in zip(budget.labels, budget.lines, strict=True)
        for line in lines
        if line.label == "drift"
    }
    assert_allclose(
        [stated[p.name] for p in plain.parameters],
        [abs(moved[p.name].value - p.value) for p in plain.parameters],
        rtol=1e-6,
        atol=1e-12,
    )


def test_numbered_columns_count_together(make_test: MakeTest) -> None:
    test = simulated(make_test)
    two = identify(with_columns(test, u_drift_1=3e-3, u_drift_2=4e-3)).budget
    one = identify(with_columns(test, u_drift=5e-3)).budget
    assert_allclose(two.covariance, one.covariance, rtol=1e-9)
    assert [[line.label for line in lines] for lines in two.lines] == [[line.label for line in lines] for lines in one.lines]


def test_a_run_without_the_column_has_none_of_it(make_test: MakeTest) -> None:
    test = with_columns(simulated(make_test), u_drift=1e-3)
    first, *others = test.runs
    bare = replace(first, columns={name: first.columns[name] for name in ("angle", "radial")})
    seen = replace(test, runs=(bare, *others)).observations()
    assert not seen[0].influences[-1].reading.any()
    assert seen[1].influences[-1].reading.all()
