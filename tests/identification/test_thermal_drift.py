"""The budget's line of a thermal drift against the test identified again with every row of its files drifted.

Rows of a file are in the order of time; the rows of the design are so for a bar, and sensor after sensor for instruments
that read several sensors at once.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.identification import identify
from elastogeo.observe import (
    Circle,
    DisplacementProbes,
    Imperfection,
    KnownInfluence,
    LoadedBallBar,
    MachineTest,
    Question,
    Run,
    Sensor,
    SensorFrame,
    Setup,
)
from elastogeo.sources import simulate
from tests.conftest import build_machine

DRIFT = 0.004
READINGS = 24
ANGLE = 2 * np.pi * np.arange(READINGS) / READINGS
SENSORS = tuple(Sensor((10.0 * k, 5.0, -3.0 * k), n) for k, n in enumerate(((1, 0, 0), (0, 1, 0), (1, 1, 1))))
CASES: dict[str, tuple[Setup, dict[str, float]]] = {
    "a frame of sensors": (SensorFrame(SENSORS, (1, 2, -2)), {"C_XXX": 6e-5, "C_YYX": 4e-5, "C_ZZX": 3e-5}),
    "probes": (
        DisplacementProbes(((1, 0, 0), (0, 1, 0), (0, 0, 1)), bar=(1, 0, 1), rotary_turn={"C": 1.0}),
        {"C_XXX": 6e-5, "C_YYY": 4e-5, "E_Xw0": 3e-3},
    ),
    "a bar": (LoadedBallBar(Circle(150.0), 30.0), {"C_XXX": 6e-5, "C_YYY": 4e-5, "E_XX1": 1e-5}),
}


def simulated(setup: Setup, truth: dict[str, float]) -> MachineTest:
    runs = tuple(Run(f"{force:g} N, {k}", {"angle": ANGLE}, force=force) for force in (100.0, 400.0, 700.0) for k in (1, 2))
    blanks = tuple(
        replace(run, columns={"angle": ANGLE, **{n: np.zeros(READINGS) for n in setup.quantities if n != "angle"}})
        for run in runs
    )
    if isinstance(setup, SensorFrame):
        blanks = runs
    stated = (KnownInfluence("thermal-drift", "room", length=DRIFT),)
    test = MachineTest("t", build_machine("wCFYXZt"), setup, blanks, Question(tuple(truth)), influences=stated)
    return simulate(test, truth, Imperfection(noise=1e-5), seed=5, exact=False)


def drifted(test: MachineTest) -> MachineTest:
    """Every row of every file, in the order in which they were recorded."""
    total, runs = READINGS * len(test.runs), []
    for k, run in enumerate(test.runs):
        shift = DRIFT * ((READINGS * k + np.arange(READINGS)) / total - 0.5)
        moved = {n: v + shift if n.startswith(("displacement", "radial")) else v for n, v in run.columns.items()}
        runs.append(replace(run, columns=moved))
    return replace(test, runs=tuple(runs))


@pytest.mark.parametrize("instrument", CASES)
def test_a_drift_moves_the_estimate_as_the_budget_says(instrument: str) -> None:
    setup, truth = CASES[instrument]
    test = simulated(setup, truth)
    plain, warm = identify(test), identify(drifted(test))
    moved = {name: abs(warm[name].value - plain[name].value) for name in truth}
    for name, lines in zip(plain.budget.labels, plain.budget.lines, strict=True):
        if name in truth:
            (contribution,) = (line.contribution for line in lines if line.label == "room")
            assert contribution == pytest.approx(moved[name], rel=1e-6, abs=1e-12)
    assert max(moved[name] / truth[name] for name in truth) > 1e-3
