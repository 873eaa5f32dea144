"""FANUC stored pitch error compensation: parameters 3620 to 3627 and the points of each axis, in one file of `N P` lines.

Points are evenly spaced; the number of that of the reference position (machine position 0) is parameter 3620. A value is the
*increment* of the correction over the interval that ends at its point, seen from the negative side, in units of the
detection times the magnification (3623). So the parameter manual's own example counts: reference point 40, interval 50 mm,
400 mm to the negative side: the farthest point there is 33. With `both=yes` (3605#0) a second run of points holds the
negative direction, from 3626, and 3627 is by how much it differs at the reference; without it both directions get the mean
and the reversal is left to the backlash parameter. Of linear axes only: over a turn of a rotary one the increments must sum
to nothing, which an error table of a part of a turn does not.

**No public text says the sign of the increments**; `sign=correction` is the default here. That points are called N10000 +
number, what a value may be (`largest`), and how an axis is named in a line are recalled, not read: settings, and for the
person at the machine to compare.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.compensation_files import (
    SIGN,
    STEP,
    CompensationFormat,
    Files,
    Setting,
    Settings,
    register,
    signed,
    step_of,
    whole,
)
from elastogeo.formats.compensation_points import even_points
from elastogeo.machine import Array, ErrorTable, motion_of

MOST_POINTS = 128
"""Between the two ends of one axis."""

_LINE = re.compile(r"N(\d{5})(?:A(\d+))?P(-?\d+)")
_WANTED = (3620, 3621, 3622, 3623, 3624)


def takes(table: ErrorTable) -> str:
    """It corrects linear axes along themselves."""
    if not table.is_own:
        return "pitch error compensation corrects an axis along itself only"
    return "the increments of a rotary axis must sum to nothing over a turn" if table.is_rotary else ""


def write(tables: Sequence[ErrorTable], settings: Settings) -> Files:
    """One file: the parameters of every axis, then its points, those of one axis after those of the other."""
    parameters: list[str] = []
    points: dict[int, int] = {}
    for table in tables:
        step, low, high = _grid(table, settings)
        reference = max(points) - low if points else whole(settings, "reference")
        if reference + low + 1 < 0:
            raise InputError(
                f"{table.name}: {-low} points lie before the reference point {reference}; say a greater reference"
            )
        values, numbers = _axis(table, step, low, high, reference, settings)
        parameters += [f"N{name:05d}A{_number(table.axis, settings)}P{value}" for name, value in sorted(values.items())]
        points |= numbers
    lines = [f"N{whole(settings, 'offset') + point:05d}P{value}" for point, value in points.items()]
    return {"pitch.txt": "\n".join(["%", *parameters, *lines, "%", ""]).encode()}


def _grid(table: ErrorTable, settings: Settings) -> tuple[float, int, int]:
    """The interval, and how many of them from the reference position to either end."""
    ends = even_points(table, MOST_POINTS, step_of(settings))
    step = float(ends[1] - ends[0]) if len(ends) > 1 else 1.0
    low, high = min(round(ends[0] / step), 0), max(round(ends[-1] / step), 0)
    if high - low >= MOST_POINTS:
        raise InputError(
            f"{table.name}: from the reference position it is {high - low + 1} points, and the control has {MOST_POINTS}; "
            f"choose a greater step"
        )
    return step, low, high


def _axis(
    table: ErrorTable, step: float, low: int, high: int, reference: int, settings: Settings
) -> tuple[dict[int, int], dict[int, int]]:
    """Parameters and points of an axis, by their numbers."""
    unit = signed(settings) * _unit(settings) * whole(settings, "magnification")
    both = settings["both"] == "yes" and not table.one_sided
    curves = table.at(step * np.arange(low, high + 1, dtype=float))
    curves = curves if both else curves.mean(axis=1, keepdims=True)
    counted = np.rint((curves - curves[-low]) / unit).astype(int)
    numbers = _increments(np.diff(counted[:, 0]), reference + low + 1, table, settings)
    values = {
        3620: reference,
        3621: reference + low + 1,
        3622: reference + high,
        3623: whole(settings, "magnification"),
        3624: round(step / _unit(settings)),
    }
    if both:
        second = reference + high + 1
        numbers |= _increments(np.diff(counted[:, 1]), second, table, settings)
        values |= {3605: 1, 3626: second, 3627: int(np.rint((curves[-low, 1] - curves[-low, 0]) / unit))}
    return values, numbers


def _number(axis: str, settings: Settings) -> int:
    """Of an axis in the control, from 1."""
    if axis not in settings["axes"]:
        raise InputError(f"the axes are {settings['axes']!r}, and {axis} is none of them; say axes in their order")
    return settings["axes"].index(axis) + 1


def _increments(found: Array, first: int, table: ErrorTable, settings: Settings) -> dict[int, int]:
    most = whole(settings, "largest")
    worst = int(np.abs(found).max(initial=0))
    if worst > most:
        raise InputError(
            f"{table.name}: an increment is {worst}, and the control takes {most} at the most; choose a smaller step, or a "
            f"magnification of {whole(settings, 'magnification') * -(-worst // most)}"
        )
    return {first + k: int(value) for k, value in enumerate(found)}


def can_read(head: bytes) -> bool:
    """Whether the lines after the first percent sign are those of parameters and points."""
    lines = head.split(b"\n")
    return (
        len(lines) > 2
        and lines[0].strip() == b"%"
        and _LINE.fullmatch(lines[1].decode("ascii", "replace").strip()) is not None
    )


def read(data: bytes, source: str, settings: Settings) -> tuple[ErrorTable, ...]:
    """The errors that the control compensates; its zero is the mean of both directions at the reference position."""
    if not (data.startswith(b"%\nN") and data.endswith(b"\n%\n")):
        raise FormatError(f"{source}: does not begin and end with % on lines of their own; it may be cut off, copy it again")
    parameters: dict[int, dict[int, int]] = {}
    points: dict[int, int] = {}
    for k, line in enumerate(data.decode("ascii", "replace").split("\n")[1:-2], 2):
        found = _LINE.fullmatch(line)
        if found is None:
            raise FormatError(f"{source}, line {k}: {line[:40]!r} is no parameter and no point; correct it")
        if found[2]:
            parameters.setdefault(int(found[2]), {})[int(found[1])] = int(found[3])
        else:
            points[int(found[1]) - whole(settings, "offset")] = int(found[3])
    return tuple(_table(number, own, points, settings, source) for number, own in parameters.items())


def _table(number: int, own: Mapping[int, int], points: Mapping[int, int], settings: Settings, source: str) -> ErrorTable:
    lacking = [str(name) for name in _WANTED if name not in own]
    if lacking or not 1 <= number <= len(settings["axes"]):
        raise FormatError(
            f"{source}: axis {number} lacks the parameters {', '.join(lacking) or 'of a letter in axes'}; add them"
        )
    axis = settings["axes"][number - 1]
    step, unit = own[3624] * _unit(settings), own[3623] * _unit(settings) * signed(settings)
    low, high = own[3621] - own[3620] - 1, own[3622] - own[3620]
    forth = unit * _summed(own[3621], high - low, -low, points, source)
    both = own.get(3605, 0) & 1
    back = unit * (_summed(own[3626], high - low, -low, points, source) + own[3627]) if both else forth
    value = np.column_stack([forth, back])
    value -= value[-low].mean()
    blank = np.full_like(value, np.nan)
    return ErrorTable(axis, motion_of(axis), step * np.arange(low, high + 1, dtype=float), value, blank)


def _summed(first: int, count: int, zero: int, points: Mapping[int, int], source: str) -> Array:
    """What increments sum to at the ends of their intervals, zero at the reference position."""
    missing = [str(first + k) for k in range(count) if first + k not in points]
    if missing:
        raise FormatError(f"{source}: the points {', '.join(missing[:5])} are not there; write every point from end to end")
    total = np.concatenate([[0], np.cumsum([points[first + k] for k in range(count)])])
    return np.asarray(total - total[zero], dtype=float)


def _unit(settings: Settings) -> float:
    try:
        unit = float(settings["unit"])
    except ValueError:
        unit = 0.0
    if not unit > 0:
        raise InputError(f"unit is {settings['unit']!r}; give the detection unit in mm")
    return unit


register(
    CompensationFormat(
        "fanuc",
        ".txt",
        "FANUC pitch error compensation",
        takes,
        write,
        can_read,
        read,
        settings=(
            replace(SIGN, default="correction"),
            STEP,
            Setting("unit", "0.001", "detection unit in mm"),
            Setting("magnification", "1", "parameter 3623"),
            Setting("largest", "127", "size of an increment that the control takes; 7 of many"),
            Setting("reference", "40", "number of the first axis's reference point, parameter 3620"),
            Setting("both", "yes", "a run of points for each direction (3605#0)", ("yes", "no")),
            Setting("offset", "10000", "what is added to the number of a point in the file"),
            Setting("axes", "XYZABC", "axis letters in the order of the control"),
        ),
        sign_is_public=False,
    )
)
