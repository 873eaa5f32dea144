"""`elastogeo.static/1`: what a static test says.

test, verdict : as in `envelope`; the verdict holds the checks of the instrument's results, then those of the joints
places : [{commands, direction, along, runs, line, refusal, drive, drive_refusal}], of a static force, else empty
    commands : {axis: value}, where the machine stands [mm, rad]
    direction : of the force, three components in the foundation
    along : whether the sensor reads along the force
    runs : [{run, cycles, branches, left_out, by_cycle, degree, force_range_N, static_compliance, rising_secant,
        falling_secant, mean_hysteresis, greatest_hysteresis, greatest_at_N, hysteresis_at_zero, backlash, remaining,
        energy_lost, residual_std_um, refusal}]
        cycles, branches, left_out : how many there are, and how many branches do not count
        by_cycle : whether there are cycles enough for uncertainties, which come from their scatter
        degree : of the polynomials through the branches
        static_compliance, rising_secant, falling_secant : numbers [um/N]; of a loop, the standard uncertainty is that of the
            scatter of the run's cycles, and there is no interval
        mean_hysteresis, greatest_hysteresis, hysteresis_at_zero, backlash, remaining : numbers [um], or null
        energy_lost : number [N mm] of one cycle
        refusal : why there is no hysteresis; all the rest is then null
    line : {compliance [um/N], offset [um], residual_std_um, greatest_departure_um, runs, by_run, needed}, or null for the
        reason `refusal`
    drive : {axis, feedback, parts, whole, limits, current}, or null (for the reason `drive_refusal`, if positions were
        recorded)
        parts : [{names, compliance [um/N], acts, share}]; more than one name where parts are not distinguished
        whole : number [um/N], or null
        limits : what cannot be said, in sentences
        current : number [A/N] of the motor per force, or null; the interval holds zero where friction holds the axis
cartesian : {compliance, undetermined, zeroed, zeros, runs, by_run, needed, residual_std_um, stiffness, symmetry, principal,
    refusal} of displacement probes, or null
    compliance : {value_um_per_N, standard_uncertainty_um_per_N, interval95_um_per_N}, matrices in the foundation; row:
        displacement, column: force; null where it is not determined
    zeroed : whether the probes count as zeroed without load; else `zeros` holds the number [um] of each
    stiffness : {value_N_per_um, standard_uncertainty_N_per_um}, matrices, or null for the reason `refusal`
    symmetry : {differences_um_per_N: XY-YX, XZ-ZX, YZ-ZY, chi_squared, probability}, or null
    principal : [{direction, direction_uncertainty_rad, compliance [um/N]}], the softest first
twists : [{run, steps, standard_deviation_um, redundancy, outlying, suspect}] of a sensor frame, along the axes in which the
    sensors are given; else empty
    steps : [{force_N, readings, translation_um, rotation_urad}]
    redundancy : by sensor, the share of its error that shows in its own residual
    outlying : by sensor, the probability that a sound one stands out so far; null where nothing checks it
    suspect : number, from 1, of the sensor that stands out, or null
twist_places : [{commands, direction, runs, compliance, by_run, needed}] of a sensor frame, by place and line of the force
    runs : names
    compliance : [six numbers: X, Y, Z in um/N, A, B, C in urad/N]
twist_refusal : why a sensor frame gives no twist, or empty
joints : `elastogeo.identification/1`, of what the test's own question asks for

A number is {value, standard_uncertainty, interval95, degrees_of_freedom}, in the unit in brackets above; all but the value
are null where runs or cycles are too few to show the uncertainty. by_run : whether there are runs enough; needed : how many
it takes, or null.
"""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from elastogeo.estimate import Estimate
from elastogeo.identification.static_tests import (
    Cartesian,
    LoadedPlace,
    LoadedRun,
    LoadStep,
    OnAxis,
    StaticLine,
    StaticResults,
    TwistPlace,
    TwistRun,
)
from elastogeo.report.document import UM, document, tested, uncertainty_entries, verdict_entries
from elastogeo.report.identification.document import identification_json

STATIC_SCHEMA = "elastogeo.static/1"
_MICRO = 1e6

_IN_UM = (
    "static_compliance",
    "rising_secant",
    "falling_secant",
    "mean_hysteresis",
    "greatest_hysteresis",
    "hysteresis_at_zero",
    "backlash",
    "remaining",
)


def static_json(found: StaticResults) -> dict[str, Any]:
    """What a static test says as one JSON object (`elastogeo.static/1`)."""
    return document(
        STATIC_SCHEMA,
        {
            "test": tested(found.joints.test, found.joints.reference_force),
            "places": [_place(place) for place in found.places],
            "cartesian": None if found.cartesian is None else _cartesian(found.cartesian),
            "twists": [_twist(run) for run in found.twists],
            "twist_places": [_twist_place(place) for place in found.twist_places],
            "twist_refusal": found.refusal,
            "joints": identification_json(found.joints),
            "verdict": verdict_entries(found.verdict),
        },
    )


def _number(found: Estimate | None, scale: float) -> dict[str, Any] | None:
    return None if found is None else {"value": found.value * scale, **uncertainty_entries(found, scale)}


def _of_cycles(found: Estimate | None, scale: float) -> dict[str, Any] | None:
    """As a number, without an interval: the cycles of a run do not show how another run differs."""
    number = _number(found, scale)
    return None if number is None else {**number, "interval95": None}


def _place(place: LoadedPlace) -> dict[str, Any]:
    return {
        "commands": place.commands,
        "direction": place.direction,
        "along": place.along,
        "runs": [_run(run) for run in place.runs],
        "line": None if place.line is None else _line(place.line),
        "refusal": place.refusal,
        "drive": None if place.drive is None else _drive(place.drive),
        "drive_refusal": place.drive_refusal,
    }


def _run(run: LoadedRun) -> dict[str, Any]:
    found = run.hysteresis
    return {
        "run": run.run,
        "cycles": len(found.cycles) if found else None,
        "branches": len(found.branches) if found else None,
        "left_out": len(found.left_out) if found else None,
        "by_cycle": found.by_cycle if found else None,
        "degree": found.degree if found else None,
        "force_range_N": found.range if found else None,
        **{name: _of_cycles(getattr(found, name), UM) if found else None for name in _IN_UM},
        "greatest_at_N": found.greatest_at if found else None,
        "energy_lost": _of_cycles(found.energy_lost, 1.0) if found else None,
        "residual_std_um": found.residual_std * UM if found else None,
        "refusal": run.refusal,
    }


def _line(line: StaticLine) -> dict[str, Any]:
    return {
        "compliance": _number(line.compliance, UM),
        "offset": _number(line.offset, UM),
        "residual_std_um": line.residual_std * UM,
        "greatest_departure_um": line.nonlinearity * UM,
        **asdict(line.counted),
    }


def _drive(found: OnAxis) -> dict[str, Any]:
    return {
        "axis": found.axis,
        "feedback": found.feedback,
        "parts": [
            {
                "names": part.names,
                "compliance": _number(part.compliance, UM),
                "acts": part.acts,
                "share": part.share,
            }
            for part in found.parts
        ],
        "whole": _number(found.whole, UM),
        "limits": found.limits,
        "current": _number(found.current, 1.0),
    }


def _cartesian(found: Cartesian) -> dict[str, Any]:
    compliance, symmetry = found.compliance, found.symmetry
    return {
        "compliance": {
            "value_um_per_N": compliance.compliance * UM,
            "standard_uncertainty_um_per_N": compliance.standard_uncertainty * UM if compliance.counted.by_run else None,
            "interval95_um_per_N": compliance.interval() * UM if compliance.counted.by_run else None,
        },
        "undetermined": compliance.undetermined,
        "zeroed": found.zeroed,
        "zeros": [_number(zero, UM) for zero in compliance.zeros],
        **asdict(compliance.counted),
        "residual_std_um": compliance.residual_std * UM,
        "stiffness": None
        if found.stiffness is None or found.stiffness_uncertainty is None
        else {
            "value_N_per_um": found.stiffness / UM,
            "standard_uncertainty_N_per_um": found.stiffness_uncertainty / UM if compliance.counted.by_run else None,
        },
        "symmetry": None
        if symmetry is None
        else {
            "differences_um_per_N": symmetry.differences * UM,
            "chi_squared": symmetry.chi_squared,
            "probability": symmetry.probability,
        },
        "principal": [
            {
                "direction": one.direction,
                "direction_uncertainty_rad": one.direction_uncertainty,
                "compliance": _number(one.compliance, UM),
            }
            for one in found.principal
        ],
        "refusal": found.refusal,
    }


def _twist(run: TwistRun) -> dict[str, Any]:
    return {
        "run": run.run,
        "steps": [_step(step) for step in run.steps],
        "standard_deviation_um": run.twist.standard_deviation * UM,
        "redundancy": run.twist.redundancy,
        "outlying": run.twist.outlying,
        "suspect": run.twist.suspect,
    }


def _twist_place(place: TwistPlace) -> dict[str, Any]:
    scales = (UM,) * 3 + (_MICRO,) * 3
    return {
        "commands": place.commands,
        "direction": place.direction,
        "runs": place.runs,
        "compliance": [_number(one, scale) for one, scale in zip(place.compliance, scales, strict=True)],
        "by_run": place.counted.by_run,
        "needed": place.counted.needed,
    }


def _step(step: LoadStep) -> dict[str, Any]:
    return {
        "force_N": step.force,
        "readings": step.readings,
        "translation_um": step.twist[:3] * UM,
        "rotation_urad": step.twist[3:] * _MICRO,
    }
