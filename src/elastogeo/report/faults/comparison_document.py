"""`elastogeo.comparison/1`: two tests of one machine, and what changed between them.

before, after : what was tested, as `test` in `envelope`
differences : [{name, unit, before, after, change, standard_uncertainty, interval95, p_value, separated, stands_for}], the
    surest change first; where `separated` is false the name stands for a sum of compliance and geometry
joint : {statistic, q, degrees_of_freedom, p_value, significant, each}, as `local_change` in `identification`
verdict : as in `envelope`
"""

from __future__ import annotations

from typing import Any

from elastogeo.identification import BeforeAfter, Difference, Parameter
from elastogeo.report.document import document, tested, uncertainty_entries, verdict_entries
from elastogeo.report.identification.document import change_entry

COMPARISON_SCHEMA = "elastogeo.comparison/1"


def comparison_json(before_after: BeforeAfter) -> dict[str, Any]:
    """A comparison of two tests as one JSON object (`elastogeo.comparison/1`)."""
    before, after = before_after.before, before_after.after
    by_name = {parameter.name: parameter for parameter in before.parameters}
    return document(
        COMPARISON_SCHEMA,
        {
            "before": tested(before.test, before.reference_force),
            "after": tested(after.test, after.reference_force),
            "differences": [_difference(found, by_name[found.name]) for found in before_after.differences],
            "joint": change_entry(before_after.joint),
            "verdict": verdict_entries(before_after.verdict),
        },
    )


def _difference(found: Difference, parameter: Parameter) -> dict[str, Any]:
    return {
        "name": found.name,
        "unit": found.unit,
        "before": found.before,
        "after": found.after,
        "change": found.change.value,
        **uncertainty_entries(found.change),
        "p_value": found.p_value,
        "separated": parameter.separated,
        "stands_for": parameter.stands_for,
    }
