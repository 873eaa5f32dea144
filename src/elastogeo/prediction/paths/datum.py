"""Where a workpiece is taken to sit: as the machine says, or as it was probed there.

A workpiece that is set up with the machine's own probe sits right where it was probed, whatever the machine is off there: a
rigid motion of it takes off what the unloaded machine is off along the path, by least squares. What is left is what shows on
the part, and it asks less of the tests: an offset or a turn of the whole machine, which no bar sees, does not matter then.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array, Cut, ToolPath
from elastogeo.prediction.knowledge import Knowledge
from elastogeo.prediction.paths.deviation import Piece

Datum = Literal["machine", "probed"]
DATUMS = ("machine", "probed")

PROBED = 500
"""Points of a path, evenly chosen, at which the workpiece counts as probed."""


@dataclass(frozen=True, slots=True)
class RigidMotion:
    """A rigid motion of the workpiece, as a linear function of the parameters.

    Attributes
    ----------
    centre : array, shape (3,) [mm]
    size : float [mm]
        Rotations count as displacements at this distance.
    per_parameter : array, shape (6, p)
        Translation and rotation about the centre, per unit of each parameter.
    """

    centre: Array
    size: float
    per_parameter: Array

    def at(self, points: Array) -> Array:
        """How far points move, shape (3, k, p), per unit of each parameter."""
        moved = rigid_rows((points - self.centre) / self.size) @ self.per_parameter
        return np.asarray(moved.transpose(1, 0, 2))


def check_datum(datum: str) -> None:
    """Refuse a datum that is none.

    Raises
    ------
    InputError
        With those that there are.
    """
    if datum not in DATUMS:
        raise InputError(f"the workpiece sits as {datum!r} says; write {' or '.join(DATUMS)}")


def probed_motion(knowledge: Knowledge, path: ToolPath, cut: Cut) -> RigidMotion:
    """The rigid motion that takes off best what the unloaded machine is off along a path."""
    at = np.unique(np.linspace(0, len(path) - 1, PROBED).round().astype(np.intp))
    rows = knowledge.rows(Piece(path, replace(cut, force=None), at).observations()).reshape(3, len(at), -1)
    centre, size, inverse = rigid_fit(path.points[at])
    flat = rows.transpose(1, 0, 2).reshape(3 * len(at), -1)
    return RigidMotion(centre, size, inverse @ flat)


def rigid_fit(points: Array) -> tuple[Array, float, Array]:
    """Centre and size of some points, and what makes of their displacements, one after the other, the best rigid motion."""
    centre = points.mean(axis=0)
    size = float(np.abs(points - centre).max()) or 1.0
    rows = rigid_rows((points - centre) / size).reshape(-1, 6)
    return centre, size, np.asarray(np.linalg.pinv(rows, rcond=1e-9))


def rigid_rows(points: Array) -> Array:
    """Displacement of points, shape (k, 3, 6), by a translation and a small rotation."""
    rows = np.zeros((len(points), 3, 6))
    rows[:, [0, 1, 2], [0, 1, 2]] = 1.0
    x, y, z = points.T
    rows[:, 0, 4], rows[:, 0, 5] = z, -y
    rows[:, 1, 3], rows[:, 1, 5] = -z, x
    rows[:, 2, 3], rows[:, 2, 4] = y, -x
    return rows
