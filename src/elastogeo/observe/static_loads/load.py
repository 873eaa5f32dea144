"""What static load tests share: where the machine stands, which way the force acts, how it is recorded.

The force acts between tool and workpiece: on the tool as recorded, on the workpiece as its reaction. It is recorded along a
known direction (column `force`, or one force for the whole run), or by components (columns `force_x`, `force_y`, `force_z`).
**It is not the weight of a part that only stands on the table:** that one loads the joints below it and not the tool.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array, Block, Comment, Machine, Stop
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.displacements import recorded
from elastogeo.observe.procedure import Procedure, change_of_level, ordered
from elastogeo.observe.programs import Pose, movable, pose_blocks
from elastogeo.observe.run import Run

COMPONENTS = ("force_x", "force_y", "force_z")
"""Columns [N] of a force that is recorded by components, along the axes of the frame in which directions are given."""

_STANDING = 1e-6
"""Positions [mm, rad] of one run may differ by this much: it is to stand still."""


def axes_along(direction: Direction) -> str:
    """Letters of the axes along which a direction has a component."""
    return "".join(axis for axis, part in zip("XYZ", direction, strict=True) if part)


def force_columns(direction: Direction | None) -> tuple[str, ...]:
    """Columns that say the force of every reading: along a known direction, or by components if there is none."""
    return COMPONENTS if direction is None else ("force",)


def force_vectors(run: Run, direction: Direction | None, count: int, level: float | None) -> Array:
    """Force on the tool at every reading, shape (count, 3) [N], along the axes in which the direction is given.

    Parameters
    ----------
    run : Run
    direction : 3-vector or None
        Of the force; None if it is recorded by components.
    count : int
        Of the readings.
    level : float or None [N]
        Force of the whole run, for a run without a column `force`.

    Raises
    ------
    InputError
        If the force is not known, or is no finite number at some reading.
    """
    if direction is None:
        force = np.column_stack([recorded(run, COMPONENTS)[name] for name in COMPONENTS])
    else:
        size = run.columns.get("force", level)
        if size is None:
            raise InputError(f"run {run.name!r} has no force: record a column force_N, or give force_N for the whole run")
        force = np.outer(np.broadcast_to(size, count), unit_vector(direction, "the direction of the force"))
    wrong = np.flatnonzero(~np.isfinite(force).all(axis=1))
    if len(wrong):
        raise InputError(f"run {run.name!r}: the force of reading {wrong[0] + 1} is no finite number; take the reading out")
    return np.asarray(force)


def force_sizes(force: Array, direction: Direction | None) -> Array:
    """Signed size of a force, shape (m,) [N], along its direction; its length if it has no known one."""
    if direction is None:
        return np.asarray(np.linalg.norm(force, axis=1))
    return np.asarray(force @ unit_vector(direction, "the direction of the force"))


def force_level(sizes: Array, level: float | None) -> float:
    """Force level [N] of a run: as given, else the force of greatest size, with its sign."""
    return level if level is not None else float(sizes[np.argmax(np.abs(sizes))])


def static_commands(machine: Machine, run: Run, pose: Mapping[str, float]) -> dict[str, float]:
    """Axis commands at which a run stands [mm, rad]: columns named as an axis (`x`, `c`) go before the set-up's pose.

    Raises
    ------
    InputError
        If the machine moves within the run.
    """
    for axis in pose:
        machine.index(axis)
    commands = dict(pose)
    for axis in machine.axes:
        position = run.columns.get(axis.lower())
        if position is None or not len(position):
            continue
        if not np.isfinite(position).all():
            raise InputError(f"run {run.name!r}: a position of axis {axis} is no finite number; take the reading out")
        if np.ptp(position) > _STANDING:
            raise InputError(
                f"run {run.name!r}: axis {axis} moves by {np.ptp(position):.4g} (mm or rad); a static test stands "
                f"still: make a run of each place"
            )
        commands[axis] = float(position[0])
    return commands


def commands_row(machine: Machine, commands: Mapping[str, float]) -> Array:
    """Axis commands as one row, shape (1, n) [mm, rad]; an axis not named is at zero."""
    return np.array([[commands.get(axis, 0.0) for axis in machine.axes]])


def with_lever(force: Array, lever: Array) -> Array:
    """Wrench at the functional point, shape (m, 6) [N, N mm], of a force, shape (m, 3), that acts at a lever from it."""
    return np.asfortranarray(np.hstack([force, np.cross(lever, force)]))


def planned(machine: Machine, run: Run, direction: Direction | None, *, ramp: bool) -> dict[str, Array]:
    """The columns of a run that is to be simulated: places and forces as they stand, without readings.

    Where a run has no column of its force, one turn of its column `angle` is a loading cycle from zero to the run's force
    and back, or (if it is no ramp) every angle is a reading at this force.

    Raises
    ------
    InputError
        If there is neither a force nor a force level.
    """
    known = {"force", *COMPONENTS, *(axis.lower() for axis in machine.axes)}
    columns = {name: np.asarray(values) for name, values in run.columns.items() if name in known}
    if "angle" in run.columns and not {"force", *COMPONENTS} & set(columns):
        if run.force is None or direction is None:
            raise InputError(
                f"run {run.name!r} cannot be simulated: it has no force; give force_N for the whole run and a direction, "
                f"or a column of its force"
            )
        angle = np.asarray(run.columns["angle"])
        columns["force"] = run.force * ((1 - np.cos(angle)) / 2 if ramp else np.ones_like(angle))
    return columns


def static_program(
    machine: Machine, runs: Sequence[Run], pose: Mapping[str, float], title: str, procedure: Procedure
) -> list[Block]:
    """The blocks that take the machine to the poses of a static test, and stop there for every run."""
    blocks: list[Block] = [
        Comment(title),
        Comment("work offset: every axis zero where the machine file counts from"),
        Stop("spindle locked, way free"),
    ]
    poses: list[Pose] = []
    last: Run | None = None
    for run in ordered(runs, procedure.order):
        change = change_of_level(run, last)
        for place in places_of(machine, run, pose):
            moved = bool(poses) and dict(poses[-1].to) != place
            there = f"{change}; read run {run.name}" if change else f"read run {run.name}"
            poses.append(Pose(place, "take load and sensors off" if moved else "", there, f"run {run.name}"))
        last = run
    return [*blocks, *pose_blocks(machine, poses, procedure)]


def places_of(machine: Machine, run: Run, pose: Mapping[str, float]) -> list[dict[str, float]]:
    """Commands of every axis at each place at which a run is read, in order."""
    named = movable(machine)
    columns = {axis: np.asarray(run.columns[axis.lower()]) for axis in named if axis.lower() in run.columns}
    count = max((len(values) for values in columns.values()), default=1)
    table = np.column_stack([columns.get(axis, np.full(count, pose.get(axis, 0.0))) for axis in named])
    apart = np.flatnonzero((np.abs(np.diff(table, axis=0)) > _STANDING).any(axis=1)) + 1
    return [dict(zip(named, map(float, table[k]), strict=True)) for k in (0, *apart)]
