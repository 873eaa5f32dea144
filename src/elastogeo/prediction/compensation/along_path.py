"""A path with its points moved by minus the deviation that is predicted for them: what no table of one axis holds.

Angles times levers, and what the force does to the compliance, are different at every point of a path. Where a program is
made for one part, its points can be moved. Only components of the deviation that the tests determine all along the path, and
that are greater than their uncertainty, are compensated, each along its own axis of the workpiece; the rest is named.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from elastogeo.errors import InputError
from elastogeo.identification import Check, Identification, identify
from elastogeo.machine import Array, ConstantForce, Cut, Directions, PathForce, Program, ToolPath, loop_frames, points_at
from elastogeo.observe import Askable
from elastogeo.prediction.compensation.corrected_program import corrected_program, fine_path, with_starts
from elastogeo.prediction.compensation.result import LeftOut, PathCompensation
from elastogeo.prediction.compensation.verdict import left_check
from elastogeo.prediction.paths import PathPrediction, path_deviation

STEP, TOLERANCE = 1.0, 0.0005
"""Distance of points [mm], and by how much lines between them may leave the corrected path."""

COMPONENTS = "xyz"
_REACHED = 1e-6
"""Part of a correction that may be lost where no linear axis moves along it."""


def compensate_path(
    one: Identification | Askable,
    program: Program,
    cut: Cut | None = None,
    *,
    force: tuple[float, float, float] | PathForce | None = None,
    along: Directions = "workpiece",
    zero: Mapping[str, float] | None = None,
    step: float = STEP,
    tolerance: float = TOLERANCE,
) -> PathCompensation:
    """Move the points of a program by minus the deviation predicted for them, and predict what is left.

    Parameters
    ----------
    one : Identification, or tests
        What is known of the machine; tests are identified first.
    program : Program
        As `read_program` gives it.
    cut : Cut, optional
        What loads the tool and the table.
    force : 3 floats [N] or PathForce, optional
        On the tool, instead of the cut's.
    along : {"workpiece", "machine", "path"}
        Directions in which 3 floats count.
    zero : mapping of str to float [mm, rad], optional
        Axis commands at the zero of the program (G54).
    step : float [mm]
        Greatest distance of the points at which the deviation is predicted.
    tolerance : float [mm]
        By which the lines of the new program may leave the corrected path.

    Returns
    -------
    PathCompensation
        With the corrected program, whose arcs are lines; with the program as it was if nothing is certain.

    Raises
    ------
    InputError
        If the path or the force cannot be used.
    PathError
        If an axis would leave its travel.
    """
    if not tolerance > 0:
        raise InputError(f"the tolerance is {tolerance:g} mm; it must be positive")
    result = one if isinstance(one, Identification) else identify(one)
    whole = cut or Cut()
    if force is not None:
        whole = replace(whole, force=ConstantForce(force, along) if isinstance(force, tuple) else force)
    prepared = with_starts(program)
    path = fine_path(prepared, result.campaign.machine, step, tolerance, zero)
    before = path_deviation(result, path, whole, split=False)
    chosen, left = _chosen(before)
    wanted = np.where(chosen, -np.nan_to_num(before.value[:, :3]), 0.0)
    new, made = program, path.commands
    if chosen.any():
        new, made = corrected_program(prepared, path, path.commands + _axis_shift(path, wanted), zero or {}, tolerance)
    after = path_deviation(result, replace(path, commands=made), whole, split=False)
    moved = points_at(path.machine, made, path.tool) - path.points
    normal = np.einsum("mi,mi->m", path.left if before.normal_to == "left" else -path.left, moved)
    value = after.value + np.column_stack([moved, normal])
    return PathCompensation(
        campaign=result.campaign,
        program=new,
        before=before,
        commands=made,
        shift=moved,
        value=value,
        expanded=after.expanded,
        components=tuple(c for c, is_chosen in zip(COMPONENTS, chosen, strict=True) if is_chosen),
        left_out=tuple(left),
        tolerance=tolerance,
        verdict=tuple(_checks(before, value, after.expanded, chosen, left, len(new.blocks))),
    )


def _chosen(before: PathPrediction) -> tuple[Array, list[LeftOut]]:
    """Which components are compensated, and why others are not."""
    chosen, left = np.zeros(3, dtype=bool), []
    for k, name in enumerate(COMPONENTS):
        if not before.asked[:, k].any():
            left.append(LeftOut((name,), "path", "not asked"))
            continue
        here = before.asked[:, k]
        if not before.supported[here, k].all():
            left.append(LeftOut((name,), "path", "not determined"))
            continue
        size = float(np.sqrt(np.mean(before.value[here, k] ** 2)))
        doubt = float(np.sqrt(np.mean(before.expanded[here, k] ** 2)))
        if size > doubt:
            chosen[k] = True
        else:
            left.append(LeftOut((name,), "path", "no interval" if doubt != doubt else "uncertainty", size, doubt))
    return chosen, left


def _axis_shift(path: ToolPath, wanted: Array) -> Array:
    """By how much the axes go elsewhere so that the tool does, shape (m, n), of displacements along the workpiece."""
    machine = path.machine
    linear = [k for k, joint in enumerate(machine.joints) if not joint.is_rotary]
    shift = np.zeros_like(path.commands)
    for part in path.slices():
        frames = loop_frames(machine, path.commands[part], path.tool)
        count = part.stop - part.start
        columns = [
            np.broadcast_to(frames.joints[machine.axes[k]].location.rotation[:, :, machine.joints[k].direction], (count, 3))
            for k in linear
        ]
        directions = np.stack(columns, axis=2)
        asked = np.broadcast_to(frames.workpiece.vector(wanted[part]), (count, 3))
        solved = np.einsum("kij,kj->ki", np.linalg.pinv(directions), asked)
        lost = np.abs(np.einsum("kij,kj->ki", directions, solved) - asked).max(initial=0.0)
        if lost > _REACHED * np.abs(asked).max(initial=0.0) + 1e-12:
            raise InputError(
                f"machine {machine.name!r} has no linear axes along which the deviation could be compensated: {lost:.3g} mm "
                f"of it would stay"
            )
        shift[part.start : part.stop, linear] = solved
    return shift


def _checks(
    before: PathPrediction, value: Array, doubt: Array, chosen: Array, left: list[LeftOut], blocks: int
) -> Iterator[Check]:
    columns = np.flatnonzero(chosen)
    yield Check("path corrected", bool(len(columns)), {"components": tuple(COMPONENTS[k] for k in columns)}, decisive=True)
    if len(columns):
        first = float(np.nanmax(np.abs(before.value[:, columns])))
        last = float(np.nanmax(np.abs(value[:, columns]) + doubt[:, columns]))
        facts = {"before": first, "after": last, "blocks": blocks, "points": len(value)}
        yield Check("deviation falls for sure", last < first, facts)
    yield left_check("determined by the tests", left, "not determined")
    yield left_check("greater than its uncertainty", left, "uncertainty")
    yield left_check("uncertainty known", left, "no interval")
    yield left_check("asked of the tests", left, "not asked")
