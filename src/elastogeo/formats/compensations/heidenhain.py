"""HEIDENHAIN axis error tables: a `.COM` table for each axis that causes errors, and the `.CMA` table that names them.

In a `.COM` table AXISPOS is the position of the causing axis, from the machine datum; the column of an axis is what that
axis is to compensate there, and BACKLASH holds the values of the causing axis itself where it comes in its negative
direction (its own column then those of the positive one). So `[axis of the column] = F(axis of the .CMA column)`. Evenly
spaced points, at most 256, four decimals. Across, one value serves both directions: the mean.

The values are the deviations that were measured: actual less nominal, as public generators write them and as MP720 counts
(positive if the travel is too long). **No public text says the sign of these tables in so many words.** Columns are found by
where their names begin. Never tried on a control.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.compensation_files import (
    SIGN,
    STEP,
    CompensationFormat,
    Files,
    Setting,
    Settings,
    displacements_only,
    number,
    register,
    signed,
    step_of,
    whole,
)
from elastogeo.formats.compensation_points import degrees_or_mm, even_points
from elastogeo.machine import LINEAR, ROTARY, Array, ErrorTable, motion_of

_WIDE, _NARROW = 13, 6
_BEGIN = re.compile(r"BEGIN ([A-Z])\.COM +MM(?: +Version:.*)?")


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:
    """A table for each causing axis, and the one that names them."""
    causing = list(dict.fromkeys(table.axis for table in tables))
    files = {f"{axis}.COM": _com(axis, [t for t in tables if t.axis == axis], settings) for axis in causing}
    names = _row("NR", ["ACTIVE", *causing])
    active = _row("0", ["*", *(f"{axis}.COM" for axis in causing)])
    return {**files, "CONFIG.CMA": "\n".join(["BEGIN CONFIG.CMA", names, active, "[END]", ""]).encode()}


def _com(axis: str, tables: Sequence[ErrorTable], settings: Settings) -> bytes:
    unit, sign = degrees_or_mm(axis), signed(settings)
    widest = max(tables, key=lambda table: np.ptp(table.position))
    points = _union(tables, widest, settings, unit)
    columns: dict[str, Array] = {}
    for table in tables:
        values = sign * table.at(points / unit) * degrees_or_mm(table.component)
        if table.is_own and not table.one_sided:
            columns = {"BACKLASH": values[:, 1], axis: values[:, 0], **columns}
        else:
            columns[axis if table.is_own else table.component] = values.mean(axis=1)
    cells = zip(points, *columns.values(), strict=True)
    rows = [_row(str(k), [f"{value + 0.0:+.4f}" for value in row]) for k, row in enumerate(cells)]
    return "\n".join([f"BEGIN {axis}.COM MM", _row("NR", ["AXISPOS", *columns]), *rows, "[END]", ""]).encode()


def _union(tables: Sequence[ErrorTable], widest: ErrorTable, settings: Settings, unit: float) -> Array:
    """Points that hold all tables of one axis."""
    low, high = min(table.span[0] for table in tables), max(table.span[1] for table in tables)
    inner = widest.position[(widest.position > low) & (widest.position < high)]
    position = np.array([low, *inner, high]) if high > low else np.array([low])
    none = np.zeros((len(position), 2))
    held = ErrorTable(widest.axis, widest.component, position, none, none)
    return even_points(held, whole(settings, "points"), step_of(settings), unit)


def _row(first: str, cells: Sequence[str]) -> str:
    return (f"{first:<{_NARROW}}" + "".join(f"{cell:<{_WIDE}}" for cell in cells)).rstrip()


def can_read(head: bytes) -> bool:
    """Whether it begins as an axis error table does."""
    return _BEGIN.fullmatch(head.split(b"\n", 1)[0].decode("ascii", "replace").strip()) is not None


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:
    """The errors that the control compensates: one of each column."""
    begin, *lines = data.decode("ascii", "replace").splitlines() or [""]
    found = _BEGIN.fullmatch(begin.strip())
    if found is None or len(lines) < 3 or lines[-1] != "[END]":
        raise FormatError(f"{source}: does not begin with BEGIN X.COM MM, or not end with [END]; it may be cut off")
    heading = [(match[0], match.start()) for match in re.finditer(r"\S+", lines[0])]
    columns: dict[str, list[float]] = {name: [] for name, _ in heading}
    if "AXISPOS" not in columns:
        raise FormatError(f"{source}, line 2: there is no column AXISPOS; its columns are {', '.join(columns)}")
    ends = [start for _, start in heading[1:]] + [None]
    for k, line in enumerate(lines[1:-1], 3):
        for (name, start), end in zip(heading, ends, strict=True):
            columns[name].append(number(line[start:end].strip(), f"the value of {name}", f"{source}, line {k}"))
    return tuple(_tables(found[1], {name: np.array(column) for name, column in columns.items()}, signed(settings), source))


def _tables(axis: str, columns: Mapping[str, Array], sign: float, source: str) -> list[ErrorTable]:
    unit = degrees_or_mm(axis)
    position = columns["AXISPOS"] / unit
    tables = []
    for name, column in columns.items():
        if name in ("NR", "AXISPOS", "BACKLASH"):
            continue
        if name not in {**LINEAR, **ROTARY}:
            raise FormatError(f"{source}, line 2: the column {name} is no axis; take it out")
        component = motion_of(name)
        back = columns.get("BACKLASH", column) if name == axis else column
        value = sign * np.column_stack([column, back]) / degrees_or_mm(component)
        tables.append(ErrorTable(axis, component, position, value, np.full_like(value, np.nan)))
    return tables


register(
    CompensationFormat(
        "heidenhain",
        ".COM",
        "HEIDENHAIN axis error tables",
        displacements_only,
        write,
        can_read,
        read,
        settings=(SIGN, STEP, Setting("points", "256", "compensation points of a table")),
        sign_is_public=False,
    )
)
