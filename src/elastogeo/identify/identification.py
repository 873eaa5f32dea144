"""From a test to parameters: the one job that everything else serves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from elastogeo.estimate import Confounding, Repeatability, Solution, confounding, minimum_norm, repeatability, solve
from elastogeo.identify.fit import fitness, rmse, strongest_harmonic
from elastogeo.identify.preference import retaining_order
from elastogeo.identify.systems import RunSystem, Systems, merged, noise_of, run_systems, same_force
from elastogeo.identify.verdict import (
    Check,
    above_resolution,
    conditioned,
    forces_distinct,
    identifiable,
    residuals_unstructured,
)
from elastogeo.machine import Array
from elastogeo.observe import MachineTest, Question
from elastogeo.sources import select_sources


@dataclass(frozen=True, slots=True)
class Parameter:
    """An identified parameter.

    Attributes
    ----------
    name, unit, meaning : str
    value, standard_uncertainty : float
        In `unit`.
    interval : tuple of 2 float
        95 % coverage interval.
    stands_for : dict of str to float
        The exact combination that it represents: coefficient by name, itself first.
    peak_to_peak : float [mm]
        Of its part of the trace at the highest force, with the sign of the value.
    share : float
        Of the sum of all absolute peak-to-peak parts, 0 to 1.
    """

    name: str
    unit: str
    meaning: str
    value: float
    standard_uncertainty: float
    interval: tuple[float, float]
    stands_for: dict[str, float]
    peak_to_peak: float
    share: float


@dataclass(frozen=True, slots=True)
class Trace:
    """Measured and predicted readings of one run, reference taken off if one was.

    Attributes
    ----------
    run : str
    force : float [N]
    pose : array, shape (m,) [rad or mm]
        What the run file counts along: the angle of a ball bar.
    measured, predicted : array, shape (m,) [mm]
    """

    run: str
    force: float
    pose: Array
    measured: Array
    predicted: Array


@dataclass(frozen=True, slots=True)
class Level:
    """Fit at one force level.

    Attributes
    ----------
    force : float [N]
    readings : int
    rmse : float [mm]
        Eq. 5.40.
    fitness : float [%]
        Eq. 5.41.
    """

    force: float
    readings: int
    rmse: float
    fitness: float


@dataclass(frozen=True, slots=True)
class Local:
    """A local estimate from a few force levels (Eq. 4.29).

    Attributes
    ----------
    forces : tuple of float [N]
    solution : Solution
    """

    forces: tuple[float, ...]
    solution: Solution


@dataclass(frozen=True, slots=True)
class Pattern:
    """The response of a reading to parameters that cannot be told apart (Table 4.4).

    Attributes
    ----------
    names : tuple of str
    pose : array, shape (m,)
    response : array, shape (m,)
        Scaled to a greatest absolute value of 1.
    """

    names: tuple[str, ...]
    pose: Array
    response: Array


@dataclass(frozen=True, slots=True)
class Identification:
    """All that one test says.

    Attributes
    ----------
    test : MachineTest
        As it was given.
    reference_force : float or None [N]
        Force level that was taken off.
    parameters : tuple of Parameter
        The retained set.
    confounding : Confounding
    solution : Solution
        Global estimate of the retained set (Eq. 4.28).
    minimum_norm : dict of str to float
        Minimum-norm solution over all parameters that were asked for.
    traces : tuple of Trace
    levels : tuple of Level
    local : tuple of Local
        From adjacent force levels.
    repeats : Repeatability or None
        From the levels that were repeated, if at least two were.
    patterns : tuple of Pattern
    rmse : float [mm]
        Over all readings.
    verdict : tuple of Check
    """

    test: MachineTest
    reference_force: float | None
    parameters: tuple[Parameter, ...]
    confounding: Confounding
    solution: Solution
    minimum_norm: dict[str, float]
    traces: tuple[Trace, ...]
    levels: tuple[Level, ...]
    local: tuple[Local, ...]
    repeats: Repeatability | None
    patterns: tuple[Pattern, ...]
    rmse: float
    verdict: tuple[Check, ...]


def identify(test: MachineTest) -> Identification:
    """Identify the parameters that a test's question asks for.

    Parameters
    ----------
    test : MachineTest

    Returns
    -------
    Identification

    Raises
    ------
    SelectionError
        If the question names no error source of the machine.
    UnsupportedError
        If no parameter changes any reading, the reference level is missing, or there are too few readings.
    """
    systems = systems_of(test)
    found = confounding_of(test, systems)
    solution = solve(merged(systems.runs), found.retained, noise_of(systems.runs, systems.references))
    traces = tuple(_trace(test, run, solution) for run in systems.runs)
    parameters = _parameters(systems, found, solution)
    overall = rmse(np.concatenate([t.predicted for t in traces]), np.concatenate([t.measured for t in traces]))
    return Identification(
        test=test,
        reference_force=test.question.reference_force,
        parameters=parameters,
        confounding=found,
        solution=solution,
        minimum_norm=dict(zip(found.labels, map(float, minimum_norm(merged(systems.runs))), strict=True)),
        traces=traces,
        levels=tuple(_level(force, traces) for force in systems.levels),
        local=local_estimates(systems, found.retained, adjacent(systems.levels)),
        repeats=_repeats(systems, found.retained),
        patterns=_patterns(test, systems, found),
        rmse=overall,
        verdict=(
            identifiable(found),
            forces_distinct(systems.applied),
            conditioned(found),
            residuals_unstructured({t.run: strongest_harmonic(t.measured - t.predicted, t.pose) for t in traces}, overall),
            above_resolution({p.name: abs(p.peak_to_peak) for p in parameters}, test.resolution),
        ),
    )


def with_question(
    test: MachineTest, parameters: Sequence[str] | None = None, prefer: Sequence[str] | None = None
) -> MachineTest:
    """The test with another question: other parameters, other preferences, or its own where none are given."""
    question = test.question
    asked = Question(
        parameters=tuple(parameters) if parameters else question.parameters,
        reference_force=question.reference_force,
        prefer=tuple(prefer) if prefer else question.prefer,
    )
    return replace(test, question=asked)


def systems_of(test: MachineTest) -> Systems:
    """The linear systems that a test and its question amount to."""
    question = test.question
    sources = select_sources(test.machine, question.parameters)
    return run_systems(sources, test.machine, test.observations(), question.reference_force)


def confounding_of(test: MachineTest, systems: Systems) -> Confounding:
    """What the test can and cannot tell apart of what its question asks for."""
    observations = [run.observations for run in systems.runs]
    order = retaining_order(systems.sources, test.machine, observations, test.question.prefer)
    return confounding(merged(systems.runs), order, kinds=[source.unit for source in systems.sources])


def adjacent(levels: Sequence[float]) -> tuple[tuple[float, ...], ...]:
    """Pairs of neighbouring force levels [N]."""
    return tuple(pairwise(levels))


def local_estimates(systems: Systems, retained: Sequence[str], choices: Sequence[Sequence[float]]) -> tuple[Local, ...]:
    """Estimates of the retained parameters from some force levels at a time (Eq. 4.29).

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
    chosen = [systems.at(*levels) for levels in choices]
    return tuple(
        Local(tuple(levels), solve(merged(runs), retained, noise_of(runs, systems.references)))
        for levels, runs in zip(choices, chosen, strict=True)
    )


def _trace(test: MachineTest, run: RunSystem, solution: Solution) -> Trace:
    columns = [run.factor.labels.index(label) for label in solution.labels]
    predicted = run.design[:, columns] @ solution.values
    return Trace(run.observations.run, run.force, _pose(test, run), run.reading, predicted)


def _pose(test: MachineTest, run: RunSystem) -> Array:
    """What the run file counts along, shape (m,)."""
    return next(r.columns[test.setup.quantities[0]] for r in test.runs if r.name == run.observations.run)


def _level(force: float, traces: Sequence[Trace]) -> Level:
    chosen = [trace for trace in traces if same_force(trace.force, force)]
    measured = np.concatenate([trace.measured for trace in chosen])
    predicted = np.concatenate([trace.predicted for trace in chosen])
    return Level(force, len(measured), rmse(predicted, measured), fitness(predicted, measured))


def _parameters(systems: Systems, found: Confounding, solution: Solution) -> tuple[Parameter, ...]:
    strongest = max(systems.runs, key=lambda run: abs(run.force))
    by_name = {source.name: source for source in systems.sources}
    spans = {
        name: float(np.ptp(strongest.design[:, found.labels.index(name)]) * value)
        for name, value in zip(solution.labels, solution.values, strict=True)
    }
    total = sum(map(abs, spans.values())) or 1.0
    return tuple(
        Parameter(
            name=name,
            unit=by_name[name].unit,
            meaning=by_name[name].meaning,
            value=float(value),
            standard_uncertainty=float(uncertainty),
            interval=(float(low), float(high)),
            stands_for=found.stands_for(name),
            peak_to_peak=spans[name],
            share=abs(spans[name]) / total,
        )
        for name, value, uncertainty, (low, high) in zip(
            solution.labels, solution.values, solution.standard_uncertainty, solution.interval(), strict=True
        )
    )


def _repeats(systems: Systems, retained: Sequence[str]) -> Repeatability | None:
    """Run-level uncertainty from the levels that were repeated."""
    if systems.references > 1:
        return None
    levels = {f"{force:g} N": [run.factor for run in systems.at(force)] for force in systems.levels}
    repeated = {name: runs for name, runs in levels.items() if len(runs) > 1}
    return repeatability(repeated, retained) if repeated else None


def _patterns(test: MachineTest, systems: Systems, found: Confounding) -> tuple[Pattern, ...]:
    strongest = max(systems.runs, key=lambda run: abs(run.force))
    pose = _pose(test, strongest)
    responses = {group: strongest.design[:, found.labels.index(group[0])] for group in found.groups}
    return tuple(
        Pattern(group, pose, response / np.abs(response).max()) for group, response in responses.items() if response.any()
    )
