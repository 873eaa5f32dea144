"""Path files: columns of axis commands or of tool points, and what a dynamometer recorded along a path.

A path has a row for each point: axis commands (`command_x_mm`, `command_c_deg`; an axis without a column stays), or tool
points from the zero of the workpiece along the axes of its frame (`x_mm`, `y_mm`, `z_mm`, with `a_deg`, `b_deg`, `c_deg` for
rotary axes that move). Besides: `feed_mm_min`, `block`, `cutting` (1 or 0), and the force on the tool, `force_x_N`,
`force_y_N`, `force_z_N`. A record of forces has these columns of force, and `way_mm`, `time_s` or none: then a row a point.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

import numpy as np

from elastogeo.errors import InputError
from elastogeo.formats.program_files import flavours, read_program_bytes
from elastogeo.formats.run_files import opened_run, read_run_bytes, run_formats
from elastogeo.formats.text.by_content import claiming, format_of
from elastogeo.formats.text.table import Table
from elastogeo.formats.unread import unread
from elastogeo.machine import (
    Array,
    Directions,
    Machine,
    MeasuredForce,
    ToolPath,
    path_of_commands,
    path_of_points,
    path_of_program,
)

_COMMANDS = ("command_", "position_")
_FORCES = ("force_x", "force_y", "force_z")
_KNOWN = (*"xyzabc", "feed", "block", "cutting", "way", "time", *_FORCES)

_OF_A_PATH = (
    "a path has axis commands (command_x_mm, command_c_deg) or tool points (x_mm, y_mm, z_mm, c_deg), and feed_mm_min, "
    "block, cutting, force_x_N, force_y_N, force_z_N"
)
"""What the columns of a path are, for messages."""

_OF_FORCES = "forces are columns force_x_N, force_y_N, force_z_N, beside way_mm or time_s, or one row a point of the path"
_NO_TABLE = "no table whose columns say what they are"

STEP = 1.0
"""Distance [mm] of two points along a block of a program, unless another is asked for."""


def read_path(
    file: str | Path,
    machine: Machine,
    zero: Mapping[str, float] | None = None,
    feed: float | None = None,
    step: float = STEP,
) -> ToolPath:
    """Read a tool path: an NC program, or a table, told from the content.

    Parameters
    ----------
    file : str or Path
        A program in any known language of controls; a table of axis commands or of tool points in any format of run files.
    machine : Machine
    zero : mapping of str to float [mm, rad], optional
        Of a program, its zero offset (G54); of tool points, the axis commands at the zero of the workpiece; of axis
        commands, where axes without a column stay.
    feed : float [mm/s], optional
        Where a table says none.
    step : float [mm]
        Greatest distance of two points along a block of a program.

    Raises
    ------
    FormatError
        If the file cannot be read.
    InputError
        If it holds no path, or the machine cannot make it.
    """
    data, number = opened_run(file)
    if number is None and claiming(flavours(), data) and not claiming(run_formats(), data):
        return path_of_program(read_program_bytes(data, str(file)), machine, step, zero)
    table = _table(data, str(file), number, f"no NC program, and {_NO_TABLE}; {_OF_A_PATH}")
    return path_of_table(table, machine, zero, feed)


def read_forces(
    file: str | Path,
    along: Directions = "workpiece",
    on: Literal["tool", "workpiece"] = "tool",
    relative_uncertainty: float = 0.0,
) -> MeasuredForce:
    """Read the forces that a dynamometer recorded along a path: see `force_of_table`.

    Raises
    ------
    FormatError
        If the file cannot be read.
    InputError
        If it holds no force.
    """
    data, number = opened_run(file)
    table = _table(data, str(file), number, f"{_NO_TABLE}; {_OF_FORCES}")
    return force_of_table(table, along, on, relative_uncertainty)


def path_of_table(
    table: Table, machine: Machine, zero: Mapping[str, float] | None = None, feed: float | None = None
) -> ToolPath:
    """The path that a table holds.

    Parameters
    ----------
    table : Table
    machine : Machine
    zero : mapping of str to float [mm, rad], optional
        Of tool points, the axis commands at the zero of the workpiece; of axis commands, where axes without a column stay.
    feed : float [mm/s], optional
        Where the table says none.

    Raises
    ------
    InputError
        If it holds no path, or a column is none of a path.
    """
    columns = table.columns
    _check(table)
    feeds = columns.get("feed", feed)
    block = _whole(table, "block")
    cutting = None if "cutting" not in columns else columns["cutting"] != 0
    commanded = {
        name[-1].upper(): name for name in columns if name.startswith(_COMMANDS) and len(name.rpartition("_")[2]) == 1
    }
    if commanded:
        commands = np.zeros((table.rows, len(machine.axes)))
        for axis, place in (zero or {}).items():
            commands[:, machine.index(axis)] = place
        for axis, name in commanded.items():
            commands[:, machine.index(axis)] = columns[name]
        return path_of_commands(machine, commands, feeds, block, cutting, name=table.source)
    points = np.column_stack([columns.get(letter, np.zeros(table.rows)) for letter in "xyz"])
    rotary = {letter.upper(): columns[letter] for letter in "abc" if letter in columns}
    return path_of_points(machine, points, zero, rotary, feeds, block, cutting, name=table.source)


def force_of_table(
    table: Table,
    along: Directions = "workpiece",
    on: Literal["tool", "workpiece"] = "tool",
    relative_uncertainty: float = 0.0,
) -> MeasuredForce:
    """The forces that a table holds.

    Parameters
    ----------
    table : Table
    along : str
        Directions in which they count: the workpiece's, the machine's, the path's.
    on : {"tool", "workpiece"}
        What the dynamometer holds.
    relative_uncertainty : float

    Raises
    ------
    InputError
        If it holds no force.
    """
    present = [name for name in _FORCES if name in table.columns]
    if not present:
        raise InputError(f"{table.source}: has no column of forces but {', '.join(table.columns)}; {_OF_FORCES}")
    force = np.column_stack([table.columns.get(name, np.zeros(table.rows)) for name in _FORCES])
    for name in ("way", "time"):
        if name in table.columns:
            counts: Literal["way", "time"] = "way" if name == "way" else "time"
            return MeasuredForce(table.columns[name], force, counts, along, on, relative_uncertainty, table.source)
    return MeasuredForce(np.arange(table.rows, dtype=float), force, "point", along, on, relative_uncertainty, table.source)


def _table(data: bytes, source: str, number: int | None, otherwise: str) -> Table:
    """The table in a file of any format of runs; `otherwise` says what a file of none of them is, and what to write."""

    def explained(data: bytes) -> str:
        return unread(data, run=False) or f"begins with {data[:20]!r}, which is {otherwise}"

    return read_run_bytes(data, source, number, claimed=[format_of(run_formats(), data, source, explained)])


def _check(table: Table) -> None:
    unknown = [name for name in table.columns if name not in _KNOWN and not name.startswith(_COMMANDS)]
    moving = [name for name in table.columns if name in "xyzabc" or name.startswith(_COMMANDS)]
    points, commands = [n for n in moving if n in "xyzabc"], [n for n in moving if n.startswith(_COMMANDS)]
    if unknown or not moving:
        what = f"a column {unknown[0]!r}, which no path has" if unknown else "no column of a path"
        raise InputError(f"{table.source}: has {what}; {_OF_A_PATH}")
    if points and commands:
        raise InputError(
            f"{table.source}: has axis commands ({commands[0]}) and tool points ({points[0]}); take one of the two out"
        )


def _whole(table: Table, name: str) -> Array | None:
    if name not in table.columns:
        return None
    values = table.columns[name]
    if (values != np.round(values)).any():
        raise InputError(
            f"{table.source}: the column {name!r} holds {values[values != np.round(values)][0]:g}; count blocks"
        )
    return values
