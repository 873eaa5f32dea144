"""A program whose points are moved: lines between as few of them as a tolerance allows, everything else as it was."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from elastogeo.machine import Arc, Array, Block, Line, Machine, Program, Rapid, ToolPath, path_of_program

LEVER = 300.0
"""Distance [mm] at which a turn of a rotary axis counts against the tolerance."""

SAGITTA = 0.25
"""Share of the tolerance that the points of an arc may lie inside of it."""

_SAME = 1e-9
_SLOW = 1e-6
"""Of the greatest velocity: enough to say from which side an axis came, too little to turn the path."""

Rows = np.ndarray[tuple[int], np.dtype[np.intp]]


def with_starts(program: Program) -> Program:
    """The program with a point at the end of every rapid move: where a cut begins."""
    blocks: list[Block] = []
    feed = next((block.feed for block in program.blocks if isinstance(block, Line | Arc)), 1.0)
    for block in program.blocks:
        blocks.append(block)
        if isinstance(block, Rapid):
            blocks.append(Line({}, feed))
    return Program(program.name, blocks, notes=program.notes)


def fine_path(
    program: Program, machine: Machine, step: float, tolerance: float, zero: Mapping[str, float] | None
) -> ToolPath:
    """The path of a program at points so close that an arc between two leaves its chord by a part of the tolerance."""
    moves = program.moves()
    radius = np.linalg.norm(np.take_along_axis(moves.start, moves.columns, axis=1) - moves.centre, axis=1)
    arcs = radius[moves.sweep != 0]
    if len(arcs):
        step = min(step, float(np.sqrt(8 * arcs.min() * SAGITTA * tolerance)))
    return _beginning(path_of_program(program, machine, step, zero))


def _beginning(path: ToolPath) -> ToolPath:
    """The path whose cuts begin as they go on: along the first chord, an axis that stands there as its rapid move had it."""
    starts = np.flatnonzero(~path.velocity[:-1].any(axis=1))
    velocity = path.velocity.copy()
    came = np.sign(path.commands[starts] - path.commands[np.maximum(starts - 1, 0)])
    ahead = velocity[starts + 1]
    velocity[starts] = np.where(ahead != 0, ahead, came * _SLOW * np.abs(velocity).max(axis=0))
    return replace(path, velocity=velocity)


def corrected_program(
    program: Program, path: ToolPath, commands: Array, zero: Mapping[str, float], tolerance: float
) -> tuple[Program, Array]:
    """The program through other commands, and the commands that it really makes at the points of the path.

    Parameters
    ----------
    program : Program
        As of `with_starts`, which the path is of.
    path : ToolPath
        Of m points.
    commands : array, shape (m, n) [mm, rad]
        Where the machine is to go at each of them.
    zero : mapping of str to float [mm, rad]
        Axis commands at the zero of the program.
    tolerance : float [mm]
        By which lines may leave the commands.
    """
    machine = path.machine
    moved = np.abs(commands - path.commands).max(axis=0) > _SAME
    axes = [axis for k, axis in enumerate(machine.axes) if axis in program.axes or moved[k]]
    shift = np.array([zero.get(axis, 0.0) for axis in machine.axes])
    weight = np.array([LEVER if joint.is_rotary else 1.0 for joint in machine.joints])
    made = np.array(commands)
    ends = np.flatnonzero(np.diff(path.block, append=-1))
    last_of = dict(zip(path.block[ends].tolist(), ends.tolist(), strict=True))
    first_of = {int(path.block[end]): start for start, end in zip(np.append(0, ends[:-1] + 1), ends, strict=True)}
    blocks: list[Block] = []
    before: int | None = None
    for k, block in enumerate(program.blocks):
        if k not in last_of or isinstance(block, Rapid):
            blocks.append(block)
            before = None if isinstance(block, Rapid) else before
            continue
        rows = np.arange(first_of[k], last_of[k] + 1)
        rows = rows if before is None else np.append(before, rows)
        kept = _kept(commands[rows] * weight, tolerance)
        made[rows] = _between(commands[rows], kept)
        feed = block.feed if isinstance(block, Line | Arc) else 1.0
        for row in rows[kept if before is None else kept[1:]]:
            where = dict(zip(machine.axes, (commands[row] - shift).tolist(), strict=True))
            blocks.append(Line({axis: where[axis] for axis in axes}, feed))
        before = int(rows[-1])
    return replace(program, blocks=blocks, notes=(*program.notes, "compensated")), made


def _kept(points: Array, tolerance: float) -> Rows:
    """Which points lines must go through so that no other is farther than the tolerance from its place on them."""
    chosen = np.zeros(len(points), dtype=bool)
    chosen[[0, -1]] = True
    open_parts = [(0, len(points) - 1)]
    while open_parts:
        low, high = open_parts.pop()
        if high - low < 2:
            continue
        share = (np.arange(low + 1, high) - low)[:, np.newaxis] / (high - low)
        off = np.linalg.norm(points[low + 1 : high] - points[low] - share * (points[high] - points[low]), axis=1)
        worst = int(off.argmax())
        if off[worst] > tolerance:
            middle = low + 1 + worst
            chosen[middle] = True
            open_parts += [(low, middle), (middle, high)]
    return np.flatnonzero(chosen)


def _between(points: Array, kept: Rows) -> Array:
    rows = np.arange(len(points))
    return np.column_stack([np.interp(rows, kept, column[kept]) for column in points.T])
