"""What a sign means: the same readings say the same of an axis, whether it carries the tool or the workpiece.

The readings come from a chain of its own: two slides whose true positions follow from their commands by the words of the
definitions, and the distance of two balls.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.estimate import solve
from elastogeo.identification import merged, systems_of
from elastogeo.machine import Array, Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Question, Run
from elastogeo.sources import catalogue, exact_response, parameter_values, select_sources

RADIUS, FEED = 150.0, 50.0
ANGLES = np.arange(720) * 2 * np.pi / 720 + 0.002
"""No reading stands on a reversal."""

TOPOLOGIES = ("wFYXt", "wFXYt", "wXFYt", "wYFXt", "wXYFt", "wYXFZt")

SHORT = {"X": 8e-3, "Y": 5e-3}
"""By how much [mm] each axis falls short of its command when it reverses."""
ASIDE = {"X": 2e-3, "Y": -1.5e-3}
"""Each sits by half of that towards - of the other's direction while it moves forth, towards + while it moves back [mm]."""
LAG = {"X": 4e-4, "Y": 1e-4}
"""By what time [s] each lags its command."""
LONG = {"X": 15e-6, "Y": -40e-6}
"""By what share each travels too far."""
CLOSED = 26e-6
"""By how much [rad] the angle between +X and +Y is less than a right one."""
BENT = {"X": 8e-8, "Y": -11e-8}
"""Each axis's path bends towards + of the other's direction by so much [mm] per mm^2 from the middle."""
SPIKE = {"X": 6e-3, "Y": 3e-3}
"""By how much [mm] each is late right after it reversed; it catches up within a tenth of a millimetre."""


def distance_of_the_balls(angle: Array, sense: int) -> Array:
    """Distance [mm] of tool and workpiece ball, where each slide stands by the words above."""
    command = {"X": RADIUS * np.cos(angle), "Y": RADIUS * np.sin(angle)}
    speed = {"X": -sense * FEED * np.sin(angle), "Y": sense * FEED * np.cos(angle)}
    true = {"X": np.zeros(len(angle)), "Y": np.zeros(len(angle))}
    for axis, other in ("XY", "YX"):
        q, forth = command[axis], np.sign(speed[axis])
        since = RADIUS - np.abs(q)
        leaving = forth * q < 0
        late = SPIKE[axis] * np.exp(-since / 0.1) * leaving
        true[axis] += q * (1 + LONG[axis]) - forth * SHORT[axis] / 2 - LAG[axis] * speed[axis] - forth * late
        true[other] += BENT[axis] * q**2 - forth * ASIDE[axis] / 2
    x = true["X"] + np.sin(CLOSED) * command["Y"]
    y = true["Y"]
    return np.asarray(np.hypot(x, y))


def measured(topology: str) -> MachineTest:
    machine = Machine(topology, parse_topology(topology))
    setup = LoadedBallBar(Circle(RADIUS), FEED)
    runs = tuple(
        Run(name, {"angle": ANGLES, "radial": distance_of_the_balls(ANGLES, sense) - RADIUS}, force=0.0, sense=sense)
        for name, sense in (("ccw", 1), ("cw", -1))
    )
    return MachineTest("either branch", machine, setup, runs, Question(("ball-bar-xy",)))


@pytest.fixture(scope="module", params=TOPOLOGIES)
def found(request: pytest.FixtureRequest) -> tuple[str, dict[str, float]]:
    test = measured(request.param)
    asked = replace(test.question, parameters=("ball-bar-xy", "E_R0"))
    names = [s.name for s in select_sources(test.machine, asked.parameters) if s.name not in ("E_R0", "T_Y1")]
    solution = solve(merged(systems_of(replace(test, question=asked)).runs), names)
    return request.param, dict(zip(solution.labels, solution.values, strict=True))


def test_what_falls_short_is_positive_on_either_branch(found: tuple[str, dict[str, float]]) -> None:
    """The linear model is of first order: it agrees with the chain to 1e-3 of what moves the readings."""
    topology, values = found
    assert values["B_XX"] == pytest.approx(SHORT["X"], abs=1e-5), topology
    assert values["B_YY"] == pytest.approx(SHORT["Y"], abs=1e-5), topology
    assert values["B_YX"] == pytest.approx(ASIDE["X"], abs=1e-5), topology
    assert values["B_XY"] == pytest.approx(ASIDE["Y"], abs=1e-5), topology
    assert values["S_XX"] == pytest.approx(SPIKE["X"], abs=5e-5), topology
    assert values["S_YY"] == pytest.approx(SPIKE["Y"], abs=5e-5), topology
    assert values["T_X1"] == pytest.approx(LAG["X"] - LAG["Y"], abs=1e-6), topology


def test_the_sign_says_the_same_of_an_error_motion_on_either_branch(found: tuple[str, dict[str, float]]) -> None:
    """A carriage that holds the workpiece has the opposite error motion for the same fault; its words are the same."""
    topology, values = found
    sources = catalogue(Machine(topology, parse_topology(topology)))
    (squareness,) = (name for name in values if name.startswith("E_C("))
    said = {}
    for name in ("E_XX1", "E_YY1", "E_YX2", "E_XY2", squareness):
        sign = sources[name].sign
        assert sign is not None
        said[sign.kind, "" if sign.kind == "squareness" else sign.axis] = sign.factor * values[name]
    assert said["gain", "X"] == pytest.approx(LONG["X"], abs=2e-7), topology
    assert said["gain", "Y"] == pytest.approx(LONG["Y"], abs=2e-7), topology
    assert said["bow", "X"] == pytest.approx(BENT["X"], abs=1e-9), topology
    assert said["bow", "Y"] == pytest.approx(BENT["Y"], abs=1e-9), topology
    assert said["squareness", ""] == pytest.approx(CLOSED, abs=2e-7), topology


@pytest.mark.parametrize("name", ["B_XX", "B_YX", "S_XX", "T_X1"])
def test_the_chain_of_transforms_moves_the_tool_the_same_way_on_either_branch(name: str) -> None:
    """By the exact products of transforms as well, with other axes between the two."""
    readings = []
    for topology in ("wYFZXt", "wXYFZt"):
        test = measured(topology)
        observed = test.observations()[0]
        readings.append(exact_response(parameter_values(test.machine, {name: 1e-3}), test.machine, observed))
    assert np.ptp(readings[0]) > 1e-5
    np.testing.assert_allclose(*readings, rtol=0, atol=1e-6)
