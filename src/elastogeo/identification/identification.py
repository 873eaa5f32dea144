"""From a test to parameters: the one job that everything else serves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from typing import Literal, TypedDict, Unpack

import numpy as np

from elastogeo.errors import DegreesOfFreedomError, InputError, RankError, UnsupportedError
from elastogeo.estimate import (
    Common,
    Confounding,
    Estimate,
    Repeatability,
    Solution,
    confounding,
    minimum_norm,
    repeatability,
    solve,
    solve_by_run,
)
from elastogeo.identification.budget import Budget, agreement, uncertainty_budget
from elastogeo.identification.change import Change, local_change, run_dispersion
from elastogeo.identification.check import Check
from elastogeo.identification.fit import fitness, rmse, strongest_harmonic
from elastogeo.identification.influences import Effect, effects
from elastogeo.identification.models import compare_models
from elastogeo.identification.physics import (
    NOT_TESTED,
    PHYSICALLY_CONSISTENT,
    Consistency,
    consistency,
    physically_consistent,
)
from elastogeo.identification.preference import retaining_order
from elastogeo.identification.reciprocity import Reciprocity, reciprocal_sources, reciprocity
from elastogeo.identification.result import Identification, Level, Local, Parameter, Pattern, Trace
from elastogeo.identification.robust import downweighted
from elastogeo.identification.shared_structure import shared_harmonic
from elastogeo.identification.systems import RunSystem, Systems, force_levels, merged, noise_of, run_systems, same_force
from elastogeo.identification.verdict import (
    above_resolution,
    conditioned,
    first_order_enough,
    forces_distinct,
    free_of_outliers,
    geometry_constant,
    identifiable,
    model_adequate,
    residuals_unstructured,
    separated,
    uncertainty_by_run,
)
from elastogeo.machine import Array
from elastogeo.observe import MachineTest, Observations, Question
from elastogeo.sources import Source, select_sources

LEVELS_FOR_MODELS = 3
"""How many force levels it takes to say more of a compliance than that it is constant."""


class Asked(TypedDict, total=False):
    """What may be asked otherwise than a test asks itself: see `with_question`."""

    parameters: str | Sequence[str] | None
    prefer: str | Sequence[str] | None
    reference: float | Literal["test", "none"]
    levels: Sequence[float] | None
    without_levels: Sequence[float] | None
    reciprocal: bool
    robust: bool


def identify(test: MachineTest, **asked: Unpack[Asked]) -> Identification:
    """Identify the parameters that a test's question asks for.

    Parameters
    ----------
    test : MachineTest
    **asked
        Another question than the test's own, as in `with_question`: `parameters`, `prefer`, `reference`, `levels`,
        `without_levels`, `reciprocal`, `robust`.

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
    test = with_question(test, **asked)
    return identify_observed(test, test.observations())


def identify_observed(test: MachineTest, observations: Sequence[Observations]) -> Identification:
    """Identify the parameters that a test's question asks for, as `identify`, of observations that were made before."""
    systems = systems_of(test, observations)
    found = confounding_of(test, systems)
    if test.question.robust:
        systems = downweighted(systems, found.retained)
    known = effects_of(test, systems)
    return _assessed(_identified(test, systems, found, known), systems, known)


def identified(one: MachineTest | Identification, **asked: Unpack[Asked]) -> Identification:
    """What a test says; of an identification, itself.

    Raises
    ------
    InputError
        If an identification is asked another question: only a test can be.
    """
    if isinstance(one, MachineTest):
        return identify(one, **asked)
    if asked:
        raise InputError(f"{', '.join(asked)} cannot be asked of a result; ask the test, or identify it with this question")
    return one


def _identified(test: MachineTest, systems: Systems, found: Confounding, known: Sequence[Effect]) -> Identification:
    """The estimate and its uncertainty, not yet held against models and physics."""
    naive = solve(merged(systems.runs), found.retained, noise_of(systems.runs, systems.references))
    solution = _by_run(systems, found) or naive
    budget = uncertainty_budget(systems, solution, known)
    traces = tuple(_trace(run, solution) for run in systems.runs)
    return Identification(
        test=test,
        reference_force=test.question.reference_force,
        parameters=_parameters(systems, found, solution, budget),
        confounding=found,
        solution=solution,
        naive=naive,
        by_run=solution is not naive,
        budget=budget,
        local_change=_local_change(systems, found.retained),
        minimum_norm=dict(zip(found.labels, map(float, minimum_norm(merged(systems.runs))), strict=True)),
        traces=traces,
        levels=tuple(_level(force, systems, traces, solution) for force in systems.levels),
        local=_adjacent_estimates(systems, found.retained),
        repeats=_repeats(systems, found.retained),
        patterns=_patterns(systems, found),
        set_up={run.name: _set_up(run, systems.own, solution) for run in systems.runs if systems.own},
        rmse=rmse(np.concatenate([t.predicted for t in traces]), np.concatenate([t.measured for t in traces])),
        verdict=(),
    )


def _assessed(result: Identification, systems: Systems, known: Sequence[Effect]) -> Identification:
    """The result with its verdict, and with what models and physics say where they can."""
    parameters, geometric = result.parameters, [p.name for p in result.parameters if not p.elastic]
    elastic = any(p.elastic and p.axis for p in parameters) and all(p.separated for p in parameters)
    if elastic and not systems.references and len(systems.levels) >= LEVELS_FOR_MODELS:
        result = replace(result, models=compare_models(result.test.machine, systems, result.confounding.retained))
    result, drawn = _held_against_draws(result, systems, known)
    physics = None
    if elastic:
        result, physics = _held_against_physics(result)
    around = result.traces if result.test.setup.pose_quantity == "angle" else ()
    harmonics = {t.run: strongest_harmonic(t.measured - t.predicted, t.pose, len(around)) for t in around}
    shared = shared_harmonic(systems.runs, result.solution.labels) if around and result.by_run else None
    robust = result.test.question.robust
    both = len({source.elastic for source in systems.sources}) == 2
    verdict = (
        identifiable(result.confounding),
        forces_distinct(systems.applied) if any(source.elastic for source in systems.sources) else None,
        separated(parameters) if both else None,
        conditioned(result.confounding),
        residuals_unstructured(harmonics, shared, result.rmse) if around else None,
        uncertainty_by_run(result.by_run, len(systems.runs), bool(systems.references)),
        drawn,
        free_of_outliers([run.weights for run in systems.runs if run.weights is not None]) if robust else None,
        above_resolution({p.name: abs(p.peak_to_peak) for p in parameters}, result.test.resolution),
        geometry_constant(result.local_change, geometric) if result.local_change and geometric else None,
        model_adequate(result.models) if result.models else None,
        physics,
    )
    return replace(result, verdict=tuple(check for check in verdict if check is not None))


def _held_against_draws(
    result: Identification, systems: Systems, known: Sequence[Effect]
) -> tuple[Identification, Check | None]:
    """The result with the random draws of its influences, if it has any; a check that could not be made says so."""
    if not known:
        return result, None
    try:
        drawn = agreement(systems, result.solution, known, result.budget)
    except UnsupportedError as error:
        return result, Check("first order enough", None, {"why": str(error)})
    return replace(result, agreement=drawn), first_order_enough(drawn, result.parameters)


def _held_against_physics(result: Identification) -> tuple[Identification, Check]:
    """The result with what physics says of its compliances; a check that could not be made says so."""
    try:
        found = consistency_of(result)
    except (InputError, UnsupportedError) as error:
        return result, Check(PHYSICALLY_CONSISTENT, None, {"state": NOT_TESTED, "why": str(error)})
    known = replace(result.solution, covariance=result.budget.covariance)
    return replace(result, consistency=found), physically_consistent(
        found, sources_of(result.test), result.confounding, known
    )


def with_question(
    test: MachineTest,
    parameters: str | Sequence[str] | None = None,
    prefer: str | Sequence[str] | None = None,
    reference: float | Literal["test", "none"] = "test",
    levels: Sequence[float] | None = None,
    without_levels: Sequence[float] | None = None,
    reciprocal: bool = False,
    robust: bool = False,
) -> MachineTest:
    """The test with another question: its own where nothing else is given.

    Parameters
    ----------
    test : MachineTest
    parameters : str or sequence of str, optional
        Names, patterns (`C_??X`) or presets (`planar-xy`) of the parameters to identify.
    prefer : str or sequence of str, optional
        Parameters to retain before others that cannot be told from them.
    reference : float [N], "none" or "test"
        Force level to subtract from all others; `"test"`: that of the test, if it has one.
    levels, without_levels : sequence of float [N], optional
        Force levels to use alone, and to leave out.
    reciprocal : bool
        Take each joint as symmetric: C_dfj and C_fdj are one parameter.
    robust : bool
        Let outlying readings count less (Huber).

    Raises
    ------
    InputError
        If the reference is neither a force nor one of the two words.
    """
    question = test.question
    if isinstance(reference, str) and reference not in ("test", "none"):
        raise InputError(f"the reference level is {reference!r}; give a force in N, or 'none' to subtract none")
    force = question.reference_force if reference == "test" else None if reference == "none" else float(reference)
    asked = Question(
        parameters=_listed(parameters) or question.parameters,
        reference_force=force,
        prefer=_listed(prefer) or question.prefer,
        levels=tuple(levels or question.levels),
        without_levels=tuple(without_levels or question.without_levels),
        reciprocal=reciprocal or question.reciprocal,
        robust=robust or question.robust,
    )
    return replace(test, question=asked)


def _listed(names: str | Sequence[str] | None) -> tuple[str, ...]:
    """Names, of which one alone may be given as it is."""
    return (names,) if isinstance(names, str) else tuple(names or ())


def systems_of(test: MachineTest, observations: Sequence[Observations] | None = None) -> Systems:
    """The linear systems that a test and its question amount to, of its observations if they were made before."""
    sources = sources_of(test)
    chosen = chosen_observations(test.observations() if observations is None else observations, test.question)
    return run_systems(sources, test.machine, chosen, test.question.reference_force, own_to_run(test, sources))


def sources_of(test: MachineTest) -> tuple[Source, ...]:
    """The error sources that a test's question asks for."""
    sources = select_sources(test.machine, test.asked)
    return reciprocal_sources(sources) if test.question.reciprocal else sources


def own_to_run(test: MachineTest, sources: Sequence[Source]) -> tuple[Source, ...]:
    """The set-up that every run has for itself; none where it is asked for as one for all, or a reference is subtracted."""
    patterns = test.setup.own_to_run
    if not patterns or test.question.reference_force is not None:
        return ()
    own = select_sources(test.machine, patterns)
    asked = {source.name for source in sources}
    return () if any(source.name in asked for source in own) else own


def chosen_observations(observations: Sequence[Observations], question: Question) -> tuple[Observations, ...]:
    """The runs at the force levels that a question wants; the reference stays.

    Raises
    ------
    InputError
        If it names a level at which no run is.
    """
    forces = force_levels(run.force for run in observations)
    for level in (*question.levels, *question.without_levels):
        if not any(same_force(level, force) for force in forces):
            raise InputError(f"no run has the force {level:g} N; there are {', '.join(f'{force:g}' for force in forces)} N")
    kept = (*question.levels, *(() if question.reference_force is None else (question.reference_force,)))
    return tuple(
        run
        for run in observations
        if (not question.levels or any(same_force(run.force, level) for level in kept))
        and not any(same_force(run.force, level) for level in question.without_levels)
    )


def confounding_of(test: MachineTest, systems: Systems) -> Confounding:
    """What the test can and cannot tell apart of what its question asks for."""
    observations = [run.observations for run in systems.runs]
    order = retaining_order(systems.sources, test.machine, observations, test.question.prefer)
    return confounding(merged(systems.runs), order, systems.ceilings, max(run.collinear for run in observations))


def consistency_of(identification: Identification) -> Consistency:
    """Whether what a test says agrees with the physics of joints, by its uncertainty with all influences.

    An uncertainty by run has few degrees of freedom; the correlations that measure the distance are those of independent
    readings.
    """
    budget, naive = identification.budget, identification.naive
    return consistency(
        sources_of(identification.test),
        identification.confounding,
        replace(identification.solution, covariance=budget.covariance, degrees_of_freedom=budget.degrees_of_freedom),
        correlated_as=naive.covariance if identification.by_run else None,
        by_reading=not identification.by_run,
    )


def what_reciprocity_buys(test: MachineTest) -> Reciprocity:
    """What taking each joint as symmetric buys for a test's question."""
    question = test.question
    sources = select_sources(test.machine, test.asked)
    return reciprocity(sources, test.machine, test.observations(), question.reference_force, question.prefer)


def effects_of(test: MachineTest, systems: Systems) -> tuple[Effect, ...]:
    """The effects of the systematic influences that a test states.

    Raises
    ------
    UnsupportedError
        If a reference level is taken off: the influences would enter reference and level alike.
    """
    if test.influences and systems.references:
        raise UnsupportedError(
            "systematic influences are propagated through the model without a reference level; "
            "leave reference_force out and ask for geometry and compliance together (elasto-geometric-xy)"
        )
    return effects(test, systems)


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
    strongest = _strongest(systems)
    dispersion = _dispersion(systems, retained)
    found = []
    for levels in choices:
        runs = systems.at(*levels)
        solution = solve(merged(runs), retained, noise_of(runs, systems.references))
        if dispersion is not None:
            variance, freedom = dispersion
            covariance = solution.covariance * (variance / solution.residual_std**2)
            solution = replace(solution, covariance=covariance, degrees_of_freedom=np.full(len(retained), freedom))
        spans = np.ptp(strongest.design_of(retained), axis=0) * solution.values
        found.append(Local(tuple(levels), solution, dict(zip(retained, map(float, spans), strict=True))))
    return tuple(found)


def _adjacent_estimates(systems: Systems, retained: Sequence[str]) -> tuple[Local, ...]:
    """Local estimates from the pairs of adjacent levels that determine the parameters: a pair read one way only may not."""
    found: list[Local] = []
    for pair in adjacent(systems.levels):
        with suppress(RankError, DegreesOfFreedomError):
            found.extend(local_estimates(systems, retained, [pair]))
    return tuple(found)


def _by_run(systems: Systems, found: Confounding) -> Solution | None:
    """The solution with its uncertainty by run; None where a reference is taken off or the runs are too few."""
    if systems.references or len(systems.runs) < 2:
        return None
    try:
        return solve_by_run([run.factor for run in systems.runs], found.retained)
    except DegreesOfFreedomError:
        return None


def _dispersion(systems: Systems, retained: Sequence[str]) -> tuple[float, float] | None:
    """Variance of a reading as the scatter between runs shows it; None where it cannot be had."""
    if systems.references:
        return None
    try:
        return run_dispersion([run.factor for run in systems.runs], retained)
    except (DegreesOfFreedomError, RankError):
        return None


def _local_change(systems: Systems, retained: Sequence[str]) -> Change | None:
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


def _set_up(run: RunSystem, own: Sequence[Source], solution: Solution) -> dict[str, float]:
    values = run.set_up(solution.labels, solution.values)
    return {source.name: float(value) for source, value in zip(own, values, strict=True)}


def _strongest(systems: Systems) -> RunSystem:
    return max(systems.runs, key=lambda run: abs(run.force))


def _trace(run: RunSystem, solution: Solution) -> Trace:
    return Trace(run.name, run.force, run.observations.pose, run.reading, run.design_of(solution.labels) @ solution.values)


def _level(force: float, systems: Systems, traces: Sequence[Trace], solution: Solution) -> Level:
    chosen = [trace for trace in traces if same_force(trace.force, force)]
    measured = np.concatenate([trace.measured for trace in chosen])
    predicted = np.concatenate([trace.predicted for trace in chosen])
    run = systems.at(force)[0]
    by_name = {source.name: source for source in systems.sources}
    machine_parts = [by_name[label] for label in solution.labels if by_name[label].site[1]]
    return Level(
        force=force,
        readings=len(measured),
        rmse=rmse(predicted, measured),
        fitness=fitness(predicted, measured),
        elastic=_span_of(run, solution, [source for source in machine_parts if source.elastic]),
        geometric=_span_of(run, solution, [source for source in machine_parts if not source.elastic]),
    )


def _span_of(run: RunSystem, solution: Solution, sources: Sequence[Source]) -> tuple[float, float]:
    """Least and greatest deviation that some of the parameters cause together."""
    names = [source.name for source in sources]
    values = [solution.values[solution.labels.index(name)] for name in names]
    part = run.design_of(names) @ np.array(values) if names else np.zeros(1)
    return float(part.min()), float(part.max())


def _parameters(systems: Systems, found: Confounding, solution: Solution, budget: Budget) -> tuple[Parameter, ...]:
    by_name = {source.name: source for source in systems.sources}
    spans = _spans(systems, solution.labels) * solution.values
    total = float(np.abs(spans).sum()) or 1.0
    return tuple(
        Parameter(
            name=name,
            unit=by_name[name].unit,
            meaning=by_name[name].meaning,
            estimate=Estimate(
                float(solution.values[k]), float(budget.standard_uncertainty[k]), float(budget.degrees_of_freedom[k])
            ),
            interval=(float(budget.interval[k, 0]), float(budget.interval[k, 1])),
            stands_for=found.stands_for(name),
            peak_to_peak=float(spans[k]),
            share=float(abs(spans[k])) / total,
            axis=by_name[name].site[1],
            elastic=by_name[name].elastic,
            sign=by_name[name].sign,
            separated=len({by_name[other].elastic for other in found.stands_for(name)}) == 1,
        )
        for k, name in enumerate(solution.labels)
    )


def _spans(systems: Systems, labels: Sequence[str]) -> Array:
    """Span of the columns over the strongest run; over all runs where a run has one force at one place."""
    within = np.ptp(_strongest(systems).design_of(labels), axis=0)
    over_all = np.ptp(np.vstack([run.design_of(labels) for run in systems.runs]), axis=0)
    return np.asarray(np.where(within > 0, within, over_all))


def _repeats(systems: Systems, retained: Sequence[str]) -> Repeatability | None:
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


def _patterns(systems: Systems, found: Confounding) -> tuple[Pattern, ...]:
    strongest = _strongest(systems)
    responses = {group: strongest.design_of([group[0]])[:, 0] for group in found.groups}
    pose = strongest.observations.pose
    return tuple(
        Pattern(group, pose, response / np.abs(response).max()) for group, response in responses.items() if response.any()
    )
