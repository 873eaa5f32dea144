"""Tests as a plan sees them: at a few poses, the same for all runs of a test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from elastogeo.machine import Array
from elastogeo.observe import MachineTest, Observations

_TURN = 2 * np.pi

PLANNED_READINGS = 36
"""Of a turn, where a planned test has more of its own."""


def at_the_same_poses(test: MachineTest) -> tuple[Observations, ...]:
    """The observations of a planned test: as they are where all runs stand at the same poses, else as those of one made."""
    observed = test.observations()
    first = observed[0].commands
    if all(run.commands.shape == first.shape and np.array_equal(run.commands, first) for run in observed[1:]):
        return observed
    return at_planned_poses(test, PLANNED_READINGS) if test.setup.pose_quantity == "angle" else observed


def at_planned_poses(test: MachineTest, readings: int) -> tuple[Observations, ...]:
    """The observations of a test that was made, no denser than those of a planned one.

    Runs around a circle are taken at evenly spaced angles that all of them reach, each with the poses of the first run:
    their angles differ by chance, and what is the same at a pose must be seen to be.

    Parameters
    ----------
    test : MachineTest
    readings : int
        Of a full turn.
    """
    observed = test.observations()
    if test.setup.pose_quantity != "angle":
        return tuple(run.at(_every(len(run), readings)) for run in observed)
    step = _TURN / readings
    nearest = [_nearest(run.pose, readings) for run in observed]
    reached = np.all([apart <= step for _, apart in nearest], axis=0)
    first = observed[0].at(nearest[0][0][reached])
    return tuple(_with_loads_of(first, run, at[reached]) for run, (at, _) in zip(observed, nearest, strict=True))


def _every(count: int, readings: int) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Evenly chosen numbers of so many readings at most."""
    return np.unique(np.linspace(0, count - 1, min(count, readings)).round().astype(np.intp))


def _nearest(angle: Array, readings: int) -> tuple[np.ndarray[tuple[int], np.dtype[np.intp]], Array]:
    """The reading nearest to each of evenly spaced angles of a turn, and how far it is from it [rad]."""
    wanted = np.arange(readings) * (_TURN / readings)
    apart = np.abs((angle[np.newaxis] - wanted[:, np.newaxis] + np.pi) % _TURN - np.pi)
    at = apart.argmin(axis=1)
    return at, apart[np.arange(readings), at]


def _with_loads_of(
    first: Observations, run: Observations, at: Sequence[int] | np.ndarray[tuple[int], np.dtype[np.intp]]
) -> Observations:
    """The first run's poses with the force of another run, along the first run's directions."""
    size = np.linalg.norm(run.wrench[at, :3], axis=1)
    push = np.sign(np.sum(run.wrench[at, :3] * run.direction[at, :3], axis=1))
    return replace(
        first, run=run.run, force=run.force, wrench=np.asfortranarray((push * size)[:, np.newaxis] * first.direction)
    )
