"""`elastogeo.compare/1`: two tests of a history, and what changed between them. Values are in `unit`, dates in UTC.

before, after : {test, name, machine, series, date, origin, from, software, error}, the earlier one first
comparable, refusal, sentence : whether the two are held against each other, why not (`other machine`, `not analysed`,
    `nothing in common`), and the answer
baseline_tests : of how many tests the baseline is that says how tests of this machine scatter; 0 without one
indicators : [{name, kind, unit, before, after, change, standard_uncertainty, interval95, degrees_of_freedom, unchanged95,
    within}], the surest change first; the interval is by the scatter within the two tests, `unchanged95` is within which the
    change lies if nothing changed, for all indicators together; null without a baseline
parameters : as `differences` of `elastogeo.comparison/1`, with `distortion_um` of the change at the highest force, or null
joint : as there; null where no parameter can be judged, then `unjudged` says why
settings : [{name, before, after, in_recipe}], those that differ
circles : [{test, run, force_N, direction, deg, um}], the first run of each level and direction, as measured
verdict : as in `envelope`
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.changes import CircleTrace, ComparedTest, ComparedTests, IndicatorDifference, ParameterDifference
from elastogeo.report.changes.compared.answers import answer_of
from elastogeo.report.days import iso_date
from elastogeo.report.document import UM, document, uncertainty_entries, verdict_entries
from elastogeo.report.identification.document import change_entry

COMPARE_SCHEMA = "elastogeo.compare/1"


def compare_json(result: ComparedTests) -> dict[str, Any]:
    """Two tests held against each other as one JSON object."""
    return document(
        COMPARE_SCHEMA,
        {
            "before": _test(result.before),
            "after": _test(result.after),
            "comparable": not result.refusal,
            "refusal": result.refusal,
            "sentence": answer_of(result),
            "baseline_tests": result.baseline,
            "indicators": [_indicator(one) for one in result.indicators],
            "parameters": [_parameter(one) for one in result.parameters],
            "joint": None if result.joint is None else change_entry(result.joint),
            "unjudged": result.unjudged,
            "settings": [
                {"name": one.name, "before": one.before, "after": one.after, "in_recipe": one.in_recipe}
                for one in result.settings
            ],
            "circles": [_circle(one, result) for one in result.traces],
            "verdict": verdict_entries(result.verdict),
        },
    )


def _test(test: ComparedTest) -> dict[str, Any]:
    return {
        "test": test.key,
        "name": test.name,
        "machine": test.machine,
        "series": test.recipe,
        "date": iso_date(test.date),
        "origin": test.origin,
        "from": test.from_what,
        "software": test.software,
        "error": test.error,
    }


def _indicator(one: IndicatorDifference) -> dict[str, Any]:
    return {
        "name": one.name,
        "kind": one.kind.name,
        "unit": one.kind.unit,
        "before": one.before,
        "after": one.after,
        "change": one.change.value,
        **uncertainty_entries(one.change),
        "unchanged95": one.expected,
        "within": one.within,
    }


def _parameter(one: ParameterDifference) -> dict[str, Any]:
    found = one.difference
    return {
        "name": found.name,
        "unit": found.unit,
        "before": found.before,
        "after": found.after,
        "change": found.change.value,
        **uncertainty_entries(found.change),
        "p_value": found.p_value,
        "separated": one.separated,
        "stands_for": one.stands_for,
        "distortion_um": None if one.distortion is None else found.change.value * one.distortion * UM,
    }


def _circle(one: CircleTrace, result: ComparedTests) -> dict[str, Any]:
    return {
        "test": (result.after if one.later else result.before).key,
        "run": one.run,
        "force_N": one.force,
        "direction": "ccw" if one.sense > 0 else "cw",
        "deg": np.degrees(one.angle),
        "um": one.deviation * UM,
    }
