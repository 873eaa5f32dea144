"""Results as JSON: what `--json` prints and a page's `.json` twin holds. Plain types, nothing rounded, null for no number.

`elastogeo.identification/1`
    schema : this name
    software : {name, version}
    test : {name, machine, topology, instrument, simulated, reference_force_N, resolution_um, runs}
        `simulated` says from what the readings are simulated and is empty if they were measured; `reference_force_N` is the
        level that was taken off, or null; `runs` counts the runs of the test, the reference among them.
    parameters : [{name, value, unit, standard_uncertainty, interval95, stands_for, peak_to_peak_um, share, meaning}]
        The retained set; `stands_for` is {name: coefficient}, `peak_to_peak_um` has the sign of the value and is that at the
        highest force, `share` is 0 to 1 of the sum of all absolute ones.
    null : [name], parameters that change no reading
    confounded : [[name, name, ...]], parameters that always produce the same trace but for its size
    rank, columns : how many combinations are determined, of how many parameters
    condition_raw, condition_scaled : of the retained columns as they are, and scaled to unit length
    rmse_um : over all readings
    levels : [{force_N, readings, rmse_um, fitness_percent}], forces and readings less the reference's if one was taken off
    local : [{forces_N, values: [{name, value, standard_uncertainty}]}], from adjacent levels
    repeats : null, or {levels: {level: runs}, combinations, mean, combination_std, estimate, standard_uncertainty,
        degrees_of_freedom, note}; from mean to degrees_of_freedom they are {name: number}; `estimate` is from all repeated
        runs together, `standard_uncertainty` is its own, from the scatter of the runs
    minimum_norm : {name: value} over all parameters that were asked for; not an estimate of each
    verdict : [{name, passed, sentence}]

`elastogeo.confounding/1`
    schema, software, test : as above
    null, confounded, rank, columns, condition_raw, condition_scaled : as above
    groups : all groups, single ones included
    retained : [{name, stands_for}]
    weakest : {name: coefficient}, the combination of the retained parameters, each scaled to a column of unit length, that
        the test sees least
    singular_values : of the scaled retained columns, greatest first
    tolerance : relative, of the decision

`elastogeo.machine/1`
    schema, software : as above
    name, topology, topology_iso, tool_mm, assumed : `assumed` says in words what was not measured
    axes : [{name, offset_mm, tilt_rad, travel, travel_unit, compliant}], from the workpiece to the tool

A number without a value (a fitness of readings that do not vary, infinite degrees of freedom or travel) is null.
Within one schema number, keys are added but never changed or removed.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np

from elastogeo import __version__
from elastogeo.estimate import Confounding, Repeatability
from elastogeo.identify import Identification, Local, Parameter
from elastogeo.machine import Machine
from elastogeo.observe import MachineTest, instruments
from elastogeo.report.text import UM

IDENTIFICATION_SCHEMA = "elastogeo.identification/1"
CONFOUNDING_SCHEMA = "elastogeo.confounding/1"
MACHINE_SCHEMA = "elastogeo.machine/1"

SHARED_RUNS = (
    "Combinations share runs and are not independent: combination_std is about that of a single combination, and dividing "
    "it by the root of their number would claim far too much. standard_uncertainty comes from the scatter of the runs and "
    "is that of the estimate from all of them; it is a repeatability, not a full uncertainty."
)
SHARED_REFERENCE = "The scatter of the reference run, which all differences share, is not contained."


def identification_json(result: Identification) -> dict[str, Any]:
    """An identification as one JSON object (`elastogeo.identification/1`)."""
    document = {
        "schema": IDENTIFICATION_SCHEMA,
        "software": _software(),
        "test": _test(result.test, result.reference_force),
        "parameters": [_parameter(parameter) for parameter in result.parameters],
        **_confounding(result.confounding),
        "rmse_um": result.rmse * UM,
        "levels": [
            {
                "force_N": level.force,
                "readings": level.readings,
                "rmse_um": level.rmse * UM,
                "fitness_percent": level.fitness,
            }
            for level in result.levels
        ],
        "local": [_local(local) for local in result.local],
        "repeats": None if result.repeats is None else _repeats(result.repeats, result.reference_force),
        "minimum_norm": result.minimum_norm,
        "verdict": [{"name": c.name, "passed": c.passed, "sentence": c.sentence} for c in result.verdict],
    }
    return {key: _plain(value) for key, value in document.items()}


def confounding_json(confounding: Confounding, test: MachineTest) -> dict[str, Any]:
    """What a test can tell apart as one JSON object (`elastogeo.confounding/1`)."""
    document = {
        "schema": CONFOUNDING_SCHEMA,
        "software": _software(),
        "test": _test(test, test.question.reference_force),
        **_confounding(confounding),
        "groups": confounding.groups,
        "retained": [{"name": name, "stands_for": confounding.stands_for(name)} for name in confounding.retained],
        "weakest": dict(zip(confounding.retained, confounding.weakest, strict=True)),
        "singular_values": confounding.singular_values,
        "tolerance": confounding.tolerance,
    }
    return {key: _plain(value) for key, value in document.items()}


def machine_json(machine: Machine) -> dict[str, Any]:
    """A machine as one JSON object (`elastogeo.machine/1`)."""
    document = {
        "schema": MACHINE_SCHEMA,
        "software": _software(),
        "name": machine.name,
        "topology": machine.topology.compact,
        "topology_iso": machine.topology.iso,
        "tool_mm": machine.tool,
        "assumed": machine.assumed,
        "axes": [
            {
                "name": joint.name,
                "offset_mm": joint.offset,
                "tilt_rad": joint.tilt,
                "travel": joint.travel,
                "travel_unit": "rad" if joint.is_rotary else "mm",
                "compliant": joint.compliant,
            }
            for joint in machine.joints
        ],
    }
    return {key: _plain(value) for key, value in document.items()}


def instrument_name(test: MachineTest) -> str:
    """The name of a test's instrument: as test files spell it, else that of its class."""
    kind = type(test.setup)
    return next((name for name, known in instruments().items() if known is kind), kind.__name__)


def _software() -> dict[str, str]:
    return {"name": "elastogeo", "version": __version__}


def _test(test: MachineTest, reference_force: float | None) -> dict[str, Any]:
    return {
        "name": test.name,
        "machine": test.machine.name,
        "topology": test.machine.topology.compact,
        "instrument": instrument_name(test),
        "simulated": test.simulated,
        "reference_force_N": reference_force,
        "resolution_um": None if test.resolution is None else test.resolution * UM,
        "runs": len(test.runs),
    }


def _parameter(parameter: Parameter) -> dict[str, Any]:
    return {
        "name": parameter.name,
        "value": parameter.value,
        "unit": parameter.unit,
        "standard_uncertainty": parameter.standard_uncertainty,
        "interval95": parameter.interval,
        "stands_for": parameter.stands_for,
        "peak_to_peak_um": parameter.peak_to_peak * UM,
        "share": parameter.share,
        "meaning": parameter.meaning,
    }


def _confounding(found: Confounding) -> dict[str, Any]:
    return {
        "null": found.null,
        "confounded": [group for group in found.groups if len(group) > 1],
        "rank": found.rank,
        "columns": len(found.labels),
        "condition_raw": found.condition_raw,
        "condition_scaled": found.condition_scaled,
    }


def _local(local: Local) -> dict[str, Any]:
    solution = local.solution
    return {
        "forces_N": local.forces,
        "values": [
            {"name": name, "value": value, "standard_uncertainty": uncertainty}
            for name, value, uncertainty in zip(solution.labels, solution.values, solution.standard_uncertainty, strict=True)
        ],
    }


def _repeats(repeats: Repeatability, reference_force: float | None) -> dict[str, Any]:
    solution = repeats.solution
    by_name = {
        "mean": repeats.combination_mean,
        "combination_std": repeats.combination_std,
        "estimate": solution.values,
        "standard_uncertainty": solution.standard_uncertainty,
        "degrees_of_freedom": solution.degrees_of_freedom,
    }
    return {
        "levels": dict(repeats.runs),
        "combinations": len(repeats.combinations),
        **{key: dict(zip(solution.labels, values, strict=True)) for key, values in by_name.items()},
        "note": SHARED_RUNS if reference_force is None else f"{SHARED_RUNS} {SHARED_REFERENCE}",
    }


def _plain(value: Any) -> Any:
    """The same with plain JSON types only; a number that is not finite becomes null."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not isfinite(value):
        return None
    return value
