"""`elastogeo.identification/1`: what one test says, or several tests of one machine together.

test, verdict : as in `envelope`; of several tests `test` holds what they have in common, and the files of all
tests : [{name, ..., id, readings, forces_N, rmse_um, scatter_um, rank, alone, rank_so_far, adds, information,
    left_out_um, left_out_fitted, against_others}], one for each
    test, in order: the entries of `test`, then the name of the test in the campaign; `rmse_um` against the estimate from
    all tests, `scatter_um` about its own best fit, which decides what its readings count (null of one test; `rmse_urad`
    and `scatter_urad` where it reads angles); how many combinations it determines alone, and which `parameters`; how many
    it determines with those before it, and which parameters only then; `information` is {parameter: share}, 1 less the
    variance with all tests over that without this one, 1 where only this test determines the parameter; `left_out_um` is the
    RMSE of its readings against the prediction from all other tests, after as many combinations as `left_out_fitted`, which
    the others do not determine, are fitted to it; `against_others` is {directions, square, statistic, effective_directions,
    degrees_of_freedom, p_value},
    of the differences in what it and the others determine: `p_value` is adjusted for the number of tests and levels. Null of
    one test, `statistic` and `p_value` also where nothing is shared
tests_agreement : {disagreeing, named, rest_agrees, level_N, run, scatter, degrees_of_freedom}, null of one test: the tests
    that differ from the others; those without which the others agree; `level_N` and `run` are what alone is wrong of the one
    that is named, null and empty if no single one is; `scatter` of runs over that of readings
together : [name], of several tests the `parameters` that none of them determines alone
by_run : whether the runs are enough for an uncertainty that assumes independent runs; if not, there is none
parameters : the retained set, [{name, value, unit, standard_uncertainty, interval95, stands_for, peak_to_peak_um, share,
    meaning, axis, elastic, separated, degrees_of_freedom, naive_standard_uncertainty, budget, truth}]
    `stands_for` is {name: coefficient}, `peak_to_peak_um` has the sign of the value and is that at the highest force,
    what shifts all readings alike counts in full; `share` is 0 to 1 of the sum of all absolute ones without the set-up,
    0 for the set-up; `axis` is empty for the set-up, `elastic` is true if a load drives it. Where `separated` is false,
    compliance and geometry are not distinguished in what it stands for: only the sum is determined, and `name`, `meaning`
    and `elastic` must not be taken for the cause. `standard_uncertainty`, `degrees_of_freedom` and `interval95` are
    those of the budget, null where `by_run` is false, and `budget` is empty then; `naive_standard_uncertainty` is the
    repeatability that independent readings would have, and no uncertainty. `budget` is [{label, type, distribution,
    degrees_of_freedom, contribution}], greatest first, `type` "A" or "B", `contribution` the standard uncertainty that
    the influence brings, in `unit`. `truth` is what it stands for truly amounts to, of simulated readings that say so; else
    null.
correlation : [[r, ...], ...], of the estimates of `parameters`, of each with those before it (the lower triangle without its
    diagonal), every influence in it; null where `by_run` is false
null : [name], parameters that change no reading
confounded : [[name, name, ...]], parameters that always produce the same trace but for its size
rank, columns : how many combinations are determined, of how many parameters
condition_raw, condition_scaled : of the retained columns as they are, and scaled to unit length
singular_values : of the scaled retained columns, greatest first
rmse_um : over all readings that are no angles; null, as `peak_to_peak_um` and the `rmse_um` of levels, where all are
levels : [{test, force_N, readings, rmse_um, fitness_percent, elastic_um, geometric_um, linear, local}], forces and
    readings less the reference's if one was subtracted; `elastic_um` and `geometric_um` are [least, greatest] deviation
    that compliance, and that geometry without the set-up, cause; null unless every parameter is separated. `linear` and
    `local` are null, or {rmse_um, fitness_percent} of the linear model and of the local estimates that the level is part
    of (Table 5.9)
linear : null, or {compliances, by_run, rmse_um, values: [{name, value, standard_uncertainty, degrees_of_freedom}]}, the
    model in which every compliance is `C0 + C1 F` (Eq. 5.39): `C_XXX` at no force, `CF1_XXX` what it gains per newton;
    the uncertainties hold the scatter alone and are null where the runs are too few
local : [{forces_N, values: [{name, value, standard_uncertainty, degrees_of_freedom, peak_to_peak_um}]}], from adjacent
    levels; the uncertainty is that of a scatter that is alike in all shapes of a trace
local_change : null, or {statistic, q, degrees_of_freedom, p_value, significant, each: {name: p_value}}, whether the local
    estimates differ by more than their uncertainty
models : null, or {supported, explained, alike, places, off_level, tested, unseen, models: [{name, places, parameters, added:
    [{name, value, stands_for}], exponent, rmse_um, left_out_run_um, left_out_level_um, log_ratio, log_ratio_uncertainty,
    p_value, sufficient}]}; `supported` is null if nothing could be tested, `constant` for the model as asked; `alike` are
    models that this test cannot distinguish; `p_value` says how likely as much seems missing from a model if nothing is;
    `off_level` is null, or {force_N, size_um, p_value} of a level that does not follow the others
consistency : null, or {state, why, constrained: {name: value}, distance, dimension, degrees_of_freedom, p_value, p_joint,
    p_negative: {name: p}, violated: [name], outward: {name: coefficient}, depth, needed, closest, shows: {name: value}},
    whether the compliances agree with physics; the sentence is that of the check `physically consistent`; `depth` is null
    where equations alone restrict
collinear : null, or {commands, compliance, translational, rotational, screws}, the stiffness at the tool point that the
    joint compliances amount to; what was not asked for counts as rigid. `compliance` is 6x6 [mm, rad per N, N mm], null if
    it is not determined; `translational` [{direction, compliance_um_per_N}] and `rotational` [{direction,
    compliance_urad_per_N_mm}] hold numbers {value, standard_uncertainty, interval95, degrees_of_freedom}; `screws` are
    [{direction, point_mm, pitch_mm, along_N_per_um, about_N_mm_per_rad}], empty unless all of the compliance is determined
repeats : null, or {levels: {level: runs}, combinations, mean, combination_std, estimate, standard_uncertainty,
    degrees_of_freedom, note}; from mean to degrees_of_freedom they are {name: number}; `estimate` is from all repeated
    runs together, `standard_uncertainty` is its own, from the scatter of the runs
set_up : [{run, E_Xt0_um, ...}], each run's own set-up, empty where it is one for all runs or not in the model
minimum_norm : {name: value} over all parameters that were asked for; not an estimate of each
"""

from __future__ import annotations

from math import isnan
from typing import Any

import numpy as np

from elastogeo.estimate import Confounding, Repeatability
from elastogeo.identification import (
    AgainstOthers,
    Agreement,
    BudgetLine,
    Change,
    Consistency,
    Fit,
    Identification,
    Level,
    Local,
    ModelChoice,
    Parameter,
    TestPart,
    TestsAgreement,
    VariableCompliance,
)
from elastogeo.machine import Array
from elastogeo.report.document import UM, document, in_um, tested, tested_together, verdict_entries
from elastogeo.report.identification.collinear import collinear_json

MICRO = 1e6

IDENTIFICATION_SCHEMA = "elastogeo.identification/1"

SHARED_RUNS = (
    "Combinations share runs and are not independent: combination_std is about that of a single combination, and dividing "
    "it by the root of their number would claim far too much. standard_uncertainty comes from the scatter of the runs and "
    "is that of the estimate from all of them; it is a repeatability, not a full uncertainty."
)
SHARED_REFERENCE = (
    "The scatter of the reference, which all differences share and the repeats do not show, is added as if the reference "
    "scattered like the repeated runs."
)


def identification_json(result: Identification) -> dict[str, Any]:
    """An identification as one JSON object (`elastogeo.identification/1`)."""
    separated = all(parameter.separated for parameter in result.parameters)
    angular = {part.name for part in result.tests if part.angular}
    return document(
        IDENTIFICATION_SCHEMA,
        {
            "test": tested_together(result.campaign, result.reference_force),
            "tests": [_test(result, part) for part in result.tests],
            "together": result.together,
            "tests_agreement": None if result.tests_agreement is None else _agreement(result.tests_agreement),
            "by_run": result.by_run,
            "parameters": [_parameter(result, k, parameter) for k, parameter in enumerate(result.parameters)],
            "correlation": _correlation(result) if result.by_run else None,
            **confounding_entries(result.confounding),
            "rmse_um": in_um(None if len(angular) == len(result.tests) else result.rmse),
            "levels": [_level(level, separated, level.test in angular) for level in result.levels],
            "linear": None if result.variable is None else _linear(result.variable, bool(angular)),
            "local": [_local(local) for local in result.local],
            "local_change": None if result.local_change is None else change_entry(result.local_change),
            "models": None if result.models is None else _models(result.models),
            "consistency": None if result.consistency is None else _consistency(result.consistency),
            "collinear": collinear_json(result),
            "repeats": None if result.repeats is None else _repeats(result.repeats, result.reference_force),
            "set_up": [
                {"run": run, **{f"{name}_um": value * UM for name, value in values.items()}}
                for run, values in result.set_up.items()
            ],
            "minimum_norm": result.minimum_norm,
            "verdict": verdict_entries(result.verdict),
        },
    )


def _test(result: Identification, part: TestPart) -> dict[str, Any]:
    """What one test of a campaign adds."""
    unit = "urad" if part.angular else "um"
    found = result.tests_agreement
    against = None if found is None else found.against[part.name]
    return {
        **tested(result.campaign.tests[part.name], result.reference_force),
        "id": part.name,
        "readings": part.readings,
        "forces_N": part.forces,
        f"rmse_{unit}": part.rmse * (MICRO if part.angular else UM),
        f"scatter_{unit}": None if part.scatter is None else part.scatter * (MICRO if part.angular else UM),
        "rank": part.rank,
        "alone": part.alone,
        "rank_so_far": part.rank_so_far,
        "adds": part.adds,
        "information": {name: shares[part.name] for name, shares in result.information.items()},
        f"left_out_{unit}": None if against is None else against.rmse * (MICRO if part.angular else UM),
        "left_out_fitted": None if against is None else against.fitted,
        "against_others": None if against is None else _against(against),
    }


def _against(one: AgainstOthers) -> dict[str, Any]:
    return {
        "directions": one.directions,
        "square": one.square,
        "statistic": one.statistic,
        "effective_directions": one.effective_directions,
        "degrees_of_freedom": one.degrees_of_freedom,
        "p_value": one.p_value,
    }


def _agreement(found: TestsAgreement) -> dict[str, Any]:
    """Whether the tests agree, and what does not."""
    return {
        "disagreeing": found.disagreeing,
        "named": found.named,
        "rest_agrees": found.rest_agrees,
        "level_N": found.level,
        "run": found.run,
        "scatter": None if isnan(found.scatter) else found.scatter,
        "degrees_of_freedom": found.scatter_freedom,
    }


def confounding_entries(found: Confounding) -> dict[str, Any]:
    """What a test can and cannot distinguish."""
    return {
        "null": found.null,
        "confounded": [group for group in found.groups if len(group) > 1],
        "rank": found.rank,
        "columns": len(found.labels),
        "condition_raw": found.condition_raw,
        "condition_scaled": found.condition_scaled,
        "singular_values": found.singular_values,
    }


def change_entry(change: Change) -> dict[str, Any]:
    """A joint test of differences."""
    return {
        "statistic": change.statistic,
        "q": change.q,
        "degrees_of_freedom": change.degrees_of_freedom,
        "p_value": change.p_value,
        "significant": change.significant,
        "each": change.each,
    }


def _parameter(result: Identification, k: int, parameter: Parameter) -> dict[str, Any]:
    angles = all(part.angular for part in result.tests)
    return {
        "name": parameter.name,
        "value": parameter.value,
        "unit": parameter.unit,
        "standard_uncertainty": parameter.standard_uncertainty,
        "interval95": parameter.interval,
        "stands_for": parameter.stands_for,
        "peak_to_peak_um": in_um(None if angles else parameter.peak_to_peak),
        "share": parameter.share,
        "meaning": parameter.meaning,
        "axis": parameter.axis,
        "elastic": parameter.elastic,
        "separated": parameter.separated,
        "degrees_of_freedom": parameter.degrees_of_freedom,
        "naive_standard_uncertainty": result.naive.standard_uncertainty[k],
        "budget": [] if parameter.estimate is None else [_budget_line(line) for line in result.budget.lines[k]],
        "truth": parameter.truth,
        "monte_carlo": None if result.agreement is None else _draws(result.agreement, k),
    }


def _correlation(result: Identification) -> list[Array]:
    """Of each parameter with those before it."""
    covariance = result.budget.covariance
    deviation = np.sqrt(np.diag(covariance))
    with np.errstate(invalid="ignore", divide="ignore"):
        whole = covariance / np.outer(deviation, deviation)
    return [row[:k] for k, row in enumerate(whole)]


def _draws(agreement: Agreement, k: int) -> dict[str, Any]:
    """What random draws say of one parameter, and whether the first order agrees."""
    return {
        "standard_uncertainty": agreement.draws.standard_uncertainty[k],
        "interval95": agreement.interval[k],
        "trials": agreement.draws.trials,
        "agrees": bool(agreement.agrees[k]),
    }


def _budget_line(line: BudgetLine) -> dict[str, Any]:
    return {
        "label": line.label,
        "type": "B" if line.type_b else "A",
        "distribution": line.distribution,
        "degrees_of_freedom": line.degrees_of_freedom,
        "contribution": line.contribution,
    }


def _level(level: Level, separated: bool, angular: bool) -> dict[str, Any]:
    return {
        "test": level.test,
        "force_N": level.force,
        "readings": level.readings,
        "rmse_um": in_um(None if angular else level.rmse),
        "fitness_percent": level.fitness,
        "elastic_um": [bound * UM for bound in level.elastic] if separated else None,
        "geometric_um": [bound * UM for bound in level.geometric] if separated else None,
        "linear": None if level.variable is None else _fit(level.variable, angular),
        "local": None if level.local is None else _fit(level.local, angular),
    }


def _fit(fit: Fit, angular: bool) -> dict[str, Any]:
    return {"rmse_um": in_um(None if angular else fit.rmse), "fitness_percent": fit.fitness}


def _linear(model: VariableCompliance, angular: bool) -> dict[str, Any]:
    solution = model.solution
    return {
        "compliances": model.elastic,
        "by_run": model.by_run,
        "rmse_um": in_um(None if angular else model.rmse),
        "values": [
            {
                "name": name,
                "value": solution.values[k],
                "standard_uncertainty": solution.standard_uncertainty[k] if model.by_run else None,
                "degrees_of_freedom": solution.degrees_of_freedom[k] if model.by_run else None,
            }
            for k, name in enumerate(solution.labels)
        ],
    }


def _local(local: Local) -> dict[str, Any]:
    solution = local.solution
    return {
        "forces_N": local.forces,
        "values": [
            {
                "name": name,
                "value": solution.values[k],
                "standard_uncertainty": solution.standard_uncertainty[k],
                "degrees_of_freedom": solution.degrees_of_freedom[k],
                "peak_to_peak_um": local.peak_to_peak[name] * UM,
            }
            for k, name in enumerate(solution.labels)
        ],
    }


def _models(found: ModelChoice) -> dict[str, Any]:
    off = found.off_level
    return {
        "supported": found.supported,
        "explained": found.explained,
        "alike": found.alike,
        "places": found.places,
        "off_level": None if off is None else {"force_N": off.force, "size_um": off.size * UM, "p_value": off.p_value},
        "tested": found.tested,
        "unseen": found.unseen,
        "models": [
            {
                "name": model.name,
                "places": model.places,
                "parameters": model.parameters,
                "added": [
                    {"name": name, "value": value, "stands_for": owners}
                    for name, value, owners in zip(model.added, model.values, model.stands_for, strict=True)
                ],
                "exponent": model.exponent,
                "rmse_um": model.rmse * UM,
                "left_out_run_um": in_um(model.left_out_run),
                "left_out_level_um": in_um(model.left_out_level),
                "log_ratio": model.log_ratio,
                "log_ratio_uncertainty": model.log_ratio_uncertainty,
                "p_value": model.p_value,
                "sufficient": model.sufficient,
            }
            for model in found.candidates
        ],
    }


def _consistency(found: Consistency) -> dict[str, Any]:
    return {
        "state": found.state,
        "why": found.why,
        "constrained": found.constrained,
        "distance": found.distance,
        "dimension": found.dimension,
        "degrees_of_freedom": found.degrees_of_freedom,
        "p_value": found.p_value,
        "p_joint": found.p_joint,
        "p_negative": found.p_negative,
        "violated": found.violated,
        "outward": found.outward,
        "depth": found.depth,
        "needed": found.needed,
        "closest": found.closest,
        "shows": found.shows,
    }


def _repeats(repeats: Repeatability, reference_force: float | None) -> dict[str, Any]:
    solution = repeats.solution
    by_name = {
        "mean": repeats.combination_mean,
        "combination_std": repeats.combination_std,
        "estimate": solution.values,
        "standard_uncertainty": solution.standard_uncertainty,
        "degrees_of_freedom": solution.degrees_of_freedom,
    }
    return {
        "levels": dict(repeats.runs),
        "combinations": len(repeats.combinations),
        **{key: dict(zip(solution.labels, values, strict=True)) for key, values in by_name.items()},
        "note": SHARED_RUNS if reference_force is None else f"{SHARED_RUNS} {SHARED_REFERENCE}",
    }
