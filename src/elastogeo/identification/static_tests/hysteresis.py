"""Static compliance and hysteresis from a force that rises and falls, and the displacement beside it.

ISO 230-1:2012 names the test (thesis 6.2); **its own text was not seen, so the definitions below are this software's**:

* a *branch* runs between two turning points of the force; *rising* ones go up, *falling* ones down (for a push, rising is
  loading and falling unloading; for a pull it is the other way round);
* a *cycle* is a rising branch with the falling one next to it;
* the *hysteresis* at a force is the displacement of the falling less that of the rising branch: positive where energy is
  lost. Its mean over the force is the area of the loop per range of the force;
* the *middle line* is halfway between the two; the *static compliance* is its secant from the least to the greatest force
  that all cycles share, the *tangent compliance* its slope at a force;
* *backlash* is the step of the middle line at zero force, between what the pulled and the pushed side extrapolate to;
* the *remaining displacement* is that at zero force after the last cycle, less that before the first.

Branches are smoothed by polynomials, for loads of both signs one on each side of zero. The force counts as exact.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.identification.static_tests.loading_branches import DEAD_BAND, Branch, branches_of, loading_cycles
from elastogeo.identification.static_tests.loading_curves import FEWEST_CYCLES, Curves, fitted_curves
from elastogeo.identification.static_tests.straight_line import checked_loading
from elastogeo.machine import Array

_GRID = 201
"""Forces at which the greatest hysteresis is looked for."""


@dataclass(frozen=True, slots=True)
class StaticHysteresis:
    """What a static loading test says.

    Attributes
    ----------
    branches : tuple of Branch
        All of them.
    cycles : tuple of tuple of 2 Branch
        Rising and falling branches that count, by pair.
    left_out : tuple of Branch
        Branches that do not cover the range of the force, or have no partner.
    range : tuple of 2 float [N]
        Least and greatest force that all cycles share.
    degree : int
        Of the polynomials.
    by_cycle : bool
        Whether there are cycles enough for uncertainties, which come from the scatter between them; else they are infinite.
    static_compliance : Estimate [mm/N]
        Secant of the middle line over the range.
    rising_secant, falling_secant : Estimate [mm/N]
        Of the branches.
    mean_hysteresis : Estimate [mm]
    greatest_hysteresis : Estimate [mm]
        At `greatest_at`; the search for it makes it a little too great rather than too small.
    greatest_at : float [N]
    hysteresis_at_zero : Estimate or None [mm]
        At zero force; None if the loads do not reach it to within the dead band.
    backlash : Estimate or None [mm]
        None unless the force takes both signs.
    remaining : Estimate or None [mm]
        None unless the record begins and ends at zero force. A run has one: nothing shows its uncertainty.
    energy_lost : Estimate [N mm]
        In one cycle: area of the loop over the range.
    residual_std : float [mm]
        Estimated standard deviation of one reading about its curve.
    checks : tuple of Check
        What is to be believed of it.
    curves : Curves
        Through the branches of every cycle.
    """

    branches: tuple[Branch, ...]
    cycles: tuple[tuple[Branch, Branch], ...]
    left_out: tuple[Branch, ...]
    range: tuple[float, float]
    degree: int
    by_cycle: bool
    static_compliance: Estimate
    rising_secant: Estimate
    falling_secant: Estimate
    mean_hysteresis: Estimate
    greatest_hysteresis: Estimate
    greatest_at: float
    hysteresis_at_zero: Estimate | None
    backlash: Estimate | None
    remaining: Estimate | None
    energy_lost: Estimate
    residual_std: float
    checks: tuple[Check, ...]
    curves: Curves

    def hysteresis_at(self, force: float) -> Estimate:
        """Falling less rising displacement [mm] at a force [N]."""
        row = self._basis(force)
        return self.curves.estimate(-row, row)

    def tangent_compliance(self, force: float) -> Estimate:
        """Slope of the middle line [mm/N] at a force [N]."""
        row = self._basis(force, slope=True) / 2
        return self.curves.estimate(row, row)

    def middle(self, force: float) -> Estimate:
        """Displacement [mm] halfway between rising and falling at a force [N]."""
        row = self._basis(force) / 2
        return self.curves.estimate(row, row)

    def _basis(self, force: float, *, slope: bool = False) -> Array:
        low, high = self.range
        if not low <= force <= high:
            raise InputError(f"the force {force:g} N lies outside the cycles, {low:g} to {high:g} N; ask within")
        return self.curves.shape.row(force, slope=slope)


def hysteresis(force: Array, displacement: Array, dead_band: float = DEAD_BAND) -> StaticHysteresis:
    """Static compliance and hysteresis of one or more loading cycles.

    Parameters
    ----------
    force : array, shape (m,) [N]
        Along its direction, in the order of time; it may take both signs.
    displacement : array, shape (m,) [mm]
        Along the sensor's direction.
    dead_band : float
        Share of the force's range by which it must come back for a turning point to count.

    Returns
    -------
    StaticHysteresis

    Raises
    ------
    InputError
        If the arrays do not fit together, hold a value that is no finite number, or the dead band is none.
    UnsupportedError
        If the force has one level, one branch, or branches of too few readings or forces.
    """
    force, displacement = checked_loading(force, displacement)
    if not 0 < dead_band < 0.5:
        raise InputError(f"the dead band is {dead_band:g} of the force's range; it must lie between 0 and 0.5")
    branches = branches_of(force, dead_band)
    cycles = loading_cycles(branches, force)
    kept = [branch for cycle in cycles for branch in cycle]
    low = max(branch.least for branch in kept)
    high = min(branch.greatest for branch in kept)
    both = min(-low, high) > dead_band * (high - low)
    curves, residual_std = fitted_curves(force, displacement, cycles, (low, 0.0, high) if both else (low, high))
    shape = curves.shape
    none, mean = np.zeros(len(shape.labels)), shape.mean()
    secant = (shape.row(high) - shape.row(low)) / (high - low)
    average = curves.estimate(-mean, mean)
    at, greatest = _greatest(curves, low, high)
    margin = dead_band * (high - low)
    zero = shape.row(0.0) if low - margin <= 0 <= high + margin else None
    if both:
        zero = (shape.row(0.0) + shape.row(0.0, below=True)) / 2
    step = (shape.row(0.0) - shape.row(0.0, below=True)) / 2 if both else none
    static = curves.estimate(secant / 2, secant / 2)
    return StaticHysteresis(
        branches=branches,
        cycles=cycles,
        left_out=tuple(branch for branch in branches if branch not in kept),
        range=(low, high),
        degree=shape.degree,
        by_cycle=len(cycles) >= FEWEST_CYCLES,
        static_compliance=static,
        rising_secant=curves.estimate(secant, none),
        falling_secant=curves.estimate(none, secant),
        mean_hysteresis=average,
        greatest_hysteresis=greatest,
        greatest_at=at,
        hysteresis_at_zero=None if zero is None else curves.estimate(-zero, zero),
        backlash=curves.estimate(step, step) if both else None,
        remaining=_remaining(force, displacement, dead_band),
        energy_lost=average.scaled(high - low),
        residual_std=residual_std,
        checks=_checks(static, average, len(cycles)),
        curves=curves,
    )


def _greatest(curves: Curves, low: float, high: float) -> tuple[float, Estimate]:
    """Where the mean hysteresis of all cycles is greatest, and how great."""
    grid = np.linspace(low, high, _GRID)
    rows = curves.shape.rows(grid)
    widths = rows @ (curves.falling - curves.rising).mean(axis=0)
    at = int(np.argmax(widths))
    return float(grid[at]), curves.estimate(-rows[at], rows[at])


def _remaining(force: Array, displacement: Array, dead_band: float) -> Estimate | None:
    """Displacement at zero force at the end less that at the beginning, if the record has both."""
    near = np.abs(force) <= dead_band * np.ptp(force)
    if not (near[0] and near[-1]):
        return None
    begin = displacement[: int(np.argmin(near))]
    end = displacement[len(near) - int(np.argmin(near[::-1])) :]
    # the readings nearest to zero, one at each end at least; their forces differ by less than the dead band
    slope = float(np.ptp(displacement) / np.ptp(force))
    first, last = int(np.argmin(np.abs(force[: len(begin)]))), int(np.argmin(np.abs(force[len(near) - len(end) :])))
    value = end[last] - begin[first] - slope * (force[len(near) - len(end) + last] - force[first])
    return Estimate(float(value), inf)


def _checks(static: Estimate, average: Estimate, cycles: int) -> tuple[Check, ...]:
    """What is to be believed."""
    enough = cycles >= FEWEST_CYCLES
    return (
        signed("displacement with the force", {"": static}, 0.95),
        signed("energy is lost, not gained", {"": average}, 0.95),
        Check("uncertainty by cycle", enough, {"cycles": cycles, "few": () if enough else ("",), "needed": FEWEST_CYCLES}),
    )


def signed(name: str, values: Mapping[str, Estimate], coverage: float) -> Check:
    """Whether a number that must be positive is so in every run, to within its interval; not tested where none is known."""
    judged = {run: value for run, value in values.items() if value.known}
    wrong = {run: value.value for run, value in judged.items() if value.interval(coverage)[1] < 0}
    sizes = [value.value for value in values.values()]
    facts = {"least": min(sizes), "greatest": max(sizes), "wrong": wrong, "needed": FEWEST_CYCLES}
    return Check(name, not wrong if judged else None, facts, decisive=True)
