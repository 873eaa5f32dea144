"""Of a static load: the stiffness in each direction in which the machine was loaded."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, isfinite, sqrt

import numpy as np

from elastogeo.changes.indicators.identified import DIRECTIONS
from elastogeo.changes.indicators.register import indicates
from elastogeo.changes.kinds import KINDS
from elastogeo.changes.series import Indicator
from elastogeo.estimate import Estimate
from elastogeo.identification import Cartesian, StaticResults
from elastogeo.machine import Array

_ALONG = 1e-6
"""Sine of the angle to an axis up to which a direction is along it."""


@indicates(StaticResults)
def of_a_static_test(result: StaticResults) -> tuple[Indicator, ...]:
    """Of each loaded place the stiffness along the force, of probes that along X, Y and Z."""
    found: dict[str, Indicator] = {}
    for one in (*_places(result), *_cartesian(result.cartesian), *_twists(result)):
        found.setdefault(one.name, one)
    return tuple(found.values())


def named(direction: Array) -> str:
    """`X`, or the unit vector of a direction that is along no axis; the sense of a force is no other direction."""
    unit = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    for axis, along in DIRECTIONS.items():
        if np.linalg.norm(np.cross(unit, along)) < _ALONG:
            return axis
    unit = unit * (np.sign(unit[np.flatnonzero(np.abs(unit) > _ALONG)[0]]))
    return "({:.2f} {:.2f} {:.2f})".format(*(unit + 0.0))


def _inverse(name: str, compliance: float, u: float) -> Iterator[Indicator]:
    if isfinite(compliance) and compliance > 0:
        yield Indicator(name, KINDS["stiffness"], 1 / compliance, u / compliance**2 if isfinite(u) else inf)


def _places(result: StaticResults) -> Iterator[Indicator]:
    several = len({tuple(place.commands.items()) for place in result.places}) > 1
    for number, place in enumerate(result.places, 1):
        if place.line is not None and place.along:
            where = f" at place {number}" if several else ""
            slope = place.line.compliance
            yield from _inverse(f"stiffness {named(place.direction)}{where}", slope.value, _u(slope))


def _cartesian(found: Cartesian | None) -> Iterator[Indicator]:
    if found is None:
        return
    for k, axis in enumerate(DIRECTIONS):
        variance = float(found.compliance.scatter[4 * k, 4 * k])
        u = sqrt(variance) if variance >= 0 else inf
        yield from _inverse(f"stiffness {axis}", float(found.compliance.compliance[k, k]), u)


def _twists(result: StaticResults) -> Iterator[Indicator]:
    """What a sensor frame shows along the force."""
    for place in result.twist_places:
        unit = place.direction / np.linalg.norm(place.direction)
        if named(unit) in DIRECTIONS:
            k = int(np.abs(unit).argmax())
            slope = place.compliance[k]
            yield from _inverse(f"stiffness {named(unit)}", float(unit[k]) * slope.value, _u(slope))


def _u(slope: Estimate) -> float:
    return float(slope.standard_uncertainty)
