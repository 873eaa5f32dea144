"""Rotary axes go from pose to pose while the linear axes keep the tool where it is on the workpiece."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import PROGRAM_AXES, Array, Block, Comment, Dwell, Line, Machine, Motion, Stop, follow
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.programs.poses import approach, axis_words, movable, retreat

Counts = np.ndarray[tuple[int], np.dtype[np.intp]]

_SAMPLES = 6
"""Points of a move between two poses from which its bend is estimated."""

_TURN = np.radians(1.0)
"""Greatest turn of a line."""

_STAYS = 1e-12


@dataclass(frozen=True, slots=True)
class FollowedRun:
    """One run: where its rotary axes are, pose after pose.

    Attributes
    ----------
    name : str
    rotary : mapping of str to array, shape (m,) [rad]
        Commands of the rotary axes that move.
    change : str
        What the operator sets before it, in words; empty for nothing.
    halts : bool
        Whether every pose is read at standstill.
    """

    name: str
    rotary: Mapping[str, Array]
    change: str = ""
    halts: bool = True


@dataclass(frozen=True, slots=True)
class Followed:
    """A test in which the linear axes follow.

    Attributes
    ----------
    machine : Machine
    centre : mapping of str to float [mm, rad]
        Axis commands at which the tool is where it then stays on the workpiece.
    tool : array, shape (3,) [mm], or None
        As of `machine.follow`.
    title : str
        Of the instrument, for the operator.
    put_in : str
        What the operator does at the first pose, in words.
    """

    machine: Machine
    centre: Mapping[str, float]
    tool: Array | None
    title: str
    put_in: str


def following_blocks(test: Followed, runs: Sequence[FollowedRun], procedure: Procedure) -> list[Block]:
    """The blocks of all runs, one after the other; from the end of one to the beginning of the next the axes follow too.

    Raises
    ------
    PathError
        If the linear axes cannot follow, or an axis would leave its travel.
    """
    axes = list(dict.fromkeys(axis for run in runs for axis in run.rotary))
    at = {axis: test.centre.get(axis, 0.0) for axis in movable(test.machine)}
    first = _commands(test, axes, _poses(test, axes, runs[0])[:1])[0]
    blocks: list[Block] = [
        Comment(f"{test.title}; tool and workpiece meet where {axis_words(at)}"),
        Comment("work offset: every axis zero where the machine file counts from"),
        Stop("spindle locked, way free, tool clear of the workpiece"),
        *approach(test.machine, first, procedure),
        Stop(test.put_in),
    ]
    last: Array | None = None
    for run in runs:
        poses = _poses(test, axes, run)
        blocks.append(Comment(f"run {run.name}"))
        if last is not None:
            blocks += _moves(test, axes, np.vstack([last, poses[:1]]), procedure, halts=False)
        if run.change:
            blocks.append(Stop(run.change) if procedure.change is None else Comment(run.change))
            blocks += [Dwell(procedure.change)] if procedure.change else []
        blocks += [Dwell(procedure.dwell)] if run.halts else []
        blocks += _moves(test, axes, poses, procedure, halts=run.halts)
        last = poses[-1]
    assert last is not None
    end = _commands(test, axes, last[np.newaxis])[0]
    return [*blocks, Stop("take the instrument out"), *retreat(test.machine, end, procedure)]


def _poses(test: Followed, axes: Sequence[str], run: FollowedRun) -> Array:
    """Commands of the rotary axes that any run moves, shape (m, k) [rad]."""
    count = max((len(values) for values in run.rotary.values()), default=1)
    still = {axis: np.full(count, test.centre.get(axis, 0.0)) for axis in axes}
    return np.column_stack([{**still, **run.rotary}[axis] for axis in axes]) if axes else np.zeros((count, 0))


def _moves(test: Followed, axes: Sequence[str], poses: Array, procedure: Procedure, *, halts: bool) -> Iterator[Block]:
    """From each pose to the next, by lines that leave the path by no more than the procedure allows."""
    turned = np.abs(np.diff(poses, axis=0)).max(axis=1, initial=0.0)
    moves = np.flatnonzero(turned > _STAYS)
    if not len(moves):
        yield from (Dwell(procedure.dwell) for _ in turned if halts)
        return
    counts: Counts = np.zeros(len(turned), dtype=np.intp)
    coarse = _between(poses, np.asarray(np.where(turned > _STAYS, _SAMPLES, 0), dtype=np.intp))
    linear = _positions(test, axes, coarse)[:, _linear(test.machine)].reshape(len(moves), _SAMPLES, -1)
    start = _positions(test, axes, poses[moves])[:, _linear(test.machine)]
    bends = np.diff(np.concatenate([start[:, np.newaxis], linear], axis=1), n=2, axis=1)
    bend = np.linalg.norm(bends, axis=2).max(axis=1) * _SAMPLES**2
    need = np.maximum(np.sqrt(bend / (8 * procedure.between)), turned[moves] / _TURN)
    counts[moves] = np.maximum(np.ceil(need), 1)
    fine = _between(poses, counts)
    commands = _commands(test, axes, fine)
    places = np.vstack([_positions(test, axes, poses[:1]), _positions(test, axes, fine)])
    feeds = _feeds(test.machine, places, procedure)
    row = 0
    for count in counts.tolist():
        for _ in range(count):
            yield Line(commands[row], feeds[row])
            row += 1
        if halts:
            yield Dwell(procedure.dwell)


def _between(poses: Array, counts: Counts) -> Array:
    """Poses between each and the next, so many to each, its end the last."""
    owner = np.repeat(np.arange(len(counts)), counts)
    part = (np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts) + 1) / counts[owner]
    return np.asarray(poses[owner] + part[:, np.newaxis] * (poses[owner + 1] - poses[owner]))


def _feeds(machine: Machine, places: Array, procedure: Procedure) -> list[float]:
    """Feed of each line: as fast as the procedure lets linear and rotary axes go."""
    steps = np.diff(places, axis=0)
    linear = _linear(machine)
    length = np.linalg.norm(steps[:, linear], axis=1)
    turned = np.linalg.norm(np.delete(steps, linear, axis=1), axis=1)
    time = np.maximum(length / procedure.feed, turned / procedure.rotary_feed)
    moved = np.where(length > 0, length, turned)
    return list(np.divide(moved, time, out=np.full(len(time), procedure.feed), where=time > 0))


def _linear(machine: Machine) -> list[int]:
    return [k for k, axis in enumerate(machine.axes) if axis in "XYZUVW"]


def _positions(test: Followed, axes: Sequence[str], poses: Array) -> Array:
    still = np.zeros((len(poses), 3))
    motion = Motion(still, still, still, dict(zip(axes, poses.T, strict=True)), dict.fromkeys(axes, 0.0))
    return follow(test.machine, test.centre, motion, test.tool).position


def _commands(test: Followed, axes: Sequence[str], poses: Array) -> list[dict[str, float]]:
    """Commands of every axis at poses."""
    if not len(poses):
        return []
    named = [(axis, k) for k, axis in enumerate(test.machine.axes) if axis in PROGRAM_AXES]
    return [{axis: float(row[k]) for axis, k in named} for row in _positions(test, axes, poses)]
