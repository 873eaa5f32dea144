"""What is watched: against the physics that the readings were simulated from, and never one of a sum."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.changes import KINDS, indicators_of
from elastogeo.changes.indicators import watched
from elastogeo.changes.series import MOST
from elastogeo.errors import UnsupportedError
from elastogeo.identification import Identification, diagnose, identify
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import BallBar, Calibration, Circle, Imperfection, LoadedBallBar, MachineTest, Question, Run
from elastogeo.result import Result
from elastogeo.sources import simulate
from tests.conftest import follow_recipe

RADIUS = 150.0
TRUTH = {
    "C_XXX": 5e-5,
    "C_YYY": 4e-5,
    "C_CCY": 1e-10,
    "E_XX1": 4e-5,
    "E_YY1": -1e-5,
    "E_YX2": 2e-7,
    "E_XY2": -1e-7,
    "E_C(0Y)X": 3e-5,
}


def loaded(truth: dict[str, float], forces: tuple[float, ...] = (100.0, 400.0, 700.0), noise: float = 1e-6) -> MachineTest:
    """A loaded circle in XY on wFYXt, the ball at the X carriage's origin as in thesis 4, two runs a force."""
    angle = 2 * np.pi * np.arange(90) / 90
    columns = {"angle": angle, "radial": np.zeros(90)}
    runs = tuple(Run(f"{force:g} N, {k}", columns, force=force, repeat=k) for force in forces for k in (1, 2))
    machine = Machine("wFYXt", parse_topology("wFYXt"))
    blank = MachineTest("circle", machine, LoadedBallBar(Circle(RADIUS), feed=30.0), runs)
    return simulate(blank, truth, Imperfection(noise=noise), 1, exact=False)


@pytest.fixture(scope="module")
def identified() -> Identification:
    return identify(loaded(TRUTH))


def test_a_loaded_circle_tells_stiffness_squareness_scale_and_straightness(identified: Identification) -> None:
    """By the model: a force at the centre deflects by C_XXX; at the ends of X its moment turns the Y carriage by C_CCY."""
    found = {one.name: one for one in indicators_of(identified)}
    expected = {
        "stiffness X": 1 / TRUTH["C_XXX"],
        "stiffness Y": 1 / TRUTH["C_YYY"],
        "squareness XY": TRUTH["E_C(0Y)X"],  # a positive rotation of X about z makes the angle from +X to +Y smaller
        "scale difference XY": TRUTH["E_XX1"] - TRUTH["E_YY1"],
        "straightness X in Y": TRUTH["E_YX2"] * RADIUS**2,
        "straightness Y in X": TRUTH["E_XY2"] * RADIUS**2,
        "stiffness Y at the ends of X": 1 / (TRUTH["C_YYY"] + TRUTH["C_CCY"] * RADIUS**2),
    }
    assert list(found) == list(expected)
    for name, value in expected.items():
        assert abs(found[name].value - value) < 3e-3 * abs(value), name
        assert 0 < found[name].standard_uncertainty < 1e-2 * abs(value), name
    assert found["stiffness X"].kind is KINDS["stiffness"]


def test_a_bar_of_another_length_moves_no_indicator(identified: Identification) -> None:
    """A length error is in both scales alike (thesis 5.1): the scale of one axis would be an alarm on the bar."""
    of_length = {**TRUTH, "E_XX1": TRUTH["E_XX1"] + 1e-4, "E_YY1": TRUTH["E_YY1"] + 1e-4}
    for before, after in zip(indicators_of(identified), indicators_of(identify(loaded(of_length))), strict=True):
        assert_allclose(after.value, before.value, rtol=1e-9, atol=1e-12)


def test_what_a_test_does_not_determine_by_itself_is_left_out() -> None:
    """One force level leaves compliance and geometry in one sum; no motion in Z says nothing of Z."""
    one_level = identify(loaded(TRUTH, forces=(400.0,)))
    assert indicators_of(one_level) == ()
    assert not [one for one in indicators_of(identify(loaded(TRUTH))) if "Z" in one.name]


def test_a_systematic_influence_widens_no_limit(identified: Identification) -> None:
    """The gauge's uncertainty is in the parameters; between tests with the same gauge nothing scatters by it."""
    test = loaded(TRUTH)
    gauge = Calibration((1.0, 7.0), (100.0, 700.0), relative=0.02)
    runs = tuple(replace(run, force=None, pressure=float(run.force or 0.0) / 100) for run in test.runs)
    result = identify(replace(test, setup=replace(test.setup, calibration=gauge), runs=runs))
    assert result["C_XXX"].standard_uncertainty == pytest.approx(0.02 * TRUTH["C_XXX"], rel=0.05)
    for one, other in zip(indicators_of(identified), indicators_of(result), strict=True):
        assert_allclose(
            [other.value, other.standard_uncertainty], [one.value, one.standard_uncertainty], rtol=1e-6, atol=1e-12
        )


def test_an_unloaded_circle_tells_its_backlash_by_its_sign() -> None:
    angle = 2 * np.pi * np.arange(180) / 180
    runs = tuple(
        Run(f"{sense}, {k}", {"angle": sense * angle, "radial": np.zeros(180)}, sense=sense, repeat=k)
        for sense in (1, -1)
        for k in (1, 2)
    )
    machine = Machine("wFYXt", parse_topology("wFYXt"))
    asked = Question(("E_XX1", "E_YY1", "E_C(0Y)X", "B_XX", "B_YY"))
    blank = MachineTest("bar", machine, BallBar(Circle(RADIUS), feed=30.0), runs, asked)
    truth = {"E_C(0Y)X": -2e-5, "B_XX": 6e-3, "B_YY": 2e-3}
    result = diagnose(simulate(blank, truth, Imperfection(noise=1e-6), 2, exact=False))
    found = {one.name: one.value for one in indicators_of(result)}
    assert list(found) == ["circular deviation", "squareness XY", "backlash X", "backlash Y", "scale difference XY"]
    assert_allclose(found["squareness XY"], -2e-5, rtol=1e-2)
    assert_allclose([found["backlash X"], found["backlash Y"]], [6e-3, 2e-3], rtol=1e-2)
    assert found["circular deviation"] == next(iter(result.circularity.values())).g_bidirectional


def test_every_kind_of_result_gives_few_indicators_of_known_kinds() -> None:
    assert len(watched()) >= 6
    assert all(issubclass(kind, Result) for kind in watched())
    assert MOST == 8


def test_the_recipe_of_the_register_works_as_it_stands() -> None:
    follow_recipe("elastogeo.changes.indicators.register", "recipe_run_out")
    found = indicators_of(sys.modules["recipe_run_out"].RunOut(0.004, 0.001))
    assert [(one.name, one.value, one.standard_uncertainty) for one in found] == [("run-out of the spindle", 0.004, 0.001)]


def test_another_result_is_refused_by_its_name() -> None:
    class Surprise(Result):
        pass

    with pytest.raises(UnsupportedError, match=r"nothing is watched of Surprise; a history takes Diagnosis, .*write a file"):
        indicators_of(Surprise())
