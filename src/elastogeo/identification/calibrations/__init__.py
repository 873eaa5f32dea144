"""Calibrations of an instrument: force against pressure, the set-up's deflection, indicators. Stands on `observe`."""

from elastogeo.identification.calibrations.bar import BarCalibration, calibrate_bar
from elastogeo.identification.calibrations.calibrate import calibrate
from elastogeo.identification.calibrations.force import ForceCalibration, calibrate_force
from elastogeo.identification.calibrations.indicator_test import IndicatorTest, Spring, indicator_test
from elastogeo.identification.calibrations.setup_deflection import SetupDeflection, calibrate_setup

__all__ = [
    "BarCalibration",
    "ForceCalibration",
    "IndicatorTest",
    "SetupDeflection",
    "Spring",
    "calibrate",
    "calibrate_bar",
    "calibrate_force",
    "calibrate_setup",
    "indicator_test",
]
