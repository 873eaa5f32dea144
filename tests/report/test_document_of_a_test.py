"""What a document says of the test it is from: who, when, which files, and whether they are simulated."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from elastogeo.identification import identify
from elastogeo.machine import About, Machine, parse_topology
from elastogeo.observe import BallBar, Circle, MachineTest, Question, Run, Sensor, SensorFrame
from elastogeo.report import view_of
from elastogeo.sources import simulate

TURN = np.arange(180) * 2 * np.pi / 180


def bar_test() -> MachineTest:
    runs = tuple(
        Run(f"r{k}", {"angle": TURN, "radial": np.zeros(180)}, repeat=k, file=f"runs/r{k}.csv", sha256=f"{k}" * 64)
        for k in (1, 2, 3)
    )
    setup = BallBar(Circle(150.0), 20.0)
    test = MachineTest("t", Machine("m", parse_topology("wFYXt")), setup, runs, Question(("E_XX1", "E_YY1")))
    made = simulate(test, {"E_XX1": 1e-4}, seed=3, exact=False)
    noise = np.random.default_rng(1).normal(0, 1e-4, (3, 180))
    noisy = (
        replace(run, columns={**run.columns, "radial": run.columns["radial"] + shift})
        for run, shift in zip(made.runs, noise, strict=True)
    )
    return replace(made, runs=tuple(noisy), about=About(date="2026-03-01", operator="A. Fischer"), simulated="")


def test_files_and_people_are_in_the_document() -> None:
    view = view_of(identify(bar_test()))
    said = view.document["test"]
    assert said["about"] == {"date": "2026-03-01", "operator": "A. Fischer"}
    assert said["files"][1] == {"run": "r2", "file": "runs/r2.csv", "sha256": "2" * 64, "simulated": ""}
    assert ("Operator", "A. Fischer") in view.head
    assert view.origin == ""


def test_a_test_of_which_some_runs_are_simulated_says_how_many() -> None:
    test = bar_test()
    marked = replace(test.runs[0], simulated="elastogeo, seed 1")
    mixed = replace(test, runs=(marked, *test.runs[1:]), simulated="elastogeo, seed 1")
    assert view_of(identify(mixed)).origin == "Simulated (1 of 3 runs): elastogeo, seed 1"


def test_a_long_sum_is_summarised_on_the_screen_and_whole_in_the_document() -> None:
    """A frame at one place, under one force: each retained name stands for many."""
    points = np.random.default_rng(12).uniform(-80, 80, (8, 3))
    directions = np.random.default_rng(13).standard_normal((8, 3))
    sensors = tuple(Sensor(tuple(p), tuple(n)) for p, n in zip(points, directions, strict=True))
    setup = SensorFrame(sensors, (1.0, -2.0, 1.0), {}, (15.0, -10.0, -40.0))
    runs = tuple(Run(f"{force:g}", {"angle": TURN[:24]}, force=force) for force in (300.0, 600.0))
    test = MachineTest("t", Machine("m", parse_topology("wFYXt")), setup, runs, Question(("C_??X", "C_??Y")))
    made = simulate(test, {"C_XXX": 6e-5}, seed=3, exact=False)
    view = view_of(identify(made))
    long = [note for note in view.notes if "more terms" in note]
    assert long
    assert all(len(note) < 160 for note in long)
    assert max(len(parameter["stands_for"]) for parameter in view.document["parameters"]) > 7
