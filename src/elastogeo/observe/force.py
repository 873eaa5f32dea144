"""From the pressure in a loaded ball bar to its force."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Forces, Pressures


@dataclass(frozen=True, slots=True)
class Calibration:
    """Force against pressure, as calibrated points joined by straight lines.

    Two points are a calibration line, which also holds beyond them; with more, only what lies between them is known.

    Attributes
    ----------
    pressure : tuple of float [bar]
        Increasing.
    force : tuple of float [N]
    """

    pressure: Pressures
    force: Forces

    def __post_init__(self) -> None:
        """Refuse a table that is no calibration."""
        if len(self.pressure) != len(self.force) or len(self.pressure) < 2:
            raise InputError(
                f"a force calibration needs at least two pressures with a force each, got {len(self.pressure)} pressures "
                f"and {len(self.force)} forces"
            )
        if any(b <= a for a, b in pairwise(self.pressure)):
            raise InputError(f"the pressures of a force calibration must increase, got {self.pressure}")


THESIS_CALIBRATION = Calibration((1.0, 6.0), (112.0, 742.0))
"""1 to 6 bar, 112 to 742 N (thesis, 4.6): 126 N/bar and an offset of -14 N."""


def force_from_pressure(pressure: float, calibration: Calibration = THESIS_CALIBRATION) -> float:
    """Force [N] of the bar at a pressure [bar].

    Raises
    ------
    InputError
        If the pressure lies outside a calibration table of more than two points.
    """
    pressures, forces = calibration.pressure, calibration.force
    if len(pressures) == 2:
        slope = (forces[1] - forces[0]) / (pressures[1] - pressures[0])
        return forces[0] + slope * (pressure - pressures[0])
    if not pressures[0] <= pressure <= pressures[-1]:
        raise InputError(
            f"a pressure of {pressure:g} bar lies outside the force calibration, {pressures[0]:g} to {pressures[-1]:g} bar; "
            f"extend the table or give the force of the run"
        )
    return float(np.interp(pressure, pressures, forces))
