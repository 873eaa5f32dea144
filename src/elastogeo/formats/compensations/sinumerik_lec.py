"""SINUMERIK leadscrew error compensation (LEC, EEC): `$AA_ENC_COMP`, one table for each axis, and its backlash.

Evenly spaced points from MIN to MAX, (MAX - MIN) / STEP + 1 of them, in mm or degrees; linear between. The control adds the
value to the actual position: a positive value makes the axis go in its negative direction, so the table holds actual less
nominal. One table serves both directions. What differs by direction is written as `$MA_BACKLASH` (MD32450), positive where
the axis falls short; its mean over the points, half of it counted on either side: what the control does with the other half
is a shift of its zero.

A table is loaded only while MD32700 ENC_COMP_ENABLE is 0; with 1 it works once the axis is referenced. Its points must fit
MD38000 MM_ENC_COMP_MAX_POINTS, which no public text limits: the setting `points` says it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.compensation_files import (
    STEP,
    CompensationFormat,
    Files,
    Setting,
    Settings,
    axis_names,
    letter_of,
    name_of,
    number,
    register,
    step_of,
    whole,
)
from elastogeo.formats.compensation_points import degrees_or_mm, even_points
from elastogeo.formats.compensations.sinumerik_ini import IniFile, even_column
from elastogeo.machine import ErrorTable, motion_of

_INI = IniFile("%_N_AX_EEC_INI", "leadscrew error compensation")
_VALUE = re.compile(r"\$AA_ENC_COMP\[(\d+),(\d+),(\w+)\]=(\S+)")
_PLACE = re.compile(r"\$AA_ENC_COMP_(STEP|MIN|MAX|IS_MODULO)\[(\d+),(\w+)\]=(\S+)")
_BACKLASH = re.compile(r"\$MA_BACKLASH\[(\d+),(\w+)\]=(\S+)")


def takes(table: ErrorTable) -> str:
    """It corrects each axis along itself."""
    return (
        ""
        if table.is_own
        else "leadscrew error compensation corrects an axis along itself only; sinumerik-cec corrects across"
    )


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:
    """One file for all axes."""
    names = axis_names(settings)
    return {"eec.ini": _INI.text(line for table in tables for line in _lines(table, names, settings))}


def _lines(table: ErrorTable, names: Mapping[str, str], settings: Settings) -> Iterator[str]:
    unit = degrees_or_mm(table.axis)
    points = even_points(table, whole(settings, "points"), step_of(settings), unit)
    name, system = name_of(table.axis, names), whole(settings, "system")
    values = table.at(points / unit) * unit
    for k, value in enumerate(values.mean(axis=1)):
        yield f"$AA_ENC_COMP[{system},{k},{name}]={value + 0.0:.6f}"
    step = points[1] - points[0] if len(points) > 1 else 1.0
    yield f"$AA_ENC_COMP_STEP[{system},{name}]={step:.6f}"
    yield f"$AA_ENC_COMP_MIN[{system},{name}]={points[0]:.6f}"
    yield f"$AA_ENC_COMP_MAX[{system},{name}]={points[-1]:.6f}"
    yield f"$AA_ENC_COMP_IS_MODULO[{system},{name}]=0"
    if not table.one_sided:
        yield f"$MA_BACKLASH[{system},{name}]={np.mean(table.value[:, 1] - table.value[:, 0]) * unit:.6f}"


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:
    """The errors that the control compensates."""
    values: dict[str, dict[int, float]] = {}
    places: dict[str, dict[str, float]] = {}
    backlash: dict[str, float] = {}
    for where, line in _INI.assignments(data, source):
        if found := _VALUE.fullmatch(line):
            values.setdefault(found[3], {})[int(found[2])] = number(found[4], "a value", where)
        elif found := _PLACE.fullmatch(line):
            places.setdefault(found[3], {})[found[1]] = number(found[4], "a value", where)
        elif found := _BACKLASH.fullmatch(line):
            backlash[found[2]] = number(found[3], "a backlash", where)
        else:
            raise _INI.unknown(line, where)
    names = axis_names(settings)
    return tuple(
        _table(letter_of(name, names, source), found, places.get(name, {}), backlash.get(name, 0.0), source)
        for name, found in values.items()
    )


def _table(axis: str, values: Mapping[int, float], place: Mapping[str, float], lost: float, source: str) -> ErrorTable:
    if not {"STEP", "MIN", "MAX"} <= set(place) or place["STEP"] <= 0:
        raise FormatError(f"{source}: {axis} has no STEP above zero, no MIN or no MAX; add what is missing")
    unit = degrees_or_mm(axis)
    position, mean = even_column(values, place["MIN"], place["MAX"], place["STEP"], axis, source)
    both = mean[:, np.newaxis] + lost * np.array([-0.5, 0.5])
    return ErrorTable(axis, motion_of(axis), position / unit, both / unit, np.full_like(both, np.nan))


register(
    CompensationFormat(
        "sinumerik-lec",
        ".ini",
        "SINUMERIK leadscrew error compensation",
        takes,
        write,
        _INI.can_read,
        read,
        settings=(
            STEP,
            Setting("points", "1000", "MD38000 MM_ENC_COMP_MAX_POINTS of the axis"),
            Setting("system", "0", "measuring system: 0 the first, 1 the second", ("0", "1")),
            Setting("axes", "X=X1,Y=Y1,Z=Z1,A=A1,B=B1,C=C1", "machine axis names by letter"),
        ),
    )
)
