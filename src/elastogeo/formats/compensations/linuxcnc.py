"""LinuxCNC screw compensation: one file for each joint, `nominal forward reverse`, and the lines of the ini file.

What the control does was measured in runs of its own simulator (`tests/linuxcnc`), and is what its manual says: motor
command = command + trim, linear between the points, constant beyond them, the forward column while the joint moves up, the
reverse column while it moves down, kept at rest. Of `COMP_FILE_TYPE` 0 the columns are where the axis really was, so that
the trim is nominal less actual; of type 1 they are the trims. `BACKLASH` of the joint is ignored where it has such a file,
so the reversal is in the two columns. At most 256 points, which ascend. One limit was found: with a the half of the joint's
`MAX_ACCELERATION` and T the servo period, a step of the correction between a T^2 / 2 and a T^2 is never applied.

A file says neither its axis nor its type, and the control stops reading at the first line that is no triplet: there the last
line says both, for people and for reading back.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.compensation_files import CompensationFormat, Files, Setting, Settings, number, register
from elastogeo.formats.compensation_points import thinned
from elastogeo.machine import Array, ErrorTable, motion_of

MOST_POINTS = 256
_TRIPLET = re.compile(rb"[ \t]*(?:[+-]?[\d.]+(?:[eE][+-]?\d+)?[ \t]+){2}[+-]?[\d.]+(?:[eE][+-]?\d+)?[ \t]*\r?")
_TRAILER = re.compile(
    r"# axis (?P<axis>[A-Z]), COMP_FILE_TYPE (?P<type>[01]), (?P<unit>mm|inch|deg), (?P<points>\d+) points"
)
_INCH = 25.4


def takes(table: ErrorTable) -> str:
    """Screw compensation is of each joint for itself."""
    return "" if table.is_own else "screw compensation corrects an axis along itself only"


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:
    """One file for each axis, and the lines that the ini file needs."""
    files = {f"{table.axis.lower()}.comp": _comp(table, settings) for table in tables}
    return {**files, "joints.ini": "\n".join(_ini(tables, settings)).encode()}


def _comp(table: ErrorTable, settings: Settings) -> bytes:
    unit = _unit(table.is_rotary, settings["unit"])
    scale = _SCALES[unit]
    position = thinned(table, MOST_POINTS)
    nominal, error = position * scale, table.at(position) * scale
    columns = nominal[:, np.newaxis] + error if settings["type"] == "0" else 0.0 - error
    rows = [f"{place:.6f} {forth:.6f} {back:.6f}" for place, (forth, back) in zip(nominal, columns, strict=True)]
    if len({row.split()[0] for row in rows}) < len(rows):
        raise InputError(f"{table.name}: two points are nearer than 1e-6 {unit}; leave one out")
    end = f"# axis {table.axis}, COMP_FILE_TYPE {settings['type']}, {unit}, {len(rows)} points"
    return "\n".join([*rows, end, ""]).encode()


def _ini(tables: Sequence[ErrorTable], settings: Settings) -> Iterator[str]:
    joints = settings["joints"]
    for table in tables:
        if table.axis not in joints:
            raise InputError(f"the joints are {joints!r}, and {table.axis} is none of them; say joints in their order")
        yield f"[JOINT_{joints.index(table.axis)}]"
        yield f"COMP_FILE = {table.axis.lower()}.comp"
        yield f"COMP_FILE_TYPE = {settings['type']}"
        yield ""


def can_read(head: bytes) -> bool:
    """Whether the first line is three numbers."""
    return _TRIPLET.fullmatch(head.split(b"\n", 1)[0]) is not None


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:  # noqa: ARG001
    """The errors that the control compensates."""
    lines = data.decode("ascii", "replace").splitlines()
    rows: list[list[float]] = []
    for line in lines:
        if not _TRIPLET.fullmatch(line.encode()):
            break
        rows.append([number(word, "a value", f"{source}, line {len(rows) + 1}") for word in line.split()])
    trailer = _TRAILER.fullmatch(lines[len(rows)]) if len(rows) < len(lines) else None
    if trailer is None or int(trailer["points"]) != len(rows):
        raise FormatError(
            f"{source}: after {len(rows)} points there is no line that says axis, type and so many points; it may be cut "
            f"off, or end it with: # axis X, COMP_FILE_TYPE 0, mm, {len(rows)} points"
        )
    scale = _SCALES[trailer["unit"]]
    nominal, forth, back = np.array(rows).T
    _check(nominal, source)
    columns = np.column_stack([forth, back])
    error = columns - nominal[:, np.newaxis] if trailer["type"] == "0" else -columns
    axis = trailer["axis"]
    return (ErrorTable(axis, motion_of(axis), nominal / scale, error / scale, np.full_like(error, np.nan)),)


def _check(nominal: Array, source: str) -> None:
    if len(nominal) > MOST_POINTS:
        raise FormatError(f"{source}: has {len(nominal)} points, and the control reads {MOST_POINTS}; write fewer")
    back = np.flatnonzero(np.diff(nominal) <= 0)
    if len(back):
        raise FormatError(f"{source}, line {back[0] + 2}: the nominal positions must ascend; sort them")


def _unit(rotary: bool, linear: str) -> str:
    return "deg" if rotary else linear


_SCALES = {"mm": 1.0, "inch": 1 / _INCH, "deg": 180 / np.pi}
"""Of the house in units of the control."""

register(
    CompensationFormat(
        "linuxcnc",
        ".comp",
        "LinuxCNC screw compensation",
        takes,
        write,
        can_read,
        read,
        settings=(
            Setting("type", "0", "COMP_FILE_TYPE: 0 where the axis really was, 1 the trims", ("0", "1")),
            Setting("unit", "mm", "LINEAR_UNITS of the machine", ("mm", "inch")),
            Setting("joints", "XYZABCUVW", "axis letters in the order of the joints, from joint 0"),
        ),
    )
)
