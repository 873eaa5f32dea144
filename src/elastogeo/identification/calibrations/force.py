"""The force of a bar against its pressure, from readings of a load cell."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from elastogeo.estimate import Estimate, Solution, effective_degrees_of_freedom
from elastogeo.identification.calibrations.readings import SIGNIFICANT, checked_pairs, explained_by_chance, line, ways
from elastogeo.identification.check import Check
from elastogeo.machine import Array
from elastogeo.observe import Calibration

LINE, WAYS = "force on a straight line", "same force rising and falling"


@dataclass(frozen=True, slots=True, eq=False)
class ForceCalibration:
    """A force calibration.

    Attributes
    ----------
    slope : Estimate [N/bar]
        With the load cell's own uncertainty, as the offset.
    offset : Estimate [N]
        Force at no pressure, by the straight line; negative where friction takes it.
    correlation : float
        Of slope and offset, from the scatter.
    residual_std : float [N]
        Estimated standard deviation of one reading about the line.
    nonlinearity : float [N]
        Greatest distance of a reading from the line.
    pressure, force, residual : array, shape (m,) [bar, N, N]
        The readings, and what the line leaves of them.
    calibration : Calibration
        What a test takes: the line, or the table of its levels where no straight line goes through the readings.
    verdict : tuple of Check
    """

    slope: Estimate
    offset: Estimate
    correlation: float
    residual_std: float
    nonlinearity: float
    pressure: Array
    force: Array
    residual: Array
    calibration: Calibration
    verdict: tuple[Check, ...]

    @property
    def is_line(self) -> bool:
        """Whether the calibration is the straight line."""
        return len(self.calibration.pressure) == 2


def calibrate_force(
    pressure: Array, force: Array, relative: float = 0.0, relative_degrees_of_freedom: float = inf
) -> ForceCalibration:
    """Force calibration from a load cell's readings: the straight line, or a table where the readings bend.

    Parameters
    ----------
    pressure : array, shape (m,) [bar]
        In the order in which they were set; rising and falling, several times each, shows most.
    force : array, shape (m,) [N]
        Positive where the bar pushes.
    relative : float
        Relative standard uncertainty of the load cell, from its certificate: one for all readings.
    relative_degrees_of_freedom : float

    Notes
    -----
    Ordinary least squares (JCGM 100, H.3): the readings scatter independently, the pressure counts as exact. Slope and
    offset are correlated; the load cell stretches both together. **The scatter is that of the day of the calibration**:
    what changes until the test (friction, temperature, the gauge's zero) is not in it.

    Raises
    ------
    InputError
        If the arrays do not fit together, or hold a value that is no finite number.
    UnsupportedError
        If there are fewer than four readings, or one pressure only.
    """
    pressure, force = checked_pairs(pressure, force, "force", 4)
    columns = (np.ones_like(pressure), pressure)
    found = line(columns, ("offset", "slope"), force)
    residual = force - found.values[0] - found.values[1] * pressure
    size = float(np.abs(force).max())
    bend = explained_by_chance(residual, columns, (pressure - pressure.mean()) ** 2, size)
    straight = bend >= SIGNIFICANT
    made = _line_of(pressure, found) if straight else _table_of(pressure, force)
    cell = np.array([relative, relative_degrees_of_freedom])
    offset, slope = (_with_load_cell(estimate, *cell) for estimate in found.estimates())
    scatter = np.sqrt(np.diag(found.covariance))
    greatest = float(np.abs(residual).max())
    facts = {"p_value": bend, "nonlinearity": greatest, "force": size, "levels": len(made.pressure)}
    return ForceCalibration(
        slope=slope,
        offset=offset,
        correlation=float(found.covariance[0, 1] / (scatter[0] * scatter[1])) if scatter.all() else 0.0,
        residual_std=found.residual_std,
        nonlinearity=greatest,
        pressure=pressure,
        force=force,
        residual=residual,
        calibration=Calibration(
            made.pressure,
            made.force,
            made.standard_uncertainty,
            made.correlation,
            made.degrees_of_freedom,
            relative,
            relative_degrees_of_freedom,
        ),
        verdict=(Check(LINE, straight, facts), _same_both_ways(pressure, residual, columns, size)),
    )


def _line_of(pressure: Array, found: Solution) -> Calibration:
    """The line as the forces at its two ends, with their covariance."""
    ends = (float(pressure.min()), float(pressure.max()))
    at_ends = np.array([[1.0, end] for end in ends])
    force, covariance = at_ends @ found.values, at_ends @ found.covariance @ at_ends.T
    u = np.sqrt(np.diag(covariance))
    return Calibration(
        ends,
        (float(force[0]), float(force[1])),
        (float(u[0]), float(u[1])),
        float(covariance[0, 1] / (u[0] * u[1])) if u.all() else 0.0,
        float(found.degrees_of_freedom.min()),
    )


def _table_of(pressure: Array, force: Array) -> Calibration:
    """The mean force of each pressure; the scatter is that of the repeats, else that about a parabola."""
    levels, which, counts = np.unique(pressure, return_inverse=True, return_counts=True)
    means = np.bincount(which, force) / counts
    freedom = len(force) - len(levels)
    if freedom:
        left = force - means[which]
    else:
        powers = (np.ones_like(pressure), pressure, pressure**2)
        freedom = len(force) - len(powers)
        left = force - np.column_stack(powers) @ line(powers, ("offset", "slope", "bend"), force).values
    std = float(np.sqrt(left @ left / freedom))
    return Calibration(
        tuple(map(float, levels)),
        tuple(map(float, means)),
        tuple(float(std / np.sqrt(n)) for n in counts),
        0.0,
        float(freedom),
    )


def _with_load_cell(estimate: Estimate, relative: float, freedom: float) -> Estimate:
    """An estimate with the load cell's scale in its uncertainty (JCGM 100, G.4)."""
    parts = np.array([[estimate.standard_uncertainty, relative * abs(estimate.value)]])
    together = float(np.hypot(*parts[0]))
    if not relative or not together:
        return estimate
    degrees = effective_degrees_of_freedom(parts, np.array([[estimate.degrees_of_freedom, freedom]]))
    return Estimate(estimate.value, together, float(degrees[0]))


def _same_both_ways(pressure: Array, residual: Array, columns: tuple[Array, Array], size: float) -> Check:
    """Whether the readings of rising and of falling pressure lie on one line: friction of the cylinder sets them apart."""
    way = ways(pressure)
    if not (way > 0).any() or not (way < 0).any():
        return Check(WAYS, None, {"why": "one way", "rising": int((way > 0).sum()), "falling": int((way < 0).sum())})
    p_value = explained_by_chance(residual, columns, way, size)
    apart = float(residual[way > 0].mean() - residual[way < 0].mean())
    return Check(WAYS, p_value >= SIGNIFICANT, {"p_value": p_value, "rising_minus_falling": apart})
