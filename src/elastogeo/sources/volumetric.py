"""The machine as one spring and one path by direction, whatever its joints: `V_045`, `G_045`.

Volumetric compliance of a circular test (Eq. 6.4): in the direction 45 degrees of the test's plane the tool gives way by
`V_045` along the force per force; `G_045` is what the path is off there without any. Between the nodes both are the
trigonometric polynomial through them, which joint compliances and error motions of low degree follow exactly.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source

NODES = tuple(range(0, 360, 15))
"""Directions [deg] that have parameters of their own."""

_AT_NODE = 1e-12


@dataclass(frozen=True, slots=True)
class InDirection:
    """Driver: 1 in a direction, 0 in those of the other nodes; times the force if a force drives it."""

    angle: float
    loaded: bool

    def __call__(self, situation: Situation) -> Array:
        """Values at every reading, shape (m,)."""
        weight = _weight(situation.observations.pose - self.angle)
        return weight * situation.force() if self.loaded else weight


def direction_weights(angle: Array) -> Array:
    """What the value of each node counts at angles, shape (m, nodes): the trigonometric polynomial through the nodes.

    Parameters
    ----------
    angle : array, shape (m,) [rad]
    """
    return _weight(angle[:, np.newaxis] - np.deg2rad(NODES))


def _weight(apart: Array) -> Array:
    half = apart / 2
    at_node = np.abs(np.sin(half)) < _AT_NODE
    kernel = np.sin(len(NODES) * half) / (len(NODES) * np.tan(np.where(at_node, 1.0, half)))
    return np.where(at_node, 1.0, kernel)


@family
def volumetric_map(_: Machine) -> Iterator[Source]:
    """Compliance and deviation of the path in every direction of a circular test."""
    for degrees in NODES:
        angle = float(np.deg2rad(degrees))
        where = f"in the direction {degrees} degrees of the test's plane"
        yield Source(
            name=f"V_{degrees:03d}",
            unit="mm/N",
            site=("reading", ""),
            component=0,
            driver=InDirection(angle, loaded=True),
            meaning=f"volumetric compliance {where}",
            load=0,
            force_degree=1.0,
        )
        yield Source(
            name=f"G_{degrees:03d}",
            unit="mm",
            site=("reading", ""),
            component=0,
            driver=InDirection(angle, loaded=False),
            meaning=f"deviation of the path {where}",
        )
