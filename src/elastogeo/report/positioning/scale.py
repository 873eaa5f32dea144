"""In which unit a positioning test is shown: micrometres, or seconds of arc, as ISO 230-2 has them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.identification import PositioningResults, StandardValue
from elastogeo.report.numbers import pretty, said_estimate, significant

ARCSEC = 180 * 3600 / np.pi
"""Seconds of arc in a radian."""


@dataclass(frozen=True, slots=True)
class Scale:
    """How values are shown.

    Attributes
    ----------
    unit, target_unit : str
        As they are printed.
    key : str
        The unit of the deviations in a document.
    factor, target_factor : float
        From the unit of the house.
    """

    unit: str
    key: str
    factor: float
    target_unit: str
    target_factor: float


def scale_of(found: PositioningResults) -> Scale:
    """The units of a test: of its deviations, and of its targets."""
    unit, key, factor = ("″", "arcsec", float(ARCSEC)) if found.angular else ("µm", "um", 1000.0)
    return Scale(unit, key, factor, *(("°", 180 / np.pi) if found.rotary else ("mm", 1.0)))


def said_value(value: StandardValue, scale: Scale) -> str:
    """A value as `value ± U`; alone, where the cycles show no scatter."""
    if value.estimate is None:
        return pretty(significant(value.value * scale.factor))
    return pretty(said_estimate(value.estimate.scaled(scale.factor)))
