"""Delimited text of a log, as controls, data loggers, spreadsheets and data-frame libraries write it.

One line of column headers, perhaps one of units, then one line for each sample. Units in the headers (`current_x_A`,
`Position X [mm]`) or under them are taken, a column without is left without (`X1_ActualVelocity`). The clock is the first
column that is named as one (`time`, `t`, `timestamp`, ...) and that says its unit (`Time [ms]`, `time_s`) or holds ISO 8601
timestamps. A time without a unit is a channel like any other, and a file without a clock is read without one. Separators,
decimal marks, encodings and comments are those of `run_csv`. A last line without a line end may be cut off, also inside a
number: it is left out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from itertools import islice
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log, in_time_order
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.text.delimited import MAX_LINE, NUMBER, Heading, comment_text, open_text, read_heading, split_cells
from elastogeo.formats.text.readings import DecimalMark
from elastogeo.formats.text.table import MAX_COLUMNS, SHOWN, problems_error
from elastogeo.formats.text.units import UNITS, check_unit, split_unit
from elastogeo.machine import Array

_BLOCK = 1 << 18
_PER_SECOND = {"s": 1.0, "sec": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6, "μs": 1e6, "ns": 1e9, "min": 1 / 60}
_UNIT = "|".join(_PER_SECOND)
_SAID = rf"(?: *[\[(] *(?P<unit>{_UNIT}) *[\])]|[ _]+(?P<tail>{_UNIT}))"
_NAMES = r"(?i:(?:(?:elapsed|relative|absolute|sample)[ _]?)?time(?:[ _]?stamp)?|date[ _]?time|zeit(?:stempel)?)"
_CLOCK = re.compile(rf"(?:{_NAMES}|t|T(?=[ _\[(])){_SAID}?")
_STAMP = re.compile(
    r"(?P<whole>\d{4}-\d{2}-\d{2}[T ]\d{2}:\d{2}:\d{2})(?:[.,](?P<part>\d{1,12}))?(?P<zone>Z|[+-]\d{2}:?\d{2})?", re.ASCII
)
_MAY_BE_EMPTY = frozenset(' \t\n\r\f\v"#%/;')
_NO_NUMBER = ("", "nan", "+nan", "-nan", "null", "none", "na", "n/a", "#n/a", "inf", "+inf", "-inf", "infinity", "-infinity")


def can_read(head: bytes) -> bool:
    """Whether these first bytes are text with a line of names and under it a line of as many cells, one of them a number."""
    if head.startswith((b"PAR1", b"<", b"{", b"[")):
        return False
    try:
        layout = _layout(open_text(head, cut=True), open_text(head, cut=True))
    except FormatError:
        return False
    if layout is None:
        return False
    headers = layout.heading.headers
    if len(headers) != len(layout.first) or not any(headers) or any(_is_value(h) or len(h) > 200 for h in headers):
        return False
    if len(headers) == 1 and not _CLOCK.fullmatch(headers[0]) and not _unit_of(headers[0])[0]:
        return False
    return any(NUMBER.fullmatch(cell) for cell in layout.first)


def read_csv_log(data: bytes, source: str) -> Log:
    """Read delimited text as a log.

    Raises
    ------
    FormatError
        If there is no header, if lines have another number of cells than it, or if two samples of one moment differ.
    """
    try:
        layout = _layout(open_text(data), open_text(data))
        stream = open_text(data)
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None
    if layout is None:
        raise FormatError(
            f"{source}: there is no line of column headers; write one such as 'time_s,position_x_mm,current_x_A'"
        )
    _check_headers(layout.heading.headers, f"{source}, line {layout.heading.line}")
    samples = _Samples(layout)
    samples.read(stream, ended=data[-2:].rstrip(b"\0")[-1:] in (b"\n", b"\r"))
    return samples.log(source)


@dataclass(frozen=True, slots=True)
class _Layout:
    """What stands above the samples: the heading, the units of a line of units, if there is one, and the first sample."""

    heading: Heading
    units: tuple[str, ...]
    first: tuple[str, ...]


def _layout(stream: TextIO, again: TextIO) -> _Layout | None:
    """Read to the first sample of a text that is open twice at its beginning; None if there are no headers."""
    heading = read_heading(stream)
    if heading is None or not heading.headers:
        return None
    rows = []
    for line in islice(again, heading.line, None):
        if not _is_empty(line, heading.separator):
            rows.append(tuple(cell.strip() for cell in split_cells(line[:MAX_LINE].rstrip("\n"), heading.separator)))
        if len(rows) == 2:
            break
    rows += [()] * 2
    if not _are_units(rows[0], len(heading.headers)):
        return _Layout(heading, (), rows[0])
    return _Layout(heading, tuple(cell.strip("[]()") for cell in rows[0]), rows[1])


def _are_units(cells: Sequence[str], width: int) -> bool:
    """Whether a line names units: no number in it, and at least half of its cells are units that are known."""
    said = [cell.strip("[]()") for cell in cells if cell]
    known = [cell for cell in said if cell in UNITS or cell in _PER_SECOND]
    return len(cells) == width and 2 * len(known) >= max(len(said), 1) and not any(map(_is_value, said))


def _is_empty(line: str, separator: str | None) -> bool:
    text = line.strip()
    return not text or comment_text(text, separator) is not None


def _check_headers(headers: Sequence[str], where: str) -> None:
    if len(headers) > MAX_COLUMNS:
        raise FormatError(f"{where}: {len(headers)} columns arrived, at most {MAX_COLUMNS} are read; split the file")
    named = [header for header in headers if header]
    twice = sorted({header for header in named if named.count(header) > 1})
    if twice:
        raise FormatError(f"{where}: several columns are named {twice[0]!r}; give each a name of its own")


@dataclass(slots=True)
class _Column:
    """One column while it is read: what of it is a number, a gap, or text."""

    header: str
    blocks: list[Array] = field(default_factory=list)
    numbers: int = 0
    gaps: int = 0
    texts: int = 0
    example: str = ""
    stamps: list[str] | None = None

    def take(self, cells: Sequence[str], line: int, decimal: DecimalMark) -> None:
        """Add the cells of a block of lines; `line` is the number of the first."""
        if self.stamps is not None:
            self.stamps += cells
            return
        self.blocks.append(self._values(cells, line, decimal))

    def _values(self, cells: Sequence[str], line: int, decimal: DecimalMark) -> Array:
        text = "\n".join(cells)
        comma, point = "," in text, "." in text
        mark = "," if comma else "." if point else ""
        if text.isascii() and "_" not in text and not (comma and point) and decimal.allows(mark) and not self.texts:
            try:
                values = np.array(list(map(float, (text.replace(",", ".") if comma else text).split("\n"))))
            except ValueError:
                pass
            else:
                decimal.settle(mark, text)
                return self._counted(values)
        return self._counted(np.array([self._value(cell.strip(), n, decimal) for n, cell in enumerate(cells, line)]))

    def _value(self, cell: str, line: int, decimal: DecimalMark) -> float:
        if NUMBER.fullmatch(cell):
            mark = "," if "," in cell else "." if "." in cell else ""
            if decimal.allows(mark):
                decimal.settle(mark, cell)
                return float(cell.replace(",", "."))
        elif cell.lower() in _NO_NUMBER:
            return math.nan
        self.texts += 1
        self.example = self.example or f"{cell[:40]!r} near line {line}"
        return math.nan

    def _counted(self, values: Array) -> Array:
        finite = np.isfinite(values)
        count = int(finite.sum())
        self.numbers += count
        self.gaps += len(values) - count
        if count < len(values):
            values[~finite] = np.nan
        return values

    def values(self) -> Array:
        """All values, shape (m,)."""
        return np.concatenate(self.blocks) if self.blocks else np.empty(0)


class _Samples:
    """The lines under a heading, read in blocks and turned into columns."""

    def __init__(self, layout: _Layout) -> None:
        self.heading, self.has_units = layout.heading, bool(layout.units)
        self.columns = [_Column(name) for name in layout.heading.headers]
        self.units = dict(zip(layout.heading.headers, layout.units, strict=False))
        self.decimal = DecimalMark(self.heading.metadata.get("decimal", ""))
        self.problems: list[str] = []
        self.notes: list[str] = []
        self.bad = self.rows = 0
        self.per_second = 1.0
        self.clock = self._clock(layout.first)

    def _clock(self, first: Sequence[str]) -> _Column | None:
        """The column that is the clock: named as one, with a unit or with timestamps in it."""
        for column, cell in zip(self.columns, first, strict=False):
            found = _CLOCK.fullmatch(column.header)
            if not found:
                continue
            unit = (found["unit"] or found["tail"] or self.units.get(column.header, "")).lower()
            if _STAMP.fullmatch(cell):
                column.stamps = []
                return column
            if unit in _PER_SECOND:
                self.per_second = _PER_SECOND[unit]
                return column
            name = column.header
            self.notes.append(f"column {name} says no unit, so it is no clock but a channel; write {name}_s or {name}_ms")
        return None

    def read(self, stream: TextIO, *, ended: bool) -> None:
        """Read all lines under the heading; `ended` says whether the last of them has its line end."""
        line = self.heading.line + 1
        for _ in range(self.heading.line):
            stream.readline()
        lines = stream.readlines(_BLOCK)
        while lines:
            following = stream.readlines(_BLOCK)
            if not following and not ended and not _is_empty(lines[-1], self.heading.separator):
                lines.pop()
                self.notes.append("the last line has no line end, so it may be cut off: left out")
            self._block(lines, line)
            line += len(lines)
            lines = following

    def _block(self, lines: list[str], number: int) -> None:
        separator, width = self.heading.separator, len(self.columns)
        rows: list[list[str]] = []
        for n, line in enumerate(lines, number):
            if line[:1] in _MAY_BE_EMPTY and _is_empty(line, separator):
                continue
            if self.has_units:
                self.has_units = False
                continue
            cells = split_cells(line.rstrip("\n"), separator) if len(line) <= MAX_LINE else []
            if len(cells) == width:
                rows.append(cells)
                continue
            self.bad += 1
            if len(self.problems) < SHOWN:
                self.problems.append(f"line {n} has {len(cells)} cells, the header has {width}; complete it or take it out")
        self.rows += len(rows)
        for column, of_column in zip(self.columns, zip(*rows, strict=True), strict=bool(rows)):
            column.take(of_column, number, self.decimal)

    def log(self, source: str) -> Log:
        """The log of what was read."""
        if self.bad:
            raise problems_error(source, self.problems, self.bad, "lines will not do (nothing was read)")
        if not self.rows:
            raise FormatError(f"{source}: no complete sample follows the column headers on line {self.heading.line}")
        self.decimal.check(source)
        values = {column.header: column.values() for column in self._numeric()}
        if not values:
            raise FormatError(f"{source}: no column but the clock holds numbers; {'; '.join(self.notes)}")
        time, keep = self._times(values, source)
        channels = {name: Channel(name, self._unit(name), v[keep], time) for name, v in values.items()}
        return Log(channels, self._metadata(), source, tuple(self.notes))

    def _numeric(self) -> list[_Column]:
        """The columns that are channels; a note on each that is not, and on missing numbers."""
        numeric: list[_Column] = []
        texts: list[str] = []
        broken: list[str] = []
        missing: list[str] = []
        for place, column in enumerate(self.columns, 1):
            if column is self.clock:
                continue
            if not column.header:
                if column.numbers or column.texts:
                    kind = "counts the rows" if _counts(column.values()) else "has no name"
                    self.notes.append(f"column {place} {kind}: left out")
            elif column.texts:
                mixed = f"{column.header} ({column.texts} of {self.rows}, {column.example})"
                (broken if column.numbers else texts).append(mixed if column.numbers else column.header)
            elif not column.numbers:
                self.notes.append(f"column {column.header} is empty: left out")
            else:
                numeric.append(column)
                if column.gaps:
                    missing.append(f"{column.header} ({column.gaps} of {self.rows})")
        if texts:
            self.notes.append(f"columns of text, left out: {', '.join(texts)}")
        if broken:
            self.notes.append(f"columns of numbers with something else among them, left out: {', '.join(broken)}")
        if missing:
            self.notes.append(f"samples without a number, kept as such: {', '.join(missing)}")
        return numeric

    def _times(self, values: Mapping[str, Array], source: str) -> tuple[Array | None, NDArray[np.intp]]:
        """The time of each sample [s] and the samples to take, in the order of their clock."""
        rows = np.arange(self.rows)
        if self.clock is None:
            return None, rows
        name = self.clock.header
        if self.clock.stamps is not None:
            time = _seconds(self.clock.stamps, f"{source}, column {name}")
        elif self.clock.texts:
            raise FormatError(f"{source}: the clock {name!r} holds {self.clock.example}; correct it")
        else:
            time = self.clock.values() / self.per_second
        rows = np.flatnonzero(np.isfinite(time))
        if not len(rows):
            raise FormatError(f"{source}: the clock {name!r} holds no time; export it again, or take the column out")
        if len(rows) < self.rows:
            self.notes.append(f"{self.rows - len(rows)} samples have no time: left out")
        keep, notes = in_time_order(time[rows], [v[rows] for v in values.values()], f"{source}, clock {name!r}")
        self.notes += notes
        return time[rows][keep], rows[keep]

    def _unit(self, header: str) -> str:
        """The unit of a column, from its header or the line of units; a note if it is not known."""
        unit, unknown = _unit_of(header)
        below = self.units.get(header, "")
        if not unit and not unknown and below not in ("", "-", "1"):
            unit, unknown = (below, "") if below in UNITS else ("", below)
        if unknown:
            self.notes.append(f"the unit {unknown!r} of column {header} is not known: its channel has none")
        return unit

    def _metadata(self) -> dict[str, str]:
        metadata = dict(self.heading.metadata)
        promised = metadata.pop("rows", "")
        if promised.isdecimal() and promised != str(self.rows):
            self.notes.append(f"the file promises {promised} samples, {self.rows} complete ones arrived")
        if self.clock is not None and self.clock.stamps:
            metadata["start"] = next(filter(None, map(str.strip, self.clock.stamps)))
        return metadata


def _seconds(cells: Sequence[str], where: str) -> Array:
    """Seconds since the first timestamp, shape (m,); NaN where a cell is empty.

    The whole seconds are counted as integers, so that no digit of the fraction is lost.
    """
    times = np.full(len(cells), np.nan)
    first: tuple[datetime, float] | None = None
    for k, cell in enumerate(map(str.strip, cells)):
        if cell.lower() in _NO_NUMBER:
            continue
        found = _STAMP.fullmatch(cell)
        try:
            if found is None:
                raise ValueError
            whole = datetime.fromisoformat(found["whole"] + (found["zone"] or ""))
        except ValueError:
            raise FormatError(
                f"{where}: {cell[:40]!r} of sample {k + 1} is no ISO 8601 time with its date; correct it"
            ) from None
        part = float(f"0.{found['part'] or 0}")
        first = first or (whole, part)
        if (whole.tzinfo is None) != (first[0].tzinfo is None):
            raise FormatError(
                f"{where}: {cell[:40]!r} of sample {k + 1}: some times have a zone and some have none; use one kind"
            )
        times[k] = (whole - first[0]).total_seconds() + (part - first[1])
    return times


def _unit_of(header: str) -> tuple[str, str]:
    """The unit that a header says, in a known spelling, and the unit in its brackets if that is not known."""
    try:
        quantity, unit = split_unit(header)
        if unit:
            check_unit(quantity, unit)
    except FormatError:
        bracketed = re.search(r"[\[(]([^\[\]()]{1,20})[\])]\s*$", header)
        return "", bracketed[1] if bracketed else ""
    return unit, ""


def _is_value(header: str) -> bool:
    """Whether a header is rather a number or a time, so that its line is no line of names."""
    return bool(NUMBER.fullmatch(header) or _STAMP.match(header))


def _counts(values: Array) -> bool:
    return bool(len(values) > 1 and (np.diff(values) == 1).all())


def _sample() -> bytes:
    return (
        b"# a sample, of no machine\n"
        b"time_ms,position_x_mm,current_x_A,State\n"
        b"0,10.0,0.5,idle\n2,10.25,0.75,idle\n4,10.75,nan,cut\n6,11.5,-0.25,cut\n"
    )


register(LogFormat("delimited text", ".csv", can_read, read_csv_log, _sample))
