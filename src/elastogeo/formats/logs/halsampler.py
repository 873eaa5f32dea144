"""Samples of LinuxCNC signals as `halsampler` prints them: a line of numbers for each sample, without any header.

The layout is that of the program itself (LinuxCNC and Machinekit, `src/hal/components/sampler_usr.c`): each value is
followed by one blank, a float printed by `%f` (six decimals), a bit as 0 or 1, an integer as such; with the option `-t`
the number of the sample comes first; a line `overrun` stands before a sample that does not follow the one before it.

The file has no names, no units and no period. So the channels are `0`, `1`, ... in the order of the sampler's pins,
without unit and without time. A first column of integers that count up by one, except after an `overrun`, is the sample
number: it becomes the channel `sample`, a count, **not** a time in seconds; times the period of the thread it is one.
Each gap is noted. In a file without numbers an `overrun` says that samples were lost there, not how many. **No overrun
does not prove that none were lost**: in present LinuxCNC (`hal_stream_write`) a full FIFO rejects a sample without
counting it; only the pin `sampler.N.overruns` shows that.

Refused are lines with another number of values than the first, a last line without end, and sample numbers that skip,
repeat or go back where no `overrun` says so.
"""

from __future__ import annotations

import re
from array import array

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.machine import Array

MAX_PINS = 1000
MAX_LINE = 40_000
SAMPLE = "sample"
"""Name of the channel of sample numbers."""

_SHOWN = 5
_BLOCK = 65_536
_VALUE = rb"(?:-?\d{1,20}|-?\d{1,310}\.\d{6}|-?nan|-?inf) "
_LINE = re.compile(rb"(?:%s)+\r?|overrun\r?" % _VALUE)


def can_read(head: bytes) -> bool:
    """Whether these first bytes are lines of numbers as `halsampler` prints them, with a blank after each number."""
    lines = head.split(b"\n")[:-1]
    return any(line.strip() != b"overrun" for line in lines) and all(_is_line(line) for line in lines)


def read_halsampler(data: bytes, source: str) -> Log:
    """Read what `halsampler` printed.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Log
        The channels `0`, `1`, ... without unit and time; with option `-t` also `sample`, the number of each sample.

    Raises
    ------
    FormatError
        If a line is not one that the program prints, or sample numbers do not count up.
    """
    if not data.endswith(b"\n"):
        raise FormatError(f"{source}: the last line has no end, so it may be cut off; copy it again or take the line out")
    columns, overruns, counted = _columns(data, source)
    inside = [row for row in overruns if 0 < row < len(columns[0])]
    notes: list[str] = []
    numbers = _sample_numbers(columns, inside, source) if counted else None
    channels = {}
    if numbers is not None:
        channels[SAMPLE] = Channel(SAMPLE, "", numbers)
        lost = np.diff(numbers)[[row - 1 for row in inside]] - 1
        if inside:
            notes.append(f"{int(lost.sum())} samples were lost in overruns, after row {_listed(inside)}")
    elif inside:
        notes.append(f"samples were lost, not known how many, after row {_listed(inside)}")
    if len(inside) < len(overruns):
        notes.append("an overrun stands before the first row or after the last: samples were lost there")
    for pin, column in enumerate(columns[numbers is not None :]):
        values = np.array(column)
        bad = ~np.isfinite(values)
        if bad.any():
            notes.append(f"{pin}: {int(bad.sum())} of {len(values)} samples have no finite number")
            values[bad] = np.nan
        channels[str(pin)] = Channel(str(pin), "", values)
    return Log(channels, {}, source, tuple(notes), SAMPLE if numbers is not None else "")


def _is_line(line: bytes) -> bool:
    return len(line) <= MAX_LINE and _LINE.fullmatch(line) is not None


def _columns(data: bytes, source: str) -> tuple[list[array[float]], list[int], bool]:
    """The values of each column, how many rows stand before each overrun, and whether the first column is of counts."""
    columns: list[array[float]] = []
    overruns: list[int] = []
    number = start = rows = 0
    counted = True
    while start < len(data):
        stop = data.find(b"\n", min(start + _BLOCK, len(data) - 1)) + 1
        for line in data[start:stop].split(b"\n")[:-1]:
            number += 1
            if not _is_line(line):
                raise FormatError(
                    f"{source}, line {number}: {line[:40]!r} is not a line of numbers as halsampler prints them; take it out"
                )
            cells = line.split()
            if cells == [b"overrun"]:
                if overruns[-1:] != [rows]:
                    overruns.append(rows)
                continue
            columns = columns or [array("d") for _ in cells]
            if len(cells) != len(columns) or len(cells) > MAX_PINS:
                raise FormatError(
                    f"{source}, line {number}: has {len(cells)} values, the first line has {len(columns)} (at most "
                    f"{MAX_PINS} are read); record it again"
                )
            for column, cell in zip(columns, cells, strict=True):
                column.append(float(cell))
            counted = counted and cells[0].isdigit()
            rows += 1
        start = stop
    if not rows:
        raise FormatError(f"{source}: has no line of numbers; record it again")
    return columns, overruns, counted and len(columns) > 1 and rows > 1


def _sample_numbers(columns: list[array[float]], inside: list[int], source: str) -> Array | None:
    """The first column if it holds the numbers of the samples (option `-t`), else None.

    Raises
    ------
    FormatError
        If most of it counts up by one, and the rest does not.
    """
    first = np.array(columns[0])
    steps = np.diff(first)
    after = np.zeros(len(steps), bool)
    after[[row - 1 for row in inside]] = True
    wrong = np.where(after, steps < 1, steps != 1)
    if not wrong.any():
        return first
    if 10 * int(wrong.sum()) > len(steps):
        return None
    row = int(np.argmax(wrong))
    raise FormatError(
        f"{source}: the sample number {first[row + 1]:.0f} of row {row + 2} follows {first[row]:.0f} without an overrun; "
        "lines are missing, doubled or out of order; take the file as it was recorded"
    )


def _listed(rows: list[int]) -> str:
    return ", ".join(map(str, rows[:_SHOWN])) + (f" and {len(rows) - _SHOWN} more" if len(rows) > _SHOWN else "")


def _sample() -> bytes:
    return b"0 0.125000 -1.500000 1 \n1 0.250000 -1.250000 1 \noverrun\n4 0.375000 -1.000000 0 \n"


register(LogFormat("halsampler", ".txt", can_read, read_halsampler, _sample))
