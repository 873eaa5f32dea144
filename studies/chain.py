"""A serial machine as a chain of homogeneous transforms: where every carriage, the tool and the workpiece ball are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LETTERS = "XYZABC"
ALONG = {"X": 0, "Y": 1, "Z": 2, "U": 0, "V": 1, "W": 2}
ABOUT = {"A": 0, "B": 1, "C": 2, "S": 2}
NONE: Mapping[str, Array] = {}


@dataclass(frozen=True)
class Chain:
    """A machine from the workpiece through the foundation to the tool.

    Attributes
    ----------
    topology : str
        `wCAFYXZSt`: F, f or b is the foundation.
    offsets : tuple of (str, 3-tuple) [mm]
        Of an axis: its location frame in the frame of the link before it.
    tool : 3-tuple [mm]
        Tool ball in the frame of the last carriage of the tool branch.
    """

    topology: str
    offsets: tuple[tuple[str, tuple[float, float, float]], ...] = ()
    tool: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @cached_property
    def branches(self) -> tuple[str, str]:
        """Axes from the foundation to the workpiece, and from the foundation to the tool."""
        inner = self.topology.removeprefix("w").removesuffix("t")
        (ground,) = (k for k, letter in enumerate(inner) if letter in "Ffb")
        return inner[:ground][::-1], inner[ground + 1 :]

    @property
    def axes(self) -> str:
        """All axes, the workpiece's first."""
        return "".join(self.branches)

    def side(self, axis: str) -> float:
        """-1 on the workpiece branch, 1 on the tool branch."""
        return -1.0 if axis in self.branches[0] else 1.0

    def frames(
        self,
        commands: Mapping[str, Array],
        before: Mapping[str, Array] = NONE,
        after: Mapping[str, Array] = NONE,
    ) -> dict[str, Array]:
        """Every carriage in the foundation, shape (m, 4, 4), by axis; `w` and `t` are the last of each branch.

        Parameters
        ----------
        commands : mapping of axis to array, shape (m,) [mm, rad]
            Motion of the tool relative to the workpiece (ISO 841); an axis not named stands at zero.
        before, after : mapping of axis to array, shape (m, 6) [mm, rad]
            Translation and rotation vector in front of the axis's motion, and behind it.
        """
        offsets = dict(self.offsets)
        found: dict[str, Array] = {}
        for end, branch in zip("wt", self.branches, strict=True):
            link = np.eye(4)[np.newaxis]
            for axis in branch:
                link = link @ transform(np.array([[*offsets.get(axis, (0.0, 0.0, 0.0)), 0.0, 0.0, 0.0]]))
                if axis in before:
                    link = link @ transform(before[axis])
                if axis in commands:
                    link = link @ transform(motion(axis, self.side(axis) * commands[axis]))
                if axis in after:
                    link = link @ transform(after[axis])
                found[axis] = link
            found[end] = link
        return found


def motion(axis: str, travel: Array) -> Array:
    """The displacement of an axis as translation and rotation vector, shape (m, 6)."""
    moved = np.zeros((len(travel), 6))
    moved[:, 3 + ABOUT[axis] if axis in ABOUT else ALONG[axis]] = travel
    return moved


def transform(twist: Array) -> Array:
    """Homogeneous transforms, shape (m, 4, 4), of translations and rotation vectors of any size, shape (m, 6)."""
    made = np.zeros((len(twist), 4, 4))
    made[:, :3, :3] = rotation(twist[:, 3:])
    made[:, :3, 3] = twist[:, :3]
    made[:, 3, 3] = 1.0
    return made


def rotation(vector: Array) -> Array:
    """Rotation matrices, shape (m, 3, 3), of rotation vectors, shape (m, 3) [rad], by the formula of Rodrigues."""
    x, y, z = vector.T
    zero = np.zeros_like(x)
    cross = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
    angle = np.sqrt(x * x + y * y + z * z)[:, np.newaxis, np.newaxis]
    half = np.sinc(angle / 2 / np.pi)
    return np.asarray(np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * half * half * (cross @ cross))


def point(frame: Array, local: Array) -> Array:
    """Foundation coordinates, shape (m, 3), of a point in a frame, shape (3,)."""
    return np.asarray(frame[:, :3, :3] @ local + frame[:, :3, 3])
