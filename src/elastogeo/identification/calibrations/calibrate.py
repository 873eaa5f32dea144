"""One door to every calibration: what is calibrated follows from what the readings hold."""

from __future__ import annotations

from collections.abc import Mapping

from elastogeo.errors import InputError
from elastogeo.identification.calibrations.bar import BarCalibration, calibrate_bar
from elastogeo.identification.calibrations.indicator_test import ENGAGEMENT, IndicatorTest, indicator_test
from elastogeo.machine import Array


def calibrate(
    *readings: Mapping[str, Array],
    load_cell: float = 0.0,
    dial: float = 0.0,
    elevation: float = 0.0,
    resolution: float = 0.0,
) -> BarCalibration | IndicatorTest:
    """Calibrate a bar that is pushed by a pressure, and its set-up; or the set-up of a ball-roller device.

    Parameters
    ----------
    *readings : mapping of str to array, shape (m,)
        Of a bar: `pressure` [bar] with `force` [N] of the load cell, or with `displacement` [mm] of a dial at the workpiece
        ball, positive away from the tool. Of a ball-roller device: `engagement` [mm] that the encoders command, `force` [N],
        `ball` and `roller` [mm], how far dials show each to give way. `read_run("dial.csv").columns`.
    load_cell, dial : float
        Relative standard uncertainty of the force and of the dials' scale, from their certificates.
    elevation : float [rad]
        Of the bar over the horizontal plane while the dial was read.
    resolution : float [mm]
        Of the dials of a ball-roller device.

    Returns
    -------
    BarCalibration or IndicatorTest

    Raises
    ------
    InputError
        If readings hold neither, or more than one of a kind.
    UnsupportedError
        If there are too few readings of a kind, or all at one pressure or engagement.
    """
    if not any(ENGAGEMENT in columns for columns in readings):
        return calibrate_bar(*readings, load_cell=load_cell, dial=dial, elevation=elevation)
    if len(readings) > 1:
        raise InputError(
            f"{len(readings)} sets of readings, one of them of an indicator test, which stands alone; put repeated readings "
            f"of it into one file"
        )
    return indicator_test(readings[0], resolution, dial, load_cell)
