"""What a machine and an instrument allow of a program: travel, feed, radius of an arc, length of the tool."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from math import degrees, inf

import numpy as np

from elastogeo.errors import PathError
from elastogeo.machine.machine import Machine
from elastogeo.machine.programs.blocks import PLANE_AXES, Arc, Block, Line, Rapid
from elastogeo.machine.programs.motion import ARC, RAPID, check_moves
from elastogeo.machine.programs.packed import PROGRAM_AXES
from elastogeo.machine.programs.program import Program
from elastogeo.machine.quantity import Feed, Length

_STAYS = 1e-10
_TOUCH = 1e-6


@dataclass(frozen=True, slots=True)
class ProgramLimits:
    """What a program must keep beside the travel of the axes, which the machine says.

    Attributes
    ----------
    most_feed : float [mm/s]
        Greatest along the linear axes.
    least_radius, most_radius : float [mm]
        Of an arc.
    least_tool, most_tool : float [mm]
        Length of the tool: from the last carriage to the functional point, along Z.
    """

    most_feed: Feed = inf
    least_radius: Length = 0.0
    most_radius: Length = inf
    least_tool: Length = 0.0
    most_tool: Length = inf


def check_limits(program: Program, machine: Machine, limits: ProgramLimits | None = None) -> Program:
    """The same program, if the machine can make it.

    Raises
    ------
    PathError
        With the axis (or feed, or radius), its value and its limit.
    """
    moves = check_moves(program.moves(), None, program.lines)
    for axis, (low, high) in program.extent().items():
        if axis not in machine.axes:
            continue
        least, most = machine.joints[machine.index(axis)].travel
        if low < least - _TOUCH or high > most + _TOUCH:
            unit, scale = ("deg", degrees(1.0)) if axis in "ABC" else ("mm", 1.0)
            raise PathError(
                f"program {program.name!r} moves {axis} from {low * scale:.6g} to {high * scale:.6g} {unit}, its travel is "
                f"{least * scale:.6g} to {most * scale:.6g} {unit}; move the test, or correct the machine file"
            )
    if limits is None:
        return program
    fed = moves.kind != RAPID
    linear = np.linalg.norm((moves.end - moves.start)[:, :6], axis=1) > 0
    fastest = float(moves.feed[fed & (linear | (moves.kind == ARC))].max(initial=0.0))
    if fastest > limits.most_feed:
        raise PathError(
            f"program {program.name!r} has a feed of {60 * fastest:.6g} mm/min, the limit is "
            f"{60 * limits.most_feed:.6g} mm/min; choose a slower feed"
        )
    arcs = moves.at(np.flatnonzero(moves.kind == ARC))
    radius = np.linalg.norm(np.take_along_axis(arcs.start, arcs.columns, axis=1) - arcs.centre, axis=1)
    for wrong in (radius.min(initial=inf), radius.max(initial=0.0)):
        if len(radius) and not limits.least_radius - _TOUCH <= wrong <= limits.most_radius + _TOUCH:
            raise PathError(
                f"program {program.name!r} has an arc of radius {wrong:.6g} mm, the limits are {limits.least_radius:.6g} "
                f"and {limits.most_radius:.6g} mm; choose a bar that fits"
            )
    return program


def check_tool(tool: tuple[float, float, float], limits: ProgramLimits) -> None:
    """Refuse a tool that is too short or too long.

    Raises
    ------
    PathError
        With its length and the limit.
    """
    length = abs(tool[2])
    if not limits.least_tool <= length <= limits.most_tool:
        raise PathError(
            f"the tool point is {length:.6g} mm from the last carriage along Z, the limits of the tool are "
            f"{limits.least_tool:.6g} and {limits.most_tool:.6g} mm; choose another tool"
        )


def only_moving(blocks: Iterable[Block]) -> Iterator[Block]:
    """Blocks that name no axis that stays, except the two of an arc's plane."""
    at: dict[str, float] = {}
    for block in blocks:
        if not isinstance(block, Rapid | Line | Arc):
            yield block
            continue
        kept = PLANE_AXES[block.plane] if isinstance(block, Arc) else ()
        moving = {
            axis: value
            for axis, value in block.to.items()
            if axis in kept or axis not in at or abs(value - at[axis]) > _STAYS
        }
        at |= moving
        if moving:
            yield replace(block, to={axis: moving[axis] for axis in PROGRAM_AXES if axis in moving})
