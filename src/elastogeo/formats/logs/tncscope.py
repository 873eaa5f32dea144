"""Recordings of the HEIDENHAIN oscilloscope program TNCscope (`.sco`, text).

The maker publishes no description. The layout is as a public MATLAB reader of such files has it (`read_tncscope_file.m`,
a function that reads recordings of a machine in Munich): lines that begin with `%`; a section `%[GLOBAL]` and one
`%[CURVE...]` for each channel, of lines `%KEY=VALUE` that end at a line with nothing but `%`; the keys `%CHANNELTYPE`,
`%AXISTYPE`, `%DIMENSION` (the unit), `%COUNT` (number of samples) and `%CYCLETIME` (in microseconds); `%[DATA]`; then
rows `time;value;value;...;` with one value for each channel, in the order of the sections. A channel's samples are its
first `COUNT` rows, `CYCLETIME` apart. Other public programs name channels of such recordings `s actual X`, `i ist X`, `I
N int S1`.

**Not known** are the unit of the column of time (it only serves to show that no row is missing, doubled or out of order;
where its steps are not the cycle time in microseconds, a note says so), and what stands in the rows of a slow channel
after its last sample (left out, with a note). Refused are decimal commas, and channels without a count or cycle time. The
channels `DSP-Debug` have an identifier `id(10)` in place of a unit; they are read without a unit, and a note says so.
"""

from __future__ import annotations

import io
import math
import re
from array import array
from collections.abc import Mapping
from typing import TextIO

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.text.units import UNITS
from elastogeo.machine import Array

MAX_LINE = 20_000
MAX_CHANNELS = 1000

_BLOCK = 32_768
_CURVE = re.compile(rb"^%\[CURVE", re.MULTILINE)
_TYPE = re.compile(rb"^%CHANNELTYPE", re.MULTILINE)
_PLAIN = re.compile(r"[-+.\deE;\s]*", re.ASCII)
_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?", re.ASCII)


def can_read(head: bytes) -> bool:
    """Whether these first bytes begin with lines of `%` that describe the curves of a TNCscope recording."""
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    return text.startswith(b"%") and _CURVE.search(text) is not None and _TYPE.search(text) is not None


def read_tncscope(data: bytes, source: str) -> Log:
    """Read a TNCscope recording.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Log
        A channel for each curve, named by its type and axis (`i ist X`), with its unit if it is a known one; time [s] from
        the first row. Metadata is what the global section says.

    Raises
    ------
    FormatError
        If the description of a curve is incomplete, a row has not one cell for each, rows are missing, doubled or out of
        order, or the file is cut off.
    """
    stream = _opened(data, source)
    metadata, curves, line = _read_head(stream, source)
    columns = _read_rows(stream, len(curves) + 1, line, source)
    if not data.endswith((b";", b"\n", b"\r")):
        raise FormatError(f"{source}: the last row has no end, so the file may be cut off; copy or export it again")
    notes: list[str] = []
    cycles = [_cycle(curve, f"{source}, curve {k}") for k, curve in enumerate(curves, 1)]
    _check_time(np.frombuffer(columns[0]), min(cycles), line, source, notes)
    channels: dict[str, Channel] = {}
    for k, (curve, cycle) in enumerate(zip(curves, cycles, strict=True), 1):
        name = _name(curve, k, channels)
        values = _samples(np.frombuffer(columns[k]), curve, f"{source}, curve {k} ({name})", name, notes)
        channels[name] = Channel(
            name, _unit(curve, name, notes), values, np.arange(len(values), dtype=np.float64) * cycle / 1e6
        )
    return Log(channels, metadata, source, tuple(notes))


def _opened(data: bytes, source: str) -> TextIO:
    try:
        data.decode("utf-8")
        encoding = "utf-8-sig"
    except UnicodeDecodeError:
        encoding = "latin-1"
    if b"\0" in data:
        raise FormatError(f"{source}: byte {data.index(0)} is zero, so this is no text; copy or export it again")
    return io.TextIOWrapper(io.BytesIO(data), encoding=encoding, newline=None)


def _read_head(stream: TextIO, source: str) -> tuple[dict[str, str], list[dict[str, str]], int]:
    """The global section, the section of each curve, and the number of the line `%[DATA]`."""
    metadata: dict[str, str] = {}
    curves: list[dict[str, str]] = []
    section: dict[str, str] | None = None
    for number, line in enumerate(stream, 1):
        text = line.strip()
        if len(line) > MAX_LINE or (text and not text.startswith("%")):
            raise FormatError(
                f"{source}, line {number}: begins with {text[:40]!r}; before %[DATA] each line begins with '%'; export again"
            )
        if text == "%[DATA]":
            if not curves:
                raise FormatError(f"{source}, line {number}: no %[CURVE] stands before the data; export it again")
            return metadata, curves, number
        if text.startswith("%[CURVE"):
            section = {}
            curves.append(section)
            if len(curves) > MAX_CHANNELS:
                raise FormatError(f"{source}, line {number}: more than {MAX_CHANNELS} curves; this is no recording")
        elif text.startswith("%["):
            section = metadata if text == "%[GLOBAL]" else None
        elif text == "%":
            section = None
        elif section is not None and "=" in text:
            key, _, value = text[1:].partition("=")
            section.setdefault(key.strip(), value.strip())
    raise FormatError(f"{source}: has no line %[DATA], so it is cut off before its samples; copy or export it again")


def _read_rows(stream: TextIO, width: int, line: int, source: str) -> list[array[float]]:
    """The cells of all rows, column by column; NaN for an empty one."""
    columns = [array("d") for _ in range(width)]
    while lines := stream.readlines(_BLOCK):
        if len(max(lines, key=len)) > MAX_LINE:
            raise FormatError(f"{source}: a line from {line + 1} on is longer than {MAX_LINE} characters; export it again")
        rows = [(n, row.strip().removesuffix(";").split(";")) for n, row in enumerate(lines, line + 1) if row.strip()]
        for n, row in rows:
            if len(row) != width:
                raise FormatError(
                    f"{source}, line {n}: has {len(row)} cells, expected are {width} (the time and {width - 1} curves); "
                    "the file may be cut off here or use decimal commas; export it again"
                )
        plain = _PLAIN.fullmatch("".join(lines)) is not None
        for n, row in rows:
            for column, cell in zip(columns, row, strict=True):
                column.append(_number(cell.strip(), plain, n, source))
        line += len(lines)
    if not columns[0]:
        raise FormatError(f"{source}: no row follows %[DATA]; record it again")
    return columns


def _number(cell: str, plain: bool, line: int, source: str) -> float:
    """A cell as a number, NaN if it is empty or says so."""
    if not cell or (not plain and cell.lower() == "nan"):
        return math.nan
    try:
        value = float(cell) if plain or _NUMBER.fullmatch(cell) else math.inf
    except ValueError:
        value = math.inf
    if not math.isfinite(value):
        hint = "write it with a decimal point" if "," in cell else "correct it"
        raise FormatError(f"{source}, line {line}: {cell[:40]!r} is not a finite number; {hint}")
    return value


def _cycle(curve: Mapping[str, str], where: str) -> float:
    """The cycle time of a curve [us]."""
    text = curve.get("CYCLETIME", "")
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    if not 1e-3 <= value < 1e12:
        raise FormatError(f"{where}: %CYCLETIME is {text[:40]!r}; a time in microseconds belongs there; export it again")
    return value


def _check_time(time: Array, cycle: float, line: int, source: str, notes: list[str]) -> None:
    """Check that the first column goes forward in equal steps; note if they are not the cycle time in microseconds."""
    if len(time) < 2:
        return
    with np.errstate(over="ignore", invalid="ignore"):
        steps = np.diff(time)
        step = float(np.median(steps))
    wrong = ~((steps > 0.5 * step) & (steps < 1.5 * step)) if step > 0 else np.ones(len(steps), bool)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise FormatError(
            f"{source}, row {row + 2} after %[DATA] (line {line}): its time {time[row + 1]:.12g} follows {time[row]:.12g}, "
            f"where rows are {step:.12g} apart; rows are missing, doubled or out of order; export it again"
        )
    if abs(step - cycle) > 0.01 * cycle:
        notes.append(
            f"the column of time goes in steps of {step:.12g}, of no stated unit; the clock is made of the shortest "
            f"cycle time, {cycle:.12g} us"
        )


def _samples(cells: Array, curve: Mapping[str, str], where: str, name: str, notes: list[str]) -> Array:
    """The samples of a curve: its first COUNT cells."""
    text = curve.get("COUNT", "")
    count = int(text) if re.fullmatch(r"\d{1,9}", text, re.ASCII) else 0
    if not count:
        raise FormatError(f"{where}: %COUNT is {text[:40]!r}; the number of its samples belongs there; export it again")
    if count > len(cells):
        raise FormatError(f"{where}: %COUNT promises {count} samples, {len(cells)} rows arrived; copy or export it again")
    values = cells[:count].copy()
    missing = int(np.isnan(values).sum())
    after = int(np.isfinite(cells[count:]).sum())
    if missing and after:
        raise FormatError(
            f"{where}: of its first {count} cells {missing} are empty, and {after} numbers stand after them; %COUNT does "
            "not tell which are samples; export it again"
        )
    if missing:
        notes.append(f"{name}: {missing} of {count} samples have no number")
    if after:
        notes.append(f"{name}: {after} numbers after its {count} samples are left out")
    return values


def _name(curve: Mapping[str, str], number: int, taken: Mapping[str, Channel]) -> str:
    """The type and axis of a curve; its number behind it if another has the same, or it has none."""
    name = f"{curve.get('CHANNELTYPE', '')} {curve.get('AXISTYPE', '')}".strip() or f"curve {number}"
    while name in taken:
        name = f"{name} ({number})"
    return name


def _unit(curve: Mapping[str, str], name: str, notes: list[str]) -> str:
    unit = curve.get("DIMENSION", "")
    if unit in UNITS:
        return unit
    notes.append(
        f"{name}: its unit {unit[:40]!r} is not known, so it has none" if unit else f"{name}: the file gives no unit"
    )
    return ""


def _sample() -> bytes:
    head = ["%[GLOBAL]", "%NAME=a sample, of no machine", "%"]
    for kind, unit in (("s actual", "mm"), ("i ist", "A")):
        head += ["%[CURVE]", f"%CHANNELTYPE={kind}", "%AXISTYPE=X", f"%DIMENSION={unit}", "%COUNT=3", "%CYCLETIME=600", "%"]
    rows = ["0;1.5;-0.25;", "600;1.75;0.5;", "1200;2;1e-17;"]
    return "\r\n".join([*head, "%[DATA]", *rows, ""]).encode()


register(LogFormat("TNCscope", ".sco", can_read, read_tncscope, _sample))
