"""From a positioning test to an error table: the mean deviation at every target, by direction, with its uncertainty.

The targets themselves, and no polynomial through them: a screw or a scale is rarely one. A compensation must not move the
machine's zero, and a sensor has any zero: so deviations count from those at one position, in each cycle for itself. What is
left is the scatter of the cycles about it, with as many degrees of freedom as there are cycles less one, and every stated
influence (calibration of the sensor, temperature, alignment) with its own.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification import PositioningResults, stated_shifts
from elastogeo.machine import COMPONENTS, Array, ErrorTable, motion_of
from elastogeo.observe import Positioning
from elastogeo.prediction.compensation.parts import ErrorPart, FoundError, expanded, zero_within

ACROSS = 0.999
"""Cosine of a sensor's direction and an axis of the foundation from which it reads that component."""


def found_by_targets(found: PositioningResults, zero_at: float | None = None) -> FoundError:
    """The error that a positioning test shows at its targets.

    Parameters
    ----------
    found : PositioningResults
    zero_at : float, optional [mm or rad]
        Position at which the mean of both directions counts as zero; 0 where the targets hold it, else the target nearest
        to it.

    Raises
    ------
    InputError
        If `zero_at` is outside the targets, or the sensor reads askew.
    UnsupportedError
        If no cycle has all that the zero needs.
    """
    component, sign = _component(found)
    place = np.searchsorted(found.targets.target, found.target)
    sides = [k for k in (0, 1) if found.targets.count[:, k].any()]
    usable = np.flatnonzero(found.targets.count[:, sides].all(axis=1))
    target = found.targets.target[usable]
    zero = zero_within(found.axis, float(target.min()), float(target.max()), zero_at)
    readings = _from_zero(_by_cycle(found, place, sign * found.reading)[:, usable][:, :, sides], target, zero)
    if np.isnan(readings).all(axis=0).any():
        raise UnsupportedError(
            f"test {found.test.name!r}: no cycle has readings at {zero:g} and at every target; read the missing ones, or "
            f"let the error count from another target"
        )
    systematic = [
        (_from_zero(_by_cycle(found, place, shift)[:, usable][:, :, sides], target, zero), freedom)
        for shift, freedom in _shifts(found)
    ]
    parts = tuple(_parts(found.axis, component, readings, systematic))
    value, doubt = _measured(readings, systematic)
    if len(sides) == 1:
        value, doubt = np.repeat(value, 2, axis=1), np.repeat(doubt, 2, axis=1)
    unknown = () if len(sides) == 2 else (f"B_{component}{found.axis}",)
    return FoundError(ErrorTable(found.axis, component, target, value, doubt), parts, zero, unknown, by_target=True)


def _component(found: PositioningResults) -> tuple[str, float]:
    """Which component the sensor reads, and whether along or against it."""
    if found.along:
        return motion_of(found.axis), 1.0
    setup = cast("Positioning", found.test.setup)
    given = setup.about if setup.about is not None else setup.direction
    if given is None:
        return setup.motion, 1.0
    direction = np.array(given, dtype=float) / np.linalg.norm(given)
    k = int(np.abs(direction).argmax())
    if abs(direction[k]) < ACROSS:
        raise InputError(
            f"test {found.test.name!r}: its sensor reads askew, along {tuple(given)}, which no control compensates alone; "
            f"compensate from an identification of several tests"
        )
    return COMPONENTS[k + 3 * found.angular], float(np.sign(direction[k]))


def _by_cycle(found: PositioningResults, place: Places, reading: Array) -> Array:
    """Readings, shape (cycles, targets, 2); NaN where there is none."""
    table = np.full((int(found.cycle.max()), len(found.targets.target), 2), np.nan)
    table[found.cycle - 1, place, (found.sense < 0).astype(int)] = reading
    return table


def _from_zero(readings: Array, target: Array, zero: float) -> Array:
    """Readings less those of the same cycle at the zero, the mean of its sides."""
    right = min(max(int(np.searchsorted(target, zero)), 1), len(target) - 1)
    left = max(right - 1, 0)
    span = target[right] - target[left]
    share = (zero - target[left]) / span if span else 0.0
    sides = readings[:, right] if share == 1 else readings[:, left] if share == 0 else None
    at_zero = (1 - share) * readings[:, left] + share * readings[:, right] if sides is None else sides
    return np.asarray(readings - at_zero.mean(axis=1)[:, np.newaxis, np.newaxis])


def _shifts(found: PositioningResults) -> list[tuple[Array, float]]:
    """What each stated influence does to the readings, by its standard uncertainty, and the degrees of freedom of that."""
    shifts = stated_shifts(found.test, found.test.observations())
    return [(one.standard_uncertainty * shift, one.degrees_of_freedom) for one, shift in shifts]


Places = np.ndarray[tuple[int, ...], np.dtype[np.intp]]
Systematic = Sequence[tuple[Array, float]]


def _parts(axis: str, component: str, readings: Array, systematic: Systematic) -> Iterator[ErrorPart]:
    """The curve that both directions have in common, and half of what they differ by."""
    both = readings.shape[2] == 2
    weights = [("E", np.full(readings.shape[2], 1 / readings.shape[2]), np.array([1.0, 1.0]))]
    if both:
        weights.append(("B", np.array([0.5, -0.5]), np.array([1.0, -1.0])))
    for letter, weight, sides in weights:
        shifts = [((shift @ weight)[:, :, np.newaxis], freedom) for shift, freedom in systematic]
        value, doubt = _measured((readings @ weight)[:, :, np.newaxis], shifts)
        yield ErrorPart((f"{letter}_{component}{axis}",), value * sides, np.repeat(doubt, 2, axis=1))


def _measured(readings: Array, systematic: Systematic) -> tuple[Array, Array]:
    """Mean over the cycles, of readings of shape (cycles, targets, sides), and its expanded uncertainty."""
    count = np.sum(~np.isnan(readings), axis=0)
    mean = np.nanmean(readings, axis=0)
    squares = np.nansum((readings - mean) ** 2, axis=0)
    enough = count > 1
    spread = np.sqrt(np.divide(squares, (count - 1) * count, out=np.full(mean.shape, np.nan), where=enough))
    sizes = [spread, *(np.abs(np.nanmean(shift, axis=0)) for shift, _ in systematic)]
    freedoms = [np.maximum(count - 1.0, 1.0), *(np.full(mean.shape, freedom) for _, freedom in systematic)]
    stacked = np.stack([size.ravel() for size in sizes], axis=1), np.stack([one.ravel() for one in freedoms], axis=1)
    return mean, expanded(*stacked).reshape(mean.shape)
