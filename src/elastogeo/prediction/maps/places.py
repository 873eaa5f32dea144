"""Where in the volume a map is asked: a grid over some axes, the others standing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import Array, Machine
from elastogeo.observe import Campaign

COUNTS = (9, 9, 5)
"""Places along X, Y, Z where none are asked for."""

MOST = 10_000_000
"""Places that a map may have."""


@dataclass(frozen=True, slots=True, eq=False)
class Grid(ByValue):
    """A grid of poses.

    Attributes
    ----------
    axes : tuple of str
        The d linear axes that it is over.
    along : tuple of array [mm]
        Commands along each.
    stands : array, shape (n,) [mm, rad]
        Where all other axes stand.
    columns : tuple of int
        Places of `axes` in the order of the machine's.
    """

    axes: tuple[str, ...]
    along: tuple[Array, ...]
    stands: Array
    columns: tuple[int, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Places along each axis."""
        return tuple(len(one) for one in self.along)

    @property
    def size(self) -> int:
        """How many places there are."""
        return prod(self.shape)

    @property
    def corners(self) -> tuple[int, ...]:
        """Its corners and its middle, counted through, each once."""
        ends = product(*((0, count - 1) for count in self.shape))
        chosen = [*ends, tuple(count // 2 for count in self.shape)]
        return tuple(sorted({int(np.ravel_multi_index(one, self.shape)) for one in chosen}))

    def commands(self, places: NDArray[np.intp]) -> Array:
        """Axis commands, shape (m, n), at places of the grid, counted through."""
        found = np.tile(self.stands, (len(places), 1))
        for column, one, index in zip(self.columns, self.along, np.unravel_index(places, self.shape), strict=True):
            found[:, column] = one[index]
        return found


def grid(
    machine: Machine,
    campaign: Campaign,
    along: Mapping[str, tuple[float, float, int]] | None = None,
    at: Mapping[str, float] | None = None,
) -> Grid:
    """The grid that is asked for.

    Parameters
    ----------
    machine : Machine
    campaign : Campaign
        Whose tests say how far, where the machine does not say its travel.
    along : mapping of str to (first, last, count), optional [mm]
        Linear axes of the grid; by default all.
    at : mapping of str to float, optional [mm, rad]
        Where others stand; by default where the first test stood.

    Raises
    ------
    InputError
        If an axis is unknown, named twice, rotary and to be gone along, or leaves its travel; if numbers are no range.
    """
    at = dict(at or {})
    ranges = dict(along) if along else _default(machine, campaign, at)
    stands = np.array(next(iter(campaign.observations().values()))[0].centre, dtype=float)
    for axis, value in at.items():
        _check(machine, axis, (value,))
        stands[machine.index(axis)] = value
    both = sorted(set(ranges) & set(at))
    if both:
        raise InputError(f"axis {both[0]} is to be gone along and to stand; ask for one of the two")
    axes = tuple(sorted(ranges))
    found = tuple(_range(machine, axis, ranges[axis]) for axis in axes)
    if prod(map(len, found)) > MOST:
        raise InputError(f"the map would have {prod(map(len, found))} places; ask for {MOST} at most")
    return Grid(axes, found, stands, tuple(machine.index(axis) for axis in axes))


def _default(machine: Machine, campaign: Campaign, at: Mapping[str, float]) -> dict[str, tuple[float, float, int]]:
    linear = [joint for joint in machine.joints if not joint.is_rotary and joint.name in "XYZ" and joint.name not in at]
    runs = [run.commands for several in campaign.observations().values() for run in several]
    found = {}
    for joint in linear:
        column = machine.index(joint.name)
        gone = np.array([[commands[:, column].min(), commands[:, column].max()] for commands in runs])
        low, high = joint.travel if np.isfinite(joint.travel).all() else (gone[:, 0].min(), gone[:, 1].max())
        found[joint.name] = (float(low), float(high), COUNTS["XYZ".index(joint.name)] if high > low else 1)
    return found


def _range(machine: Machine, axis: str, asked: Sequence[float]) -> Array:
    first, last, count = asked
    if not (float(count).is_integer() and count >= 1) or (count == 1) != (first == last):
        raise InputError(
            f"axis {axis} is asked from {first:g} to {last:g} at {count:g} places; give first, last and how many, two at "
            f"least, or one place once"
        )
    _check(machine, axis, (first, last))
    if machine.joints[machine.index(axis)].is_rotary:
        raise InputError(f"a map goes along linear axes; say where {axis} stands, and make a map for each of its positions")
    return np.linspace(first, last, int(count))


def _check(machine: Machine, axis: str, values: Sequence[float]) -> None:
    low, high = machine.joints[machine.index(axis)].travel
    for value in values:
        if not np.isfinite(value) or not low <= value <= high:
            raise InputError(f"axis {axis} cannot stand at {value:g}: its travel is {low:g} to {high:g}")
