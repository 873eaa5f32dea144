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
from elastogeo.formats.compensation_points import degrees_or_mm, even_points
from elastogeo.formats.compensations.sinumerik_ini import IniFile, even_column
from elastogeo.machine import Array, ErrorTable, motion_of

_INI = IniFile("%_N_NC_CEC_INI", "sag compensation")
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
    return {"cec.ini": _INI.text(line for part in parts for line in part)}


def _lines(t: int, table: ErrorTable, direction: int, names: Mapping[str, str], settings: Settings) -> Iterator[str]:
    unit = degrees_or_mm(table.axis)
    points = even_points(table, whole(settings, "points"), step_of(settings), unit)
    column = _SIDES[direction][0]
    values = signed(settings) * table.at(points / unit)[:, column] * degrees_or_mm(table.component)
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


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:
    """The errors that the control compensates."""
    values: dict[int, dict[int, float]] = {}
    facts: dict[int, dict[str, str]] = {}
    for where, line in _INI.assignments(data, source):
        if found := _VALUE.fullmatch(line):
            values.setdefault(int(found[1]), {})[int(found[2])] = number(found[3], "a value", where)
        elif found := _FACT.fullmatch(line):
            facts.setdefault(int(found[2]), {})[found[1]] = found[3]
        else:
            raise _INI.unknown(line, where)
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
    position, value = even_column(values, low, high, step, f"table {t}", source)
    component = motion_of(output)
    direction = int(number(facts.get("DIRECTION", "0"), "DIRECTION", f"{source}, table {t}"))
    column = signed(settings) * value / degrees_or_mm(component)
    return axis, component, position / degrees_or_mm(axis), column, direction


def _merged(axis: str, component: str, parts: Sequence[tuple[Array, Array, int]], source: str) -> ErrorTable:
    """All tables of one output by one input, which add."""
    position = parts[0][0]
    if any(not np.array_equal(position, other) for other, _, _ in parts):
        raise FormatError(f"{source}: the tables of {component} by {axis} have different points; make them the same")
    value = np.zeros((len(position), 2))
    for _, column, direction in parts:
        value[:, _SIDES[direction]] += column[:, np.newaxis]
    return ErrorTable(axis, component, position, value, np.full_like(value, np.nan))


register(
    CompensationFormat(
        "sinumerik-cec",
        ".ini",
        "SINUMERIK sag compensation",
        displacements_only,
        write,
        _INI.can_read,
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
