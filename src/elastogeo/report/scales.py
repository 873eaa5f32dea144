"""In which units deviations of an axis are shown: micrometres or seconds of arc, over millimetres or degrees (ISO 230-2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.machine import ErrorTable
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty

ARCSEC = 180 * 3600 / np.pi
"""Seconds of arc in a radian."""


@dataclass(frozen=True, slots=True)
class Scale:
    """How deviations over positions are shown.

    Attributes
    ----------
    unit, place_unit : str
        As they are printed.
    key, place_key : str
        The same in a document.
    factor, place_factor : float
        From the unit of the house.
    """

    unit: str
    key: str
    factor: float
    place_unit: str
    place_key: str
    place_factor: float


def scale_for(angular: bool, rotary: bool) -> Scale:
    """The units of deviations that are angles or lengths, over positions that are angles or lengths."""
    deviation = ("″", "arcsec", float(ARCSEC)) if angular else ("µm", "um", 1000.0)
    return Scale(*deviation, *(("°", "deg", 180 / np.pi) if rotary else ("mm", "mm", 1.0)))


def scale_of(table: ErrorTable) -> Scale:
    """The units of an error table."""
    return scale_for(table.is_angular, table.is_rotary)


def said(value: float, angular: bool, digits: int = 3) -> str:
    """A deviation with its unit."""
    shown = scale_for(angular, False)
    return pretty(f"{significant(value * shown.factor, digits)} {shown.unit}")


def said_with(value: float, uncertainty: float, angular: bool) -> str:
    """A deviation as `value ± U`, with its unit."""
    shown = scale_for(angular, False)
    return pretty(f"{value_with_uncertainty(value * shown.factor, uncertainty * shown.factor)} {shown.unit}")
