"""Deflection against force in every direction of a ball-roller test: one point a run and direction.

A run goes around the ball, so its force and its deflection are functions of the direction. Their trigonometric polynomials
through the nodes are taken by least squares, and their values at the nodes are the points of 24 curves. What is uncertain
in drives and set-up moves the points of all runs together (`Change`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from elastogeo.errors import UnsupportedError
from elastogeo.identification.levels import force_levels
from elastogeo.machine import Array
from elastogeo.observe import Observations
from elastogeo.sources import NODES, direction_weights

WORST_CONDITION = 1e4
"""Of the polynomial on the samples of a run: beyond it a gap in the turn is so wide that it would be made up."""


@dataclass(frozen=True, slots=True, eq=False)
class Change:
    """How one uncertain quantity, common to all runs, moves the points: by one standard uncertainty of it.

    Attributes
    ----------
    label : str
    degrees_of_freedom : float
    force : array, shape (r, k) [N]
    reading : array, shape (r, k) [mm]
    """

    label: str
    degrees_of_freedom: float
    force: Array
    reading: Array


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """The points of r runs in k directions.

    Attributes
    ----------
    angle : array, shape (k,) [rad]
        In the plane of the test.
    levels : tuple of float [N]
        Mean force of every engagement, increasing.
    level : array of int, shape (r,)
        Of every run.
    force, reading : array, shape (r, k) [N, mm]
        The reading is the machine's deflection and what its path is off.
    changes : tuple of Change
    """

    angle: Array
    levels: tuple[float, ...]
    level: Array
    force: Array
    reading: Array
    changes: tuple[Change, ...]

    def mean(self, values: Array) -> Array:
        """Mean of points over the runs of each level, shape (levels, k)."""
        return np.array([values[self.level == n].mean(axis=0) for n in range(len(self.levels))])


def curves_of(observations: Sequence[Observations]) -> Curves:
    """The curves of a test.

    Parameters
    ----------
    observations : sequence of Observations
        Of the runs with an engagement.

    Raises
    ------
    UnsupportedError
        If a run does not go around the ball, or all runs have one engagement.
    """
    levels = force_levels(run.force for run in observations)
    if len(levels.forces) < 2:
        raise UnsupportedError(
            f"all runs with an engagement are at {levels.forces[0]:.0f} N: compliance and path are not "
            f"distinguished in any of "
            f"{len(NODES)} directions; it takes two engagements all around the ball"
        )
    at = [_at_nodes(run) for run in observations]
    force, reading = [], []
    for run, nodes in zip(observations, at, strict=True):
        force.append(nodes(np.linalg.norm(run.wrench[:, :3], axis=1)))
        reading.append(nodes(run.reading))
    changes = []
    for several in zip(*(run.influences for run in observations), strict=True):
        size = several[0].standard_uncertainty
        along = [
            np.sum(one.wrench[:, :3] * run.direction[:, :3], axis=1) for one, run in zip(several, observations, strict=True)
        ]
        changes.append(
            Change(
                several[0].label,
                several[0].degrees_of_freedom,
                size * np.array([nodes(values) for nodes, values in zip(at, along, strict=True)]),
                size * np.array([nodes(one.reading) for nodes, one in zip(at, several, strict=True)]),
            )
        )
    of = [levels.forces.index(levels.level(run.force)) for run in observations]
    return Curves(np.deg2rad(NODES), levels.forces, np.array(of), np.array(force), np.array(reading), tuple(changes))


def _at_nodes(run: Observations) -> Callable[[Array], Array]:
    """From values along a run to those of their polynomial at the nodes."""
    weights = direction_weights(run.pose)
    Q, R = np.linalg.qr(weights)
    if len(weights) < len(NODES) or np.linalg.cond(R) > WORST_CONDITION:
        raise UnsupportedError(
            f"run {run.run!r} does not go around the ball: its samples do not determine the force in {len(NODES)} "
            f"directions; it takes two engagements all around the ball"
        )
    return lambda values: solve_triangular(R, Q.T @ values)
