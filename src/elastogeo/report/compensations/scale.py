"""In which units an error table is shown: micrometres or seconds of arc, over millimetres or degrees."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.machine import ErrorTable
from elastogeo.report.numbers import pretty, significant, value_with_uncertainty

ARCSEC = 180 * 3600 / np.pi


@dataclass(frozen=True, slots=True)
class Scale:
    """How an error table is shown.

    Attributes
    ----------
    unit, place_unit : str
        As they are printed.
    factor, place_factor : float
        From the unit of the house.
    """

    unit: str
    factor: float
    place_unit: str
    place_factor: float


def scale_of(table: ErrorTable) -> Scale:
    """The units of a table."""
    return scale(table.is_angular, table.is_rotary)


def scale(angular: bool, rotary: bool) -> Scale:
    """The units of values that are angles or lengths, over positions that are angles or lengths."""
    unit, factor = ("″", float(ARCSEC)) if angular else ("µm", 1000.0)
    return Scale(unit, factor, *(("°", 180 / np.pi) if rotary else ("mm", 1.0)))


def said(value: float, angular: bool, digits: int = 3) -> str:
    """A deviation with its unit."""
    shown = scale(angular, False)
    return pretty(f"{significant(value * shown.factor, digits)} {shown.unit}")


def said_with(value: float, uncertainty: float, angular: bool) -> str:
    """A deviation as `value ± U`, with its unit."""
    shown = scale(angular, False)
    return pretty(f"{value_with_uncertainty(value * shown.factor, uncertainty * shown.factor)} {shown.unit}")
