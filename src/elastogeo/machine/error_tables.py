"""An error of one axis as a table: what compensation files of controls hold, and what they are made of.

One sign for all: actual less nominal. The deviation of the tool relative to the workpiece counts along the positive command
of the axis that makes it good (ISO 841), whichever of the two the axis carries: `E_XX` = +0.010 at 100 mm means that X
stands at 100.010 mm when 100 mm were commanded. Every control has a sign of its own; only its own file knows it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.estimate import Array
from elastogeo.machine.jacobian import COMPONENTS
from elastogeo.machine.topology import LINEAR, ROTARY

SIDES = ("+", "-")
"""Directions in which the axis comes: the columns of a table."""


@dataclass(frozen=True, slots=True, eq=False)
class ErrorTable(ByValue):
    """One component of the deviation as a function of the position of one axis.

    Attributes
    ----------
    axis : str
        Letter of the axis whose command it goes with.
    component : str
        X, Y, Z (a displacement) or A, B, C (a rotation) of the tool relative to the workpiece.
    position : array, shape (k,) [mm or rad]
        Commands of the axis, ascending.
    value : array, shape (k, 2) [mm or rad]
        Actual less nominal where the axis came in its positive direction, and in its negative one.
    uncertainty : array, shape (k, 2) [mm or rad]
        Expanded, for 95 %; NaN where it is not known, as of a table that was read from a file of a control.

    Raises
    ------
    InputError
        If there is no such axis or component, the positions do not ascend, a number is not finite, or shapes differ.
    """

    axis: str
    component: str
    position: Array
    value: Array
    uncertainty: Array

    def __post_init__(self) -> None:
        """Refuse what is no table."""
        if self.axis not in {**LINEAR, **ROTARY} or self.component not in COMPONENTS:
            raise InputError(
                f"an error table of component {self.component!r} of axis {self.axis!r}; axes are "
                f"{' '.join([*LINEAR, *ROTARY])}, components X Y Z A B C"
            )
        count = len(self.position)
        if not count or self.value.shape != (count, 2) or self.uncertainty.shape != (count, 2):
            raise InputError(
                f"error table {self.name}: {count} positions, values of shape {self.value.shape}, uncertainties of shape "
                f"{self.uncertainty.shape}; every position needs one of each for both directions"
            )
        if not (np.isfinite(self.position).all() and np.isfinite(self.value).all()):
            raise InputError(f"error table {self.name}: a position or a value is no finite number")
        back = np.flatnonzero(np.diff(self.position) <= 0)
        if len(back):
            one, other = self.position[back[0]], self.position[back[0] + 1]
            raise InputError(f"error table {self.name}: {other:.6g} follows {one:.6g}; sort the positions, each once")

    @property
    def name(self) -> str:
        """As ISO 230-1 has it: `E_YX`."""
        return f"E_{self.component}{self.axis}"

    @property
    def is_rotary(self) -> bool:
        """Whether the positions are angles."""
        return self.axis in ROTARY

    @property
    def is_angular(self) -> bool:
        """Whether the values are angles."""
        return self.component in ROTARY

    @property
    def is_own(self) -> bool:
        """Whether the axis itself makes it good: positioning."""
        return self.component == motion_of(self.axis)

    @property
    def span(self) -> tuple[float, float]:
        """Least and greatest position [mm or rad]."""
        return float(self.position[0]), float(self.position[-1])

    @property
    def one_sided(self) -> bool:
        """Whether both directions have the same values."""
        return bool(np.array_equal(self.value[:, 0], self.value[:, 1]))

    def at(self, position: Array) -> Array:
        """Values, shape (m, 2), at positions, shape (m,): linear between the points, constant beyond them."""
        return _between(position, self.position, self.value)

    def uncertainty_at(self, position: Array) -> Array:
        """Uncertainties, shape (m, 2), between the points in proportion."""
        return _between(position, self.position, self.uncertainty)

    def deviation(self, position: Array, sense: Array) -> Array:
        """Value, shape (m,), at positions that were come to in a direction: +1, -1, or 0 for the mean."""
        both = self.at(position)
        share = (1.0 + np.sign(sense)) / 2
        return np.asarray(share * both[:, 0] + (1.0 - share) * both[:, 1])


def motion_of(axis: str) -> str:
    """The component that the command of an axis is: X of X and U, C of C."""
    return COMPONENTS[3 + ROTARY[axis]] if axis in ROTARY else COMPONENTS[LINEAR[axis]]


def _between(at: Array, position: Array, columns: Array) -> Array:
    return np.column_stack([np.interp(at, position, column) for column in columns.T])
