"""The uncertainty of the values of ISO 230-2: what is known of the sensor, temperature and alignment, and few cycles.

As ISO/TR 230-9 has it, every influence that the test states (calibration of the sensor, temperature, alignment, drift) is
carried to each value by itself, here by shifting the readings up and down by its standard uncertainty. What five cycles say
of a machine's scatter is uncertain too; that part stands beside them under a name of its own, and is no part of the
uncertainty of the measurement as the standard counts it. To first order: where several targets are nearly the farthest, the
greatest of their deviations is a little greater than each, which no first order sees.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.estimate import Estimate, Influence, effective_degrees_of_freedom
from elastogeo.identification.positioning.result import Contribution, StandardValue
from elastogeo.identification.positioning.standard import ByTarget, by_target, standard_values
from elastogeo.machine import Array

CYCLES = "scatter of the cycles"
_STEP = 1e-6
"""Share of the spread of the deviations by which one mean is moved to see what follows it."""


def with_uncertainty(
    target: Array, sense: Array, reading: Array, shifts: Sequence[tuple[Influence, Array]], straight: bool = False
) -> Mapping[str, StandardValue]:
    """The values of ISO 230-2, each with its uncertainty.

    Parameters
    ----------
    target, sense, reading : array, shape (m,)
        As of `by_target`.
    shifts : sequence of (Influence, array), shape (m,) [mm or rad]
        By how much each stated influence makes these readings too great, per unit of its quantity.
    straight : bool
        Whether a straight line through all readings is subtracted first.
    """

    def values(read: Array) -> dict[str, float]:
        return standard_values(by_target(target, sense, straightened(target, read) if straight else read))

    found = by_target(target, sense, straightened(target, reading) if straight else reading)
    nominal = standard_values(found)
    known = [_carried(influence, shift, reading, values) for influence, shift in shifts]
    scatter = _scatter(found, nominal)
    return {name: _value(name, value, scatter.get(name), [one[name] for one in known]) for name, value in nominal.items()}


def straightened(target: Array, reading: Array) -> Array:
    """Readings, shape (m,), less the straight line through all of them (least squares)."""
    if np.ptp(target) == 0:
        return np.asarray(reading - reading.mean())
    return np.asarray(reading - np.polyval(np.polyfit(target, reading, 1), target))


def _carried(
    influence: Influence, shift: Array, reading: Array, values: Callable[[Array], dict[str, float]]
) -> dict[str, Contribution]:
    off = influence.standard_uncertainty * shift
    above, below = values(reading + off), values(reading - off)
    freedom = influence.degrees_of_freedom
    return {name: Contribution(influence.label, abs(above[name] - below[name]) / 2, freedom) for name in above}


def _scatter(found: ByTarget, nominal: Mapping[str, float]) -> dict[str, Contribution]:
    """What the scatter of few approaches makes of each value; nothing of values with a target read once only."""
    step = _STEP * max(float(np.nanmax(found.mean) - np.nanmin(found.mean)), float(np.nanmax(found.deviation, initial=0)))
    if not step:
        return {name: Contribution(CYCLES, 0.0, np.inf) for name in nominal if (found.count > 1).any()}
    sizes: dict[str, list[float]] = {name: [] for name in nominal}
    freedoms: list[float] = []
    alone: set[str] = set()
    for cell in zip(*np.nonzero(found.count), strict=True):
        count, spread = float(found.count[cell]), float(found.deviation[cell])
        by_mean = standard_values(replace(found, mean=_moved(found.mean, cell, step)))
        by_spread = standard_values(replace(found, deviation=_moved(found.deviation, cell, step)))
        for name, value in nominal.items():
            slopes = (by_mean[name] - value) / step, (by_spread[name] - value) / step
            if count < 2:
                alone |= {name} if slopes[0] else set()
                sizes[name].append(0.0)
            else:
                sizes[name].append(
                    spread * float(np.hypot(slopes[0] / np.sqrt(count), slopes[1] / np.sqrt(2 * (count - 1))))
                )
        freedoms.append(max(count - 1, 1))
    return {
        name: Contribution(CYCLES, float(np.linalg.norm(parts)), _freedom(parts, freedoms))
        for name, parts in sizes.items()
        if name not in alone
    }


def _moved(values: Array, cell: tuple[int, ...], step: float) -> Array:
    moved = values.copy()
    moved[cell] += step
    return moved


def _freedom(parts: Sequence[float], freedoms: Sequence[float]) -> float:
    return float(effective_degrees_of_freedom(np.array([parts]), np.array(freedoms))[0])


def _value(name: str, value: float, scatter: Contribution | None, known: Sequence[Contribution]) -> StandardValue:
    together: dict[str, Contribution] = {}
    for one in known:
        before = together[one.label].standard_uncertainty if one.label in together else 0.0
        together[one.label] = replace(one, standard_uncertainty=float(np.hypot(before, one.standard_uncertainty)))
    parts = [*together.values(), *([] if scatter is None else [scatter])]
    estimate = None
    if scatter is not None:
        sizes, freedoms = [p.standard_uncertainty for p in parts], [p.degrees_of_freedom for p in parts]
        estimate = Estimate(value, float(np.linalg.norm(sizes)), _freedom(sizes, freedoms))
    measurement = float(np.linalg.norm([p.standard_uncertainty for p in together.values()]))
    ordered = tuple(sorted(parts, key=lambda part: -part.standard_uncertainty))
    return StandardValue(name, value, estimate, measurement, ordered)
