"""The calibration of a loaded bar: its force, its set-up, or both, from whatever readings there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from elastogeo.errors import InputError
from elastogeo.identification.calibrations.force import ForceCalibration, calibrate_force
from elastogeo.identification.calibrations.setup_deflection import SetupDeflection, calibrate_setup
from elastogeo.identification.check import Check
from elastogeo.machine import Array
from elastogeo.result import Result

PRESSURE, FORCE, DEFLECTION = "pressure", "force", "displacement"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class BarCalibration(Result):
    """What is known of a bar's force and of its set-up.

    Attributes
    ----------
    force : ForceCalibration or None
    setup : SetupDeflection or None
    """

    force: ForceCalibration | None
    setup: SetupDeflection | None

    @property
    def verdict(self) -> tuple[Check, ...]:
        """The checks of both."""
        return tuple(check for part in (self.force, self.setup) if part is not None for check in part.verdict)


def calibrate_bar(
    *readings: Mapping[str, Array], load_cell: float = 0.0, dial: float = 0.0, elevation: float = 0.0
) -> BarCalibration:
    """Calibrate a bar that is pushed by a pressure: against a load cell, and its set-up against a dial.

    Parameters
    ----------
    *readings : mapping of str to array, shape (m,)
        `pressure` [bar] with `force` [N] of the load cell, or with `displacement` [mm] of a dial at the workpiece ball,
        positive away from the tool: `read_run("load-cell.csv").columns`.
    load_cell, dial : float
        Relative standard uncertainty of the load cell and of the dial, from their certificates.
    elevation : float [rad]
        Of the bar over the horizontal plane while the dial was read.

    Returns
    -------
    BarCalibration

    Raises
    ------
    InputError
        If readings hold neither a force nor a displacement against pressure, or two of them hold the same.
    UnsupportedError
        If there are fewer than four readings of a kind, or one pressure only.
    """
    force: ForceCalibration | None = None
    setup: SetupDeflection | None = None
    for columns in readings:
        if PRESSURE not in columns or (FORCE in columns) == (DEFLECTION in columns):
            raise InputError(
                f"readings of a calibration hold {', '.join(columns) or 'nothing'}; they need pressure_bar, and either "
                f"force_N of a load cell or displacement_um of a dial"
            )
        if FORCE in columns and force is None:
            force = calibrate_force(columns[PRESSURE], columns[FORCE], load_cell)
        elif DEFLECTION in columns and setup is None:
            setup = calibrate_setup(columns[PRESSURE], columns[DEFLECTION], elevation, dial)
        else:
            kind = FORCE if FORCE in columns else DEFLECTION
            raise InputError(f"two sets of readings hold a {kind} against pressure; put them into one, in the order of time")
    if not readings:
        raise InputError("a calibration needs readings: pressure with force, or pressure with displacement")
    return BarCalibration(force, setup)
