"""`elastogeo.compliance_map/1`: the compliance at the tool over the volume.

test, verdict : as in `envelope`
axes : {axis: [command]}, mm: the grid, in the order of the arrays below
stands : {axis: command}, mm or rad: where all other axes stand
tool_mm : functional point in the last tool-branch frame
direction : of the force, and of the displacement that counts, in the foundation; null for the softest of each place
compliance_nm_per_N, expanded_nm_per_N : arrays over the grid, null where the tests do not support a value, or show no U
supported : array over the grid, true or false
prior_share : array over the grid, share of the variance that is the stated prior's; null unless a prior was asked for
places : number of places
every : {axis: n}, of which every n-th along each axis is in the arrays: 1 unless there are more than 20000
stiffest, softest : {commands, compliance, stiffness, principal, at_tool}, or null where nothing is known
    compliance : {value, standard_uncertainty, interval95, degrees_of_freedom}, nm/N
    stiffness : the same in N/um, or null where the compliance may as well be zero
    principal : [{direction, direction_uncertainty_rad, compliance}], the softest first
    at_tool : {compliance, expanded, supported, alone, stiffness, stiffness_expanded}, 6 x 6, in mm, N, rad
difference_nm_per_N : by how much the softest place is softer than the stiffest, with its uncertainty
limit : null, or {least_stiffness_N_per_um, conforming, failing, undecided, passed}
design : null, or {name, p_value, compliance_nm_per_N, agrees, parameters, missing, unused}
    p_value : of such a difference at any place if the machine is as designed
    compliance_nm_per_N, agrees : arrays over the grid; agrees within U: 1, differs: -1, not told by the tests: 0
    parameters : [{name, unit, stands_for, value, standard_uncertainty, interval95, degrees_of_freedom, design,
        design_uncertainty, agrees}], what the tests determine, in `unit`
    missing : [name] that were asked for and are rigid by design; unused : [name] of the design that were not asked for
rigid : [name] of the compliances that were not asked for
prior : null, or {compliance_mm_per_N, lever_mm}: the standard deviation of what no test sees
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.identification import Principal
from elastogeo.prediction import TYPICAL_COMPLIANCE, TYPICAL_LEVER, Acceptance, AgainstDesign, ComplianceMap, Place
from elastogeo.report.document import UM, document, tested_together, uncertainty_entries, verdict_entries

MAP_SCHEMA = "elastogeo.compliance_map/1"

NM = 1e6
"""Nanometres in a millimetre."""

MOST_PLACES = 20_000


def map_json(found: ComplianceMap) -> dict[str, Any]:
    """A map of the compliance as one JSON object (`elastogeo.compliance_map/1`)."""
    machine, grid, every = found.campaign.machine, found.grid, thinned(found)
    part = tuple(slice(None, None, step) for step in every)
    axes = {axis: one[cut] for axis, one, cut in zip(grid.axes, grid.along, part, strict=True)}
    return document(
        MAP_SCHEMA,
        {
            "test": tested_together(found.campaign, None),
            "axes": axes,
            "stands": {axis: grid.stands[k] for k, axis in enumerate(machine.axes) if axis not in grid.axes},
            "tool_mm": found.tool,
            "direction": found.direction,
            "places": grid.size,
            "every": dict(zip(grid.axes, every, strict=True)),
            "compliance_nm_per_N": found.compliance[part] * NM,
            "expanded_nm_per_N": found.expanded[part] * NM,
            "supported": found.supported[part],
            "prior_share": found.prior_share[part] if found.prior else None,
            "stiffest": _place(found, found.stiffest),
            "softest": _place(found, found.softest),
            "difference_nm_per_N": None if found.difference is None else _estimate(found.difference, NM),
            "limit": None if found.acceptance is None else _limit(found.acceptance),
            "design": None if found.design is None else _design(found.design, part),
            "rigid": found.rigid,
            "prior": {"compliance_mm_per_N": TYPICAL_COMPLIANCE, "lever_mm": TYPICAL_LEVER} if found.prior else None,
            "verdict": verdict_entries(found.verdict),
        },
    )


def thinned(found: ComplianceMap, most: int = MOST_PLACES) -> tuple[int, ...]:
    """At which step along each axis places are shown: 1 unless there are more than `most`."""
    every = [1] * len(found.grid.shape)
    while _count(found.grid.shape, every) > most:
        widest = max(range(len(every)), key=lambda k: -(-found.grid.shape[k] // every[k]))
        every[widest] += 1
    return tuple(every)


def _count(shape: tuple[int, ...], every: list[int]) -> int:
    places = 1
    for count, step in zip(shape, every, strict=True):
        places *= -(-count // step)
    return places


def rows_of(found: ComplianceMap) -> list[dict[str, Any]]:
    """A row a place, in the units of the house; thinned as the document is."""
    part = tuple(slice(None, None, step) for step in thinned(found))
    along = [one[cut] for one, cut in zip(found.grid.along, part, strict=True)]
    compliance, expanded, supported = (a[part] for a in (found.compliance, found.expanded, found.supported))
    return [
        {
            **{axis: float(one[k]) for axis, one, k in zip(found.grid.axes, along, index, strict=True)},
            "compliance": _or_none(compliance[index]),
            "expanded": _or_none(expanded[index]),
            "supported": bool(supported[index]),
        }
        for index in np.ndindex(compliance.shape)
    ]


def _or_none(value: Any) -> float | None:
    return float(value) if np.isfinite(value) else None


def _place(found: ComplianceMap, place: Place | None) -> dict[str, Any] | None:
    if place is None:
        return None
    at = place.at_tool
    return {
        "commands": dict(zip(found.campaign.machine.axes, place.commands, strict=True)),
        "compliance": _estimate(place.compliance, NM),
        "stiffness": stiffness_entry(place.compliance),
        "principal": [_principal(one) for one in at.principal],
        "at_tool": {
            "compliance": at.compliance,
            "expanded": at.expanded,
            "supported": at.supported,
            "alone": at.alone,
            "stiffness": at.stiffness,
            "stiffness_expanded": at.stiffness_expanded,
        },
    }


def _principal(one: Principal) -> dict[str, Any]:
    turn = one.direction_uncertainty
    return {"direction": one.direction, "direction_uncertainty_rad": turn, "compliance": _estimate(one.compliance, NM)}


def stiffness_entry(compliance: Estimate) -> dict[str, Any] | None:
    """The stiffness of a compliance in N/um; null where it may as well be infinite."""
    try:
        return _estimate(compliance.inverse(), 1 / UM)
    except UnsupportedError:
        return None


def _estimate(found: Estimate, factor: float) -> dict[str, Any]:
    return {"value": found.value * factor, **uncertainty_entries(found, factor)}


def _design(found: AgainstDesign, part: tuple[slice, ...]) -> dict[str, Any]:
    return {
        "name": found.name,
        "p_value": found.p_value,
        "compliance_nm_per_N": found.compliance[part] * NM,
        "agrees": found.agrees[part],
        "parameters": [
            {
                "name": one.name,
                "unit": one.unit,
                "stands_for": one.stands_for,
                **_estimate(one.measured, 1.0),
                "design": one.design,
                "design_uncertainty": one.design_uncertainty,
                "agrees": one.agrees,
            }
            for one in found.parameters
        ],
        "missing": found.missing,
        "unused": found.unused,
    }


def _limit(found: Acceptance) -> dict[str, Any]:
    return {
        "least_stiffness_N_per_um": 1.0 / found.limit / UM,
        "conforming": found.conforming,
        "failing": found.failing,
        "undecided": found.undecided,
        "passed": found.passed,
    }
