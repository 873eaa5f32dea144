"""What a control can make good: error tables with their uncertainty, what of them is written, what is left after it."""

from elastogeo.prediction.compensation.compensate import compensate
from elastogeo.prediction.compensation.parts import ErrorPart, FoundError
from elastogeo.prediction.compensation.result import CompensatedError, Compensation, LeftOut

__all__ = ["CompensatedError", "Compensation", "ErrorPart", "FoundError", "LeftOut", "compensate"]
