"""`elastogeo.what-if/1`: a test with some of its faults corrected.

test : as in `envelope`
corrected : [{name, value, unit, separated, stands_for}], whose part is subtracted
traces : [{run, force_N, peak_to_peak_before_um, peak_to_peak_after_um}]
before, after : ISO 230-4 by force level, as `circularity` in `diagnosis`
verdict : of the identification it rests on, as in `envelope`
"""

from __future__ import annotations

from typing import Any

from elastogeo.identification import WhatIf
from elastogeo.report.document import UM, document, tested, verdict_entries
from elastogeo.report.faults.diagnosis_document import circularity_entries

WHAT_IF_SCHEMA = "elastogeo.what-if/1"


def what_if_json(what_if: WhatIf) -> dict[str, Any]:
    """A what-if as one JSON object (`elastogeo.what-if/1`).

    Parameters
    ----------
    what_if : WhatIf
    """
    result = what_if.identification
    forces = {trace.run: trace.force for trace in result.traces}
    return document(
        WHAT_IF_SCHEMA,
        {
            "test": tested(result.test, result.reference_force),
            "corrected": [
                {"name": p.name, "value": p.value, "unit": p.unit, "separated": p.separated, "stands_for": p.stands_for}
                for p in result.parameters
                if p.name in what_if.corrected
            ],
            "traces": [
                {
                    "run": run,
                    "force_N": forces[run],
                    "peak_to_peak_before_um": before * UM,
                    "peak_to_peak_after_um": after * UM,
                }
                for run, (before, after) in what_if.peak_to_peak.items()
            ],
            "before": circularity_entries(what_if.before),
            "after": circularity_entries(what_if.after),
            "verdict": verdict_entries(result.verdict),
        },
    )
