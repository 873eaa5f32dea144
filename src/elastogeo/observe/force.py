"""From the pressure in a loaded ball bar to its force, with what is uncertain in it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array, Forces, Pressures
from elastogeo.observe.observations import ObservedInfluence

DISAGREE = 0.05
"""Relative difference, at most, of a force that is given beside a pressure from that of the calibration."""


@dataclass(frozen=True, slots=True)
class ForceInfluence:
    """One independent part of the uncertainty of a force calibration.

    Attributes
    ----------
    label : str
    standard_uncertainty, degrees_of_freedom : float
        Of the influence quantity.
    force : float [N]
        Change of the force at a pressure, per unit of the quantity.
    """

    label: str
    standard_uncertainty: float
    degrees_of_freedom: float
    force: float


@dataclass(frozen=True, slots=True)
class Calibration:
    """Force against pressure, as calibrated points joined by straight lines.

    Two points are a calibration line, which also holds beyond them; with more, only what lies between them is known.

    Attributes
    ----------
    pressure : tuple of float [bar]
        Increasing.
    force : tuple of float [N]
    standard_uncertainty : tuple of float [N]
        Of the force of each point, from the scatter of the calibration; empty if it is not known.
    correlation : float
        Of the two points of a line. The points of a table count as independent.
    degrees_of_freedom : float
        Of these uncertainties.
    relative : float
        Relative standard uncertainty of all forces together: that of the load cell.
    relative_degrees_of_freedom : float
    """

    pressure: Pressures
    force: Forces
    standard_uncertainty: Forces = ()
    correlation: float = 0.0
    degrees_of_freedom: float = inf
    relative: float = 0.0
    relative_degrees_of_freedom: float = inf

    def __post_init__(self) -> None:
        """Refuse a table that is no calibration."""
        if len(self.pressure) != len(self.force) or len(self.pressure) < 2:
            raise InputError(
                f"a force calibration needs at least two pressures with a force each, got {len(self.pressure)} pressures "
                f"and {len(self.force)} forces"
            )
        if any(b <= a for a, b in pairwise(self.pressure)):
            raise InputError(f"the pressures of a force calibration must increase, got {self.pressure}")
        if self.standard_uncertainty and len(self.standard_uncertainty) != len(self.force):
            raise InputError(
                f"a force calibration needs a standard uncertainty for each of its {len(self.force)} forces, got "
                f"{len(self.standard_uncertainty)}"
            )
        if min((*self.standard_uncertainty, self.relative), default=0.0) < 0 or not abs(self.correlation) <= 1:
            raise InputError(
                f"the uncertainties of a force calibration are at least 0 and a correlation lies between -1 and 1, got "
                f"{self.standard_uncertainty}, {self.relative:g} and {self.correlation:g}"
            )

    def weights(self, pressure: float) -> Array:
        """How much each point counts in the force at a pressure [bar], shape (n,).

        Raises
        ------
        InputError
            If the pressure lies outside a table of more than two points.
        """
        low, high = self.pressure[0], self.pressure[-1]
        if len(self.pressure) == 2:
            share = (pressure - low) / (high - low)
            return np.array([1.0 - share, share])
        if not low <= pressure <= high:
            raise InputError(
                f"a pressure of {pressure:g} bar lies outside the force calibration, {low:g} to {high:g} bar; extend the "
                f"table or give the force of the run"
            )
        return np.array([np.interp(pressure, self.pressure, point) for point in np.eye(len(self.pressure))])

    def influences(self, pressure: float | None) -> tuple[ForceInfluence, ...]:
        """What is uncertain in the force at a pressure [bar], as independent parts; none of them acts where it is None."""
        weights = np.zeros(len(self.force)) if pressure is None else self.weights(pressure)
        found = []
        if any(self.standard_uncertainty):
            u = np.array(self.standard_uncertainty)
            correlation = np.eye(len(u))
            if len(u) == 2:
                correlation[0, 1] = correlation[1, 0] = self.correlation
            spreads, vectors = np.linalg.eigh(correlation * np.outer(u, u))
            parts = weights @ (vectors * np.sqrt(np.maximum(spreads, 0.0)))
            found = [ForceInfluence("force calibration", 1.0, self.degrees_of_freedom, float(part)) for part in parts]
        if self.relative:
            force = float(weights @ np.array(self.force))
            found.append(ForceInfluence("load cell", self.relative, self.relative_degrees_of_freedom, force))
        return tuple(found)


THESIS_CALIBRATION = Calibration((1.0, 6.0), (112.0, 742.0))
"""1 to 6 bar, 112 to 742 N (thesis, 4.6): 126 N/bar and an offset of -14 N. **That of one cylinder, and of no other.**"""


def force_from_pressure(pressure: float, calibration: Calibration) -> float:
    """Force [N] of the bar at a pressure [bar].

    Raises
    ------
    InputError
        If the pressure lies outside a calibration table of more than two points, or gives a negative force.
    """
    force = float(calibration.weights(pressure) @ np.array(calibration.force))
    if force < 0:
        raise InputError(
            f"a pressure of {pressure:g} bar gives a force of {force:.4g} N by the force calibration; a pressed cylinder "
            f"cannot pull: correct the pressure or the calibration"
        )
    return force


def force_of_run(name: str, force: float | None, pressure: float | None, calibration: Calibration | None) -> float:
    """Force [N] of a run that gives a force, a pressure, or both.

    Parameters
    ----------
    name : str
        Of the run, for messages.
    force : float or None [N]
    pressure : float or None [bar]
    calibration : Calibration or None

    Raises
    ------
    InputError
        If the run gives neither, a pressure without a calibration, or both and they do not agree.
    """
    if pressure is None:
        if force is None:
            raise InputError(f"run {name!r} has neither a force nor a pressure; give force_N or pressure_bar")
        return force
    if calibration is None:
        if force is not None:
            return force
        raise InputError(
            f"run {name!r} gives a pressure of {pressure:g} bar, and the test no force calibration; add [setup.calibration] "
            f'with pressure_bar and force_N, or calibration = "gauge.toml" of elastogeo calibrate, or give force_N'
        )
    calibrated = force_from_pressure(pressure, calibration)
    if force is not None and abs(force - calibrated) > DISAGREE * max(abs(force), abs(calibrated)):
        raise InputError(
            f"run {name!r} gives {force:g} N and {pressure:g} bar, which is {calibrated:.4g} N by the force calibration; "
            f"correct one of them, or leave one out"
        )
    return calibrated if force is None else force


def force_influences(
    calibration: Calibration | None, force: float | None, pressure: float | None, readings: int
) -> tuple[ObservedInfluence, ...]:
    """What is uncertain in the force of a run, for its observations: nothing of a force that was given as such.

    Parameters
    ----------
    calibration : Calibration or None
    force : float or None [N]
    pressure : float or None [bar]
    readings : int
        Of the run.
    """
    if calibration is None:
        return ()
    wrench, reading = np.zeros((readings, 6)), np.zeros(readings)
    return tuple(
        ObservedInfluence(part.label, part.standard_uncertainty, part.degrees_of_freedom, wrench, reading, part.force)
        for part in calibration.influences(pressure if force is None else None)
    )
