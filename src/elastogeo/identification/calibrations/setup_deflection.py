"""How far the set-up itself gives way under the bar: the post of the workpiece ball against pressure (Eq. 5.38)."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Estimate, effective_degrees_of_freedom
from elastogeo.identification.calibrations.readings import SIGNIFICANT, checked_pairs, explained_by_chance, line
from elastogeo.identification.check import Check
from elastogeo.machine import Array

LINE = "deflection in proportion to the pressure"


@dataclass(frozen=True, slots=True, eq=False)
class SetupDeflection:
    """The set-up's own compliance.

    Attributes
    ----------
    per_pressure : Estimate [mm/bar]
        Deflection of the workpiece ball along a horizontal bar, per pressure.
    zero : Estimate [mm]
        Reading of the dial without pressure.
    residual_std : float [mm]
        Estimated standard deviation of one reading.
    pressure, deflection, residual : array, shape (m,) [bar, mm, mm]
    verdict : tuple of Check
    """

    per_pressure: Estimate
    zero: Estimate
    residual_std: float
    pressure: Array
    deflection: Array
    residual: Array
    verdict: tuple[Check, ...]


def calibrate_setup(
    pressure: Array,
    deflection: Array,
    elevation: Array | float = 0.0,
    relative: float = 0.0,
    relative_degrees_of_freedom: float = inf,
) -> SetupDeflection:
    """Compliance of a set-up from dial readings at the workpiece ball.

    Parameters
    ----------
    pressure : array, shape (m,) [bar]
    deflection : array, shape (m,) [mm]
        Along the bar's axis, positive away from the tool; the zero of the dial is found with it.
    elevation : float or array, shape (m,) [rad]
        Of the bar over the horizontal plane.
    relative : float
        Relative standard uncertainty of the dial, one for all readings.
    relative_degrees_of_freedom : float

    Notes
    -----
    Eq. 5.38: `delta = c P cos^2(elevation)`, by ordinary least squares with a constant. **It is the set-up's, not the
    machine's**: fix the dial to the table beside the post, not to the machine's frame.

    Raises
    ------
    InputError
        If the arrays do not fit together, hold a value that is no finite number, or the bar stands upright throughout.
    UnsupportedError
        If there are fewer than four readings, or one pressure only.
    """
    pressure, deflection = checked_pairs(pressure, deflection, "deflection", 4)
    across = np.broadcast_to(np.cos(np.asarray(elevation, dtype=float)) ** 2, pressure.shape)
    if not np.isfinite(across).all() or float(across.max()) < 1e-6:
        raise InputError("the bar stands upright at every reading, where its post does not bend; read at a lower elevation")
    columns = (np.ones_like(pressure), pressure * across)
    found = line(columns, ("zero", "per pressure"), deflection)
    residual = deflection - np.column_stack(columns) @ found.values
    zero, slope = found.estimates()
    bend = explained_by_chance(residual, columns, columns[1] ** 2, float(np.abs(deflection).max()))
    parts = np.array([[slope.standard_uncertainty, relative * abs(slope.value)]])
    if relative and parts.any():
        degrees = effective_degrees_of_freedom(parts, np.array([[slope.degrees_of_freedom, relative_degrees_of_freedom]]))
        slope = Estimate(slope.value, float(np.hypot(*parts[0])), float(degrees[0]))
    facts = {"p_value": bend, "greatest": float(np.abs(residual).max()), "deflection": float(np.ptp(deflection))}
    verdict = (Check(LINE, bend >= SIGNIFICANT, facts),)
    return SetupDeflection(slope, zero, found.residual_std, pressure, deflection, residual, verdict)
