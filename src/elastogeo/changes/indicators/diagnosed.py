"""Of a ball bar without load: how round its circles are, then what the diagnosis of them determines."""

from __future__ import annotations

from collections.abc import Iterator
from math import nan

from elastogeo.changes.indicators.identified import of_an_identification
from elastogeo.changes.indicators.register import indicates
from elastogeo.changes.kinds import KINDS
from elastogeo.changes.series import Indicator
from elastogeo.identification import Diagnosis


@indicates(Diagnosis)
def of_a_diagnosis(result: Diagnosis) -> tuple[Indicator, ...]:
    """Circular deviation at the lowest force, then what the identification says."""
    return (*_circular_deviation(result), *of_an_identification(result.identification))


def _circular_deviation(result: Diagnosis) -> Iterator[Indicator]:
    """Of both directions together, else of the one that was run. **It has no uncertainty of its own** (ISO 230-4)."""
    if not result.circularity:
        return
    found = result.circularity[min(result.circularity, key=abs)]
    known = (found.g_bidirectional, found.g_ccw, found.g_cw)
    value = next((one for one in known if one is not None), None)
    if value is not None:
        yield Indicator("circular deviation", KINDS["circular deviation"], value, nan)
