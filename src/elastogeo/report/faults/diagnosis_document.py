"""`elastogeo.diagnosis/1`: the faults of a test, ranked by how much they distort the trace at the highest force.

test, verdict : as in `envelope`
faults : [{names, meaning, axis, value, unit, standard_uncertainty, distortion_um, distortion_uncertainty_um,
    distortion_interval95_um, share, significant, separated, also}]
    Greatest distortion first, the set-up (no axis, share 0) last. A cyclic error has two names and its amplitude as
    value. `also` names parameters that this test cannot tell from it. Where `separated` is false, compliance and geometry
    are not distinguished: `names` are all members of the sum, none of them the cause by itself, and `axis` is null.
untold : [name], parameters that change no reading of this test
circularity : [{force_N, centre, g_ccw_um, g_cw_um, g_bidirectional_um, f_max_ccw_um, f_min_ccw_um, f_max_cw_um,
    f_min_cw_um, mean_radial_um, not_determined: [why]}], ISO 230-4 of the measured traces; null where not determined
joints : `elastogeo.identification/1`, what the faults were ranked from
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from elastogeo.identification import Circularity, Diagnosis, Fault, Identification
from elastogeo.report.document import UM, document, in_um, tested, verdict_entries
from elastogeo.report.faults.rows import described, distortion_interval
from elastogeo.report.identification.document import identification_json

DIAGNOSIS_SCHEMA = "elastogeo.diagnosis/1"
_IN_WORDS = ("centre", "not_determined")


def diagnosis_json(diagnosis: Diagnosis) -> dict[str, Any]:
    """A diagnosis as one JSON object (`elastogeo.diagnosis/1`).

    Parameters
    ----------
    diagnosis : Diagnosis
    """
    result = diagnosis.identification
    return document(
        DIAGNOSIS_SCHEMA,
        {
            "test": tested(result.test, result.reference_force),
            "faults": [_fault(fault, result) for fault in diagnosis.faults],
            "untold": diagnosis.untold,
            "circularity": circularity_entries(diagnosis.circularity),
            "joints": identification_json(result),
            "verdict": verdict_entries(result.verdict),
        },
    )


def circularity_entries(by_force: Mapping[float, Circularity]) -> list[dict[str, Any]]:
    """ISO 230-4 parameters by force level."""
    return [{"force_N": force, **_circularity(found)} for force, found in by_force.items()]


def _circularity(found: Circularity) -> dict[str, Any]:
    lengths = {key: value for key, value in asdict(found).items() if key not in _IN_WORDS}
    return {
        "centre": found.centre,
        **{f"{key}_um": in_um(value) for key, value in lengths.items()},
        "not_determined": found.not_determined,
    }


def _fault(fault: Fault, result: Identification) -> dict[str, Any]:
    spread = fault.distortion_estimate
    shown, interval = described(fault, result), distortion_interval(fault)
    return {
        "names": shown.names,
        "meaning": shown.meaning,
        "axis": fault.axis if shown.separated else None,
        "value": fault.value,
        "unit": fault.unit,
        "standard_uncertainty": fault.estimate and fault.estimate.standard_uncertainty,
        "distortion_um": fault.distortion * UM,
        "distortion_uncertainty_um": None if spread is None else spread.standard_uncertainty * UM,
        "distortion_interval95_um": None if interval is None else [bound * UM for bound in interval],
        "share": fault.share,
        "significant": fault.significant,
        "separated": shown.separated,
        "also": shown.also,
    }
