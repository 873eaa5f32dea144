"""`elastogeo.positioning/1`: what a positioning test says.

test, verdict : as in `envelope`; the verdict holds what ISO 230-2 asks for, then the checks of the joints
axis : its letter
unit : of all deviations and values: "um" or "arcsec"
target_unit : "mm" or "deg"
along : whether the positioning of the axis itself was read; if not, straightness (a straight line is subtracted) or an angle
values : [{name, value, standard_uncertainty, interval95, degrees_of_freedom, measurement_uncertainty, contributions}]
    name : B, mean B, M, E+, E-, E, R+, R-, R, A+, A-, A of ISO 230-2, as many as the readings give
    standard_uncertainty, interval95, degrees_of_freedom : of stated influences and scatter; null with one approach only
    measurement_uncertainty : the standard uncertainty of the stated influences alone
    contributions : [{label, standard_uncertainty, degrees_of_freedom}], greatest first
targets : [{target, readings, mean, reversal, standard_deviation, repeatability}], readings, mean and standard_deviation
    for + and -; null where there is none
levers_mm : {name: value}, change of the readings per angular error motion of the axis, at the place of the sensor
joints : `elastogeo.identification/1`, of what the test's own question asks for, or null for the reason `refusal`
"""

from __future__ import annotations

from typing import Any

from elastogeo.identification import PositioningResults, StandardValue
from elastogeo.report.document import document, tested, uncertainty_entries, verdict_entries
from elastogeo.report.identification.document import identification_json
from elastogeo.report.scales import scale_for

POSITIONING_SCHEMA = "elastogeo.positioning/1"


def positioning_json(found: PositioningResults) -> dict[str, Any]:
    """What a positioning test says as one JSON object (`elastogeo.positioning/1`)."""
    scale, targets = scale_for(found.angular, found.rotary), found.targets
    return document(
        POSITIONING_SCHEMA,
        {
            "test": tested(found.test, None),
            "axis": found.axis,
            "unit": scale.key,
            "target_unit": scale.place_key,
            "along": found.along,
            "values": [_value(value, scale.factor) for value in found.values.values()],
            "targets": [
                {
                    "target": target * scale.place_factor,
                    "readings": targets.count[k].astype(int),
                    "mean": targets.mean[k] * scale.factor,
                    "reversal": targets.reversal[k] * scale.factor,
                    "standard_deviation": targets.deviation[k] * scale.factor,
                    "repeatability": targets.repeatability[k] * scale.factor,
                }
                for k, target in enumerate(targets.target)
            ],
            "levers_mm": dict(found.levers),
            "joints": None if found.joints is None else identification_json(found.joints),
            "refusal": found.refusal,
            "verdict": verdict_entries(found.verdict),
        },
    )


def _value(value: StandardValue, factor: float) -> dict[str, Any]:
    return {
        "name": value.name,
        "value": value.value * factor,
        **uncertainty_entries(value.estimate, factor),
        "measurement_uncertainty": value.measurement * factor,
        "contributions": [
            {
                "label": part.label,
                "standard_uncertainty": part.standard_uncertainty * factor,
                "degrees_of_freedom": part.degrees_of_freedom,
            }
            for part in value.contributions
        ],
    }
