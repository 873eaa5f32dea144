"""How far the tool is off along a path, in pieces: what a path asks of the parameters, and what is known of that.

Each point asks for four readings that no instrument takes: the displacement of the tool relative to the workpiece along the
three axes of the workpiece, and along the normal of the path. They are rows of the same design as every test's (Eq. 4.13).
The memory does not grow with the path: a piece of it is worked on at a time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from elastogeo.machine import Array, Cut, Frame, LoopFrames, ToolPath, loop_frames
from elastogeo.observe import Observations
from elastogeo.prediction.knowledge import Flags, Knowledge, Predicted
from elastogeo.prediction.paths.along import Rows, predicted_along
from elastogeo.prediction.virtual import virtual_observations

PIECE = 4096
"""Points of a path that are worked on at a time."""

DEVIATION_COMPONENTS = ("x", "y", "z", "normal")
"""Along the axes of the workpiece, and along the normal of the path."""

GEOMETRY, COMPLIANCE, TOOL_SIDE, WORKPIECE_SIDE = "geometry", "compliance", "spindle side", "workpiece side"
PARTS = (GEOMETRY, COMPLIANCE, TOOL_SIDE, WORKPIECE_SIDE)
"""Geometry and compliance are all of the machine; so are spindle side and workpiece side: two ways to split one sum."""


class Moved(Protocol):
    """A motion of the workpiece that follows from the parameters."""

    def at(self, points: Array) -> Array:
        """How far points move, shape (3, k, p), per unit of each parameter."""


@dataclass(frozen=True)
class Piece:
    """A piece of a path, with all that the machine sees of it.

    Attributes
    ----------
    path : ToolPath
    cut : Cut
    part : slice, or array of int
        Which points, k of them.
    """

    path: ToolPath
    cut: Cut
    part: slice | Rows
    frames: LoopFrames = field(init=False)

    def __post_init__(self) -> None:
        """Place the frames."""
        frames = loop_frames(self.path.machine, self.path.commands[self.part], self.path.tool)
        object.__setattr__(self, "frames", frames)

    def __len__(self) -> int:
        return len(self.path.block[self.part])

    @cached_property
    def rotation(self) -> Array:
        """From the axes of the workpiece to the foundation, shape (k, 3, 3)."""
        return np.asarray(np.broadcast_to(self.frames.workpiece.rotation, (len(self), 3, 3)))

    @cached_property
    def wrench(self) -> Array:
        """On the tool, along the axes of the workpiece, shape (k, 6) [N, N mm]."""
        if self.cut.force is None:
            return np.zeros((len(self), 6))
        return self.cut.force.on_tool(self.path, self.part, self.frames.workpiece)

    @cached_property
    def normal(self) -> Array:
        """Unit normals, shape (k, 3), along the axes of the workpiece; NaN where the path has none, zero below."""
        left = self.path.left[self.part]
        return left if self.cut.normal_to == "left" else -left

    def with_normal(self, along: Array) -> Array:
        """A vector along the axes of the workpiece, shape (k, 3), with its component along the normal, shape (k, 4)."""
        return np.column_stack([along, np.einsum("ki,ki->k", np.nan_to_num(self.normal), along)])

    def tool_deflection(self) -> Array:
        """What tool and holder give, shape (k, 4) [mm]."""
        if self.cut.tool is None:
            return np.zeros((len(self), len(DEVIATION_COMPONENTS)))
        workpiece, tool = self.frames.workpiece, self.frames.tool

        def carried(vector: Array, towards: Frame, away: Frame) -> Array:
            return towards.components(away.vector(vector))

        load = np.hstack([carried(part, tool, workpiece) for part in (self.wrench[:, :3], self.wrench[:, 3:])])
        moved = (self.cut.tool.matrix @ load.T).T[:, :3]
        return self.with_normal(np.broadcast_to(carried(moved, workpiece, tool), (len(self), 3)))

    def observations(self) -> Observations:
        """Displacements along x of all points, then along y, then along z of the workpiece: 3 k readings."""
        three, rotation = range(3), self.rotation
        direction = np.zeros((3 * len(self), 6), order="F")
        direction[:, :3] = np.concatenate([rotation[:, :, axis] for axis in three])
        wrench = np.hstack([np.einsum("kij,kj->ki", rotation, part) for part in (self.wrench[:, :3], self.wrench[:, 3:])])
        commands, velocity, sense = (
            np.tile(one[self.part], (3, 1)) for one in (self.path.commands, self.path.velocity, self.path.sense)
        )
        asked = virtual_observations(self.path.machine, commands, direction, np.tile(wrench, (3, 1)), self.path.tool)
        return replace(asked, velocity=velocity, acceleration=None, sense=sense, weight=self.cut.workpiece)

    def functionals(self, knowledge: Knowledge, moved: Moved | None = None) -> Array:
        """What each of the four components asks of the parameters at every point, shape (4, k, p)."""
        rows = knowledge.rows(self.observations()).reshape(3, len(self), -1)
        if moved is not None:
            rows -= moved.at(self.path.points[self.part])
        normal = np.einsum("ki,ikp->kp", np.nan_to_num(self.normal), rows)
        return np.concatenate([rows, normal[np.newaxis]])


@dataclass(frozen=True, slots=True)
class PieceDeviation:
    """Deviation of the tool along a piece of a path.

    Attributes
    ----------
    part : slice
        Which points of the path, k of them.
    wrench : array, shape (k, 6) [N, N mm]
        On the tool, along the axes of the workpiece.
    machine : Predicted
        Of the machine alone: 4 k values [mm], all of the first component first.
    asked : array of bool, shape (4, k)
        Whether any parameter that was asked for moves this component at all.
    tool : array, shape (k, 4) [mm]
        What tool and holder add.
    """

    part: slice
    wrench: Array
    machine: Predicted
    asked: Flags
    tool: Array


def deviations(
    knowledge: Knowledge,
    path: ToolPath,
    cut: Cut,
    prior: bool = False,
    moved: Moved | None = None,
    points: int = PIECE,
) -> Iterator[PieceDeviation]:
    """The deviation along a path, piece by piece.

    Parameters
    ----------
    knowledge : Knowledge
        Of the machine, from its tests.
    path : ToolPath
    cut : Cut
    prior : bool
        Whether what the tests do not support is given by the stated prior.
    moved : Moved, optional
        By which motion the workpiece was set right.
    points : int
        In a piece.
    """
    for part in path.slices(points):
        piece = Piece(path, cut, part)
        asked = piece.functionals(knowledge, moved)
        found = predicted_along(knowledge, asked, prior)
        yield PieceDeviation(part, piece.wrench, found, np.asarray(asked.any(axis=2)), piece.tool_deflection())


def parts_of(
    knowledge: Knowledge, path: ToolPath, cut: Cut, points: Rows, prior: bool = False, moved: Moved | None = None
) -> dict[str, Predicted]:
    """Each of `PARTS` at some points of a path, k of them, of one piece: 4 k values, as in `PieceDeviation`."""
    asked = Piece(path, cut, points).functionals(knowledge, moved)
    return {name: predicted_along(knowledge, asked * members, prior) for name, members in part_members(knowledge).items()}


def part_members(knowledge: Knowledge) -> dict[str, Array]:
    """Which parameters each of `PARTS` is made of, shape (p,): 1 where it is, else 0."""
    machine = knowledge.machine
    carries = {place.name: place.on for place in machine.places}
    on_tool = [
        (name := carries.get(source.site[1], source.site[1])) == "tool" or name in machine.topology.tool
        for source in knowledge.sources
    ]
    elastic = [source.elastic for source in knowledge.sources]
    return {
        GEOMETRY: 1.0 - np.array(elastic, dtype=float),
        COMPLIANCE: np.array(elastic, dtype=float),
        TOOL_SIDE: np.array(on_tool, dtype=float),
        WORKPIECE_SIDE: 1.0 - np.array(on_tool, dtype=float),
    }
