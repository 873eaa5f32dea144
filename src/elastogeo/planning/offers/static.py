"""Loads at a standstill: a force and one sensor, a force and three probes, a frame of sensors, anywhere in the volume."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from elastogeo.machine import Array, Point
from elastogeo.observe import DisplacementProbes, MachineTest, Question, Run, Sensor, SensorFrame, Setup, StaticForce
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import MINUTES_BETWEEN_RUNS, MINUTES_OF_SET_UP, Means
from elastogeo.planning.offers.proposal import Draft, proposes

AXES: tuple[Point, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

SENSORS = (
    Sensor((60.0, -40.0, 30.0), AXES[0]),
    Sensor((60.0, 40.0, 30.0), AXES[0]),
    Sensor((60.0, 0.0, -50.0), AXES[0]),
    Sensor((-40.0, 60.0, 20.0), AXES[1]),
    Sensor((40.0, 60.0, 30.0), AXES[1]),
    Sensor((-45.0, -30.0, 90.0), AXES[2]),
    Sensor((40.0, -35.0, 90.0), AXES[2]),
    Sensor((0.0, 50.0, 90.0), AXES[2]),
)
"""A frame that sees all six components of the twist."""

_LEVER = 80.0
"""Within which a force acts beside the tool point of a frame [mm]."""


@proposes("static-force")
def forces_and_a_sensor(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """A force in a random direction, read along it or across it."""
    while True:
        tool, pose = _tool(means, random), _pose(means, random)
        force = _unit(random)
        sensor = force if random.random() < 1 / 2 else _unit(random)
        setup = StaticForce(direction=force, sensor=sensor, pose=pose, tool=tool)
        load = {"force": np.array(means.forces)}
        yield _standing(means, "static", setup, {"loads": load | _blank(("displacement",), means)})


@proposes("displacement-probes")
def forces_and_probes(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """Three forces one after the other at one pose, each read by three probes."""
    while True:
        tool, pose = _tool(means, random), _pose(means, random)
        setup = DisplacementProbes(probes=AXES, centre=pose, bar_in_workpiece=False, probes_in_workpiece=False, tool=tool)
        blank = {"angle": np.zeros(len(means.forces))} | _blank(setup.readings, means)
        yield _standing(means, "probes", setup, {f"along {a}": _along(k, means) | blank for k, a in enumerate("xyz")})


@proposes("sensor-frame")
def forces_and_a_frame(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """Three forces one after the other beside the tool point, each read by a frame of sensors."""
    while True:
        tool, pose = _tool(means, random), _pose(means, random)
        x, y, z = (float(part) for part in random.uniform(-_LEVER, _LEVER, 3))
        setup = SensorFrame(sensors=SENSORS, pose=pose, lever=(x, y, z), tool=tool)
        blank = _blank(setup.readings, means)
        yield _standing(means, "frame", setup, {f"along {a}": _along(k, means) | blank for k, a in enumerate("xyz")})


def _standing(means: Means, word: str, setup: Setup, loads: Mapping[str, Mapping[str, Array]]) -> Draft:
    """The candidate of loads at one pose; None if the spindle would stand below the table."""
    runs = tuple(Run(name, columns, force=max(means.forces, key=abs)) for name, columns in loads.items())
    test = MachineTest(word, means.machine, setup, runs, Question(("compliance",)))
    if not means.clearance.stands(means.machine, test.setup.observe(means.machine, runs[0]).commands[:1]).all():
        return None
    return Candidate(word, test, MINUTES_OF_SET_UP + len(runs) * len(means.forces) * MINUTES_BETWEEN_RUNS)


def _along(axis: int, means: Means) -> dict[str, Array]:
    """Columns of a force along one axis at every level."""
    none = np.zeros(len(means.forces))
    return {f"force_{name}": np.array(means.forces) if k == axis else none for k, name in enumerate("xyz")}


def _blank(names: tuple[str, ...], means: Means) -> dict[str, Array]:
    return dict.fromkeys(names, np.zeros(len(means.forces)))


def _tool(means: Means, random: np.random.Generator) -> Point:
    return means.tool_points[random.integers(len(means.tool_points))]


def _pose(means: Means, random: np.random.Generator) -> dict[str, float]:
    return means.somewhere(random) | (means.turned(random) if means.rotary else {})


def _unit(random: np.random.Generator) -> Point:
    x, y, z = random.standard_normal(3)
    length = float(np.sqrt(x * x + y * y + z * z))
    return float(x) / length, float(y) / length, float(z) / length
