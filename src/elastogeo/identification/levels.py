"""Force levels: one definition, made once from the runs of a test and used by everything that speaks of a level.

Runs whose forces agree within their uncertainty are one level, whose force is their mean. Each run is in one level.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import hypot, sqrt

import numpy as np

from elastogeo.errors import InputError
from elastogeo.observe import MachineTest

SET_AGAIN = 0.002
"""Relative standard uncertainty with which a force is set, run by run, where the test states none."""

LEAST_SET_AGAIN = 0.2
"""Standard uncertainty [N] with which a force is set at least."""

AGREE = 2.0
"""Forces are one level if their difference is no more than this many of its standard uncertainties."""


@dataclass(frozen=True, slots=True)
class ForceSpread:
    """How well a force is known against another of the same test; what is common to all forces does not count.

    Attributes
    ----------
    relative : float
        Relative standard uncertainty of one force.
    absolute : float [N]
        Standard uncertainty of one force, beside the relative one.
    """

    relative: float = SET_AGAIN
    absolute: float = LEAST_SET_AGAIN

    def of(self, force: float) -> float:
        """Standard uncertainty [N] of one force."""
        return hypot(self.relative * force, self.absolute)

    def agree(self, one: float, other: float) -> bool:
        """Whether two forces [N] are one level."""
        return abs(one - other) <= AGREE * hypot(self.of(one), self.of(other))


@dataclass(frozen=True, slots=True)
class ForceLevels:
    """The force levels of a test.

    Attributes
    ----------
    forces : tuple of float [N]
        Mean force of each level, increasing.
    members : tuple of tuple of float [N]
        The forces of each level.
    spread : ForceSpread
    """

    forces: tuple[float, ...]
    members: tuple[tuple[float, ...], ...]
    spread: ForceSpread

    def level(self, force: float) -> float:
        """The level [N] that a force belongs to.

        Raises
        ------
        InputError
            If it agrees with none.
        """
        for level, members in zip(self.forces, self.members, strict=True):
            if members[0] <= force <= members[-1]:
                return level
        nearest = min(self.forces, key=lambda level: abs(level - force))
        if not self.spread.agree(nearest, force):
            there = ", ".join(f"{level:g}" for level in self.forces)
            raise InputError(f"no run has the force {force:g} N; there are {there} N")
        return nearest

    def __contains__(self, force: float) -> bool:
        try:
            self.level(force)
        except InputError:
            return False
        return True

    @property
    def separation(self) -> float:
        """Distance of the levels over the uncertainty of their forces: 0 for one level.

        The root of the sum of squares about the mean; one over it is about the relative uncertainty that the forces alone
        give to a slope.
        """
        about_mean = np.array(self.forces) - np.mean(self.forces)
        return float(np.linalg.norm(about_mean) / np.sqrt(np.mean([self.spread.of(force) ** 2 for force in self.forces])))


def force_levels(forces: Iterable[float], spread: ForceSpread | None = None) -> ForceLevels:
    """The levels of forces [N], from the least on: what does not agree with the first of a level begins another."""
    spread = spread or ForceSpread()
    levels: list[list[float]] = []
    for force in sorted(forces):
        if levels and spread.agree(levels[-1][0], force):
            levels[-1].append(force)
        else:
            levels.append([force])
    return ForceLevels(tuple(_mean(level) for level in levels), tuple(map(tuple, levels)), spread)


def _mean(forces: Sequence[float]) -> float:
    """Of equal forces exactly their own."""
    return forces[0] if forces[0] == forces[-1] else float(np.mean(forces))


def force_spread(test: MachineTest) -> ForceSpread:
    """How well the forces of a test are known against one another: as its influences on single levels say."""
    stated = [known.relative or 0.0 for known in test.influences if known.kind == "force-level"]
    return ForceSpread(relative=sqrt(sum(part**2 for part in stated))) if stated else ForceSpread()
