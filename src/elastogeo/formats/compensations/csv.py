"""Error tables as plain CSV, for any control that has no file of its own here: a row for each point and direction.

All that an error table holds, with its uncertainty, at full precision: positions in mm or degrees, deviations in micrometres
or seconds of arc, actual less nominal. A control wants the correction, which is the other sign, or the error itself: see its
manual.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.compensation_files import CompensationFormat, Files, Settings, number, register
from elastogeo.machine import ROTARY, SIDES, ErrorTable

HEADER = "error,axis,component,direction,position,position_unit,deviation,uncertainty,unit"
_DEGREE, _ARCSEC, _MICRO = 180 / np.pi, 180 * 3600 / np.pi, 1000.0


def takes(table: ErrorTable) -> str:  # noqa: ARG001
    """Any table."""
    return ""


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:  # noqa: ARG001
    """One file for all tables; its last line counts the rows."""
    rows = [row for table in tables for row in _rows(table)]
    return {"errors.csv": "\n".join([HEADER, *rows, f"# {len(rows)} rows, actual less nominal", ""]).encode()}


def _rows(table: ErrorTable) -> Iterator[str]:
    place, unit = (_DEGREE, "deg") if table.is_rotary else (1.0, "mm")
    size, of = (_ARCSEC, "arcsec") if table.is_angular else (_MICRO, "um")
    for side, sign in enumerate(SIDES):
        for k, at in enumerate(table.position):
            doubt = table.uncertainty[k, side]
            told = "" if np.isnan(doubt) else f"{doubt * size:.9g}"
            deviation = table.value[k, side] * size
            yield (
                f"{table.name},{table.axis},{table.component},{sign},{at * place:.12g},{unit},{deviation:.9g},{told},{of}"
            )


def can_read(head: bytes) -> bool:
    """Whether the first line is the header."""
    return head.split(b"\n", 1)[0].strip() == HEADER.encode()


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:  # noqa: ARG001
    """The tables of a file, in its order."""
    _, *lines = data.decode("utf-8", "replace").splitlines() or [""]
    if not lines or lines[-1] != f"# {len(lines) - 1} rows, actual less nominal":
        raise FormatError(
            f"{source}: its last line does not count {max(len(lines) - 1, 0)} rows; it may be cut off, copy it again"
        )
    found: dict[tuple[str, str], dict[str, list[tuple[float, float, float]]]] = {}
    for k, line in enumerate(lines[:-1], 2):
        where = f"{source}, line {k}"
        cells = line.split(",")
        if len(cells) != HEADER.count(",") + 1 or cells[3] not in SIDES:
            raise FormatError(f"{where}: {line[:60]!r} has not the columns {HEADER}, with a direction of + or -; correct it")
        _, axis, component, sign, *rest = cells
        found.setdefault((axis, component), {side: [] for side in SIDES})[sign].append(_point(axis, component, rest, where))
    return tuple(_table(axis, component, sides, source) for (axis, component), sides in found.items())


def _point(axis: str, component: str, cells: Sequence[str], where: str) -> tuple[float, float, float]:
    position, place_unit, deviation, uncertainty, unit = cells
    wanted = ("deg" if axis in ROTARY else "mm"), ("arcsec" if component in ROTARY else "um")
    if (place_unit, unit) != wanted:
        raise FormatError(f"{where}: positions in {place_unit} and deviations in {unit}; give {wanted[0]} and {wanted[1]}")
    place, size = (_DEGREE if axis in ROTARY else 1.0), (_ARCSEC if component in ROTARY else _MICRO)
    doubt = number(uncertainty, "an uncertainty", where) if uncertainty else np.nan
    return number(position, "a position", where) / place, number(deviation, "a deviation", where) / size, doubt / size


def _table(axis: str, component: str, sides: dict[str, list[tuple[float, float, float]]], source: str) -> ErrorTable:
    forth, back = (np.array(sides[sign]).reshape(-1, 3) for sign in SIDES)
    if not np.array_equal(forth[:, 0], back[:, 0]):
        raise FormatError(f"{source}: E_{component}{axis} has other positions in + than in -; give both for each position")
    return ErrorTable(
        axis, component, forth[:, 0], np.column_stack([forth[:, 1], back[:, 1]]), np.column_stack([forth[:, 2], back[:, 2]])
    )


register(CompensationFormat("csv", ".csv", "error table as CSV", takes, write, can_read, read))
