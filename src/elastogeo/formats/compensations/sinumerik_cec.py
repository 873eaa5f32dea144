"""SINUMERIK sag compensation (CEC): `$AN_CEC`, the correction of one axis by the position of another, or of its own.

Evenly spaced points, (MAX - MIN) / STEP + 1 of them, linear between, by the setpoint of the input axis; all tables of one
output axis add. DIRECTION 0 is both directions, 1 and -1 are travel in + and in -: where the error differs by direction,
there are two tables. Straightness and squareness go so, and positioning that differs by direction.

**No public text says the sign.** A public generator writes what was measured less what should be, as leadscrew error
compensation has it; so does this file, unless `sign=correction` is set. Products of two tables (`MULT_BY_TABLE`: an angle
times a lever) are not written. Load only while MD32710 CEC_ENABLE is 0; then set it, and SD41300 SN_CEC_TABLE_ENABLE[t].
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.compensation_files import (
    SIGN,
    STEP,
    CompensationFormat,
    Files,
    Setting,
    Settings,
    axis_names,
    displacements_only,
    letter_of,
    name_of,
    number,
    register,
    signed,
    step_of,
    whole,
)
from elastogeo.formats.compensation_points import even_points
from elastogeo.machine import LINEAR, ROTARY, Array, ErrorTable, motion_of

_HEAD = "%_N_NC_CEC_INI"
_VALUE = re.compile(r"\$AN_CEC\[(\d+),(\d+)\]=(\S+)")
_FACT = re.compile(r"\$AN_CEC_(\w+)\[(\d+)\]=(\S+)")
_SIDES = {0: (0, 1), 1: (0,), -1: (1,)}
"""Columns of a table by the direction that it is for."""


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:
    """One file for all tables."""
    names, most = axis_names(settings), whole(settings, "tables")
    single = [(table, direction) for table in tables for direction in ((0,) if table.one_sided else (1, -1))]
    if len(single) > most:
        raise InputError(
            f"sag compensation: {len(tables)} errors take {len(single)} tables, and the control has {most}; choose "
            f"fewer, or say tables"
        )
    first = whole(settings, "first")
    parts = [_lines(first + t, table, direction, names, settings) for t, (table, direction) in enumerate(single)]
    lines = [_HEAD, "CHANDATA(1)", *(line for part in parts for line in part), "M17", ""]
    return {"cec.ini": "\n".join(lines).encode()}


def _lines(t: int, table: ErrorTable, direction: int, names: Mapping[str, str], settings: Settings) -> Iterator[str]:
    unit = _unit(table.axis)
    points = even_points(table, whole(settings, "points"), step_of(settings), unit)
    column = _SIDES[direction][0]
    values = signed(settings) * table.at(points / unit)[:, column] * _unit(table.component)
    for k, value in enumerate(values):
        yield f"$AN_CEC[{t},{k}]={value + 0.0:.6f}"
    yield f"$AN_CEC_INPUT_AXIS[{t}]=({name_of(table.axis, names)})"
    yield f"$AN_CEC_OUTPUT_AXIS[{t}]=({name_of(_moved_by(table), names)})"
    yield f"$AN_CEC_STEP[{t}]={points[1] - points[0] if len(points) > 1 else 1.0:.6f}"
    yield f"$AN_CEC_MIN[{t}]={points[0]:.6f}"
    yield f"$AN_CEC_MAX[{t}]={points[-1]:.6f}"
    yield f"$AN_CEC_DIRECTION[{t}]={direction}"
    yield f"$AN_CEC_MULT_BY_TABLE[{t}]=0"
    yield f"$AN_CEC_IS_MODULO[{t}]=0"


def _moved_by(table: ErrorTable) -> str:
    """The axis that makes the error good."""
    return table.axis if table.is_own else table.component


def can_read(head: bytes) -> bool:
    """Whether it begins as such a file does."""
    return head.startswith(_HEAD.encode())


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:
    """The errors that the control compensates."""
    lines = data.decode("ascii", "replace").split("\n")
    if len(lines) < 2 or lines[-2:] != ["M17", ""]:
        raise FormatError(f"{source}: does not end with M17 on a line of its own; it may be cut off, copy it again")
    values: dict[int, dict[int, float]] = {}
    facts: dict[int, dict[str, str]] = {}
    for k, line in enumerate(lines[:-2], 1):
        if found := _VALUE.fullmatch(line):
            values.setdefault(int(found[1]), {})[int(found[2])] = number(found[3], "a value", f"{source}, line {k}")
        elif found := _FACT.fullmatch(line):
            facts.setdefault(int(found[2]), {})[found[1]] = found[3]
        elif line not in (_HEAD, "CHANDATA(1)"):
            raise FormatError(f"{source}, line {k}: {line[:60]!r} is nothing that sag compensation has; take it out")
    merged: dict[tuple[str, str], list[tuple[Array, Array, int]]] = {}
    for t, found_values in values.items():
        axis, component, position, column, direction = _table(t, found_values, facts.get(t, {}), settings, source)
        merged.setdefault((axis, component), []).append((position, column, direction))
    return tuple(_merged(axis, component, parts, source) for (axis, component), parts in merged.items())


def _table(
    t: int, values: Mapping[int, float], facts: Mapping[str, str], settings: Settings, source: str
) -> tuple[str, str, Array, Array, int]:
    wanted = {"INPUT_AXIS", "OUTPUT_AXIS", "STEP", "MIN", "MAX"}
    if not wanted <= set(facts):
        raise FormatError(f"{source}: table {t} lacks {', '.join(sorted(wanted - set(facts)))}; add it")
    if float(facts.get("MULT_BY_TABLE", "0")):
        raise FormatError(f"{source}: table {t} is multiplied by another, which is not read; take it apart")
    names = axis_names(settings)
    axis, output = (letter_of(facts[name].strip("()"), names, source) for name in ("INPUT_AXIS", "OUTPUT_AXIS"))
    step, low, high = (number(facts[name], name, f"{source}, table {t}") for name in ("STEP", "MIN", "MAX"))
    count = round((high - low) / step) + 1 if step > 0 else 0
    if sorted(values) != list(range(count)):
        raise FormatError(f"{source}: table {t} has {len(values)} points where MIN, MAX and STEP make {count}; correct them")
    component = motion_of(output)
    position = (low + step * np.arange(count, dtype=float)) / _unit(axis)
    column = signed(settings) * np.array([values[k] for k in range(count)]) / _unit(component)
    return axis, component, position, column, int(number(facts.get("DIRECTION", "0"), "DIRECTION", f"{source}, table {t}"))


def _merged(axis: str, component: str, parts: Sequence[tuple[Array, Array, int]], source: str) -> ErrorTable:
    """All tables of one output by one input, which add."""
    position = parts[0][0]
    if any(not np.array_equal(position, other) for other, _, _ in parts):
        raise FormatError(f"{source}: the tables of {component} by {axis} have different points; make them the same")
    value = np.zeros((len(position), 2))
    for _, column, direction in parts:
        value[:, _SIDES[direction]] += column[:, np.newaxis]
    return ErrorTable(axis, component, position, value, np.full_like(value, np.nan))


def _unit(letter: str) -> float:
    """Of the house in the unit of the control, of an axis or a component."""
    return 180 / np.pi if letter in ROTARY and letter not in LINEAR else 1.0


register(
    CompensationFormat(
        "sinumerik-cec",
        ".ini",
        "SINUMERIK sag compensation",
        displacements_only,
        write,
        can_read,
        read,
        settings=(
            SIGN,
            STEP,
            Setting("points", "200", "MD18342 MM_CEC_MAX_POINTS of a table; 200 of an 828D"),
            Setting("tables", "8", "that the control has; 8 of an 828D, 2 of an 802D sl"),
            Setting("first", "0", "number of the first table to be written"),
            Setting("axes", "X=AX1,Y=AX2,Z=AX3,A=AX4,B=AX5,C=AX6", "machine axis identifiers by letter"),
        ),
        sign_is_public=False,
    )
)
