"""What every instrument says of itself, and the ordinary ball bar."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from elastogeo.drive import FeedDrive
from elastogeo.errors import FormatError, InputError
from elastogeo.formats.text.toml_documents import build
from elastogeo.identification import diagnose, identify
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import (
    BallBar,
    BallRoller,
    Circle,
    DisplacementProbes,
    Imperfection,
    LoadedBallBar,
    MachineTest,
    Question,
    Run,
    Sensor,
    SensorFrame,
    Setup,
    StaticForce,
    instruments,
)
from elastogeo.sources import simulate

CIRCLE = Circle(150.0, "ZX", {"X": 10.0, "C": 0.5})
SETUPS: dict[str, Setup] = {
    "ball-bar": BallBar(CIRCLE, 25.0),
    "loaded-ball-bar": LoadedBallBar(CIRCLE, 25.0),
    "ball-roller": BallRoller(CIRCLE, 25.0, (FeedDrive("X", torque_constant=1e3, pitch=10.0),)),
    "static-force": StaticForce((0.0, 0.0, -1.0)),
    "displacement-probes": DisplacementProbes(((1.0, 0.0, 0.0),), (1.0, 0.0, 0.0)),
    "sensor-frame": SensorFrame((Sensor((0.0, 0.0, 50.0), (1.0, 0.0, 0.0)),), (1.0, 0.0, 0.0)),
}
TURN = np.arange(360) * 2 * np.pi / 360


@pytest.mark.parametrize("name", SETUPS)
def test_an_instrument_says_what_a_report_needs(name: str) -> None:
    setup = SETUPS[name]
    assert instruments()[name] is type(setup)
    test = MachineTest("t", Machine("m", parse_topology("wFXYZCt")), setup, (Run("r", {}),))
    assert test.instrument == name
    facts = {fact.name: (fact.value, fact.unit) for fact in setup.facts()}
    assert len(facts) == len(setup.facts()) > 0
    circular = name in ("ball-bar", "loaded-ball-bar", "ball-roller")
    assert setup.nominal_radius == (150.0 if circular else None)
    if circular:
        assert facts["plane"] == ("ZX", "")
        assert facts["radius"] == (150.0, "mm")
        assert facts["feed"] == (25.0, "mm_s")
        assert facts["centre"] == ({"X": 10.0, "C": 0.5}, "mm|rad")
    assert setup.loads is (name != "ball-bar")
    assert setup.limits
    assert setup.extra


def test_what_an_instrument_says_of_itself_is_no_key_of_a_test_file() -> None:
    with pytest.raises(FormatError, match="extra is not known"):
        build(BallBar, {"feed_mm_s": 20, "circle": {"radius_mm": 150}, "extra": "twist"}, "f")


def both_ways(setup: Setup, force: float | None) -> MachineTest:
    machine = Machine("m", parse_topology("wYXFZt"))
    runs = tuple(
        Run(f"{way}-{k}", {"angle": TURN + 0.002, "radial": np.zeros(360)}, force=force, sense=sense, repeat=k)
        for way, sense in (("ccw", 1), ("cw", -1))
        for k in (1, 2, 3)
    )
    return MachineTest("ball bar", machine, setup, runs, Question(("ball-bar-xy",)))


TRUTH = {"B_XX": 6e-3, "E_XX1": 2e-5, "E_C(0X)Y": 3e-5, "T_X1": 3e-4}


def test_an_ordinary_ball_bar_is_a_loaded_one_without_its_load() -> None:
    bar, loaded = BallBar(Circle(150.0), 50.0), LoadedBallBar(Circle(150.0), 50.0)
    one = simulate(both_ways(bar, None), TRUTH, Imperfection(noise=1e-4), seed=1)
    other = simulate(both_ways(loaded, 0.0), TRUTH, Imperfection(noise=1e-4), seed=1)
    for run, same in zip(one.runs, other.runs, strict=True):
        assert run.force is None
        assert_array_equal(run.columns["radial"], same.columns["radial"])
    for seen in one.observations():
        assert seen.force == 0.0
        assert not seen.wrench.any()
    found = diagnose(identify(one))
    assert {fault.names[0] for fault in found.faults[:4]} >= {"B_XX"}
    assert found.circularity[0.0].g_ccw is not None


def test_an_ordinary_ball_bar_states_no_force() -> None:
    test = both_ways(BallBar(Circle(150.0), 50.0), None)
    for stated, said in (({"force": -36.0}, "-36 N"), ({"pressure": 1.0}, "1 bar")):
        wrong = replace(test, runs=(replace(test.runs[0], **stated),))
        with pytest.raises(InputError, match=f"run 'ccw-1' states {said}, and a ball-bar pushes nothing; write instrument"):
            wrong.observations()
