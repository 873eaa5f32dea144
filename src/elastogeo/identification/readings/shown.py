"""What a result shows of the readings of its tests: made test by test, so that one is in memory at a time.

Of one test the traces are kept. Those of several are made again when they are asked for, as raw as they were.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np

from elastogeo.equality import same
from elastogeo.estimate import Confounding, Solution, select
from elastogeo.identification.fit import Fit, Harmonic, fit_of, strongest_harmonic
from elastogeo.identification.model_choice.variable_compliance import VariableCompliance
from elastogeo.identification.readings.shared_structure import shared_harmonic
from elastogeo.identification.result import Level, Local, Pattern, Response, Trace
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems, greatest_range, merged, ranges_of
from elastogeo.machine import Array
from elastogeo.observe import Campaign
from elastogeo.sources import Source

POSES_DRAWN = 181
"""Poses of a run at which its response is kept to be drawn."""


@dataclass(frozen=True, slots=True)
class RunLeft:
    """What the solution leaves of a run: the sum of squares of so many readings, and whether some of them are angles."""

    angular: bool
    readings: int
    square: float


@dataclass(frozen=True, slots=True)
class TestShown:
    """What one test shows.

    Attributes
    ----------
    test : str
    left : tuple of RunLeft
        Of each run.
    ranges : tuple of (bool, array of shape (p,))
        Of each run at the highest force, whether it reads angles, and `ranges_of`.
    levels : tuple of Level
    responses : tuple of Response
        Of one test alone; of several none.
    set_up : dict of str to dict of str to float [mm]
    harmonics : dict of str to Harmonic
        The strongest of each run around a circle.
    shared : Harmonic or None
        The surest that its runs around a circle share.
    """

    test: str
    left: tuple[RunLeft, ...]
    ranges: tuple[tuple[bool, Array], ...]
    levels: tuple[Level, ...]
    responses: tuple[Response, ...]
    set_up: dict[str, dict[str, float]]
    harmonics: dict[str, Harmonic]
    shared: Harmonic | None

    @property
    def readings(self) -> int:
        """How many it has."""
        return sum(run.readings for run in self.left)

    @property
    def angular(self) -> bool:
        """Whether it reads angles."""
        return any(run.angular for run in self.left)

    @property
    def rmse(self) -> float:
        """Root mean square [mm or rad] of what is left of its readings."""
        return _rmse(self.left)


@dataclass(frozen=True, slots=True)
class Shown:
    """What all tests show, and the traces: held of one test, made again of several."""

    tests: tuple[TestShown, ...]
    patterns: tuple[Pattern, ...]
    traces: Sequence[Trace]

    @property
    def ranges(self) -> Array:
        """As `Systems.range_per_unit` of all tests: where some runs read lengths and some angles, that of lengths."""
        every = [pair for one in self.tests for pair in one.ranges]
        return greatest_range([r for angular, r in every if not angular] or [r for _, r in every])

    @property
    def rmse(self) -> float:
        """Over all readings; where some runs read lengths and some angles, over those of lengths."""
        every = [run for one in self.tests for run in one.left]
        return _rmse([run for run in every if not run.angular] or every)

    @property
    def harmonics(self) -> dict[str, Harmonic]:
        """The strongest of each run around a circle."""
        return {run: harmonic for one in self.tests for run, harmonic in one.harmonics.items()}

    @property
    def shared(self) -> Harmonic | None:
        """The surest harmonic that the runs of a circle share."""
        found = [one.shared for one in self.tests if one.shared is not None]
        return max(found, key=lambda harmonic: (harmonic.significant, harmonic.amplitude), default=None)


def shown(
    campaign: Campaign,
    systems: Systems,
    solution: Solution,
    found: Confounding,
    local: Sequence[Local],
    variable: VariableCompliance | None,
) -> Shown:
    """What a solution shows of all tests, in one pass over their readings."""
    circles = [name for name in systems.tests if campaign.tests[name].setup.pose_quantity == "angle"]
    around = sum(run.test in circles for run in systems.runs)
    tests: list[TestShown] = []
    patterns: dict[tuple[str, ...], Pattern] = {}
    traces: tuple[Trace, ...] = ()
    for name in systems.tests:
        own = systems.of(name).holding(solution.labels)
        traces = tuple(trace_of(run, solution) for run in own.runs)
        patterns |= {g: p for g in found.groups if g not in patterns for p in [_pattern(own, g)] if p is not None}
        looks = (around, len(circles)) if name in circles else None
        senses = {run.name: run.sense for run in campaign.tests[name].runs}
        responses = () if campaign.several else _responses(own, solution, senses)
        levels = _levels(own, traces, solution, local, variable)
        tests.append(_shown(own, solution, traces, levels, responses, looks))
    ordered = tuple(patterns[group] for group in found.groups if group in patterns)
    return Shown(tuple(tests), ordered, TracesAgain(systems, solution) if campaign.several else traces)


def _shown(
    systems: Systems,
    solution: Solution,
    traces: Sequence[Trace],
    levels: tuple[Level, ...],
    responses: tuple[Response, ...],
    looks: tuple[int, int] | None,
) -> TestShown:
    """What one test shows; if it goes around a circle, with how many runs and circles are looked at in all."""
    harmonics, shared = {}, None
    if looks is not None:
        harmonics = {t.run: strongest_harmonic(t.measured - t.predicted, t.pose, looks[0]) for t in traces}
        norms = select(merged(systems.runs), solution.labels).column_norms
        moving = [label for label, norm in zip(solution.labels, norms, strict=True) if norm]
        shared = shared_harmonic(systems.runs, moving, looks[1])
    return TestShown(
        test=systems.runs[0].test,
        left=tuple(_left(run, trace) for run, trace in zip(systems.runs, traces, strict=True)),
        ranges=tuple((run.angular, ranges_of(run, solution.labels)) for run in systems.strongest),
        levels=levels,
        responses=responses,
        set_up={run.name: _set_up(run, solution) for run in systems.runs if run.set_up_names},
        harmonics=harmonics,
        shared=shared,
    )


def _left(run: RunSystem, trace: Trace) -> RunLeft:
    return RunLeft(run.angular, run.readings, float(np.sum((trace.measured - trace.predicted) ** 2)))


def _rmse(runs: Sequence[RunLeft]) -> float:
    return float(np.sqrt(sum(run.square for run in runs) / sum(run.readings for run in runs)))


def trace_of(run: RunSystem, solution: Solution) -> Trace:
    """The measured and the predicted readings of a run."""
    predicted = run.design_of(solution.labels) @ solution.values
    return Trace(run.name, run.force, run.observations.pose, run.reading.copy(), predicted, run.test)


class TracesAgain(Sequence[Trace]):
    """The traces of several tests, each made of readings that are observed anew; of the last test they are kept."""

    def __init__(self, systems: Systems, solution: Solution) -> None:
        self._runs = tuple(run.of_labels(solution.labels) for run in systems.runs)
        self._solution = solution
        self._test, self._last = "", tuple[Trace, ...]()

    def __len__(self) -> int:
        return len(self._runs)

    @overload
    def __getitem__(self, k: int) -> Trace: ...
    @overload
    def __getitem__(self, k: slice) -> tuple[Trace, ...]: ...
    def __getitem__(self, k: int | slice) -> Trace | tuple[Trace, ...]:
        return tuple(map(self._of, self._runs[k])) if isinstance(k, slice) else self._of(self._runs[k])

    def __iter__(self) -> Iterator[Trace]:
        return map(self._of, self._runs)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, TracesAgain) and same(tuple(self), tuple(other))

    __hash__ = None  # type: ignore[assignment]

    def _of(self, run: RunSystem) -> Trace:
        if run.test != self._test:
            own = [one for one in self._runs if one.test == run.test]
            self._test, self._last = (
                run.test,
                tuple(trace_of(one.holding(self._solution.labels), self._solution) for one in own),
            )
        return next(trace for trace in self._last if trace.run == run.name)


def _set_up(run: RunSystem, solution: Solution) -> dict[str, float]:
    values = run.set_up(solution.labels, solution.values)
    return dict(zip(run.set_up_names, map(float, values), strict=True))


def _levels(
    systems: Systems,
    traces: Sequence[Trace],
    solution: Solution,
    local: Sequence[Local],
    variable: VariableCompliance | None,
) -> tuple[Level, ...]:
    fits = variable.levels if variable else (None,) * len(systems.levels)
    return tuple(
        _level(force, systems, traces, solution, fit, [one.solution for one in local if force in one.forces])
        for force, fit in zip(systems.levels, fits, strict=True)
    )


def _level(
    force: float,
    systems: Systems,
    traces: Sequence[Trace],
    solution: Solution,
    variable: Fit | None,
    local: Sequence[Solution],
) -> Level:
    runs = systems.at(force)
    own = [trace for trace in traces if trace.force == force and trace.test == runs[0].test]
    fit = fit_of([(trace.predicted, trace.measured) for trace in own])
    around = [(run.design_of(one.labels) @ one.values, run.reading) for one in local for run in runs]
    by_name = {source.name: source for source in systems.sources}
    machine_parts = [by_name[label] for label in solution.labels if by_name[label].site[1]]
    return Level(
        force=force,
        readings=sum(len(trace.measured) for trace in own),
        rmse=fit.rmse,
        fitness=fit.fitness,
        elastic=_span_of(runs[0], solution, [source for source in machine_parts if source.elastic]),
        geometric=_span_of(runs[0], solution, [source for source in machine_parts if not source.elastic]),
        variable=variable,
        local=fit_of(around) if around else None,
        test=runs[0].test,
    )


def _responses(systems: Systems, solution: Solution, senses: Mapping[str, int]) -> tuple[Response, ...]:
    """Of the first run of each level in each direction, at evenly chosen readings."""
    first: dict[tuple[float, int], RunSystem] = {}
    for run in systems.runs:
        first.setdefault((run.force, senses.get(run.name, 1)), run)  # a part of a run, as a cycle, goes around nothing
    found = []
    for (force, _), run in sorted(first.items(), key=lambda item: item[0][0]):
        chosen = np.unique(np.linspace(0, run.readings - 1, POSES_DRAWN).round().astype(int))
        found.append(Response(run.name, force, run.observations.pose[chosen], run.design_of(solution.labels)[chosen]))
    return tuple(found)


def _span_of(run: RunSystem, solution: Solution, sources: Sequence[Source]) -> tuple[float, float]:
    """Least and greatest deviation that some of the parameters cause together."""
    names = [source.name for source in sources]
    values = [solution.values[solution.labels.index(name)] for name in names]
    part = run.design_of(names) @ np.array(values) if names else np.zeros(1)
    return float(part.min()), float(part.max())


def _pattern(systems: Systems, group: tuple[str, ...]) -> Pattern | None:
    """The response of the first strongest run that a group of parameters moves; None if it moves none."""
    for run in systems.strongest:
        response = run.design_of([group[0]])[:, 0]
        if response.any():
            return Pattern(group, run.observations.pose, response / np.abs(response).max(), run.test)
    return None
