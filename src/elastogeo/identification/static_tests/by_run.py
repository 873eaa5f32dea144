"""The uncertainty of what an instrument shows by itself: the scatter between its runs, and every influence that is known.

As `identify` has it (decision 24): by run where there are runs enough, and none where there are not. What is known of force
and readings moves the observations by one standard uncertainty, and the results with them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass, replace
from math import inf
from typing import Any, TypeVar, cast

import numpy as np

from elastogeo.errors import DegreesOfFreedomError
from elastogeo.estimate import (
    Estimate,
    Factor,
    Solution,
    effective_degrees_of_freedom,
    merge,
    runs_needed,
    solve,
    solve_by_run,
)
from elastogeo.observe import Observations

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Counted:
    """What an uncertainty assumes.

    Attributes
    ----------
    runs : int
    by_run : bool
        Whether it comes from their scatter; else there is none.
    needed : int or None
        How many runs like these it takes; None if there are enough, or no number is.
    """

    runs: int
    by_run: bool
    needed: int | None


def solved_by_run(runs: Sequence[Factor], labels: Sequence[str]) -> tuple[Solution, Counted]:
    """Least squares with the uncertainty of the scatter between runs: infinite where they are too few for one.

    Raises
    ------
    RankError
        If the parameters are dependent.
    DegreesOfFreedomError
        If there are no more readings than parameters.
    """
    if len(runs) > 1:
        with suppress(DegreesOfFreedomError):
            return solve_by_run(runs, labels), Counted(len(runs), True, None)
    plain = solve(merge(*runs), labels)
    unknown = np.full(plain.covariance.shape, inf)
    counted = Counted(len(runs), False, runs_needed(runs, labels))
    return replace(plain, covariance=unknown, degrees_of_freedom=np.ones(len(labels))), counted


@dataclass(frozen=True, slots=True)
class Moved:
    """The observations of a test, moved by one standard uncertainty of one influence.

    Attributes
    ----------
    observed : tuple of Observations
    degrees_of_freedom : float
        Of that uncertainty.
    """

    observed: tuple[Observations, ...]
    degrees_of_freedom: float


def moved_observations(observed: Sequence[Observations]) -> Iterator[Moved]:
    """The observations moved by each influence that they carry."""
    for n, first in enumerate(observed[0].influences):
        moved = []
        for run in observed:
            one = run.influences[n]
            size = one.standard_uncertainty
            stretch = size * one.force / run.force if one.force else 0.0
            wrench = run.wrench * (1.0 + stretch) + size * one.wrench
            moved.append(replace(run, wrench=wrench, reading=run.reading + size * one.reading))
        yield Moved(tuple(moved), first.degrees_of_freedom)


def widened(found: T, moved: Sequence[T], freedoms: Sequence[float]) -> T:
    """Results whose estimates hold, beside their scatter, what each influence moves them by.

    Parameters
    ----------
    found : dataclass, tuple or Estimate
        Whatever holds estimates, at any depth.
    moved : sequence of the same
        From the observations moved by each influence.
    freedoms : sequence of float
        Degrees of freedom of each.
    """
    if isinstance(found, Estimate):
        return cast("T", _widened_estimate(found, cast("Sequence[Estimate]", moved), freedoms))
    if isinstance(found, tuple) and all(len(cast("tuple[Any, ...]", one)) == len(found) for one in moved):
        parts = zip(found, *cast("Sequence[tuple[Any, ...]]", moved), strict=True)
        return cast("T", tuple(widened(part[0], part[1:], freedoms) for part in parts))
    if is_dataclass(found) and not isinstance(found, type):
        changed: dict[str, Any] = {
            each.name: widened(getattr(found, each.name), [getattr(one, each.name) for one in moved], freedoms)
            for each in fields(found)
            if each.init and all(isinstance(one, type(found)) for one in moved)
        }
        return cast("T", replace(cast("Any", found), **changed))
    return found


def _widened_estimate(found: Estimate, moved: Sequence[Estimate], freedoms: Sequence[float]) -> Estimate:
    if not found.known:
        return found
    parts = [found.standard_uncertainty, *(abs(one.value - found.value) for one in moved)]
    freedom = effective_degrees_of_freedom(np.array([parts]), np.array([[found.degrees_of_freedom, *freedoms]]))
    return Estimate(found.value, float(np.linalg.norm(parts)), float(freedom[0]))
