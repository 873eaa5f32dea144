"""What a change points to: faults simulated in loaded ball-bar tests, identified, judged by the signatures of the test."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.changes import (
    ALARM,
    Baseline,
    ChangeVerdict,
    Indicator,
    Series,
    Signatures,
    indicators_of,
    judge,
    signatures_of,
)
from elastogeo.identification import Identification, identify
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import Circle, Imperfection, LoadedBallBar, MachineTest, Run
from elastogeo.sources import simulate

HEALTHY = {"C_XXX": 4e-5, "C_XXY": 1e-5, "C_YYY": 4e-5, "E_XX1": 1e-5, "E_YY1": -1e-5, "E_C(0Y)X": 1e-5, "E_XY2": 1e-7}
BASELINE, AFTER = 10, 5


def circle(truth: Mapping[str, float], seed: int = 1) -> MachineTest:
    """A loaded circle in XY on wCFYXZt, away from the table's centre, both ways round."""
    angle = 2 * np.pi * np.arange(72) / 72
    runs = tuple(
        Run(f"{force:g} N, {sense:+d}", {"angle": sense * angle, "radial": np.zeros(72)}, force=force, sense=sense)
        for force in (100.0, 400.0, 700.0)
        for sense in (1, -1)
    )
    machine = Machine("wCFYXZt", parse_topology("wCFYXZt"), tool=(0.0, 0.0, -150.0))
    setup = LoadedBallBar(Circle(150.0, centre={"X": 100.0}), feed=30.0)
    return simulate(MachineTest("circle", machine, setup, runs), truth, Imperfection(noise=1e-5), seed)


@cache
def healthy() -> Identification:
    return identify(circle(HEALTHY))


@cache
def signatures() -> Signatures:
    found = signatures_of(healthy())
    assert found is not None
    return found


def judged(faults: Mapping[str, float], seed: int = 0) -> ChangeVerdict:
    """Ten tests of the healthy machine, five with faults added; between tests indicators scatter as their kinds say."""
    sick = indicators_of(identify(circle({**HEALTHY, **{name: HEALTHY.get(name, 0.0) + by for name, by in faults.items()}})))
    return judge(series(indicators_of(healthy()), sick, seed), baseline())


def baseline() -> Baseline:
    return Baseline(tuple(f"test {i}" for i in range(BASELINE)), 30.0 * BASELINE - 1)


def series(before: tuple[Indicator, ...], after: tuple[Indicator, ...], seed: int) -> Series:
    assert [one.name for one in before] == [one.name for one in after]
    scatter = np.array([one.kind.reproducibility * (abs(one.value) if one.kind.relative else 1) for one in before])
    n, q = BASELINE + AFTER, len(before)
    means = np.array([[one.value for one in before]] * BASELINE + [[one.value for one in after]] * AFTER)
    return Series(
        name="simulated",
        indicators=tuple(one.name for one in before),
        kinds=tuple(one.kind for one in before),
        tests=tuple(f"test {i}" for i in range(n)),
        date=30.0 * np.arange(n),
        value=means + scatter * np.random.default_rng(seed).standard_normal((n, q)),
        standard_uncertainty=np.full((n, q), np.nan),
        temperature=np.full(n, np.nan),
        repeats=np.full(n, -1),
        aside=np.zeros(n, dtype=bool),
        instruments=("",) * n,
        simulated="simulated loaded circles",
        signatures=signatures(),
    )


def test_a_guideway_that_wears_is_named_and_what_cannot_explain_its_path_is_not() -> None:
    """Y's guideway gives way across it (x) and its path bends: X's drive gives way alike, but bends nothing."""
    verdict = judged({"C_XXY": 8e-6, "E_XY2": 2.5e-7})
    assert verdict.state == ALARM
    assert {one.name for one in verdict.changed} >= {"stiffness X", "straightness Y in X"}
    assert verdict.causes[0].component == "guideway Y"
    assert set(verdict.causes[0].supported_by) >= {"stiffness X", "straightness Y in X"}
    assert verdict.causes[0].share > 0.9
    assert verdict.causes[0].alike == ()
    assert verdict.cannot_tell == ()


def test_softness_along_an_axis_alone_points_to_its_drive_and_says_what_it_cannot_be_told_from() -> None:
    """Of a circle in one plane the compliances of all carriages along x are one sum (thesis 4.5: C_XXX and C_XXY).

    X's own guideway is among them: a force in x pitches its carriage, and the tool hangs 150 mm below.
    """
    verdict = judged({"C_XXX": 8e-6})
    assert [one.name for one in verdict.changed] == ["stiffness X"]
    named = [cause.component for cause in verdict.causes]
    assert named[0] == "drive X"
    assert {"drive X", "guideway X", "guideway Y"} <= set(verdict.cannot_tell[0])
    assert not {"drive Y", "squareness XY", "spindle side"} & set(named)


def test_a_collision_points_to_squareness() -> None:
    verdict = judged({"E_C(0Y)X": 3e-5})
    assert [one.name for one in verdict.changed] == ["squareness XY"]
    assert verdict.causes[0].component == "squareness XY"
    assert verdict.causes[0].alike == ()


def test_a_gauge_that_reads_too_much_points_to_the_instrument_and_a_soft_holder_to_the_spindle_side() -> None:
    """A gauge scales all compliances alike; a holder adds the same to all: here X and Y differ enough to tell."""
    sick = {name: value * 1.08 if name.startswith("C_") else value for name, value in HEALTHY.items()}
    verdict = judged({name: sick[name] - HEALTHY[name] for name in HEALTHY})
    assert verdict.causes[0].component == "instrument"
    before = indicators_of(healthy())
    softer = tuple(replace(one, value=1 / (1 / one.value + 6e-6)) if one.kind.name == "stiffness" else one for one in before)
    verdict = judge(series(before, softer, 0), baseline())
    assert verdict.causes[0].component == "spindle side"
    assert "workpiece side" in verdict.causes[0].alike, "a bar pushes both apart: the test sees only their sum"


def test_what_the_test_does_not_see_is_said() -> None:
    """A circle in XY neither moves nor loads Z along itself."""
    assert "drive Z" in signatures().unseen
    assert not {"drive X", "guideway Y", "squareness XY"} & set(signatures().unseen)


@pytest.mark.parametrize("name", ["C_XXY", "E_XY2", "C_CCY", "E_C(0Y)X", "C_YYX"])
def test_a_signature_is_what_identifying_the_faulty_machine_shows(name: str) -> None:
    """First-order rows from the design against simulated, identified tests without noise."""
    found = signatures()
    components = {"C_XXY": "guideway Y", "E_XY2": "guideway Y", "C_CCY": "guideway Y", "E_C(0Y)X": "squareness XY"}
    size = {"C_XXY": 5e-6, "C_YYX": 5e-6, "E_XY2": 5e-3 / 300**2, "C_CCY": 5e-6 / 300**2, "E_C(0Y)X": 5e-3 / 300}[name]
    rows = [k for k, c in enumerate(found.components) if c == components.get(name, "guideway X")]
    small = 1e-3 * size
    quiet = [simulate(circle(HEALTHY), {**HEALTHY, name: HEALTHY.get(name, 0.0) + by}, exact=False) for by in (0.0, small)]
    before, after = ([one.value for one in indicators_of(identify(test))] for test in quiet)
    moved = (np.array(after) - np.array(before)) / small * size
    known = indicators_of(healthy())
    scatter = np.array([one.kind.reproducibility * (abs(one.value) if one.kind.relative else 1) for one in known])
    off = [np.abs((found.matrix[k] - moved) / scatter).max() for k in rows]
    best = found.matrix[rows[int(np.argmin(off))]] / scatter
    assert np.abs(best).max() > 1
    assert min(off) < 0.02 * np.abs(best).max()


def test_signatures_are_plain_numbers_that_survive_being_kept() -> None:
    found = signatures()
    assert Signatures.of_document(found.document()) == found
    assert_allclose(found.of(["stiffness X", "of another recipe"])[:, 1], np.nan)


def test_without_signatures_nothing_is_named() -> None:
    made = replace(series(indicators_of(healthy()), indicators_of(healthy()), 0), signatures=None)
    value = made.value.copy()
    value[BASELINE:, 0] *= 0.7
    verdict = judge(replace(made, value=value), baseline())
    assert verdict.state == ALARM
    assert verdict.causes == ()
