"""What packed blocks move: where every move begins and ends, how long it is and takes, points along it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.errors import MachineError, PathError
from elastogeo.estimate import Array
from elastogeo.machine.machine import Machine
from elastogeo.machine.programs.packed import ARC, LINE, OTHER, PROGRAM_AXES, RAPID, Counts, PackedBlocks, Small

SAME_POINT = 1e-7
"""Distance [mm] of start and end of an arc up to which it is a full circle."""

LINEAR_AXES = 6
"""The first so many of `PROGRAM_AXES` are linear, the others rotary."""

_PLANE_COLUMNS = np.array([[0, 1], [1, 2], [2, 0]])

Rows = np.ndarray[tuple[int], np.dtype[np.intp]]


@dataclass(frozen=True, slots=True, eq=False)
class MovesOf:
    """Moves of a program, one row a move, all axes absolute; dwells stand beside them as `pause`.

    Attributes
    ----------
    block : array of int, shape (k,)
        The place of each move in the program.
    kind : array of int, shape (k,)
        `RAPID`, `LINE` or `ARC`.
    start, end : array, shape (k, 9) [mm, rad]
        Commands of `PROGRAM_AXES`.
    feed : array, shape (k,) [mm/s or rad/s]
    columns : array of int, shape (k, 2)
        Of an arc, the columns of its plane.
    centre : array, shape (k, 2) [mm]
    sweep : array, shape (k,) [rad]
        Of an arc, signed; zero for others.
    length : array, shape (k,) [mm or rad]
        What the feed counts along: of the linear axes, or of the rotary ones where these alone move.
    pause : array, shape (k,) [s]
        For which the machine stands still before the move.
    """

    block: Rows
    kind: Small
    start: Array
    end: Array
    feed: Array
    columns: Rows
    centre: Array
    sweep: Array
    length: Array
    pause: Array

    def at(self, part: slice | Rows) -> MovesOf:
        """Some of the moves."""
        return MovesOf(*(getattr(self, name)[part] for name in self.__slots__))

    @property
    def duration(self) -> Array:
        """Time [s] of each line and arc, shape (k,), without its pause; zero of rapid moves, which is not known."""
        rapid = self.kind == RAPID
        return np.where(rapid | (self.length == 0), 0.0, self.length / np.where(rapid, 1.0, self.feed))

    def extent(self) -> tuple[Array, Array]:
        """Least and greatest command of each axis, shape (9,), where an arc bulges too."""
        if not len(self.block):
            nothing = np.full(len(PROGRAM_AXES), np.nan)
            return nothing, nothing
        low, high = np.minimum(self.start, self.end).min(axis=0), np.maximum(self.start, self.end).max(axis=0)
        arcs = self.at(np.flatnonzero(self.kind == ARC))
        radius, begin = _polar(arcs)[:2]
        for quarter in range(4):
            angle = quarter * np.pi / 2
            ahead = np.remainder((angle - begin) * np.sign(arcs.sweep), 2 * np.pi)
            crossed = ahead <= np.abs(arcs.sweep)
            for side, unit in enumerate((np.cos(angle), np.sin(angle))):
                reach = (arcs.centre[:, side] + radius * unit)[crossed]
                np.minimum.at(low, arcs.columns[crossed, side], reach)
                np.maximum.at(high, arcs.columns[crossed, side], reach)
        return low, high


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ProgramPath:
    """Points along the lines and arcs of a program.

    Attributes
    ----------
    commands : array, shape (m, n) [mm, rad]
        In the order of `machine.axes`.
    velocity : array, shape (m, n) [mm/s, rad/s]
        Their time derivatives.
    block : array of int, shape (m,)
        The block that each point lies on.
    feed : array, shape (m,) [mm/s or rad/s]
    time : array, shape (m,) [s]
        Since the beginning, dwells included; rapid moves take none of it.
    end_time : float [s]
        When the last block is done.
    """

    commands: Array
    velocity: Array
    block: Rows
    feed: Array
    time: Array
    end_time: float

    def __len__(self) -> int:
        return len(self.block)


def moves_of(blocks: PackedBlocks, start: Mapping[str, float]) -> MovesOf:
    """The moves of packed blocks, all axes absolute."""
    row = np.flatnonzero(blocks.kind != OTHER)
    kind, end = blocks.kind[row], _filled(blocks.to[row], start)
    begin = np.vstack([_first(blocks.to[row], start), end[:-1]]) if len(row) else end
    columns = np.asarray(_PLANE_COLUMNS[blocks.plane[row]])
    moves = MovesOf(
        block=row,
        kind=kind,
        start=begin,
        end=end,
        feed=blocks.feed[row],
        columns=columns,
        centre=blocks.centre[row],
        sweep=np.zeros(len(row)),
        length=np.zeros(len(row)),
        pause=_pauses(blocks, row),
    )
    sweep = _sweep(moves, blocks.turns[row])
    return replace(moves, sweep=sweep, length=_length(moves, sweep))


def check_moves(moves: MovesOf, tolerance: float | None, lines: Rows | None) -> MovesOf:
    """The same moves, if every one can be made.

    Raises
    ------
    PathError
        With the first block (and its line) whose numbers are not finite, whose feed is not positive, or whose arc is none.
    """
    arc, fed = moves.kind == ARC, moves.kind != RAPID
    finite = np.isfinite(moves.end).all(axis=1) & (~arc | np.isfinite(moves.centre).all(axis=1))
    _refuse(moves, ~finite, lines, "has a number that is not finite")
    _refuse(moves, fed & ~(moves.feed > 0), lines, "has no positive feed")
    inner, outer = _radii(moves)
    _refuse(moves, arc & ~(np.minimum(inner, outer) > 0), lines, "is an arc of radius zero")
    if tolerance is not None:
        off = np.where(arc, np.abs(outer - inner), 0.0)
        worst = f"is an arc whose end is {off.max(initial=0.0):.4g} mm off its circle, more than {tolerance:g} mm"
        _refuse(moves, off > tolerance, lines, worst)
    return moves


def path_of(moves: MovesOf, machine: Machine, step: float, turn: float, time: float = 0.0) -> ProgramPath:
    """Points along lines and arcs, shape (m, n); no loop over the points of a block.

    Raises
    ------
    MachineError
        If an axis moves that the machine does not have.
    PathError
        If the step is not positive.
    """
    if not (step > 0 and turn > 0):
        raise PathError(f"the step along a path is {step:g} mm and {turn:g} rad, both must be positive")
    _check_axes(moves, machine)
    ready = time + np.cumsum(moves.pause + moves.duration)
    fed = np.flatnonzero(moves.kind != RAPID)
    made = moves.at(fed)
    count = _counts(made, step, turn)
    owner = np.repeat(np.arange(len(fed)), count)
    part = (np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count) + 1) / count[owner]
    commands, rate = _along(made, owner, part)
    duration = made.duration[owner]
    velocity = np.divide(rate, duration[:, np.newaxis], out=np.zeros_like(rate), where=duration[:, np.newaxis] > 0)
    where = [PROGRAM_AXES.index(axis) if axis in PROGRAM_AXES else -1 for axis in machine.axes]
    return ProgramPath(
        commands=_chosen(commands, where),
        velocity=_chosen(velocity, where),
        block=made.block[owner],
        feed=made.feed[owner],
        time=ready[fed][owner] - (1 - part) * duration,
        end_time=float(ready[-1]) if len(ready) else time,
    )


def _filled(to: Array, start: Mapping[str, float]) -> Array:
    """Commands of every axis after each move: where it was commanded last."""
    if not len(to):
        return to
    rows = np.maximum.accumulate(np.where(np.isnan(to), -1, np.arange(len(to))[:, np.newaxis]), axis=0)
    found = np.take_along_axis(to, np.maximum(rows, 0), axis=0)
    return np.where(rows < 0, _first(to, start), found)


def _first(to: Array, start: Mapping[str, float]) -> Array:
    """Where every axis is before the first move, shape (9,): given, else where its first command puts it, else zero."""
    named = ~np.isnan(to)
    first = np.take_along_axis(to, named.argmax(axis=0)[np.newaxis], axis=0)[0] if len(to) else np.zeros(to.shape[1])
    found = np.where(named.any(axis=0), first, 0.0)
    for axis, value in start.items():
        if axis in PROGRAM_AXES:
            found[PROGRAM_AXES.index(axis)] = value
    return found


def _pauses(blocks: PackedBlocks, row: Rows) -> Array:
    """Seconds of the dwells between each move and the one before it; those after the last belong to none."""
    pause = np.zeros(len(row))
    for place, block in blocks.others.items():
        seconds = getattr(block, "seconds", 0.0)
        k = int(np.searchsorted(row, place))
        if seconds and k < len(row):
            pause[k] += seconds
    return pause


def _in_plane(moves: MovesOf, ends: Array) -> Array:
    """From the centre to one end of each arc, shape (k, 2)."""
    return np.take_along_axis(ends, moves.columns, axis=1) - moves.centre


def _radii(moves: MovesOf) -> tuple[Array, Array]:
    begin, end = (np.asarray(np.linalg.norm(_in_plane(moves, ends), axis=1)) for ends in (moves.start, moves.end))
    return begin, end


def _polar(moves: MovesOf) -> tuple[Array, Array, Array]:
    """Radius and angle at the start of each arc, and its radius at the end."""
    begin = _in_plane(moves, moves.start)
    inner, outer = _radii(moves)
    return inner, np.arctan2(begin[:, 1], begin[:, 0]), outer


def _sweep(moves: MovesOf, turns: Counts) -> Array:
    """Signed angle [rad] of each arc, zero of others."""
    begin, end = _in_plane(moves, moves.start), _in_plane(moves, moves.end)
    sense = np.sign(turns)
    cross, dot = begin[:, 0] * end[:, 1] - begin[:, 1] * end[:, 0], np.sum(begin * end, axis=1)
    part = np.remainder(np.arctan2(cross, dot) * sense, 2 * np.pi)
    closed = np.linalg.norm(end - begin, axis=1) <= SAME_POINT
    sweep = sense * (np.where(closed, 2 * np.pi, part) + 2 * np.pi * (np.abs(turns) - 1))
    return np.where(moves.kind == ARC, sweep, 0.0)


def _length(moves: MovesOf, sweep: Array) -> Array:
    move = moves.end - moves.start
    arc = moves.kind == ARC
    inner, outer = _radii(moves)
    planar = (inner + outer) / 2 * np.abs(sweep)
    for_arc = move[:, :LINEAR_AXES].copy()
    rows = np.flatnonzero(arc)
    for side in (0, 1):
        for_arc[rows, moves.columns[rows, side]] = 0.0
    linear = np.where(arc, np.hypot(planar, np.linalg.norm(for_arc, axis=1)), np.linalg.norm(move[:, :LINEAR_AXES], axis=1))
    return np.asarray(np.where(linear > 0, linear, np.linalg.norm(move[:, LINEAR_AXES:], axis=1)))


def _counts(moves: MovesOf, step: float, turn: float) -> Rows:
    """How many points each move gets, shape (k,): its end at least."""
    rotary = np.abs(moves.end - moves.start)[:, LINEAR_AXES:].max(axis=1, initial=0.0)
    linear = (moves.end - moves.start)[:, :LINEAR_AXES].any(axis=1) | (moves.kind == ARC)
    need = np.maximum(np.where(linear, moves.length / step, 0.0), rotary / turn)
    return np.asarray(np.maximum(np.ceil(need - 1e-9), 1), dtype=np.intp)


def _along(moves: MovesOf, owner: Rows, part: Array) -> tuple[Array, Array]:
    """Commands, shape (m, 9), at parts of their moves, and how they change per part."""
    rate = (moves.end - moves.start)[owner]
    commands = moves.start[owner] + part[:, np.newaxis] * rate
    last = part == 1.0
    commands[last] = moves.end[owner[last]]
    point = np.flatnonzero(moves.kind[owner] == ARC)
    if len(point):
        arcs, share = owner[point], part[point]
        inner, begin, outer = (one[arcs] for one in _polar(moves))
        angle, radius = begin + share * moves.sweep[arcs], inner + share * (outer - inner)
        unit, normal = np.stack([np.cos(angle), np.sin(angle)]), np.stack([-np.sin(angle), np.cos(angle)])
        place = moves.centre[arcs].T + radius * unit
        change = (outer - inner) * unit + radius * moves.sweep[arcs] * normal
        inside = share < 1.0
        for side in (0, 1):
            column = moves.columns[arcs, side]
            commands[point[inside], column[inside]] = place[side, inside]
            rate[point, column] = change[side]
    return commands, rate


def _chosen(values: Array, where: list[int]) -> Array:
    """The columns of a machine's axes, zero for one that no program moves (a spindle)."""
    padded = np.column_stack([values, np.zeros(len(values))])
    return np.asarray(padded[:, where])


def _check_axes(moves: MovesOf, machine: Machine) -> None:
    moved = (moves.end != moves.end[:1]).any(axis=0) | (moves.end[:1] != 0).any(axis=0)
    missing = [axis for axis, moves_it in zip(PROGRAM_AXES, moved, strict=True) if moves_it and axis not in machine.axes]
    if missing:
        raise MachineError(
            f"machine {machine.name!r} ({machine.topology.compact}) has no axis {', '.join(missing)}, which "
            "the program moves"
        )


def _refuse(moves: MovesOf, wrong: Array | np.ndarray[tuple[int], np.dtype[np.bool_]], lines: Rows | None, why: str) -> None:
    first = np.flatnonzero(wrong)
    if not len(first):
        return
    block = int(moves.block[first[0]])
    where = f"block {block + 1}" if lines is None else f"line {int(lines[block])}"
    more = f" ({len(first)} blocks in all)" if len(first) > 1 else ""
    raise PathError(f"{where} of the program {why}{more}; correct it")


__all__ = ["ARC", "LINE", "RAPID", "MovesOf", "ProgramPath", "Rows", "check_moves", "moves_of", "path_of"]
