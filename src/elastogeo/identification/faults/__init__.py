"""What a person asks of a test beside its parameters: ranked faults, ISO 230-4 parameters, what-if, what changed.

Stands on the files of `identification` and the rooms below it.
"""

from elastogeo.identification.faults.circularity import Circularity, circularity
from elastogeo.identification.faults.comparison import (
    BeforeAfter,
    Determined,
    Difference,
    compare,
    determined,
    differences_of,
    in_common,
    unchanged,
)
from elastogeo.identification.faults.diagnosis import Diagnosis, Fault, diagnose
from elastogeo.identification.faults.what_if import WhatIf, what_if

__all__ = [
    "BeforeAfter",
    "Circularity",
    "Determined",
    "Diagnosis",
    "Difference",
    "Fault",
    "WhatIf",
    "circularity",
    "compare",
    "determined",
    "diagnose",
    "differences_of",
    "in_common",
    "unchanged",
    "what_if",
]
