"""Estimates from part of the runs: from some force levels at a time, and from the levels that were repeated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise

import numpy as np

from elastogeo.errors import DegreesOfFreedomError, RankError
from elastogeo.estimate import Common, Repeatability, repeatability, solve
from elastogeo.identification.change import Change, local_change, run_dispersion
from elastogeo.identification.result import Local
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems, merged, noise_of


def adjacent(levels: Sequence[float]) -> tuple[tuple[float, ...], ...]:
    """Pairs of neighbouring force levels [N]."""
    return tuple(pairwise(levels))


def local_estimates(systems: Systems, retained: Sequence[str], choices: Sequence[Sequence[float]]) -> tuple[Local, ...]:
    """Estimates of the retained parameters from some force levels at a time (Eq. 4.29).

    Few levels have too few runs for an uncertainty by run; it comes from the scatter between all runs of the test.

    Parameters
    ----------
    systems : Systems
    retained : sequence of str
    choices : sequence of sequence of float [N]
        Pairs, triples, any choice of the levels of `systems`.

    Raises
    ------
    InputError
        If no run is at one of the levels.
    RankError
        If the chosen levels do not determine the parameters.
    """
    dispersion = _dispersion(systems, retained)
    found = []
    for levels in choices:
        runs = systems.at(*levels)
        solution = solve(merged(runs), retained, noise_of(runs, systems.references))
        if dispersion is not None:
            variance, freedom = dispersion
            covariance = solution.covariance * (variance / solution.residual_std**2)
            solution = replace(solution, covariance=covariance, degrees_of_freedom=np.full(len(retained), freedom))
        spans = systems.range_per_unit(retained) * solution.values
        found.append(Local(tuple(levels), solution, dict(zip(retained, map(float, spans), strict=True))))
    return tuple(found)


def adjacent_estimates(systems: Systems, retained: Sequence[str]) -> tuple[Local, ...]:
    """Local estimates from the pairs of adjacent levels that determine the parameters: a pair read one way only may not."""
    found: list[Local] = []
    for pair in adjacent(systems.levels):
        with suppress(RankError, DegreesOfFreedomError):
            found.extend(local_estimates(systems, retained, [pair]))
    return tuple(found)


def _dispersion(systems: Systems, retained: Sequence[str]) -> tuple[float, float] | None:
    """Variance of a reading as the scatter between runs shows it; None where it cannot be had."""
    if systems.references:
        return None
    try:
        return run_dispersion([run.factor for run in systems.runs], retained)
    except (DegreesOfFreedomError, RankError):
        return None


def change_between_levels(systems: Systems, retained: Sequence[str]) -> Change | None:
    """Whether local estimates differ; None where that cannot be said."""
    pairs = adjacent(systems.levels)
    choices = [[k for k, run in enumerate(systems.runs) if run in systems.at(*pair)] for pair in pairs]
    # Where two levels meet a parabola, the straight line through them cuts the axis in proportion to their product.
    products = [low * high for low, high in pairs]
    if systems.references or len(choices) < 2:
        return None
    try:
        return local_change([run.factor for run in systems.runs], retained, choices, products)
    except (DegreesOfFreedomError, RankError):
        return None


def of_repeats(systems: Systems, retained: Sequence[str]) -> Repeatability | None:
    """Run-level uncertainty from the levels that were repeated, if they determine the parameters."""
    levels = {f"{force:g} N": systems.at(force) for force in systems.levels}
    repeated = {name: runs for name, runs in levels.items() if len(runs) > 1}
    if not repeated:
        return None
    factors = {name: [run.factor for run in runs] for name, runs in repeated.items()}
    try:
        return repeatability(factors, retained, _of_reference(systems, repeated, retained) if systems.references else None)
    except RankError:
        return None


def _of_reference(systems: Systems, repeated: Mapping[str, Sequence[RunSystem]], retained: Sequence[str]) -> Common:
    """What the scatter of the reference adds: it enters every difference alike, and the repeats do not show it.

    The reference counts as scattering like the repeated runs, reading by reading. It was applied with the least force and
    may scatter less; then this is too much, never too little.
    """
    runs = [run for chosen in repeated.values() for run in chosen]
    designs = [run.design_of(retained) for run in runs]
    norms = np.sqrt(sum(np.sum(design**2, axis=0) for design in designs))
    information = sum((design / norms).T @ (design / norms) for design in designs)
    pull = np.linalg.solve(information, (sum(designs) / norms).T)
    moved = [
        pull @ (run.reading - np.mean([r.reading for r in chosen], axis=0)) for chosen in repeated.values() for run in chosen
    ]
    freedom = len(runs) - len(repeated)
    covariance = sum(np.outer(m, m) for m in moved) / freedom / systems.references
    return Common(np.asarray(covariance / np.outer(norms, norms)), float(freedom))
