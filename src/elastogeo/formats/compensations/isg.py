"""ISG kernel and Beckhoff TF5280 volumetric compensation: a CSV of error motions by the names of ISO 230-1.

A header names the axis and its errors, blanks apart (`X EXX EYX EBX`), a row for each position; `//` begins a comment, `#`
a new header. Positions in mm and degrees, errors in mm and **radians**. One value for both directions: the mean. The errors
are those of the axis, at the reference point of its measurement: a table that was read with a lever holds that lever.

Of the maker's lists of single axes a public page gives the sign, actual less nominal; **of this file none does.** The
configuration (`.lis`: axes, `file_format[0] ISG_CSV`, at most `max_records` rows) is the machine's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.compensation_files import (
    SIGN,
    CompensationFormat,
    Files,
    Setting,
    Settings,
    number,
    register,
    signed,
    whole,
)
from elastogeo.formats.compensation_points import degrees_or_mm
from elastogeo.machine import COMPONENTS, LINEAR, ROTARY, ErrorTable

_END = "// end"


def takes(table: ErrorTable) -> str:  # noqa: ARG001
    """Every error motion."""
    return ""


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:
    """One file: a block for each axis."""
    axes = list(dict.fromkeys(table.axis for table in tables))
    blocks = [list(_block(axis, [t for t in tables if t.axis == axis], signed(settings))) for axis in axes]
    rows = sum(len(block) - 1 for block in blocks)
    if rows > whole(settings, "records"):
        raise InputError(f"volumetric compensation: {rows} records, and the control has {settings['records']}; say records")
    lines = [line for k, block in enumerate(blocks) for line in ([] if k == 0 else ["#"]) + block]
    return {"volumetric.csv": "\n".join([*lines, _END, ""]).encode()}


def _block(axis: str, tables: Sequence[ErrorTable], sign: float) -> Iterator[str]:
    position = np.unique(np.concatenate([table.position for table in tables]))
    yield " ".join([axis, *(f"E{table.component}{axis}" for table in tables)])
    columns = [sign * table.at(position).mean(axis=1) for table in tables]
    place = position * degrees_or_mm(axis)
    for k, at in enumerate(place):
        values = (f"{column[k] + 0.0:.{9 if t.is_angular else 6}f}" for column, t in zip(columns, tables, strict=True))
        yield " ".join([f"{at:.6f}", *values])


def can_read(head: bytes) -> bool:
    """Whether its first line that is no comment names an axis and error motions of it."""
    for line in head.decode("ascii", "replace").splitlines():
        if not line.startswith("//"):
            return _axis_of(line.split()) != ""
    return False


def _axis_of(words: Sequence[str]) -> str:
    """The axis that a header is of; nothing if it is none."""
    if len(words) < 2 or words[0] not in {**LINEAR, **ROTARY}:
        return ""
    named = {f"E{component}{words[0]}" for component in COMPONENTS}
    return words[0] if set(words[1:]) <= named else ""


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:
    """The errors that the control compensates: one of each column."""
    text = data.decode("ascii", "replace")
    if not text.endswith(f"{_END}\n"):
        raise FormatError(f"{source}: its last line is not {_END!r}; it may be cut off, or add it")
    found: list[ErrorTable] = []
    for block in text.split("\n#\n"):
        lines = [line for line in block.splitlines() if line.strip() and not line.startswith("//")]
        axis = _axis_of(lines[0].split()) if lines else ""
        if not axis or len(lines) < 2:
            raise FormatError(f"{source}: a block has no header of one axis and its errors, or no rows; correct it")
        found += _tables(axis, lines, signed(settings), source)
    return tuple(found)


def _tables(axis: str, lines: Sequence[str], sign: float, source: str) -> Iterator[ErrorTable]:
    names = lines[0].split()
    rows = [[number(word, "a value", source) for word in line.split()] for line in lines[1:]]
    if {len(row) for row in rows} != {len(names)}:
        raise FormatError(f"{source}: a row of {axis} has not {len(names)} values; correct it")
    columns = np.array(rows).T
    position = columns[0] / degrees_or_mm(axis)
    for name, column in zip(names[1:], columns[1:], strict=True):
        value = sign * np.column_stack([column, column])
        yield ErrorTable(axis, name[1], position, value, np.full_like(value, np.nan))


register(
    CompensationFormat(
        "isg",
        ".csv",
        "ISG and Beckhoff volumetric compensation",
        takes,
        write,
        can_read,
        read,
        settings=(SIGN, Setting("records", "2000", "vol_comp[0].max_records of the control")),
        sign_is_public=False,
    )
)
