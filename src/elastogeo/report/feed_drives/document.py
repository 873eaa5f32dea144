"""`elastogeo.drive/1`: the torque balance of feed drives.

test : {name, simulated, runs, held_out, axes, notes, about, files: [{run, file, sha256}]}
axes : one entry per axis:
    axis, effort_unit
    refusal : why it cannot be identified; empty if it can
    shown : name of the model whose parameters follow
    model : {terms, least_speed_mm_s, smooth_speed_mm_s, stribeck_speed_mm_s, delay_s, neighbours}; speeds in rad/s of a
        rotary axis; a least speed of null is that of the noise which each record shows at rest
    samples : {run: number used}; left_out : how many were too slow or without a motion
    counted : what the uncertainties take as independent: `runs`, `pieces`, `samples`
    parameters : [{name, value, unit, meaning, standard_uncertainty, interval95, stands_for, at_motor}]
        Where `stands_for` has several terms, the value is that of the combination, and none of its terms has one.
        `at_motor` is null or {value, standard_uncertainty, unit}: J_T, B_T at the motor's shaft.
    known : {name: value}
    searched : [{name, value, unit, interval95, at_bound}]; an end of an interval that was not found is null
    null, rank, columns, condition_raw, condition_scaled : as in `identification`
    rmse, r2 : over the identified runs
    identified, held_out, left_out_runs : [{run, samples, rmse, r2}]; `left_out_rmse` over all of the last
    models : [{name, terms, parameters, searched, rmse, left_out_rmse, gain_percent, better, impossible, left_out_runs,
        held_out, searched_without_run}]; of the error of left-out runs against the first; `parameters` as above
    rest : {share, used, speed_mm_s, left_out_rmse, kept_rmse}, of the samples at standstill; or null
    supported : name of the model that the runs support; not_compared : {name: why not}
    residuals : {autocorrelation, apart [s], limit, forward, backward, slow, fast, rms, flips}
    verdict : as in `envelope`
verdict : of all axes, names beginning with the axis
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from typing import Any

from elastogeo.drive import BalanceFit, RunScore, Searched
from elastogeo.identification.feed_drives import AxisDrive, DriveIdentification, DriveParameter, ModelScore, Rest
from elastogeo.report.document import document, verdict_entries

DRIVE_SCHEMA = "elastogeo.drive/1"


def drive_json(result: DriveIdentification) -> dict[str, Any]:
    """Identified feed drives as one JSON object (`elastogeo.drive/1`)."""
    test = result.test
    return document(
        DRIVE_SCHEMA,
        {
            "test": {
                "name": test.name,
                "simulated": test.simulated,
                "runs": test.runs,
                "held_out": test.held_out,
                "axes": test.axes,
                "notes": test.notes,
                "about": test.about.said(),
                "files": [{"run": run, "file": file, "sha256": sha256} for run, (file, sha256) in test.files.items()],
            },
            "axes": [_axis(axis) for axis in result.axes],
            "verdict": verdict_entries(result.verdict),
        },
    )


def _axis(axis: AxisDrive) -> dict[str, Any]:
    return {
        "axis": axis.axis,
        "effort_unit": axis.effort_unit,
        "refusal": axis.refusal,
        "shown": axis.model,
        **({} if axis.fit is None else _fit(axis.fit)),
        "parameters": [_parameter(parameter) for parameter in axis.parameters],
        "identified": _scores(axis.identified),
        "held_out": _scores(axis.held_out),
        "left_out_runs": _scores(axis.left_out.scores if axis.left_out else ()),
        "left_out_rmse": axis.left_out.rmse if axis.left_out else None,
        "models": [_model(model) for model in axis.models],
        "supported": axis.supported,
        "not_compared": axis.not_compared,
        "rest": None if axis.rest is None else _rest(axis.rest),
        "residuals": asdict(axis.structure) if axis.structure else None,
        "verdict": verdict_entries(axis.verdict),
    }


def _fit(fit: BalanceFit) -> dict[str, Any]:
    found, model = fit.confounding, fit.model
    return {
        "model": {
            "terms": model.terms,
            "least_speed_mm_s": model.least_speed,
            "smooth_speed_mm_s": model.smooth_speed,
            "stribeck_speed_mm_s": model.stribeck_speed,
            "delay_s": model.delay,
            "neighbours": model.neighbours,
        },
        "samples": fit.samples,
        "left_out": fit.left_out,
        "counted": fit.counted,
        "known": fit.known,
        "searched": _searched(fit.searched),
        "null": found.null,
        "rank": found.rank,
        "columns": len(found.labels),
        "condition_raw": found.condition_raw,
        "condition_scaled": found.condition_scaled,
        "rmse": fit.rmse,
        "r2": fit.r2,
    }


def _rest(rest: Rest) -> dict[str, Any]:
    return {
        "share": rest.share,
        "used": rest.used,
        "speed_mm_s": rest.speed,
        "left_out_rmse": rest.left_out,
        "kept_rmse": rest.kept,
    }


def _parameter(parameter: DriveParameter) -> dict[str, Any]:
    at_motor = None
    if parameter.at_motor:
        found, unit = parameter.at_motor
        at_motor = {"value": found.value, "standard_uncertainty": found.standard_uncertainty, "unit": unit}
    return {
        "name": parameter.name,
        "value": parameter.estimate.value,
        "unit": parameter.unit,
        "meaning": parameter.meaning,
        "standard_uncertainty": parameter.estimate.standard_uncertainty,
        "degrees_of_freedom": parameter.estimate.degrees_of_freedom,
        "interval95": parameter.estimate.interval(),
        "stands_for": parameter.stands_for,
        "at_motor": at_motor,
    }


def _searched(found: Iterable[Searched]) -> list[dict[str, Any]]:
    return [
        {"name": s.name, "value": s.value, "unit": s.unit, "interval95": s.interval, "at_bound": s.at_bound} for s in found
    ]


def _scores(scores: Iterable[RunScore]) -> list[dict[str, Any]]:
    return [{"run": s.run, "samples": s.samples, "rmse": s.rmse, "r2": s.r2} for s in scores]


def _model(model: ModelScore) -> dict[str, Any]:
    return {
        "name": model.name,
        "terms": model.fit.model.terms,
        "parameters": [_parameter(parameter) for parameter in model.parameters],
        "searched": _searched(model.fit.searched),
        "rmse": model.fit.rmse,
        "left_out_rmse": model.left_out.rmse,
        "gain_percent": 100 * model.gain,
        "better": model.better,
        "impossible": model.impossible,
        "left_out_runs": _scores(model.left_out.scores),
        "held_out": _scores(model.held_out),
        "searched_without_run": model.left_out.searched,
    }
