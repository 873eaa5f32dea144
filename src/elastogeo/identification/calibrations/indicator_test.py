"""The set-up's stiffness from dial indicators at ball and roller bearing (section 6.6.2, Tables 6.5 and 6.6).

The roller is pressed against the ball along one axis. The encoders say how far, one indicator how far the ball gives way,
one how far the roller bearing does; what is left is the machine's (Eq. 6.1). With the force, from currents or a
dynamometer, each spring has a stiffness; the springs are in series, so compliances add (Eqs. 6.3, 6.4).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
from scipy.special import chdtrc

from elastogeo.drive import SetupCompliance
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate, effective_degrees_of_freedom
from elastogeo.identification.check import Check
from elastogeo.machine import Array
from elastogeo.result import Result

ENGAGEMENT, FORCE, BALL, ROLLER = "engagement", "force", "ball", "roller"
SET_UP, MACHINE = "set-up", "machine"

OFFSET = 0.05
"""Share of the least deflection of the machine that may be the same at every engagement for a secant to show it."""

MISFIT = 0.01
"""p value below which deflections do not go in proportion to the force, or along a straight line."""

FEWEST = 3
"""Engagements without which a straight line leaves nothing to judge it by."""

_SAME = 1e-6
"""Commanded engagements [mm] that differ by less are one."""


@dataclass(frozen=True, slots=True, eq=False)
class Spring:
    """One spring of the loop at k engagements.

    Attributes
    ----------
    name : str
        `ball`, `roller`, `set-up` (both of these in series), `machine`.
    deflection : array, shape (k,) [mm]
        Mean of its readings at each engagement.
    read : array, shape (k,) [mm]
        Standard uncertainty of that from the resolution of the dials and the scatter of repeats.
    secants : tuple of Estimate, length k [mm/N]
        Compliance from no force on: deflection over force (Eq. 6.2). **Without repeats their uncertainty is that of the
        resolution and of the scales alone.**
    increments : tuple of Estimate, length k - 1 [mm/N]
        Compliance between neighbouring engagements.
    """

    name: str
    deflection: Array
    read: Array
    secants: tuple[Estimate, ...]
    increments: tuple[Estimate, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class IndicatorTest(Result):
    """What dial indicators say of a ball-roller set-up.

    Attributes
    ----------
    engagement, force : array, shape (k,) [mm, N]
        Commanded, increasing, and the mean force at each.
    readings : int
    springs : mapping of str to Spring
        Ball, roller, set-up, machine.
    setup : SetupCompliance
        As a ball-roller test takes it.
    resolution : float [mm]
        Of the dials.
    verdict : tuple of Check
    """

    engagement: Array
    force: Array
    readings: int
    springs: Mapping[str, Spring]
    setup: SetupCompliance
    resolution: float
    verdict: tuple[Check, ...]

    @property
    def repeated(self) -> bool:
        """Whether repeats show the scatter; without them the uncertainties hold less than 95 % intervals take."""
        return self.readings > len(self.engagement)

    @property
    def share(self) -> Array:
        """Share of the machine in the deflection at each engagement, shape (k,); the rest is the set-up's."""
        return np.asarray(self.springs[MACHINE].deflection / self.engagement)


def indicator_test(
    readings: Mapping[str, Array], resolution: float = 0.0, dial: float = 0.0, load_cell: float = 0.0
) -> IndicatorTest:
    """Stiffness of ball, roller bearing, set-up and machine from dial readings.

    Parameters
    ----------
    readings : mapping of str to array, shape (m,)
        `engagement` [mm] that the encoders command, `force` [N], `ball` and `roller` [mm]: how far each gives way.
    resolution : float [mm]
        Of the dials: its rectangular distribution has the standard deviation resolution / sqrt(12).
    dial, load_cell : float
        Relative standard uncertainty of the scale of the dials, and of the force; one for all readings.

    Raises
    ------
    InputError
        If a column is missing, holds a value that is no finite number, or the set-up gives way by more than the engagement.
    UnsupportedError
        If there are fewer than two engagements.
    """
    columns = _checked(readings)
    levels = _levels(columns[ENGAGEMENT])
    if len(levels) < 2:
        raise UnsupportedError("all readings of the indicator test are at one engagement; press at two at least")

    def mean(values: Array) -> Array:
        return np.array([values[level].mean() for level in levels])

    engagement, force = mean(columns[ENGAGEMENT]), mean(columns[FORCE])
    setup = columns[BALL] + columns[ROLLER]
    deflections = {BALL: columns[BALL], ROLLER: columns[ROLLER], SET_UP: setup, MACHINE: columns[ENGAGEMENT] - setup}
    springs = {}
    for name, values in deflections.items():
        both = name in (SET_UP, MACHINE)
        spread, freedom = _scatter(values, levels)
        springs[name] = _spring(
            name,
            (mean(values), force),
            (spread, freedom),
            resolution * sqrt((2 if both else 1) / 12),
            dial * mean(setup if both else values),
            load_cell,
        )
    if springs[MACHINE].deflection.min() <= 0:
        worst = int(springs[MACHINE].deflection.argmin())
        raise InputError(
            f"at {1000 * engagement[worst]:g} um the dials show {1000 * springs[SET_UP].deflection[worst]:g} um of ball and "
            f"roller, as much as was commanded or more; look at the signs and units of ball_um and roller_um"
        )
    table = springs[SET_UP].secants
    found = SetupCompliance(
        compliance=tuple(secant.value for secant in table),
        engagement=tuple(engagement.tolist()),
        standard_uncertainty=max(secant.standard_uncertainty for secant in table),
    )
    verdict = (_offset(springs[MACHINE], force), _constant(springs[SET_UP], force), _repeated(levels, resolution))
    return IndicatorTest(engagement, force, len(columns[FORCE]), springs, found, resolution, verdict)


def _checked(readings: Mapping[str, Array]) -> dict[str, Array]:
    columns = {
        name: np.asarray(readings[name], dtype=float) for name in (ENGAGEMENT, FORCE, BALL, ROLLER) if name in readings
    }
    if len(columns) < 4:
        raise InputError(
            f"readings of an indicator test hold {', '.join(readings) or 'nothing'}; they need "
            f"engagement_um, force_N, ball_um and roller_um"
        )
    sizes = {name: values.shape for name, values in columns.items()}
    if len(set(sizes.values())) > 1 or columns[FORCE].ndim != 1:
        raise InputError(f"every engagement needs one force, ball and roller: got the shapes {sizes}")
    for name, values in columns.items():
        if not np.isfinite(values).all():
            row = int(np.flatnonzero(~np.isfinite(values))[0])
            raise InputError(f"the {name} of reading {row + 1} is {values[row]}; remove the reading")
    for name in (ENGAGEMENT, FORCE):
        if not (columns[name] > 0).all():
            row = int(np.flatnonzero(columns[name] <= 0)[0])
            raise InputError(
                f"the {name} of reading {row + 1} is {columns[name][row]:g}; set the dials to zero before the "
                f"contact, and leave that reading out"
            )
    return columns


def _levels(engagement: Array) -> list[Array]:
    """Indices of the readings of each engagement, increasing."""
    order = np.argsort(engagement, kind="stable")
    cuts = np.flatnonzero(np.diff(engagement[order]) > _SAME) + 1
    return [np.asarray(part) for part in np.split(order, cuts)]


def _scatter(values: Array, levels: list[Array]) -> tuple[Array, int]:
    """Standard uncertainty of the mean of each engagement from its repeats, shape (k,), 0 without any; its freedom."""
    freedom = sum(len(level) - 1 for level in levels)
    squares = sum(float(np.sum((values[level] - values[level].mean()) ** 2)) for level in levels)
    return np.sqrt(squares / max(freedom, 1) / np.array([len(level) for level in levels])), freedom


def _spring(
    name: str,
    seen: tuple[Array, Array],
    scatter: tuple[Array, int],
    resolution: float,
    scale: Array,
    load_cell: float,
) -> Spring:
    """Secants and increments of one spring; `scale` is what one standard uncertainty of the dials' scale does to it."""
    (deflection, force), (spread, freedom) = seen, scatter
    step = np.diff(force)

    def estimates(compliance: Array, per: Array, parts: tuple[Array, ...]) -> tuple[Estimate, ...]:
        contributions = np.column_stack([*(part / per for part in parts), load_cell * compliance])
        degrees = np.array([max(freedom, 1), inf, inf, inf], dtype=float)
        size = np.linalg.norm(contributions, axis=1)
        known = effective_degrees_of_freedom(contributions, degrees) if size.any() else np.full(len(size), inf)
        numbers = zip(compliance.tolist(), size.tolist(), known.tolist(), strict=True)
        return tuple(Estimate(value, u, v) for value, u, v in numbers)

    constant = np.full(len(force), resolution)
    return Spring(
        name,
        deflection,
        np.hypot(spread, resolution),
        estimates(deflection / force, force, (spread, constant, scale)),
        estimates(
            np.diff(deflection) / step,
            step,
            (np.hypot(spread[1:], spread[:-1]), np.hypot(constant[1:], constant[:-1]), np.diff(scale)),
        ),
    )


def _offset(machine: Spring, force: Array) -> Check:
    """Whether the machine's secants show the machine, or what is the same at every engagement."""
    start = straight_from(machine, force)
    columns = np.column_stack([np.ones(len(force)), force])[start:]
    offset = float(np.linalg.lstsq(columns, machine.deflection[start:])[0][0])
    share = abs(offset) / float(machine.deflection[0])
    facts = {
        "offset_mm": offset,
        "share": share,
        "force_N": float(force[0]),
        "straight_from_N": float(force[start]) if len(force) - start >= FEWEST else None,
        "secants_mm_per_N": tuple(one.value for one in machine.secants),
        "increments_mm_per_N": tuple(one.value for one in machine.increments),
    }
    return Check("machine's secants free of an offset", share <= OFFSET, facts)


def straight_from(spring: Spring, force: Array) -> int:
    """Index of the engagement from which the deflection is a straight line of the force, as far as the dials can tell.

    0 where all engagements are, or where nothing is known of the dials.
    """
    if not spring.read.all():
        return 0
    for first in range(len(force) - FEWEST + 1):
        if _misfit(spring, np.column_stack([np.ones(len(force)), force]), first) >= MISFIT:
            return first
    return max(len(force) - FEWEST + 1, 0)


def _constant(setup: Spring, force: Array) -> Check:
    """Whether one compliance describes the set-up at every engagement, or it takes a table."""
    stiffness = tuple(one.value for one in setup.secants)
    p_value = _misfit(setup, force[:, np.newaxis], 0) if setup.read.all() else None
    passed = None if p_value is None else p_value >= MISFIT
    return Check("set-up's compliance constant", passed, {"secants_mm_per_N": stiffness, "p_value": p_value})


def _misfit(spring: Spring, columns: Array, first: int) -> float:
    """p value of what a weighted fit leaves of the deflections from an engagement on (chi square)."""
    weight = 1 / spring.read[first:]
    design, seen = columns[first:] * weight[:, np.newaxis], spring.deflection[first:] * weight
    left = seen - design @ np.linalg.lstsq(design, seen)[0]
    return float(chdtrc(len(seen) - design.shape[1], float(left @ left)))


def _repeated(levels: list[Array], resolution: float) -> Check:
    repeats = sum(len(level) - 1 for level in levels)
    facts = {"repeats": repeats, "engagements": len(levels), "resolution_mm": resolution}
    return Check("readings repeated", True if repeats else None, facts)
