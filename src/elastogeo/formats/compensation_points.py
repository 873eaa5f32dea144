"""At which points a table is written: as many as a control takes, evenly spaced where it asks for that."""

from __future__ import annotations

from math import ceil, floor, log10

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import ROTARY, Array, ErrorTable

BETWEEN = 4
"""Points to each step between two targets, where the spacing is left to the program: what lies between two is then a few
per cent of what lies between two targets."""

_STEPS = (1.0, 2.0, 5.0, 10.0)
_WHOLE = 1e-9


def even_points(table: ErrorTable, most: int, step: float | None, unit: float = 1.0) -> Array:
    """Evenly spaced positions, multiples of the step, that hold the whole table, in the unit of the control.

    Parameters
    ----------
    table : ErrorTable
    most : int
        That the control takes.
    step : float or None
        In the unit of the control; None for a round one (1, 2 or 5 times a power of ten) of about a quarter of the space
        between the targets, or as small as the control takes.
    unit : float
        Of the house in the unit of the control: 57.3 for degrees.

    Raises
    ------
    InputError
        If the step is not positive, or too small for the points that the control takes.
    """
    low, high = (end * unit for end in table.span)
    if step is None:
        step = _round_step(max((high - low) / max(BETWEEN * (len(table.position) - 1), 1), (high - low) / max(most - 3, 1)))
    if not step > 0:
        raise InputError(f"{table.name}: the step between points is {step:g}; it must be positive")
    first, last = floor(low / step + _WHOLE), ceil(high / step - _WHOLE)
    count = last - first + 1
    if count > most:
        raise InputError(
            f"{table.name}: {low:g} to {high:g} at a step of {step:g} takes {count} points, and the control has {most}; "
            f"choose a step of {_round_step((high - low) / max(most - 3, 1)):g}"
        )
    return np.arange(first, last + 1, dtype=float) * step


def degrees_or_mm(letter: str) -> float:
    """The unit of the house in that of most controls, of an axis or a component: degrees in a radian, or 1 for mm."""
    return 180 / np.pi if letter in ROTARY else 1.0


def _round_step(least: float) -> float:
    if least <= 0:
        return 1.0
    power = 10.0 ** floor(log10(least))
    return float(next(power * one for one in _STEPS if power * one >= least * (1 - _WHOLE)))


def thinned(table: ErrorTable, most: int) -> Array:
    """The positions of a table, or so many of them, evenly chosen, as a control takes."""
    if len(table.position) <= most:
        return table.position
    return np.asarray(table.position[np.unique(np.linspace(0, len(table.position) - 1, most).round().astype(int))])
