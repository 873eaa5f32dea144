"""What a control can compensate: error tables with their uncertainty, what of them is written, what is left after it.

Stands on the files of `prediction`, and on its wing `paths`: a corrected program is a path with its points moved.
"""

from elastogeo.prediction.compensation.along_path import compensate_path
from elastogeo.prediction.compensation.compensate import compensate
from elastogeo.prediction.compensation.in_volume import InVolume
from elastogeo.prediction.compensation.parts import ErrorPart, FoundError
from elastogeo.prediction.compensation.result import CompensatedError, Compensation, LeftOut, PathCompensation

__all__ = [
    "CompensatedError",
    "Compensation",
    "ErrorPart",
    "FoundError",
    "InVolume",
    "LeftOut",
    "PathCompensation",
    "compensate",
    "compensate_path",
]
