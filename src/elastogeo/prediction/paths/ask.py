"""The question of a person: how far will the tool be off along this path, on this machine, under this force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.errors import InputError
from elastogeo.identification import Identification, identify
from elastogeo.machine import (
    Array,
    ConstantForce,
    Cut,
    Directions,
    PathForce,
    Program,
    ToolPath,
    path_of_commands,
    path_of_program,
)
from elastogeo.observe import Askable
from elastogeo.prediction.paths.datum import Datum
from elastogeo.prediction.paths.predict import path_deviation
from elastogeo.prediction.paths.result import PathPrediction

STEP = 1.0
"""Distance [mm] of two points along a block of a program, unless another is asked for."""

Way = ToolPath | Program | Array


def predict(
    one: Identification | Askable,
    path: Way,
    cut: Cut | None = None,
    *,
    force: Sequence[float] | PathForce | None = None,
    along: Directions = "workpiece",
    zero: Mapping[str, float] | None = None,
    feed: float | None = None,
    step: float = STEP,
    split: bool = True,
    prior: bool = False,
    datum: Datum = "machine",
) -> PathPrediction:
    """Predict how far the tool will be off along a path, with the interval that the tests support.

    Parameters
    ----------
    one : Identification, or tests
        What is known of the machine; tests are identified first.
    path : ToolPath, Program or array of shape (m, n)
        As `read_path` gives it; an NC program; or axis commands [mm, rad].
    cut : Cut, optional
        As `read_cut` gives it: force or milling model, tool and holder, workpiece.
    force : 3 floats [N] or PathForce, optional
        On the tool, instead of the cut's.
    along : {"workpiece", "machine", "path"}
        Directions in which 3 floats count.
    zero : mapping of str to float [mm, rad], optional
        Of a program, axis commands at the zero of the workpiece (G54).
    feed : float [mm/s], optional
        Of an array.
    step : float [mm]
        Distance of the points along a program.
    split : bool
        Whether the deviation is split into its parts.
    prior : bool
        Whether what the tests do not support is given by the stated prior.
    datum : {"machine", "probed"}
        Whether the workpiece sits as the machine says, or as the machine's own probe finds it there, unloaded.

    Returns
    -------
    PathPrediction

    Raises
    ------
    InputError
        If the path or the force cannot be used.
    """
    result = one if isinstance(one, Identification) else identify(one)
    machine = result.campaign.machine
    if isinstance(path, Program):
        path = path_of_program(path, machine, step, zero)
    elif not isinstance(path, ToolPath):
        path = path_of_commands(machine, np.asarray(path, dtype=float), feed)
    whole = cut or Cut()
    if force is not None:
        whole = replace(whole, force=_force(force, along))
    return path_deviation(result, path, whole, split, prior, datum)


def _force(given: Sequence[float] | PathForce, along: Directions) -> PathForce:
    if not isinstance(given, Sequence | np.ndarray):
        return given
    if len(given) != 3:
        raise InputError(f"a force on the tool is three numbers in N, along x, y and z; {len(given)} arrived")
    return ConstantForce((float(given[0]), float(given[1]), float(given[2])), along)
