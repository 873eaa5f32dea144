"""Of a ball-roller test: the collinear stiffness of its plane, by direction."""

from __future__ import annotations

from math import inf, isfinite

import numpy as np

from elastogeo.changes.indicators.register import indicates
from elastogeo.changes.kinds import KINDS
from elastogeo.changes.series import Indicator
from elastogeo.identification import Stiffness, StiffnessMap

DEGREES = (0, 45, 90, 135)
"""Directions in the plane of the test, from its first axis: both axes and both diagonals."""

_FARTHEST = np.deg2rad(15.0)
"""From a direction to the nearest that was measured."""


@indicates(StiffnessMap)
def of_a_ball_roller_test(result: StiffnessMap) -> tuple[Indicator, ...]:
    """Stiffness along the axes of the plane and along its diagonals: of force and its opposite, which are one direction."""
    found = (_along(result.overall, degrees) for degrees in DEGREES)
    return tuple(one for one in found if one is not None)


def _along(stiffness: Stiffness, degrees: float) -> Indicator | None:
    """The mean compliance of the measured directions nearest to this one and to its opposite."""
    near = []
    for direction in np.deg2rad((degrees, degrees + 180.0)):
        away = np.abs(np.angle(np.exp(1j * (stiffness.angle - direction))))
        nearest = int(away.argmin())
        if away[nearest] <= _FARTHEST and isfinite(stiffness.compliance[nearest]):
            near.append(nearest)
    if not near:
        return None
    compliance, u = float(stiffness.compliance[near].mean()), float(stiffness.scatter[near].max())
    if compliance <= 0:
        return None
    return Indicator(
        f"stiffness at {degrees:g} deg", KINDS["stiffness"], 1 / compliance, u / compliance**2 if isfinite(u) else inf
    )
