"""Calibrations of an instrument: force against pressure, deflection of the set-up. Stands on `observe`."""

from elastogeo.identification.calibrations.bar import BarCalibration, calibrate
from elastogeo.identification.calibrations.force import ForceCalibration, calibrate_force
from elastogeo.identification.calibrations.setup_deflection import SetupDeflection, calibrate_setup

__all__ = ["BarCalibration", "ForceCalibration", "SetupDeflection", "calibrate", "calibrate_force", "calibrate_setup"]
