"""Values of a channel that are no measurement: codes for a missing value, and single samples far beyond all others.

A code is a number that loggers and controls write for a value that they do not have (999999, -32768, 1e30), and that
stands far beyond everything else in its channel. It is taken as what it says: a sample without a number. Any other value
that far out is named and kept: it may be a crash of the machine or of the logger, and only a person can tell.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.machine import Array

FAR = 50.0
"""How far beyond the others a value must stand, in widths of the middle 98 % of the channel."""
LEAST = 20
"""Samples that a channel must have for its middle to be known."""

_POWERS = [2.0**bits for bits in (15, 16, 31, 32)]
_NINES = [10.0**digits - 1 for digits in range(3, 11)]
_CODES = [sign * code for power in _POWERS for code in (power, power - 1) for sign in (1, -1)]
_CODES += [sign * code for code in _NINES for sign in (1, -1)]
_LARGEST = 1e30


@dataclass(frozen=True, slots=True)
class Spikes:
    """What stands far beyond the other values of a channel.

    Attributes
    ----------
    code : array of bool, shape (m,)
        Samples that hold a code for a missing value.
    far : array of bool, shape (m,)
        Other samples as far out.
    """

    code: NDArray[np.bool_]
    far: NDArray[np.bool_]


def spikes(values: Array) -> Spikes:
    """Find what is no measurement in a channel, shape (m,), in the unit of the file; NaN are passed over.

    A channel that stands still but for single samples has no width; there the size of its value, at least one, counts.
    """
    none = np.zeros(len(values), dtype=bool)
    with np.errstate(invalid="ignore"):
        coded = np.isin(values, _CODES) | (np.abs(values) >= _LARGEST)
        others = values[np.isfinite(values) & ~coded]
        if len(others) < LEAST:
            return Spikes(none, none)
        low, middle, high = np.quantile(others, (0.01, 0.5, 0.99))
        out = np.abs(values - middle) > FAR * (high - low or max(abs(middle), 1.0))
    return Spikes(out & coded, out & ~coded)


def sentences(name: str, values: Array, found: Spikes) -> list[str]:
    """What was found in a channel, in words."""
    said = []
    for which, what in (
        (found.code, "a code for a missing value, taken as a sample without a number"),
        (found.far, "far beyond all others, kept: look at it, and cut it away by start_s and end_s if it is no measurement"),
    ):
        if which.any():
            several = np.unique(values[which])
            shown = ", ".join(f"{value:.9g}" for value in several[:3]) + (", ..." if len(several) > 3 else "")
            count = int(which.sum())
            where = int(np.argmax(which)) + 1
            times = "once" if count == 1 else f"{count} times"
            said.append(f"{name}: {shown} stands {times} (first at sample {where}): {what}")
    return said
