"""What ISO 230-2 asks of a positioning test, and whether the readings drift."""

from __future__ import annotations

import numpy as np
from scipy.special import fdtrc, stdtr

from elastogeo.identification.check import Check
from elastogeo.identification.positioning.standard import ByTarget, Numbers
from elastogeo.identification.result import Identification
from elastogeo.machine import Array

CYCLES = 5
"""Approaches of each target from each side that the standard asks for."""

LONG = 2000.0
"""Travel [mm] from which one approach is enough for it, and targets may be 250 mm apart."""

APART = 250.0
PER_METRE = 5
FEWEST = 5
"""Targets, in all and per metre of travel."""

OF_A_TURN = ((np.pi / 2, 3), (np.pi, 5), (np.inf, 8))
"""Targets of a rotary axis, by its travel [rad]."""

EVEN = 0.01
"""Share of the mean step within which targets are evenly spaced."""

FALSE_ALARM = 0.01
FOR_A_TREND = 4
"""Cycles that it takes to tell a drift from scatter."""


def standard_checks(
    found: ByTarget, sense: Array, reading: Array, cycle: Numbers, place: Numbers, rotary: bool, angular: bool
) -> list[Check]:
    """Sides, cycles, targets and their spacing, completeness, drift.

    Parameters
    ----------
    found : ByTarget
    sense, reading, cycle : array, shape (m,)
        In the order of the test.
    place : array of int, shape (m,)
        Which target each reading is of.
    rotary : bool
        Whether the targets are angles.
    angular : bool
        Whether the deviations are.
    """
    span = float(np.ptp(found.target))
    sides = tuple(sign for sign, column in zip("+-", found.count.T, strict=True) if column.any())
    counts = found.count[:, [k for k, sign in enumerate("+-") if sign in sides]]
    least, most = int(counts.min()), int(counts.max())
    wanted_cycles = 1 if not rotary and span > LONG else CYCLES
    wanted = _targets_wanted(span, rotary)
    checks = [
        Check("approached from both sides", len(sides) == 2, {"sides": sides}),
        Check("cycles enough", least >= wanted_cycles, {"least": least, "most": most, "wanted": wanted_cycles}),
        Check("targets enough", len(found.target) >= wanted, {"targets": len(found.target), "wanted": wanted, "span": span}),
    ]
    if len(found.target) > 2:
        checks.append(_spacing(found.target, rotary))
    checks.append(Check("readings complete", least == most, {"least": least, "most": most, "targets": len(found.target)}))
    return [*checks, _drift(sense, reading, cycle, place, angular)]


def _targets_wanted(span: float, rotary: bool) -> int:
    if rotary:
        return next(number for limit, number in OF_A_TURN if span <= limit + 1e-9)
    if span > LONG:
        return int(np.ceil(span / APART)) + 1
    return max(FEWEST, int(np.ceil(PER_METRE * span / 1000)))


def _spacing(target: Array, rotary: bool) -> Check:
    """Evenly spaced targets meet a periodic error at the same phase, or nearly so."""
    steps = np.diff(target)
    uneven = float(np.abs(steps - steps.mean()).max() / steps.mean())
    return Check("targets unevenly spaced", uneven > EVEN, {"step": float(steps.mean()), "rotary": rotary})


def _drift(sense: Array, reading: Array, cycle: Numbers, place: Numbers, angular: bool) -> Check:
    """Whether the cycles as a whole wander one way: Student's t of the trend of their means.

    The readings of a cycle may drift together, so that a cycle counts as one reading.
    """
    numbers, order = np.unique(cycle, return_inverse=True)
    name = "free of drift"
    if len(numbers) < FOR_A_TREND:
        return Check(name, None, {"cycles": len(numbers), "needed": FOR_A_TREND})
    cell = _cells(sense, place)
    off = reading - (np.bincount(cell, reading) / np.bincount(cell))[cell]
    means = np.bincount(order, off) / np.bincount(order)
    rank = np.arange(len(numbers)) - (len(numbers) - 1) / 2
    slope = float(rank @ means / (rank @ rank))
    freedom = len(numbers) - 2
    left = means - means.mean() - slope * rank
    error = float(np.sqrt(left @ left / freedom / (rank @ rank)))
    p_value = float(2 * stdtr(freedom, -abs(slope) / error)) if error else float(slope == 0)
    facts = {"drift": slope * (len(numbers) - 1), "p_value": p_value, "cycles": len(numbers), "angular": angular}
    return Check(name, p_value >= FALSE_ALARM, facts)


def followed(joints: Identification, sense: Array, place: Numbers, angular: bool) -> Check:
    """Whether the identified parameters leave no more of the means by target than the cycles scatter: F of the lack of fit.

    The zero of each cycle is subtracted, as in the estimate.
    """
    left = np.concatenate([trace.measured - trace.predicted for trace in joints.traces])
    cell = _cells(sense, place)
    mean = np.bincount(cell, left) / np.bincount(cell)
    cells, own = int(cell.max()) + 1, len(joints.traces) * max(len(values) for values in (*joints.set_up.values(), ()))
    freedom, pure = cells - len(joints.parameters) - 1, len(left) - cells - own
    name, lack = "error motion followed", float(np.sum(mean[cell] ** 2))
    scatter = float(np.sum((left - mean[cell]) ** 2))
    if freedom < 1 or pure < 1 or not scatter:
        return Check(name, None, {"angular": angular})
    p_value = float(fdtrc(freedom, pure, lack / freedom / (scatter / pure)))
    facts = {"left": np.sqrt(lack / len(left)), "scatter": np.sqrt(scatter / pure), "p_value": p_value, "angular": angular}
    return Check(name, p_value >= FALSE_ALARM, facts)


def _cells(sense: Array, place: Numbers) -> Numbers:
    """Which target and direction each reading is of, counted from zero, shape (m,)."""
    _, cell = np.unique(2 * place + (sense > 0), return_inverse=True)
    return np.asarray(cell).reshape(-1)
