"""From a test to parameters: the one job that everything else serves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Unpack

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import (
    Confounding,
    Estimate,
    Solution,
    minimum_norm,
    runs_needed,
    select,
    solve,
    solve_as_runs_show,
)
from elastogeo.identification.budget import Budget, agreement, uncertainty_budget
from elastogeo.identification.campaigns.agreement import tests_agree, tests_agreement
from elastogeo.identification.campaigns.parts import Shares, TestPart, shares_of
from elastogeo.identification.campaigns.scopes import truth_of
from elastogeo.identification.check import Check
from elastogeo.identification.fit import Fit, Harmonic, fit_of, rmse, strongest_harmonic
from elastogeo.identification.influences import Effect
from elastogeo.identification.local import adjacent_estimates, change_between_levels, of_repeats
from elastogeo.identification.model_choice.choice import compare_models
from elastogeo.identification.model_choice.missing_geometry import with_missing_geometry
from elastogeo.identification.model_choice.variable_compliance import VariableCompliance, variable_compliance
from elastogeo.identification.physics import (
    NOT_TESTED,
    PHYSICALLY_CONSISTENT,
    Consistency,
    consistency,
    physically_consistent,
)
from elastogeo.identification.question import (
    Asked,
    confounding_of,
    effects_of,
    sources_of,
    systems_of,
    with_question,
)
from elastogeo.identification.result import Identification, Level, Local, Parameter, Pattern, Response, Trace
from elastogeo.identification.robust import downweighted
from elastogeo.identification.rounding import ROUNDING
from elastogeo.identification.shared_structure import shared_harmonic
from elastogeo.identification.systems import RunSystem, Systems, merged, noise_of
from elastogeo.identification.verdict import (
    above_resolution,
    conditioned,
    first_order_enough,
    forces_distinct,
    free_of_assumptions,
    free_of_outliers,
    geometry_constant,
    geometry_modelled,
    identifiable,
    influences_stated,
    levels_agree,
    model_adequate,
    residuals_unstructured,
    separated,
    uncertainty_by_run,
)
from elastogeo.observe import Askable, Campaign, MachineTest, Observations, campaign_of
from elastogeo.sources import Source

POSES_DRAWN = 181
"""Poses of a run at which its response is kept to be drawn."""

LEVELS_FOR_MODELS = 2
"""How many force levels it takes for a comparison of models to have anything to say, if only that they are too few."""


def identify(one: Askable, **asked: Unpack[Asked]) -> Identification:
    """Identify the parameters that the question of a test, or of several tests of one machine, asks for.

    Parameters
    ----------
    one : MachineTest, Campaign, sequence of MachineTest, or mapping of str to MachineTest
        A test; or several, of any instruments, that are estimated together: parameters of the machine are one for all, the
        set-up is of each test.
    **asked
        Another question than the tests' own, as in `with_question`: `parameters`, `prefer`, `reference`, `levels`,
        `without_levels`, `reciprocal`, `robust`.

    Returns
    -------
    Identification

    Raises
    ------
    SelectionError
        If the question names no error source of the machine.
    InputError
        If the tests are not of one machine, or one of several subtracts a reference level.
    UnsupportedError
        If no parameter changes any reading, the reference level is missing, or there are too few readings.
    """
    return identify_observed(with_question(campaign_of(one), **asked))


def identify_observed(one: Askable, observations: Sequence[Observations] | None = None) -> Identification:
    """Identify what the tests' question asks for, as `identify`; of one test with observations that were made before."""
    campaign = campaign_of(one)
    if observations is None and not campaign.several:
        observations = campaign.only.observations()
    systems = systems_of(campaign, observations)
    found = confounding_of(campaign, systems)
    if campaign.question.robust:
        systems = downweighted(systems, found.retained)
    if campaign.several:
        systems = systems.holding(found.retained)
    known = effects_of(campaign, systems)
    result = replace(_identified(campaign, systems, found, known), corrected=_corrected(campaign, observations or (), found))
    return _assessed(result, systems, known)


def identified(one: MachineTest | Identification, **asked: Unpack[Asked]) -> Identification:
    """What one test says; of an identification, itself.

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


def _identified(campaign: Campaign, systems: Systems, found: Confounding, known: Sequence[Effect]) -> Identification:
    """The estimate and its uncertainty, not yet held against models and physics."""
    naive = solve(merged(systems.runs), found.retained, noise_of(systems.runs, systems.references))
    by_run, unshown = _by_run(systems, found)
    solution = by_run or naive
    budget = uncertainty_budget(systems, solution, known)
    traces = tuple(_trace(run, solution) for run in systems.runs)
    shares, one = shares_of(systems, solution.labels), not campaign.several
    parts = [systems.of(test) for test in systems.tests]
    local = adjacent_estimates(systems, found.retained) if one else ()
    variable = variable_compliance(systems, found.retained) if one else None
    truth = truth_of(campaign, systems.sources)
    return Identification(
        campaign=campaign,
        tests=tuple(_part(k, part, traces, shares) for k, part in enumerate(parts)),
        together=() if one else shares.together,
        information={} if one else _information(shares, systems.tests),
        reference_force=campaign.question.reference_force,
        parameters=_parameters(systems, found, solution, budget if by_run else None, unshown, truth),
        confounding=found,
        solution=solution,
        naive=naive,
        by_run=by_run is not None,
        unshown=unshown,
        budget=budget,
        local_change=change_between_levels(systems, found.retained) if one else None,
        minimum_norm=dict(zip(found.labels, map(float, minimum_norm(merged(systems.runs))), strict=True)),
        traces=traces,
        levels=tuple(level for part in parts for level in _levels(part, traces, solution, local, variable)),
        local=local,
        repeats=of_repeats(systems, found.retained) if one else None,
        patterns=_patterns(systems, found),
        responses=_responses(campaign, systems, solution),
        variable=variable,
        set_up={run.name: _set_up(run, solution) for run in systems.runs if run.set_up_names},
        corrected={},
        rmse=_rmse([trace for trace, run in zip(traces, systems.runs, strict=True) if not run.angular] or traces),
        verdict=(),
    )


def _assessed(result: Identification, systems: Systems, known: Sequence[Effect]) -> Identification:
    """The result with its verdict, and with what models and physics say where they can."""
    parameters, geometric = result.parameters, [p.name for p in result.parameters if not p.elastic]
    elastic = any(p.elastic and p.axis for p in parameters) and all(p.separated for p in parameters)
    campaign = result.campaign
    circles = [name for name, test in campaign.tests.items() if test.setup.pose_quantity == "angle"]
    if elastic and not campaign.several and not systems.references and len(systems.levels) >= LEVELS_FOR_MODELS:
        models = compare_models(campaign.machine, systems, result.confounding.retained, bool(circles))
        result = replace(result, models=models)
    result = replace(result, tests_agreement=tests_agreement(systems, result.solution, known))
    result, drawn = _held_against_draws(result, systems, known)
    physics = None
    if elastic:
        result, physics = _held_against_physics(result, systems)
    around = [trace for trace in result.traces if trace.test in circles]
    harmonics = {t.run: strongest_harmonic(t.measured - t.predicted, t.pose, len(around)) for t in around}
    shared = _shared(systems, circles, result.solution.labels) if result.by_run else None
    robust = campaign.question.robust
    elastic_sources = [source for source in systems.sources if source.elastic]
    both = 0 < len(elastic_sources) < len(systems.sources)
    reference, runs = bool(systems.references), len(systems.runs)
    needed = (
        None
        if (result.by_run and not result.unshown) or reference
        else runs_needed([run.factor for run in systems.runs], result.solution.labels)
    )
    stated = [effect.influence.label for effect in known if effect.influence.label != ROUNDING]
    stated += [one.label or one.kind for test in campaign.tests.values() for one in test.influences]
    verdict = (
        identifiable(result.confounding, by_default=not campaign.question.parameters),
        forces_distinct(systems.applied, both) if elastic_sources and not _weighed(campaign) else None,
        geometry_modelled(systems.sources, reference, bool(around)) if elastic_sources and _goes_around(systems) else None,
        separated(parameters, systems.applied) if both else None,
        conditioned(result.confounding),
        residuals_unstructured(harmonics, shared, result.rmse) if around else None,
        uncertainty_by_run(result.by_run, runs, reference, needed, result.unshown),
        influences_stated(stated, reference),
        free_of_assumptions(result.budget),
        drawn,
        free_of_outliers([run.weights for run in systems.runs if run.weights is not None]) if robust else None,
        above_resolution(
            {p.name: abs(p.peak_to_peak) for p in parameters}, _resolution(campaign), angles=_reads_angles(campaign)
        ),
        model_adequate(result.models) if result.models else None,
        levels_agree(result.models) if result.models else None,
        tests_agree(result.tests_agreement) if result.tests_agreement else None,
        geometry_constant(result.models, result.local_change, geometric) if result.models and geometric else None,
        physics,
    )
    return replace(result, verdict=tuple(check for check in verdict if check is not None))


def _held_against_draws(
    result: Identification, systems: Systems, known: Sequence[Effect]
) -> tuple[Identification, Check | None]:
    """The result with the random draws of its influences, if it has any; a check that could not be made says so.

    Where the first order is not enough, the interval of the draws is that of the parameter.
    """
    if not (known and result.by_run):
        return result, None
    try:
        drawn = agreement(systems, result.solution, known, result.budget)
    except UnsupportedError as error:
        return result, Check("first order enough", None, {"why": str(error)})
    parameters = tuple(
        parameter
        if drawn.agrees[k] or parameter.interval is None
        else replace(parameter, interval=(float(low), float(high)))
        for k, (parameter, (low, high)) in enumerate(zip(result.parameters, drawn.interval, strict=True))
    )
    return replace(result, agreement=drawn, parameters=parameters), first_order_enough(drawn, parameters)


def _shared(systems: Systems, circles: Sequence[str], labels: Sequence[str]) -> Harmonic | None:
    """The surest harmonic that the runs of a circular test share, and whether it is one for so many tests."""
    parts = [systems.of(test).runs for test in circles if test in systems.tests]
    norms = [select(merged(runs), labels).column_norms for runs in parts]
    seen = [[label for label, norm in zip(labels, own, strict=True) if norm] for own in norms]
    found = [shared_harmonic(runs, own, len(parts)) for runs, own in zip(parts, seen, strict=True)]
    return max(filter(None, found), key=lambda harmonic: (harmonic.significant, harmonic.amplitude), default=None)


def _resolution(campaign: Campaign) -> float | None:
    """The coarsest resolution of the tests that state one, of angles only if all read angles; None if none does."""
    angles = _reads_angles(campaign)
    alike = (test for test in campaign.tests.values() if test.setup.reads_angles == angles)
    return max((test.resolution for test in alike if test.resolution is not None), default=None)


def _reads_angles(campaign: Campaign) -> bool:
    return all(test.setup.reads_angles for test in campaign.tests.values())


def _weighed(campaign: Campaign) -> bool:
    """Whether known weights load the machine, so that compliance shows without a force at the tool."""
    carriages = any(joint.mass for joint in campaign.machine.joints)
    return carriages or any(test.workpiece is not None and bool(test.workpiece.mass) for test in campaign.tests.values())


def _goes_around(systems: Systems) -> bool:
    """Whether the axes move within the test, so that its readings hold the geometry of the machine."""
    return any(np.ptp(run.observations.commands, axis=0).any() for run in systems.runs)


def _held_against_physics(result: Identification, systems: Systems) -> tuple[Identification, Check]:
    """The result with what physics says of its compliances; a check that could not be made says so."""
    try:
        found = consistency_of(result)
    except (InputError, UnsupportedError) as error:
        return result, Check(PHYSICALLY_CONSISTENT, None, {"state": NOT_TESTED, "why": str(error)})
    known = replace(result.solution, covariance=result.budget.covariance)
    check = physically_consistent(found, sources_of(result.campaign), result.confounding, known)
    result = replace(result, consistency=found)
    if check.passed is not False or result.models is None:
        return result, check
    geometry = with_missing_geometry(result.campaign.only, systems, result.models)
    if geometry is None:
        return result, check
    facts = {**check.facts, "with_geometry": geometry.facts_of(check.facts["negative"])}
    return replace(result, missing_geometry=geometry), replace(check, facts=facts)


def consistency_of(identification: Identification) -> Consistency:
    """Whether what a test says agrees with the physics of joints, by its uncertainty with all influences.

    An uncertainty by run has few degrees of freedom; the correlations that measure the distance are those of independent
    readings.
    """
    budget, naive = identification.budget, identification.naive
    return consistency(
        sources_of(identification.campaign),
        identification.confounding,
        replace(identification.solution, covariance=budget.covariance, degrees_of_freedom=budget.degrees_of_freedom),
        correlated_as=naive.covariance if identification.by_run and naive.residual_std else None,
        by_reading=not identification.by_run,
    )


def _by_run(systems: Systems, found: Confounding) -> tuple[Solution | None, tuple[str, ...]]:
    """The solution with its uncertainty by run, and the parameters of which the runs show none.

    No solution where a reference is taken off, or the runs are too few for every parameter.
    """
    if systems.references or len(systems.runs) < 2:
        return None, ()
    solution, unshown = solve_as_runs_show([run.factor for run in systems.runs], found.retained)
    return (None, ()) if len(unshown) == len(found.retained) else (solution, unshown)


def _part(k: int, systems: Systems, traces: Sequence[Trace], shares: Shares) -> TestPart:
    """What one test adds."""
    test = systems.runs[0].test
    own = [trace for trace in traces if trace.test == test]
    return TestPart(
        name=test,
        runs=len(systems.runs),
        readings=sum(len(trace.measured) for trace in own),
        forces=systems.levels,
        rmse=_rmse(own),
        scatter=systems.scatter.get(test),
        angular=any(run.angular for run in systems.runs),
        rank=shares.ranks[k],
        alone=shares.named(shares.alone[k]),
        rank_so_far=shares.ranks_so_far[k],
        adds=shares.adds(k),
    )


def _information(shares: Shares, tests: Sequence[str]) -> dict[str, dict[str, float]]:
    columns = zip(shares.labels, shares.information.T, strict=True)
    return {label: dict(zip(tests, map(float, column), strict=True)) for label, column in columns}


def _rmse(traces: Sequence[Trace]) -> float:
    return rmse(np.concatenate([t.predicted for t in traces]), np.concatenate([t.measured for t in traces]))


def _corrected(campaign: Campaign, observations: Sequence[Observations], found: Confounding) -> dict[str, float]:
    """How much greater each parameter would be with what was subtracted from one test's readings left in; else empty."""
    if not any(run.correction.any() for run in observations):
        return {}
    left_in = systems_of(campaign, [run.with_reading(run.correction) for run in observations])
    values = solve(merged(left_in.runs), found.retained).values
    return dict(zip(found.retained, map(float, values), strict=True))


def _set_up(run: RunSystem, solution: Solution) -> dict[str, float]:
    values = run.set_up(solution.labels, solution.values)
    return dict(zip(run.set_up_names, map(float, values), strict=True))


def _trace(run: RunSystem, solution: Solution) -> Trace:
    predicted = run.design_of(solution.labels) @ solution.values
    return Trace(run.name, run.force, run.observations.pose, run.reading.copy(), predicted, run.test)


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


def _responses(campaign: Campaign, systems: Systems, solution: Solution) -> tuple[Response, ...]:
    """Of the first run of each level in each direction of each test, at evenly chosen readings."""
    senses = {name: {run.name: run.sense for run in test.runs} for name, test in campaign.tests.items()}
    first: dict[tuple[float, str, int], RunSystem] = {}
    for run in systems.runs:
        sense = senses[run.test].get(run.name.removeprefix(f"{run.test}/"), 1)
        first.setdefault((run.force, run.test, sense), run)  # a part of a run, as a cycle, goes around nothing
    found = []
    for (force, *_), run in sorted(first.items(), key=lambda item: item[0][0]):
        chosen = np.unique(np.linspace(0, len(run.reading) - 1, POSES_DRAWN).round().astype(int))
        found.append(Response(run.name, force, run.observations.pose[chosen], run.design_of(solution.labels)[chosen]))
    return tuple(found)


def _span_of(run: RunSystem, solution: Solution, sources: Sequence[Source]) -> tuple[float, float]:
    """Least and greatest deviation that some of the parameters cause together."""
    names = [source.name for source in sources]
    values = [solution.values[solution.labels.index(name)] for name in names]
    part = run.design_of(names) @ np.array(values) if names else np.zeros(1)
    return float(part.min()), float(part.max())


def _parameters(
    systems: Systems,
    found: Confounding,
    solution: Solution,
    budget: Budget | None,
    unshown: Sequence[str],
    truth: Mapping[str, float],
) -> tuple[Parameter, ...]:
    """The parameters; without a budget, without uncertainty; of readings that were measured, without a truth."""
    budgets = {name: None if name in unshown else budget for name in solution.labels}
    by_name = {source.name: source for source in systems.sources}
    ranges = systems.range_per_unit(solution.labels) * solution.values
    machine = [not by_name[name].set_up for name in solution.labels]
    total = float(np.abs(ranges[machine]).sum()) or 1.0
    return tuple(
        Parameter(
            name=name,
            unit=by_name[name].unit,
            meaning=by_name[name].meaning,
            value=float(solution.values[k]),
            estimate=_estimate(solution, budgets[name], k),
            interval=_interval(budgets[name], k),
            stands_for=found.stands_for(name),
            peak_to_peak=float(ranges[k]),
            share=float(abs(ranges[k])) / total if machine[k] else 0.0,
            axis=by_name[name].site[1],
            elastic=by_name[name].elastic,
            sign=by_name[name].sign,
            separated=len({by_name[other].elastic for other in found.stands_for(name)}) == 1,
            truth=sum(c * truth.get(other, 0.0) for other, c in found.stands_for(name).items()) if truth else None,
        )
        for k, name in enumerate(solution.labels)
    )


def _interval(budget: Budget | None, k: int) -> tuple[float, float] | None:
    return None if budget is None else (float(budget.interval[k, 0]), float(budget.interval[k, 1]))


def _estimate(solution: Solution, budget: Budget | None, k: int) -> Estimate | None:
    if budget is None:
        return None
    return Estimate(float(solution.values[k]), float(budget.standard_uncertainty[k]), float(budget.degrees_of_freedom[k]))


def _patterns(systems: Systems, found: Confounding) -> tuple[Pattern, ...]:
    patterns = []
    for group in found.groups:
        for run in systems.strongest:
            response = run.design_of([group[0]])[:, 0]
            if response.any():
                patterns.append(Pattern(group, run.observations.pose, response / np.abs(response).max(), run.test))
                break
    return tuple(patterns)
