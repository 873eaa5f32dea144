"""`elastogeo.stiffness/1`: the stiffness map of a ball-roller test.

test, verdict : as in `envelope`
law : {supported, alike, misfit_p, misfit_um, laws: [{name, exponent, rmse_um, left_out_um, better}]}
engagements_um : [..], commanded, of every level, in the order of `secants`
overall : {kind, force_N, directions}: what stands for the machine: the only one, that at the greatest engagement, or, where
    no law holds, the last increment
modelled, secants, increments : [{kind, force_N, directions}]; `force_N` lists the level, or the two, or none for all
    directions : [{angle_deg, compliance_um_per_N, standard_uncertainty_um_per_N, interval95_um_per_N, stiffness_N_per_um,
    stiffness_interval95_N_per_um}]; null for a bound that no data give
path : [{angle_deg, path_um}], what the law leaves to the path
balances : [{axis, parameter, value, standard_uncertainty, degrees_of_freedom, unit}], of the drives, at the motor's shaft
torques : [{axis, run, engagement_um, unit, peak, angle_deg, recorded, parts}]: what a motor takes along a run of the
    greatest engagement; `peak` and `parts` by the terms of its balance and `load`, at every n-th sample, null where the
    axis is too slow
dynamometer : {gain, gain_interval95, offset_N, offset_interval95_N, rms_difference_N, maximum_difference_N, delays_s,
    agrees, runs: [{run, column, engagement_um, rms_difference_N}]}, or null
rig : {directions: [{angle_deg, without_um_per_N, rig_um_per_N, predicted_um_per_N, measured_um_per_N, difference_um_per_N,
    expanded_uncertainty_um_per_N, normalised_error, agrees}], engagements_um, secants, increments}, or null
joints : `elastogeo.identification/1`, of what the test's own question asks for
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.identification import AgainstDynamometer, LawChoice, RigTest, Stiffness, StiffnessMap, TorqueParts
from elastogeo.machine import Array
from elastogeo.report.document import UM, document, tested, verdict_entries
from elastogeo.report.drive_terms import effort_unit
from elastogeo.report.identification.document import identification_json

STIFFNESS_SCHEMA = "elastogeo.stiffness/1"
_SAMPLES = 150
"""Of a run, about so many are in the document."""


def stiffness_json(found: StiffnessMap) -> dict[str, Any]:
    """A stiffness map as one JSON object (`elastogeo.stiffness/1`)."""
    return document(
        STIFFNESS_SCHEMA,
        {
            "test": tested(found.joints.test, found.joints.reference_force),
            "engagements_um": [engagement * UM for engagement in found.engagements],
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
            "torques": [_torques(motor) for motor in found.torques],
            "dynamometer": None if found.dynamometer is None else _dynamometer(found.dynamometer),
            "rig": None if found.rig is None else _rig(found.rig),
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


def _torques(found: TorqueParts) -> dict[str, Any]:
    """In N m of a rotary motor, N of a linear one."""
    unit, factor = effort_unit(found.unit)
    step = max(1, len(found.angle) // _SAMPLES)

    def series(values: Array) -> list[float | None]:
        kept = zip(values[::step].tolist(), found.counts[::step].tolist(), strict=True)
        return [value * factor if counts else None for value, counts in kept]

    return {
        "axis": found.axis,
        "run": found.run,
        "engagement_um": found.engagement * UM,
        "unit": unit,
        "peak": {part: found.peak(part) * factor for part in found.parts},
        "angle_deg": np.rad2deg(found.angle[::step]),
        "recorded": series(found.recorded),
        "parts": {part: series(values) for part, values in found.parts.items()},
    }


def _dynamometer(found: AgainstDynamometer) -> dict[str, Any]:
    agreement = found.agreement
    return {
        "gain": agreement.gain,
        "gain_interval95": agreement.gain_interval,
        "offset_N": agreement.offset,
        "offset_interval95_N": agreement.offset_interval,
        "rms_difference_N": agreement.rms_difference,
        "maximum_difference_N": agreement.maximum_difference,
        "delays_s": [delay.seconds for delay in agreement.delays],
        "agrees": agreement.agrees,
        "runs": [
            {
                "run": force.run,
                "column": force.column,
                "engagement_um": force.engagement * UM,
                "rms_difference_N": force.rms_difference,
            }
            for force in found.forces
        ],
    }


def _rig(found: RigTest) -> dict[str, Any]:
    check = found.check
    return {
        "directions": [
            {
                "angle_deg": float(np.rad2deg(angle)),
                "without_um_per_N": found.without.compliance[k] * UM,
                "rig_um_per_N": found.rig[k] * UM,
                "predicted_um_per_N": found.predicted[k] * UM,
                "measured_um_per_N": found.measured.compliance[k] * UM,
                "difference_um_per_N": check.difference[k] * UM,
                "expanded_uncertainty_um_per_N": check.expanded_uncertainty[k] * UM,
                "normalised_error": check.normalised_error[k],
                "agrees": bool(check.agrees[k]),
            }
            for k, angle in enumerate(found.without.angle)
        ],
        "engagements_um": [engagement * UM for engagement in found.engagements],
        "secants": [_stiffness(level) for level in found.secants],
        "increments": [_stiffness(level) for level in found.increments],
    }
