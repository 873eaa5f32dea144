"""What the workspace goal is about: the compliance at the tool, at poses spread over the volume, in every direction.

At each pose the compliance along X, Y, Z and along the three diagonals between them: six numbers, which are the symmetric
part of the translational compliance there. **A plan for one tool does not promise another, and one with the rotary axes
held does not promise others:** both are in the poses, or they are not planned for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array, Point
from elastogeo.planning.information import Unknowns
from elastogeo.planning.offers.means import Means
from elastogeo.prediction import functionals, virtual_observations

_HALF = np.sqrt(0.5)
DIRECTIONS: Array = np.array(
    [[1, 0, 0], [0, 1, 0], [0, 0, 1], [_HALF, _HALF, 0], [0, _HALF, _HALF], [_HALF, 0, _HALF]], dtype=float
)
"""Along which the compliance is asked for at every pose."""


@dataclass(frozen=True, slots=True, eq=False)
class Workspace:
    """The compliance at the tool as functionals of the parameters.

    Attributes
    ----------
    functionals : array, shape (m, p)
        In scaled parameters: compliance [mm/N] along a direction at a pose.
    commands : array, shape (m, n) [mm, rad]
        The pose of each.
    direction : array, shape (m, 3)
    tool : array, shape (m,) of int
        Which of the tools each is of.
    """

    functionals: Array
    commands: Array
    direction: Array
    tool: np.ndarray[tuple[int], np.dtype[np.intp]]


def workspace(means: Means, asked: Unknowns, poses: int, seed: int) -> Workspace:
    """The workspace at random poses in the travel, for every tool.

    Parameters
    ----------
    means : Means
        Rotary axes are held at zero where it says so.
    asked : Unknowns
    poses : int
        Of each tool. Every other one stands in a corner of the travel, where the levers are longest; all corners in turn.
    seed : int
    """
    random = np.random.default_rng(seed)
    parts = [_of_tool(means, asked, poses, tool, random) for tool in means.tool_points]
    rows, commands, direction = (np.concatenate(part) for part in zip(*parts, strict=True))
    return Workspace(rows, commands, direction, np.repeat(np.arange(len(parts)), len(parts[0][0])))


def _of_tool(
    means: Means, asked: Unknowns, poses: int, tool: Point, random: np.random.Generator
) -> tuple[Array, Array, Array]:
    commands = np.zeros((poses, len(means.machine.axes)))
    for k, row in enumerate(commands):
        place = means.somewhere(random)
        if k % 2:
            place = {axis: means.travel(axis)[k >> (bit + 1) & 1] for bit, axis in enumerate(place)}
        for axis, value in (place | (means.turned(random) if means.rotary else {})).items():
            row[means.machine.index(axis)] = value
    commands = np.repeat(commands, len(DIRECTIONS), axis=0)
    direction = np.tile(DIRECTIONS, (poses, 1))
    along = np.hstack([direction, np.zeros_like(direction)])
    seen = virtual_observations(means.machine, commands, along, along, np.array(tool))
    return functionals(asked.sources, means.machine, seen) * asked.scales, commands, direction
