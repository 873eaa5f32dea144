"""The straight line of displacement against force."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate, factor_blocks
from elastogeo.identification.static_tests.by_run import Counted, solved_by_run
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
    readings : int
    counted : Counted
        What the uncertainties assume; without runs enough they are infinite.
    """

    compliance: Estimate
    offset: Estimate
    residual_std: float
    nonlinearity: float
    readings: int
    counted: Counted

    def stiffness(self) -> Estimate:
        """Inverse of the compliance [N/mm], with its uncertainty to first order.

        Raises
        ------
        UnsupportedError
            If the compliance may as well be zero: its inverse is then unbounded.
        """
        return self.compliance.inverse()


def static_line(force: Array, displacement: Array, run: Sequence[str | int] | None = None) -> StaticLine:
    """Compliance from loads that need not come back: the straight line through the readings (weights on a rig, Figure 6.11).

    Parameters
    ----------
    force : array, shape (m,) [N]
        Along its direction; two levels at least.
    displacement : array, shape (m,) [mm]
    run : sequence, length m, optional
        Which run each reading is of; by default all are of one. A weight that is put on anew for each reading makes each a
        run.

    Notes
    -----
    Ordinary least squares; the uncertainty is that of the scatter between runs, infinite where they are too few for one. The
    force counts as exact. **It does not see hysteresis.**

    Raises
    ------
    InputError
        If the arrays do not fit together, or hold a value that is no finite number.
    UnsupportedError
        If the force has one level only, or there are fewer than three readings.
    """
    force, displacement = checked_loading(force, displacement)
    of = np.zeros(len(force)) if run is None else np.unique(np.asarray(run), return_inverse=True)[1]
    if len(of) != len(force):
        raise InputError(f"{len(force)} readings need the run of each, got {len(of)}")
    rows = np.column_stack([np.ones_like(force), force, displacement])
    labels = ("offset", "compliance")
    runs = [factor_blocks(labels, [np.asfortranarray(rows[of == k])]) for k in range(int(of.max()) + 1)]
    found, counted = solved_by_run(runs, labels)
    offset, slope = found.estimates()
    left = displacement - offset.value - slope.value * force
    return StaticLine(slope, offset, found.residual_std, float(np.abs(left).max()), len(force), counted)


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
