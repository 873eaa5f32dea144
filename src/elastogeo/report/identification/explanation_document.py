"""`elastogeo.explanation/1`: what a test can distinguish, before anything is estimated.

test : as in `envelope`
null, confounded, rank, columns, condition_raw, condition_scaled : as in `identification`
groups : all groups, single ones included
retained : [{name, stands_for}]
weakest : {name: coefficient}, the combination of the retained parameters, each scaled to a column of unit length, that
    the test sees least
steps : [{id, rank, rank_so_far, alone, adds}], of several tests, in order: how many combinations each determines alone and
    with those before it, which retained parameters alone, and which only now; empty for one test
ceiling : {compliances, rank, family, rank_of_family, rank_of_any}, of the compliances that were asked for how many
    combinations are determined, what the tests load and read (`bar`: along one line; `probes`: forces and displacements in
    any direction; `six`), how many all such tests tell with these tools, and how many any tests between tool and workpiece;
    null where none was asked for, or something else loads or reads
singular_values : of the scaled retained columns, greatest first
tolerance : relative, of the decision
"""

from __future__ import annotations

from typing import Any

from elastogeo.identification import Explanation
from elastogeo.planning import Reach
from elastogeo.report.document import document, tested_together
from elastogeo.report.identification.document import confounding_entries

EXPLANATION_SCHEMA = "elastogeo.explanation/1"


def explanation_json(explained: Explanation, reach: Reach | None) -> dict[str, Any]:
    """What a test can distinguish as one JSON object (`elastogeo.explanation/1`)."""
    campaign, confounding = explained.campaign, explained.confounding
    return document(
        EXPLANATION_SCHEMA,
        {
            "test": tested_together(campaign, campaign.question.reference_force),
            **confounding_entries(confounding),
            "groups": confounding.groups,
            "retained": [{"name": name, "stands_for": confounding.stands_for(name)} for name in confounding.retained],
            "weakest": dict(zip(confounding.retained, confounding.weakest, strict=True)),
            "singular_values": confounding.singular_values,
            "tolerance": confounding.tolerance,
            "ceiling": reach
            and {
                "compliances": reach.columns,
                "rank": reach.rank,
                "family": reach.family,
                "rank_of_family": reach.of_family,
                "rank_of_any": reach.of_any,
            },
            "steps": [
                {"id": s.name, "rank": s.rank, "rank_so_far": s.rank_so_far, "alone": s.alone, "adds": s.adds}
                for s in explained.steps
            ],
        },
    )
