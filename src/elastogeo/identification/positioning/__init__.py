"""What a positioning test shows by itself: the values of ISO 230-2 with their uncertainty.

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.positioning.assessment import evaluate_positioning
from elastogeo.identification.positioning.result import Contribution, PositioningResults, StandardValue
from elastogeo.identification.positioning.standard import ByTarget, by_target, standard_values

__all__ = [
    "ByTarget",
    "Contribution",
    "PositioningResults",
    "StandardValue",
    "by_target",
    "evaluate_positioning",
    "standard_values",
]
