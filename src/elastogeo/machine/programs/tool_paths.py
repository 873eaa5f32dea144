"""The path of a program as a tool path."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from elastogeo.errors import PathError
from elastogeo.estimate import Array
from elastogeo.machine.machine import Machine
from elastogeo.machine.programs.packed import RAPID
from elastogeo.machine.programs.program import Program
from elastogeo.machine.tool_path import UP, ToolPath, check_travel, points_at


def path_of_program(
    program: Program, machine: Machine, step: float, zero: Mapping[str, float] | None = None, tool: Array | None = None
) -> ToolPath:
    """The path of an NC program: it cuts on lines and arcs; rapid moves only lead from one to the next.

    Parameters
    ----------
    program : Program
    machine : Machine
    step : float [mm]
        Greatest distance of two points along a block.
    zero : mapping of str to float [mm, rad], optional
        Axis commands where the program says 0, the zero offset (G54); an axis that is not named has none.
    tool : array, shape (3,) [mm], optional
        Tip of the tool in the last tool-branch frame, if not the machine's own.

    Raises
    ------
    MachineError, PathError
        If the machine cannot make it, or it makes no line and no arc.
    """
    made = program.path(machine, step)
    if not len(made):
        raise PathError(f"program {program.name!r} moves nothing at a feed; give one with lines or arcs")
    commands = made.commands
    for axis, offset in (zero or {}).items():
        commands[:, machine.index(axis)] += offset
    check_travel(machine, commands, program.name)
    tip = np.asarray(machine.tool if tool is None else tool, dtype=float)
    steps = np.append(0.0, np.linalg.norm(np.diff(points_at(machine, commands, tip), axis=0), axis=1))
    rapid = np.cumsum(program.packed.kind == RAPID)[made.block]
    steps[1:][np.diff(rapid) != 0] = 0.0
    cutting = np.ones(len(made), dtype=bool)
    return ToolPath(machine, commands, made.velocity, steps, made.block, cutting, True, tip, np.array(UP), program.name)
