"""A probe across one joint: what no test between tool and workpiece tells from its neighbours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from elastogeo.machine import Array, Point
from elastogeo.observe import JointProbe, MachineTest, Question, Run
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import MINUTES_BETWEEN_RUNS, MINUTES_OF_SET_UP, Means
from elastogeo.planning.offers.proposal import Draft, proposes

AXES: tuple[Point, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

PLACES = 3
"""Of the tool, at which the forces act: a compliance for a force is told from that for a moment by the lever."""

_BESIDE = 100.0
"""How far from the origin of the carriage's frame a probe touches that is to see rotations [mm]."""


@proposes("joint-probe")
def probes_across_joints(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """A probe across each joint along each axis of its carriage at its origin; then at random points beside it too."""
    joints = [joint.name for joint in means.machine.compliant]
    for joint in joints:
        for sensor in AXES:
            yield across(means, random, joint, sensor)
    while True:
        joint, sensor = joints[random.integers(len(joints))], AXES[random.integers(3)]
        x, y, z = (float(part) for part in random.uniform(-_BESIDE, _BESIDE, 3))
        yield across(means, random, joint, sensor, (x, y, z))


def across(
    means: Means, random: np.random.Generator, joint: str, sensor: Point, point: Point = (0.0, 0.0, 0.0)
) -> Candidate:
    """The candidate of a probe across a joint: forces along three axes at several places of the tool, at every level."""
    tool = means.tool_points[random.integers(len(means.tool_points))]
    setup = JointProbe(across=(joint,), sensor=sensor, point=point, tool=tool)
    places = [means.somewhere(random) for _ in range(PLACES)]
    runs = tuple(_run(f"along {name}", k, means.forces, places) for k, name in enumerate("xyz"))
    test = MachineTest("across", means.machine, setup, runs, Question(("compliance",)))
    loads = len(runs) * PLACES * len(means.forces)
    return Candidate(f"across_{joint}", test, MINUTES_OF_SET_UP + loads * MINUTES_BETWEEN_RUNS)


def _run(name: str, axis: int, forces: Sequence[float], places: Sequence[dict[str, float]]) -> Run:
    """Every force level at every place."""
    levels = np.tile(np.array(forces), len(places))
    none = np.zeros(len(levels))
    load = {f"force_{letter}": levels if k == axis else none for k, letter in enumerate("xyz")}
    at: dict[str, Array] = {
        linear.lower(): np.repeat([place[linear] for place in places], len(forces)) for linear in places[0]
    }
    return Run(name, {**load, **at, "displacement": none}, force=max(forces, key=abs))
