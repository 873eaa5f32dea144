"""A section through a map: the stiffness in one direction over two axes, at one place of the third."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import Array
from elastogeo.prediction.maps.elements import COVARIANCES, ElementMap, Elements
from elastogeo.prediction.maps.result import Flags
from elastogeo.prediction.tool_compliances import TRANSLATION, unit_direction, weights_of
from elastogeo.result import Result

_NOT_USED = 1e-12
"""A weight of an element below this is the rounding of a sine: it needs none of it."""


@dataclass(frozen=True, slots=True, eq=False)
class Spot(ByValue):
    """A place of a section.

    Attributes
    ----------
    commands : mapping of str to float [mm]
        Of the axes of the map.
    stiffness : float [N/mm]
    expanded : float [N/mm]
        U of 95 %, to first order; NaN where the runs show none.
    """

    commands: Mapping[str, float]
    stiffness: float
    expanded: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class MapSection(Result):
    """The stiffness in one direction over a plane of a map.

    Attributes
    ----------
    map : ElementMap
    axes : tuple of 2 str
        Across and up.
    height_axis : str
        The axis that stands at one of its places; empty if the map has two axes only.
    height : int
        At which of its places.
    direction : array, shape (3,)
        Of the force, and of the displacement that counts, in the foundation.
    compliance, expanded : array, shape (n, m) [mm/N]
        Along the direction, with U of 95 %; NaN where it is not known.
    resting : array of bool, shape (n, m)
        Where it rests on joints that were never tested and count as rigid.
    told : Elements
        Of the n m places, the second axis the fastest.
    beside : Elements or None
        What rests on rigid joints there; None if it is not shown.
    """

    map: ElementMap
    axes: tuple[str, str]
    height_axis: str
    height: int
    direction: Array
    compliance: Array
    expanded: Array
    resting: Flags
    told: Elements
    beside: Elements | None

    @property
    def along(self) -> tuple[Array, Array]:
        """Commands of both axes [mm]."""
        of = dict(zip(self.map.axes, self.map.along, strict=True))
        return of[self.axes[0]], of[self.axes[1]]

    @property
    def heights(self) -> Array:
        """The places of the third axis [mm]; empty without one."""
        return dict(zip(self.map.axes, self.map.along, strict=True)).get(self.height_axis, np.zeros(0))

    @property
    def stiffness(self) -> Array:
        """[N/mm], NaN where it is not known, or the compliance is not positive."""
        positive = self.compliance > 0
        return np.where(positive, 1.0 / np.where(positive, self.compliance, 1.0), np.nan)

    @property
    def known(self) -> Flags:
        """Where there is a number, shape (n, m)."""
        return np.asarray(np.isfinite(self.stiffness))

    @property
    def softest(self) -> Spot | None:
        """Where the machine gives way most; None where nothing is known."""
        return self._spot(int(np.nanargmin(self.stiffness))) if self.known.any() else None

    @property
    def stiffest(self) -> Spot | None:
        """Where it gives way least."""
        return self._spot(int(np.nanargmax(self.stiffness))) if self.known.any() else None

    def _spot(self, k: int) -> Spot:
        at = np.unravel_index(k, self.compliance.shape)
        commands = {axis: float(one[i]) for axis, one, i in zip(self.axes, self.along, at, strict=True)}
        if self.height_axis:
            commands[self.height_axis] = float(self.heights[self.height])
        found = float(self.stiffness[at])
        return Spot({axis: commands[axis] for axis in self.map.axes}, found, float(self.expanded[at]) * found**2)


def section_of(
    found: ElementMap,
    plane: Sequence[str] = (),
    height: int | None = None,
    direction: Sequence[float] = (1.0, 0.0, 0.0),
    assumed: bool = False,
) -> MapSection:
    """A section through a map.

    Parameters
    ----------
    found : ElementMap
    plane : sequence of 2 str
        Axes of the map; by default the first two that have more than one place.
    height : int, optional
        Place of the third axis, counted from 0; by default its middle.
    direction : sequence of 3 float
        Need not be a unit vector.
    assumed : bool
        Whether to show what rests on rigid joints where the tests tell nothing.

    Raises
    ------
    InputError
        If the map is no plane, or has no such axes, place or direction.
    """
    wide = [axis for axis, one in zip(found.axes, found.along, strict=True) if len(one) > 1]
    across, up = _plane(wide, plane)
    rest = [axis for axis in found.axes if axis not in (across, up)]
    height_axis = rest[0] if rest else ""
    count = len(found.along[found.axes.index(height_axis)]) if height_axis else 1
    chosen = count // 2 if height is None else height
    if not 0 <= chosen < count:
        raise InputError(
            f"the map has {count} places along {height_axis}, not one of number {chosen}; ask for 0 to {count - 1}"
        )
    way = unit_direction(direction)
    at = _places(found, (across, up), height_axis, chosen)
    told = _of(found.told, at)
    beside = _of(found.assumed, at) if assumed and found.assumed is not None else None
    value, expanded = along(told, way)
    resting = np.zeros(len(at), dtype=bool)
    if beside is not None:
        more, more_expanded = along(beside, way)
        resting = ~np.isfinite(value) & np.isfinite(more)
        value, expanded = np.where(resting, more, value), np.where(resting, more_expanded, expanded)
    shape = tuple(len(found.along[found.axes.index(axis)]) for axis in (across, up))
    return MapSection(
        map=found,
        axes=(across, up),
        height_axis=height_axis,
        height=chosen,
        direction=way,
        compliance=value.reshape(shape),
        expanded=expanded.reshape(shape),
        resting=resting.reshape(shape),
        told=told,
        beside=beside,
    )


def along(elements: Elements, direction: Array) -> tuple[Array, Array]:
    """Compliance along a unit direction, and its U, of each place, shape (m,) [mm/N].

    u is that of just this sum, U is u times a coverage factor whose square is the mean of those of the elements, weighted by
    what each brings to the variance: along an axis its own, in between an approximation.
    """
    weights = weights_of(direction, TRANSLATION)
    used = np.abs(weights) > _NOT_USED
    weights = np.where(used, weights, 0.0)
    value = np.sum(elements.compliance[:, used] * weights[used], axis=1)
    pairs = np.array([(1 if i == j else 2) * weights[i] * weights[j] for i, j in COVARIANCES])
    needed = pairs != 0
    variance = np.maximum(np.sum(elements.covariance[:, needed] * pairs[needed], axis=1), 0.0)
    own = [k for k, (i, j) in enumerate(COVARIANCES) if i == j and used[i]]
    brought = elements.covariance[:, own] * weights[used] ** 2
    whole = brought.sum(axis=1)
    factor = np.sum(brought * elements.coverage[:, used] ** 2, axis=1) / np.where(whole > 0, whole, 1.0)
    return value, np.sqrt(factor * variance)


def _plane(wide: Sequence[str], asked: Sequence[str]) -> tuple[str, str]:
    if len(wide) < len("XY"):
        raise InputError("the map has fewer than two axes with more than one place, so that it has no section")
    chosen = tuple(asked) or tuple(wide[:2])
    if len(set(chosen)) != len("XY") or not set(chosen) <= set(wide):
        raise InputError(f"the map goes along {', '.join(wide)}; a section takes two of them")
    return chosen[0], chosen[1]


def _places(found: ElementMap, axes: tuple[str, str], height_axis: str, height: int) -> Array:
    """Numbers of the places of the section, the second axis the fastest."""
    numbers = np.arange(int(np.prod(found.shape))).reshape(found.shape)
    order = [found.axes.index(axis) for axis in (*axes, *((height_axis,) if height_axis else ()))]
    turned = numbers.transpose(order)
    return np.asarray((turned[..., height] if height_axis else turned).ravel())


def _of(elements: Elements, at: Array) -> Elements:
    return Elements(elements.compliance[at], elements.covariance[at], elements.coverage[at])
