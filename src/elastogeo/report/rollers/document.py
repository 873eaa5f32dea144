"""`elastogeo.stiffness/1`: the stiffness map of a ball-roller test.

test, verdict : as in `envelope`
law : {supported, alike, misfit_p, misfit_um, laws: [{name, exponent, rmse_um, left_out_um, better}]}
overall : {kind, force_N, directions}: what stands for the machine: the only one, that at the greatest engagement, or, where
    no law holds, the last increment
modelled, secants, increments : [{kind, force_N, directions}]; `force_N` lists the level, or the two, or none for all
    directions : [{angle_deg, compliance_um_per_N, standard_uncertainty_um_per_N, interval95_um_per_N, stiffness_N_per_um,
    stiffness_interval95_N_per_um}]; null for a bound that no data give
path : [{angle_deg, path_um}], what the law leaves to the path
balances : [{axis, parameter, value, standard_uncertainty, degrees_of_freedom, unit}], of the drives, at the motor's shaft
dynamometer : {gain, gain_interval95, offset_N, offset_interval95_N, rms_difference_N, maximum_difference_N, delays_s,
    agrees}, or null
rig : [{angle_deg, difference_um_per_N, expanded_uncertainty_um_per_N, normalised_error, agrees}], or null
joints : `elastogeo.identification/1`, of what the test's own question asks for
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.drive import ForceAgreement, RigCheck
from elastogeo.identification import LawChoice, Stiffness, StiffnessMap
from elastogeo.report.document import UM, document, tested, verdict_entries
from elastogeo.report.identification.document import identification_json

STIFFNESS_SCHEMA = "elastogeo.stiffness/1"


def stiffness_json(found: StiffnessMap) -> dict[str, Any]:
    """A stiffness map as one JSON object (`elastogeo.stiffness/1`)."""
    return document(
        STIFFNESS_SCHEMA,
        {
            "test": tested(found.joints.test, found.joints.reference_force),
            "overall": _stiffness(found.overall),
            "modelled": [_stiffness(level) for level in found.modelled],
            "secants": [_stiffness(level) for level in found.secants],
            "increments": [_stiffness(level) for level in found.increments],
            "law": _law(found.law),
            "path": [
                {"angle_deg": float(np.rad2deg(angle)), "path_um": float(path) * UM}
                for angle, path in zip(found.overall.angle, found.path, strict=True)
            ],
            "balances": [
                {
                    "axis": axis,
                    "parameter": parameter.label,
                    "value": parameter.estimate.value,
                    "standard_uncertainty": parameter.estimate.standard_uncertainty,
                    "degrees_of_freedom": parameter.estimate.degrees_of_freedom,
                    "unit": parameter.unit,
                }
                for axis, parameters in found.motors.items()
                for parameter in parameters
            ],
            "dynamometer": None if found.dynamometer is None else _dynamometer(found.dynamometer),
            "rig": None if found.rig is None else _rig(found.rig, found.overall),
            "joints": identification_json(found.joints),
            "verdict": verdict_entries(found.verdict),
        },
    )


def _law(law: LawChoice) -> dict[str, Any]:
    return {
        "supported": law.supported,
        "alike": law.alike,
        "misfit_p": law.misfit,
        "misfit_um": law.misfit_size * UM,
        "laws": [
            {
                "name": score.name,
                "exponent": score.exponent,
                "rmse_um": score.rmse * UM,
                "left_out_um": score.left_out * UM,
                "better": score.better,
            }
            for score in law.scores
        ],
    }


def _stiffness(found: Stiffness) -> dict[str, Any]:
    intervals, bounds = found.interval, found.stiffness_interval
    return {
        "kind": found.kind,
        "force_N": found.force,
        "directions": [
            {
                "angle_deg": float(np.rad2deg(found.angle[k])),
                "compliance_um_per_N": found.compliance[k] * UM,
                "standard_uncertainty_um_per_N": found.standard_uncertainty[k] * UM,
                "interval95_um_per_N": intervals[k] * UM,
                "stiffness_N_per_um": found.stiffness[k] / UM,
                "stiffness_interval95_N_per_um": bounds[k] / UM,
            }
            for k in range(len(found.angle))
        ],
    }


def _dynamometer(found: ForceAgreement) -> dict[str, Any]:
    return {
        "gain": found.gain,
        "gain_interval95": found.gain_interval,
        "offset_N": found.offset,
        "offset_interval95_N": found.offset_interval,
        "rms_difference_N": found.rms_difference,
        "maximum_difference_N": found.maximum_difference,
        "delays_s": [delay.seconds for delay in found.delays],
        "agrees": found.agrees,
    }


def _rig(found: RigCheck, overall: Stiffness) -> list[dict[str, Any]]:
    return [
        {
            "angle_deg": float(np.rad2deg(angle)),
            "difference_um_per_N": found.difference[k] * UM,
            "expanded_uncertainty_um_per_N": found.expanded_uncertainty[k] * UM,
            "normalised_error": found.normalised_error[k],
            "agrees": bool(found.agrees[k]),
        }
        for k, angle in enumerate(overall.angle)
    ]
