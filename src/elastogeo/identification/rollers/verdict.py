"""The checks of a stiffness map."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.drive import FeedDrive
from elastogeo.identification.check import Check
from elastogeo.identification.rollers.result import StiffnessMap
from elastogeo.observe import LOSSES

OFFSET = 0.05
"""Share of the least deflection that the path may have for a secant to show the machine."""

FEWEST = 4
"""Degrees of freedom within the engagements without which their scatter says little."""


def map_verdict(found: StiffnessMap, drives: Sequence[FeedDrive], untested: str) -> tuple[Check, ...]:
    """All checks of a map.

    Parameters
    ----------
    found : StiffnessMap
        But for its verdict.
    drives : sequence of FeedDrive
    untested : str
        Why the force was not compared with that of a dynamometer; empty if there is none.
    """
    checks = [_one_stiffness(found), _follows(found), _offset(found), _repeated(found), _driven_back(found, drives)]
    if found.dynamometer is not None or untested:
        checks.append(_measured(found, untested))
    if found.rig is not None:
        checks.append(_rig(found))
    return tuple(checks)


def _one_stiffness(found: StiffnessMap) -> Check:
    law = found.law
    facts = {
        "supported": law.supported,
        "alike": law.alike,
        "follows": law.follows,
        "levels_N": tuple(level.force[0] for level in found.secants),
        "left_out_mm": {score.name: score.left_out for score in law.scores},
        "exponent": next((score.exponent for score in law.scores if score.name == law.supported), None),
    }
    one = law.supported == "constant" and law.follows
    return Check("one stiffness at every engagement", one if law.scores or not one else None, facts)


def _follows(found: StiffnessMap) -> Check:
    law = found.law
    passed = None if law.misfit is None else law.follows
    facts = {"law": law.supported, "p_value": law.misfit, "rms_mm": law.misfit_size, "levels": len(found.secants)}
    return Check("engagements follow the law", passed, facts)


def _offset(found: StiffnessMap) -> Check:
    least = found.secants[0]
    deflection = least.compliance * least.force[0]
    size = float(np.sqrt(np.mean(found.path**2)))
    share = size / float(np.sqrt(np.mean(deflection**2)))
    facts = {
        "path_mm": size,
        "share": share,
        "force_N": least.force[0],
        "secants_mm_per_N": tuple(float(level.compliance.mean()) for level in found.secants),
        "increments_mm_per_N": tuple(float(step.compliance.mean()) for step in found.increments),
    }
    return Check("secants free of an offset", share <= OFFSET, facts)


def _repeated(found: StiffnessMap) -> Check:
    freedom = found.secants[0].scatter_freedom
    return Check("engagements repeated", freedom >= FEWEST, {"degrees_of_freedom": freedom, "levels": len(found.secants)})


def _driven_back(found: StiffnessMap, drives: Sequence[FeedDrive]) -> Check:
    assumed = {drive.axis: drive.back_driven for drive in drives if drive.back_uncertainty}
    overall = found.overall
    worst = float(np.max(overall.contribution(LOSSES) / np.abs(overall.compliance))) if assumed else 0.0
    facts = {"assumed": assumed, "relative_uncertainty": worst}
    return Check("losses when driven back known", None if assumed else True, facts)


def _measured(found: StiffnessMap, untested: str) -> Check:
    name = "force agrees with the dynamometer"
    if found.dynamometer is None:
        return Check(name, None, {"reason": untested})
    agreement = found.dynamometer.agreement
    facts = {
        "gain": agreement.gain,
        "gain_interval": agreement.gain_interval,
        "gain_is_one": agreement.gain_is_one,
        "offset_N": agreement.offset,
        "offset_interval_N": agreement.offset_interval,
        "offset_is_zero": agreement.offset_is_zero,
        "rms_N": agreement.rms_difference,
        "maximum_N": agreement.maximum_difference,
        "units": agreement.units,
        "by_run": agreement.by_run,
    }
    return Check(name, agreement.agrees, facts)


def _rig(found: StiffnessMap) -> Check:
    assert found.rig is not None
    rig = found.rig.check
    worst = int(np.argmax(np.abs(rig.normalised_error)))
    facts = {
        "share": float(np.mean(rig.agrees)),
        "directions": len(rig.agrees),
        "worst_rad": float(found.overall.angle[worst]),
        "normalised_error": float(rig.normalised_error[worst]),
    }
    return Check("compliance with the rig as predicted", facts["share"] >= rig.coverage - 0.1, facts)
