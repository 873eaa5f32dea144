"""Forces on the tool along a path: constant, measured, or of a milling model. A new kind is a class with `on_tool`.

Every force is that on the tool, at its tip; its reaction acts on the workpiece. Inside it counts along the axes of the
workpiece (the table's frame): `on_tool` turns it there from the directions in which it is known.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite, pi
from typing import Literal, Protocol

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Array
from elastogeo.machine.cutting.coefficients import CuttingCoefficients
from elastogeo.machine.cutting.milling import Engagement, Mill, forces_over_a_turn, mean_force
from elastogeo.machine.frames import Frame
from elastogeo.machine.tool_path import Rows, ToolPath

Directions = Literal["workpiece", "machine", "path"]
DIRECTIONS = ("workpiece", "machine", "path")
"""Along the axes of the table, of the foundation, or of the path: its travel, its left, and from the tip to the holder."""

_FEED_DIGITS = 9
"""Feeds per tooth [mm] that agree to so many digits are one: rounding of a path."""

_TURN = 720
"""Angles of the mill at which forces over a turn are looked at."""


class PathForce(Protocol):
    """A force along a path."""

    @property
    def relative_uncertainty(self) -> float:
        """Standard uncertainty of all of it together, as a share: a gauge's scale, a material's coefficients."""

    @property
    def said(self) -> str:
        """What it is, in words."""

    def on_tool(self, path: ToolPath, part: slice | Rows, workpiece: Frame) -> Array:
        """Wrench on the tool at its tip, shape (k, 6) [N, N mm], along the axes of the workpiece.

        Parameters
        ----------
        path : ToolPath
        part : slice, or array of int
            The k points that are wanted.
        workpiece : Frame
            Of the table at these points.
        """


@dataclass(frozen=True, slots=True)
class ConstantForce:
    """One force while the tool cuts, or one for each block of the program.

    Attributes
    ----------
    force : tuple of 3 float [N]
        On the tool.
    along : str
        Directions in which it counts: see `DIRECTIONS`.
    blocks : mapping of int to tuple of 3 float [N]
        Forces of single blocks, by their number; all others have `force`.
    relative_uncertainty : float
    """

    force: tuple[float, float, float]
    along: Directions = "workpiece"
    blocks: Mapping[int, tuple[float, float, float]] = field(default_factory=dict)
    relative_uncertainty: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no force."""
        for one in (self.force, *self.blocks.values()):
            if len(one) != 3 or not all(map(isfinite, one)):
                raise InputError(f"a force on the tool is three numbers in N; got {one}")
        check_directions(self.along)
        check_share(self.relative_uncertainty)

    @property
    def said(self) -> str:
        """What it is, in words."""
        components = ", ".join(f"{part:g}" for part in self.force)
        own = f", {len(self.blocks)} blocks with forces of their own" if self.blocks else ""
        return f"constant, ({components}) N along the {self.along}{own}"

    def on_tool(self, path: ToolPath, part: slice | Rows, workpiece: Frame) -> Array:
        """As `PathForce`: none where the tool does not cut."""
        found = np.tile(np.asarray(self.force, dtype=float), (len(path.block[part]), 1))
        for block, force in self.blocks.items():
            found[path.block[part] == block] = force
        found *= path.cutting[part, np.newaxis]
        return turned(found, self.along, path, part, workpiece)


@dataclass(frozen=True, slots=True)
class MeasuredForce:
    """Forces that a dynamometer recorded along the path.

    Attributes
    ----------
    at : array, shape (k,)
        Where each was recorded: the way along the path [mm], the time [s], or the number of the point, from 0.
    force : array, shape (k, 3) [N]
    counts : str
        `way`, `time` or `point`: what `at` is.
    along : str
        Directions in which it counts: those of a dynamometer on the table are the workpiece's.
    on : str
        `tool`, or `workpiece` where the dynamometer carries the workpiece: it shows the opposite of the force on the tool.
    relative_uncertainty : float
        Of the dynamometer's scale.
    source : str
    """

    at: Array
    force: Array
    counts: Literal["way", "time", "point"] = "point"
    along: Directions = "workpiece"
    on: Literal["tool", "workpiece"] = "tool"
    relative_uncertainty: float = 0.0
    source: str = "measured"

    def __post_init__(self) -> None:
        """Refuse a record that does not go forward or holds no force."""
        if self.force.shape != (len(self.at), 3) or not (np.isfinite(self.force).all() and np.isfinite(self.at).all()):
            raise InputError(f"{self.source}: measured forces are three finite numbers [N] at each of {len(self.at)} places")
        if not len(self.at) or (np.diff(self.at) <= 0).any():
            raise InputError(f"{self.source}: the forces must be in the order of their {self.counts}, each once")
        if self.on not in ("tool", "workpiece"):
            raise InputError(
                f"{self.source}: the dynamometer shows the force on the tool or the workpiece, not on {self.on!r}"
            )
        check_directions(self.along)
        check_share(self.relative_uncertainty)

    @property
    def said(self) -> str:
        """What it is, in words."""
        return f"measured ({self.source}), {len(self.at)} readings by {self.counts}"

    def on_tool(self, path: ToolPath, part: slice | Rows, workpiece: Frame) -> Array:
        """As `PathForce`: between two readings in proportion.

        Raises
        ------
        InputError
            If the record does not cover the path, or counts by time and the feed is not known.
        """
        where = _counted(path, self.counts)
        slack = 1e-9 * max(abs(where[0]), abs(where[-1]))
        if self.at[0] > where[0] + slack or self.at[-1] < where[-1] - slack:
            raise InputError(
                f"{self.source}: the forces cover {self.at[0]:g} to {self.at[-1]:g} of the {self.counts}, the path needs "
                f"{where[0]:g} to {where[-1]:g}; record them along all of it, or cut the path"
            )
        found = np.column_stack([np.interp(where[part], self.at, column) for column in self.force.T])
        return turned(found if self.on == "tool" else -found, self.along, path, part, workpiece)


@dataclass(frozen=True, slots=True)
class MillingForce:
    """The force of an end mill that cuts with a constant engagement, by its coefficients and the feed of the path.

    Attributes
    ----------
    edge : CuttingCoefficients
    mill : Mill
    engagement : Engagement
    speed : float [rad/s]
        Of the spindle, clockwise seen from the holder (M3).
    feed : float or None [mm/s]
        Where the path says none.
    moment : str
        `mean` over a turn; or `surface`: when the tip of an edge makes the surface, at the side where the material is.
    draws_out : bool
        Whether a positive axial force draws the mill out of its holder, as a right-hand helix does; else it pushes it in.
    relative_uncertainty : float
        Of the coefficients: 0.1 to 0.2 where they are not of one's own material and tool.
    """

    edge: CuttingCoefficients
    mill: Mill
    engagement: Engagement
    speed: float
    feed: float | None = None
    moment: Literal["mean", "surface"] = "mean"
    draws_out: bool = True
    relative_uncertainty: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a spindle that stands."""
        if not (isfinite(self.speed) and self.speed > 0):
            raise InputError(f"the spindle turns at {self.speed * 30 / pi:g} 1/min; it must turn for a mill to cut")
        if self.moment not in ("mean", "surface"):
            raise InputError(f"the force is taken at the moment {self.moment!r}; write mean or surface")
        check_share(self.relative_uncertainty)

    @property
    def said(self) -> str:
        """What it is, in words."""
        return (
            f"milling model, {self.mill.teeth} teeth of {self.mill.diameter:g} mm, {self.engagement.depth:g} mm deep, "
            f"{self.speed * 30 / pi:g} 1/min, {self.moment} force; coefficients: {self.edge.source or 'own'}"
        )

    def on_tool(self, path: ToolPath, part: slice | Rows, workpiece: Frame) -> Array:
        """As `PathForce`: none where the tool does not cut, or stands, or plunges.

        Raises
        ------
        InputError
            If no feed is known.
        """
        if not path.timed and self.feed is None:
            raise InputError(f"{path.name}: the milling model needs the feed; write it in the path, or give it with the cut")
        count = len(path.block[part])
        feed = path.speed[part] if path.timed else np.full(count, self.feed)
        per_tooth = np.round(feed * 2 * pi / (self.speed * self.mill.teeth), _FEED_DIGITS)
        found = np.zeros((count, 3))
        for one in np.unique(per_tooth):
            found[per_tooth == one] = self.of_feed(float(one))
        cuts = path.cutting[part] & np.isfinite(path.left[part]).all(axis=1)
        return turned(found * cuts[:, np.newaxis], "path", path, part, workpiece)

    def of_feed(self, per_tooth: float) -> Array:
        """Force on the mill at a feed per tooth [mm], shape (3,) [N]: along the travel, its left, and from tip to holder."""
        force = self._mean(per_tooth) if self.moment == "mean" else self._when_the_surface_is_made(per_tooth)
        return np.asarray(force * np.array([1.0, 1.0, -1.0 if self.draws_out else 1.0]))

    def _mean(self, per_tooth: float) -> Array:
        if not self.mill.run_out:
            return mean_force(self.edge, self.mill.teeth, self.engagement, per_tooth)
        angles = np.arange(_TURN) * 2 * pi / _TURN
        return np.asarray(forces_over_a_turn(self.edge, self.mill, self.engagement, per_tooth, angles).mean(axis=0))

    def _when_the_surface_is_made(self, per_tooth: float) -> Array:
        """Mean over the teeth, each with its tip at the side where the wall stays (Kline, DeVor, Shareef 1982)."""
        at = pi if self.engagement.exit == pi else 0.0
        tips = at + 2 * pi * np.arange(self.mill.teeth) / self.mill.teeth
        return np.asarray(forces_over_a_turn(self.edge, self.mill, self.engagement, per_tooth, tips).mean(axis=0))


def turned(force: Array, along: Directions, path: ToolPath, part: slice | Rows, workpiece: Frame) -> Array:
    """Forces [N], shape (k, 3), as wrenches along the axes of the workpiece, shape (k, 6)."""
    found = np.zeros((len(force), 6))
    match along:
        case "workpiece":
            found[:, :3] = force
        case "machine":
            found[:, :3] = workpiece.components(force)
        case _:
            axis = np.broadcast_to(path.axis, path.tangent.shape)[part]
            left = np.nan_to_num(path.left[part])
            found[:, :3] = force[:, :1] * path.tangent[part] + force[:, 1:2] * left + force[:, 2:] * axis
    return found


def check_directions(along: str) -> None:
    """Refuse directions that are none.

    Raises
    ------
    InputError
        With those that there are.
    """
    if along not in DIRECTIONS:
        raise InputError(f"forces along {along!r} are not known; they count along {', '.join(DIRECTIONS)}")


def check_share(share: float) -> None:
    """Refuse a relative uncertainty that is none.

    Raises
    ------
    InputError
        If it is not from 0 to below 1.
    """
    if not 0 <= share < 1:
        raise InputError(f"the relative uncertainty of a force is {share:g}; it is a share, from 0 to below 1")


def _counted(path: ToolPath, counts: str) -> Array:
    """What the record of a force counts by, at every point of the path."""
    if counts == "point":
        return np.arange(len(path), dtype=float)
    if counts == "way":
        return path.travelled
    if not path.timed:
        raise InputError(f"{path.name}: forces by time need the feed of the path; write it, or count them by way or point")
    return np.cumsum(np.divide(path.steps, path.speed, out=np.zeros(len(path)), where=path.speed > 0))
