"""What the sensor of a positioning test reads, as deviations, and what no such sensor reads."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array
from elastogeo.observe.run import Run

MOST_OFF = 0.1
"""By how much the positions per command may differ from one, and a deviation from the span of the targets."""

MOST_ROTATION = 0.1
"""Angular deviation [rad] of an axis: more is a wrong unit."""


def deviations(run: Run, columns: Mapping[str, Array], along: Array | None) -> Array:
    """What each reading is off, shape (m,) [mm or rad], in the sensitive direction: the x_ij of ISO 230-2, from any zero.

    Parameters
    ----------
    run : Run
    columns : mapping of str to array, shape (m,)
        `target`, and `position` or `deviation`.
    along : array, shape (m,), or None
        How much of the command the sensor reads; None if it does not read along the axis.

    Raises
    ------
    InputError
        If there is neither or both, positions are read across the axis, or they do not follow the targets.
    """
    read = [name for name in ("position", "deviation") if name in columns]
    if len(read) != 1:
        said = "both position and deviation; leave one out" if read else "neither a position nor a deviation; record one"
        raise InputError(f"run {run.name!r} has {said}")
    if read == ["deviation"]:
        return columns["deviation"]
    if along is None:
        raise InputError(
            f"run {run.name!r} gives positions, but its sensor does not read along the axis; call the column deviation_um "
            f"(deviation_arcsec for an angle)"
        )
    position, nominal = columns["position"], along * columns["target"]
    wide = float(np.sum((nominal - nominal.mean()) ** 2))
    if wide:
        slope = float(np.sum((nominal - nominal.mean()) * (position - position.mean()))) / wide
        if slope < 0:
            raise InputError(
                f"run {run.name!r}: the positions fall while the targets grow; the sensor counts the other way: give its "
                f"direction, or turn the sign of the positions"
            )
        if abs(slope - 1) > MOST_OFF:
            raise InputError(
                f"run {run.name!r}: the positions change by {slope:.4g} per unit of the target; look at the units of both, "
                f"and whether these are deviations"
            )
    return np.asarray(position - nominal)


def check_readings(run: Run, target: Array, reading: Array, *, angular: bool) -> None:
    """Refuse deviations of a size that only a wrong unit gives.

    Raises
    ------
    InputError
        If they span more than `MOST_OFF` of the targets, or `MOST_ROTATION` of an angle.
    """
    spread, span = float(np.ptp(reading)), float(np.ptp(target))
    if angular and spread > MOST_ROTATION:
        raise InputError(
            f"run {run.name!r}: the deviations span {spread:.3g} rad; are they arcseconds or microradians given as radians?"
        )
    if not angular and span and spread > max(MOST_OFF * span, 1.0):
        raise InputError(
            f"run {run.name!r}: the deviations span {spread:.4g} mm over targets that span {span:.4g}; are they micrometres "
            f"given as millimetres, or positions given as deviations?"
        )
