"""The values of ISO 230-2: from the deviations at each target, by direction of approach, to A, E, R, B and M.

The formulas are those of ISO 230-2:2014, clauses 3 and 5, as the literature has them; its own text was not seen.
Everything is a pure function of targets, directions and deviations, in the unit of the deviations.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array

Numbers = np.ndarray[tuple[int, ...], np.dtype[np.intp]]
"""Whole numbers by reading, shape (m,)."""

NAMES = ("B", "mean B", "M", "E+", "E-", "E", "R+", "R-", "R", "A+", "A-", "A")
"""Reversal and its mean, mean deviation of both sides, systematic deviation, repeatability, accuracy; + and - by side."""

FEWEST = 2
"""Approaches of a target from one side from which they have a scatter."""


@dataclass(frozen=True, slots=True)
class ByTarget:
    """What was read at t targets, by direction of approach: first column +, second -.

    Attributes
    ----------
    target : array, shape (t,) [mm or rad]
        Increasing.
    count : array, shape (t, 2)
        Readings.
    mean : array, shape (t, 2) [mm or rad]
        Mean unidirectional deviation; NaN where there is no reading.
    deviation : array, shape (t, 2) [mm or rad]
        Standard deviation about it, with n - 1; NaN with less than two readings.
    """

    target: Array
    count: Array
    mean: Array
    deviation: Array

    @property
    def reversal(self) -> Array:
        """Reversal value B_i of each target, shape (t,); NaN where it was not approached from both sides."""
        return np.asarray(self.mean[:, 0] - self.mean[:, 1])

    @property
    def middle(self) -> Array:
        """Mean bidirectional deviation of each target, shape (t,); NaN where it was not approached from both sides."""
        return np.asarray(self.mean.mean(axis=1))

    @property
    def repeatability(self) -> Array:
        """Bidirectional repeatability R_i of each target, shape (t,); NaN where it is not known."""
        both = 2 * self.deviation.sum(axis=1) + np.abs(self.reversal)
        return np.asarray(np.maximum(both, 4 * self.deviation.max(axis=1)))


def by_target(target: Array, sense: Array, reading: Array) -> ByTarget:
    """Readings gathered by target and direction.

    Parameters
    ----------
    target : array, shape (m,) [mm or rad]
        Equal ones are one target.
    sense : array, shape (m,)
        +1, -1: the direction of approach.
    reading : array, shape (m,) [mm or rad]
        Deviations.
    """
    targets, place = np.unique(target, return_inverse=True)
    side = (sense < 0).astype(int)
    shape = (len(targets), 2)
    count, total, squares = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    np.add.at(count, (place, side), 1.0)
    np.add.at(total, (place, side), reading)
    mean = np.divide(total, count, out=np.full(shape, np.nan), where=count > 0)
    np.add.at(squares, (place, side), (reading - mean[place, side]) ** 2)
    variance = np.divide(squares, count - 1, out=np.full(shape, np.nan), where=count >= FEWEST)
    return ByTarget(targets, count, mean, np.sqrt(variance))


def standard_values(found: ByTarget) -> dict[str, float]:
    """The values of ISO 230-2 that the readings give, by name; what takes another side or a scatter is left out.

    Only targets count that have what a value needs: E+ all that were approached in the positive direction.
    """
    mean, spread = found.mean, 2 * found.deviation
    values: dict[str, float] = {}
    reversal, middle = _known(found.reversal), _known(found.middle)
    if len(reversal):
        values |= {
            "B": float(np.abs(reversal).max()),
            "mean B": float(reversal.mean()),
            "M": float(np.ptp(middle)),
            "E": float(np.nanmax(mean) - np.nanmin(mean)),
        }
    for k, sign in enumerate("+-"):
        here = _known(mean[:, k])
        if len(here):
            values[f"E{sign}"] = float(np.ptp(here))
        if len(_known(spread[:, k])):
            values[f"R{sign}"] = 2 * float(np.nanmax(spread[:, k]))
            values[f"A{sign}"] = float(np.nanmax((mean + spread)[:, k]) - np.nanmin((mean - spread)[:, k]))
    both = _known(found.repeatability)
    if len(both):
        values["R"] = float(both.max())
        values["A"] = float(np.nanmax(mean + spread) - np.nanmin(mean - spread))
    return {name: values[name] for name in NAMES if name in values}


def _known(values: Array) -> Array:
    return values[~np.isnan(values)]
