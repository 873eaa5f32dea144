"""From the sensors of a nest to the three deviations of the ball, measured and predicted, over the rotary axes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.identification.result import Identification, Trace
from elastogeo.machine import Array
from elastogeo.observe import Observations

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


def ball_deviations(result: Identification) -> tuple[BallDeviations, ...]:
    """The deviations of every run of a test with a sphere nest.

    Raises
    ------
    UnsupportedError
        If the instrument is no nest, or the directions of its sensors lie in one plane.
    """
    test = result.test
    if test.setup.extra != "ball-deviations":
        raise UnsupportedError(f"test {test.name!r} is made with {test.instrument}; deviations of a ball take a sphere-nest")
    observed = {run.run: run for run in test.observations()}
    rotary = [joint.name for joint in test.machine.joints if joint.is_rotary]
    places = [(axis, test.machine.index(axis)) for axis in rotary]
    return tuple(_of_run(trace, observed[trace.run], places, test.name) for trace in result.traces)


def _of_run(trace: Trace, observed: Observations, places: list[tuple[str, int]], test: str) -> BallDeviations:
    count = int(np.sum(observed.pose == observed.pose[0]))
    directions = observed.direction[:, :3].reshape(count, -1, 3).swapaxes(0, 1)
    if float(np.linalg.svd(directions[0], compute_uv=False)[-1]) < SEEN or count < 3:
        raise UnsupportedError(
            f"test {test!r}: the directions of its {count} sensors lie in one plane, so that they do not show the three "
            f"deviations of the ball"
        )
    inverse = np.linalg.pinv(directions)
    commands = observed.commands[: len(directions)]
    moving = {axis: commands[:, k] for axis, k in places if np.ptp(commands[:, k]) > 0}
    measured, predicted = (
        np.einsum("mij,jm->mi", inverse, values.reshape(count, -1)) for values in (trace.measured, trace.predicted)
    )
    return BallDeviations(trace.run, trace.force, moving, measured, predicted)
