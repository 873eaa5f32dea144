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
    solve,
    solve_as_runs_show,
)
from elastogeo.identification.budget import Budget, agreement, budget_of
from elastogeo.identification.campaigns.agreement import tests_agree, tests_agreement
from elastogeo.identification.campaigns.parts import Shares, TestPart, shares_of
from elastogeo.identification.campaigns.scopes import truth_of
from elastogeo.identification.check import Check
from elastogeo.identification.local import adjacent_estimates, change_between_levels, of_repeats
from elastogeo.identification.model_choice.choice import compare_models
from elastogeo.identification.model_choice.missing_geometry import with_missing_geometry
from elastogeo.identification.model_choice.variable_compliance import variable_compliance
from elastogeo.identification.moments import Moments, moments_of
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
from elastogeo.identification.readings.robust import downweighted
from elastogeo.identification.readings.rounding import ROUNDING
from elastogeo.identification.readings.shown import Shown, TestShown, shown
from elastogeo.identification.result import Identification, Parameter
from elastogeo.identification.systems import Systems, merged, noise_of
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
from elastogeo.machine import Array
from elastogeo.observe import Askable, Campaign, MachineTest, Observations, campaign_of

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
    result, seen, moments = _identified(campaign, systems, found)
    result = replace(result, corrected=_corrected(campaign, observations or (), found))
    return _assessed(result, systems, seen, moments)


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


def _identified(campaign: Campaign, systems: Systems, found: Confounding) -> tuple[Identification, Shown, Moments]:
    """The estimate and its uncertainty, not yet held against models and physics; what the tests show, and about what."""
    naive = solve(merged(systems.runs), found.retained, noise_of(systems.runs, systems.references))
    by_run, unshown = _by_run(systems, found)
    solution = by_run or naive
    moments = moments_of(systems, solution, effects_of(campaign, systems))
    budget = budget_of(solution, moments)
    shares, one = shares_of(systems, solution.labels), not campaign.several
    local = adjacent_estimates(systems, found.retained) if one else ()
    variable = variable_compliance(systems, found.retained) if one else None
    seen = shown(campaign, systems, solution, found, local, variable)
    truth = truth_of(campaign, systems.sources)
    result = Identification(
        campaign=campaign,
        tests=tuple(_part(k, systems.of(part.test), part, shares) for k, part in enumerate(seen.tests)),
        together=() if one else shares.together,
        information={} if one else _information(shares, systems.tests),
        reference_force=campaign.question.reference_force,
        parameters=_parameters(systems, seen.ranges, found, solution, budget if by_run else None, unshown, truth),
        confounding=found,
        solution=solution,
        naive=naive,
        by_run=by_run is not None,
        unshown=unshown,
        budget=budget,
        local_change=change_between_levels(systems, found.retained) if one else None,
        minimum_norm=dict(zip(found.labels, map(float, minimum_norm(merged(systems.runs))), strict=True)),
        traces=seen.traces,
        levels=tuple(level for part in seen.tests for level in part.levels),
        local=local,
        repeats=of_repeats(systems, found.retained) if one else None,
        patterns=seen.patterns,
        responses=tuple(one for part in seen.tests for one in part.responses),
        variable=variable,
        set_up={run: values for part in seen.tests for run, values in part.set_up.items()},
        corrected={},
        rmse=seen.rmse,
        verdict=(),
    )
    return result, seen, moments


def _assessed(result: Identification, systems: Systems, seen: Shown, moments: Moments) -> Identification:
    """The result with its verdict, and with what models and physics say where they can."""
    parameters, geometric = result.parameters, [p.name for p in result.parameters if not p.elastic]
    elastic = any(p.elastic and p.axis for p in parameters) and all(p.separated for p in parameters)
    campaign = result.campaign
    circles = [name for name, test in campaign.tests.items() if test.setup.pose_quantity == "angle"]
    if elastic and not campaign.several and not systems.references and len(systems.levels) >= LEVELS_FOR_MODELS:
        models = compare_models(campaign.machine, systems, result.confounding.retained, bool(circles), moments.effects)
        result = replace(result, models=models)
    result = replace(result, tests_agreement=tests_agreement(systems, result.solution, moments))
    result, drawn = _held_against_draws(result, moments)
    physics = None
    if elastic:
        result, physics = _held_against_physics(result, systems)
    robust = campaign.question.robust
    elastic_sources = [source for source in systems.sources if source.elastic]
    both = 0 < len(elastic_sources) < len(systems.sources)
    reference, runs = bool(systems.references), len(systems.runs)
    needed = (
        None
        if (result.by_run and not result.unshown) or reference
        else runs_needed([run.factor for run in systems.runs], result.solution.labels)
    )
    stated = [effect.influence.label for effect in moments.effects if effect.influence.label != ROUNDING]
    stated += [one.label or one.kind for test in campaign.tests.values() for one in test.influences]
    verdict = (
        identifiable(result.confounding, by_default=not campaign.question.parameters),
        forces_distinct(systems.applied, both) if elastic_sources and not _weighed(campaign) else None,
        geometry_modelled(systems.sources, reference, bool(circles)) if elastic_sources and _goes_around(systems) else None,
        separated(parameters, systems.applied) if both else None,
        conditioned(result.confounding),
        residuals_unstructured(seen.harmonics, seen.shared if result.by_run else None, result.rmse) if circles else None,
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


def _held_against_draws(result: Identification, moments: Moments) -> tuple[Identification, Check | None]:
    """The result with the random draws of its influences, if it has any; a check that could not be made says so.

    Where the first order is not enough, the interval of the draws is that of the parameter.
    """
    if not (moments.effects and result.by_run):
        return result, None
    try:
        drawn = agreement(result.solution, moments, result.budget)
    except UnsupportedError as error:
        return result, Check("first order enough", None, {"why": str(error)})
    parameters = tuple(
        parameter
        if drawn.agrees[k] or parameter.interval is None
        else replace(parameter, interval=(float(low), float(high)))
        for k, (parameter, (low, high)) in enumerate(zip(result.parameters, drawn.interval, strict=True))
    )
    return replace(result, agreement=drawn, parameters=parameters), first_order_enough(drawn, parameters)


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
    return any(run.spans.any() for run in systems.runs)


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

    No solution where a reference is subtracted, or the runs are too few for every parameter.
    """
    if systems.references or len(systems.runs) < 2:
        return None, ()
    solution, unshown = solve_as_runs_show([run.factor for run in systems.runs], found.retained)
    return (None, ()) if len(unshown) == len(found.retained) else (solution, unshown)


def _part(k: int, systems: Systems, seen: TestShown, shares: Shares) -> TestPart:
    """What one test adds."""
    return TestPart(
        name=seen.test,
        runs=len(systems.runs),
        readings=seen.readings,
        forces=systems.levels,
        rmse=seen.rmse,
        scatter=systems.scatter.get(seen.test),
        angular=seen.angular,
        rank=shares.ranks[k],
        alone=shares.named(shares.alone[k]),
        rank_so_far=shares.ranks_so_far[k],
        adds=shares.adds(k),
    )


def _information(shares: Shares, tests: Sequence[str]) -> dict[str, dict[str, float]]:
    columns = zip(shares.labels, shares.information.T, strict=True)
    return {label: dict(zip(tests, map(float, column), strict=True)) for label, column in columns}


def _corrected(campaign: Campaign, observations: Sequence[Observations], found: Confounding) -> dict[str, float]:
    """How much greater each parameter would be with what was subtracted from one test's readings left in; else empty."""
    if not any(run.correction.any() for run in observations):
        return {}
    left_in = systems_of(campaign, [run.with_reading(run.correction) for run in observations])
    values = solve(merged(left_in.runs), found.retained).values
    return dict(zip(found.retained, map(float, values), strict=True))


def _parameters(
    systems: Systems,
    per_unit: Array,
    found: Confounding,
    solution: Solution,
    budget: Budget | None,
    unshown: Sequence[str],
    truth: Mapping[str, float],
) -> tuple[Parameter, ...]:
    """The parameters; without a budget, without uncertainty; of readings that were measured, without a truth."""
    budgets = {name: None if name in unshown else budget for name in solution.labels}
    by_name = {source.name: source for source in systems.sources}
    ranges = per_unit * solution.values
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
