"""The straight line of displacement against force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate, factor_blocks, solve
from elastogeo.machine import Array

_ONE_LEVEL = 1e-9
"""Share of its size by which a force must change to be more than one level."""


@dataclass(frozen=True, slots=True)
class StaticLine:
    """A straight line through displacements against forces.

    Attributes
    ----------
    compliance : Estimate [mm/N]
        Its slope.
    offset : Estimate [mm]
        Displacement at zero force.
    residual_std : float [mm]
        Estimated standard deviation of one reading about the line.
    nonlinearity : float [mm]
        Greatest distance of a reading from the line.
    """

    compliance: Estimate
    offset: Estimate
    residual_std: float
    nonlinearity: float

    def stiffness(self) -> Estimate:
        """Inverse of the compliance [N/mm], with its uncertainty to first order.

        Raises
        ------
        UnsupportedError
            If the compliance may as well be zero: its inverse is then unbounded.
        """
        return self.compliance.inverse()


def static_line(force: Array, displacement: Array) -> StaticLine:
    """Compliance from loads that need not come back: the straight line through the readings (weights on a rig, Figure 6.11).

    Parameters
    ----------
    force : array, shape (m,) [N]
        Along its direction; two levels at least.
    displacement : array, shape (m,) [mm]

    Notes
    -----
    Ordinary least squares: the readings scatter independently, the force counts as exact. **It does not see hysteresis.**

    Raises
    ------
    InputError
        If the arrays do not fit together, or hold a value that is no finite number.
    UnsupportedError
        If the force has one level only, or there are fewer than three readings.
    """
    force, displacement = checked_loading(force, displacement)
    rows = np.column_stack([np.ones_like(force), force, displacement])
    found = solve(factor_blocks(["offset", "compliance"], [np.asfortranarray(rows)]))
    offset, slope = found.estimates()
    left = displacement - offset.value - slope.value * force
    return StaticLine(slope, offset, found.residual_std, float(np.abs(left).max()))


def checked_loading(force: Array, displacement: Array) -> tuple[Array, Array]:
    """Both as arrays of one length, finite, and of more than one force.

    Raises
    ------
    InputError
        If they do not fit together, or hold a value that is no finite number.
    UnsupportedError
        If the force has one level only, or there are fewer than three readings.
    """
    force, displacement = np.asarray(force, dtype=float), np.asarray(displacement, dtype=float)
    if force.ndim != 1 or force.shape != displacement.shape:
        raise InputError(f"every force needs one displacement: got the shapes {force.shape} and {displacement.shape}")
    for name, values in (("force", force), ("displacement", displacement)):
        if not np.isfinite(values).all():
            row = int(np.flatnonzero(~np.isfinite(values))[0])
            raise InputError(f"the {name} of reading {row + 1} is {values[row]}; take the reading out")
    if len(force) < 3:
        raise UnsupportedError(
            f"{len(force)} readings are too few for a compliance with an uncertainty; take three at least"
        )
    if np.ptp(force) <= _ONE_LEVEL * np.abs(force).max():
        raise UnsupportedError(
            f"the force is {force[0]:g} N at every reading: one level gives no compliance; read at two forces at least"
        )
    return force, displacement
