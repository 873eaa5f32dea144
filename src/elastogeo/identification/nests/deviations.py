"""From the sensors of a nest to the three deviations of the ball, measured and predicted, over the rotary axes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.identification.result import Identification, Trace
from elastogeo.machine import Array
from elastogeo.observe import MachineTest, Observations

SEEN = 1e-6
"""Sensors whose directions are closer than this to a plane do not show the three deviations."""


@dataclass(frozen=True, slots=True, eq=False)
class BallDeviations:
    """Deviations of the tool point from the workpiece ball in one run, along X, Y, Z of the foundation.

    Attributes
    ----------
    run : str
    force : float [N]
    rotary : mapping of str to array, shape (m,) [rad]
        Commands of the rotary axes that move in the run.
    measured, predicted : array, shape (m, 3) [mm]
        With more than three sensors, by least squares.
    """

    run: str
    force: float
    rotary: Mapping[str, Array]
    measured: Array
    predicted: Array


def shows_deviations(test: MachineTest) -> bool:
    """Whether a test is made with a nest whose sensors show all three deviations of the ball."""
    if test.setup.extra != "ball-deviations":
        return False
    directions = _directions(test.setup.observe(test.machine, test.runs[0]))[0]
    return len(directions) >= 3 and bool(np.linalg.svd(directions, compute_uv=False)[-1] > SEEN)


def ball_deviations(result: Identification) -> tuple[BallDeviations, ...]:
    """The deviations of every run of a test with a sphere nest.

    Raises
    ------
    UnsupportedError
        If the instrument is no nest, or the directions of its sensors lie in one plane.
    """
    test = result.test
    if not shows_deviations(test):
        raise UnsupportedError(
            f"test {test.name!r} ({test.instrument}) does not show the three deviations of a ball: that takes a sphere-nest "
            f"with three sensors whose directions do not lie in one plane"
        )
    observed = {run.run: run for run in test.observations()}
    rotary = [joint.name for joint in test.machine.joints if joint.is_rotary]
    places = [(axis, test.machine.index(axis)) for axis in rotary]
    return tuple(_of_run(trace, observed[trace.run], places) for trace in result.traces)


def _of_run(trace: Trace, observed: Observations, places: list[tuple[str, int]]) -> BallDeviations:
    directions = _directions(observed)
    count = directions.shape[1]
    inverse = np.linalg.pinv(directions)
    commands = observed.commands[: len(directions)]
    moving = {axis: commands[:, k] for axis, k in places if np.ptp(commands[:, k]) > 0}
    measured, predicted = (
        np.einsum("mij,jm->mi", inverse, values.reshape(count, -1)) for values in (trace.measured, trace.predicted)
    )
    return BallDeviations(trace.run, trace.force, moving, measured, predicted)


def _directions(observed: Observations) -> Array:
    """Of every sensor at every pose, shape (m, sensors, 3); the readings come sensor after sensor."""
    sensors = int(np.sum(observed.pose == observed.pose[0]))
    return np.asarray(observed.direction[:, :3].reshape(sensors, -1, 3).swapaxes(0, 1))
