"""Delimited text of a log, as controls, data loggers, spreadsheets and data-frame libraries write it.

One line of column headers, perhaps one of units, then one line for each sample; above them comments, pairs of key and
value, and any preamble. Units in the headers (`current_x_A`, `Position X [mm]`) or under them are taken, a column
without is left without (`X1_ActualVelocity`). The clock is the first column that is named as one (`time`, `t`,
`timestamp`, ...) and that says its unit (`Time [ms]`, `time_s`) or holds ISO 8601 timestamps. A time without a unit is
a channel like any other. A file without a clock may have a counter (`CYCLE`, `sample`, ...): what it leaves out is
missing in the log, too. Separators, decimal marks, encodings and comments are those of runs. A last line without a line
end may be cut off, also inside a number: it is left out.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log, in_time_order
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.logs.counters import counted
from elastogeo.formats.logs.timestamps import Timestamps
from elastogeo.formats.text.decimal_mark import DecimalMark, mark_of
from elastogeo.formats.text.delimited import MAX_LINE, NUMBER, comment_text, utf8_text
from elastogeo.formats.text.heading import PREAMBLE, STAMP, Heading, is_value, read_heading
from elastogeo.formats.text.rows import NO_NUMBER, Block, Rows, number_of
from elastogeo.formats.text.table import MAX_COLUMNS, SHOWN, problems_error
from elastogeo.formats.text.units import PER_SECOND, UNITS, check_unit, split_unit
from elastogeo.machine import Array

FEW = 0.5
"""Share of a column's cells that may be no numbers: with more, it is a column of text."""

_OTHER = re.compile(rb"PAR1|<|\s*[\[{]\s*[\[{\"\d\]}]")
"""How Parquet, XML and JSON begin."""
_UNIT = "|".join(PER_SECOND)
_SAID = rf"(?: *[\[(] *(?P<unit>{_UNIT}) *[\])]|[ _]+(?P<tail>{_UNIT}))"
_NAMES = r"(?i:(?:(?:elapsed|relative|absolute|sample)[ _]?)?time(?:[ _]?stamp)?|date[ _]?time|zeit(?:stempel)?)"
_CLOCK = re.compile(rf"(?:{_NAMES}|t|T(?=[ _\[(])){_SAID}?")


def can_read(head: bytes) -> bool:
    """Whether these first bytes are text with a line of names and under it a line of as many cells, one of them a number."""
    if _OTHER.match(head):
        return False
    try:
        heading = read_heading(utf8_text(head, cut=True))
    except FormatError:
        return False
    if heading is None:
        return False
    headers = heading.headers
    if not heading.has_numbers or not any(headers) or any(is_value(h) or len(h) > 200 for h in headers):
        return False
    if len(headers) == 1 and not _CLOCK.fullmatch(headers[0]) and not _unit_of(headers[0])[0]:
        return False
    return any(map(NUMBER.fullmatch, heading.cells))


def read_csv_log(data: bytes, source: str) -> Log:
    """Read delimited text as a log.

    Raises
    ------
    FormatError
        If there is no header, if lines have another number of cells than it, or if two samples of one moment differ.
    """
    try:
        text = utf8_text(data)
        heading = read_heading(text)
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None
    if heading is None or not heading.headers:
        raise FormatError(
            f"{source}: there is no line of column headers; write one such as 'time_s,position_x_mm,current_x_A'"
        )
    _check_headers(heading.headers, f"{source}, line {heading.line}")
    samples = _Samples(heading)
    samples.read(text)
    return samples.log(source)


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
    examples: dict[str, int] = field(default_factory=dict)
    stamps: Timestamps | None = None

    def take(self, found: Array | list[str], lines: Sequence[int], decimal: DecimalMark) -> None:
        """Add the cells of a block of lines, whose numbers are given."""
        if self.stamps is not None:
            self.stamps.take(found if isinstance(found, list) else [repr(value) for value in found.tolist()])
            return
        if isinstance(found, list):
            found = self._values(found, lines, decimal)
        finite = np.isfinite(found)
        count = int(finite.sum())
        self.numbers += count
        self.gaps += len(found) - count
        self.blocks.append(found)

    def _values(self, cells: list[str], lines: Sequence[int], decimal: DecimalMark) -> Array:
        """The numbers among cells, each spelling looked at once; what is neither number nor gap is counted as text."""
        known: dict[str, float] = {}
        odd: set[str] = set()
        for cell, line in zip(cells, lines, strict=True):
            if cell in known:
                continue
            value = number_of(cell, decimal)
            known[cell] = np.nan if value is None else value
            if value is None and not _is_gap(cell, decimal):
                odd.add(cell)
                if len(self.examples) < SHOWN:
                    self.examples.setdefault(cell, line)
        if odd:
            self.texts += sum(cell in odd for cell in cells)
        return np.array([known[cell] for cell in cells])

    @property
    def example(self) -> str:
        """The first cells that are no numbers, each with its line."""
        return ", ".join(f"{cell[:40]!r} on line {line}" for cell, line in list(self.examples.items())[:SHOWN])

    def values(self) -> Array:
        """All values, shape (m,)."""
        return np.concatenate(self.blocks) if self.blocks else np.empty(0)


class _Samples:
    """The lines under a heading, turned into columns."""

    def __init__(self, heading: Heading) -> None:
        self.heading = heading
        self.columns = [_Column(name) for name in heading.headers]
        self.units = dict(zip(heading.headers, heading.units, strict=False))
        self.problems: list[str] = []
        self.notes: list[str] = []
        self.bad = self.rows = 0
        self.per_second = 1.0
        self.clock = self._clock(heading.cells)
        self.decimal = DecimalMark()

    def _clock(self, first: Sequence[str]) -> _Column | None:
        """The column that is the clock: named as one, with a unit or with timestamps in it."""
        for column, cell in zip(self.columns, first, strict=False):
            found = _CLOCK.fullmatch(column.header)
            if not found:
                continue
            unit = (found["unit"] or found["tail"] or self.units.get(column.header, "")).lower()
            if STAMP.fullmatch(cell):
                column.stamps = Timestamps()
                return column
            if unit in PER_SECOND:
                self.per_second = PER_SECOND[unit]
                return column
            name = column.header
            self.notes.append(f"column {name} says no unit, so it is no clock but a channel; write {name}_s or {name}_ms")
        return None

    def read(self, text: bytes) -> None:
        """Read all lines under the heading of a text; the last of them only if it has its line end."""
        whole = text.rfind(b"\n") + 1
        rows = Rows(text[:whole] if whole < len(text) else text, self.heading, gaps=True)
        self.decimal = rows.decimal
        last = text[whole:].decode("utf-8", "replace").strip()
        if last and comment_text(last, self.heading.separator) is None:
            self.notes.append("the last line has no line end, so it may be cut off: left out")
        for block in rows.blocks():
            self._block(block)

    def _block(self, block: Block) -> None:
        width = len(self.columns)
        for line in block.uneven[: max(0, SHOWN - len(self.problems))]:
            self.problems.append(
                f"line {line.number} is longer than {MAX_LINE} characters; put one sample on a line"
                if len(line.text) > MAX_LINE
                else f"line {line.number} has {line.cells} cells, the header has {width}; complete it or take it out"
            )
        self.bad += len(block.uneven)
        self.rows += len(block.lines)
        for column, found in zip(self.columns, block.columns, strict=True):
            column.take(found, block.lines, self.decimal)

    def log(self, source: str) -> Log:
        """The log of what was read."""
        if self.bad:
            raise problems_error(source, self.problems, self.bad, "lines cannot be read (nothing was read)")
        if not self.rows:
            raise FormatError(f"{source}: no complete sample follows the column headers on line {self.heading.line}")
        self.decimal.check(source)
        if PREAMBLE in self.heading.metadata:
            self.notes.append(f"lines above the column headers on line {self.heading.line} were not understood: left out")
        values = {column.header: column.values() for column in self._numeric()}
        if not values:
            raise FormatError(f"{source}: no column but the clock holds numbers; {'; '.join(self.notes)}")
        counter = self._counter(values, source) if self.clock is None else ""
        time, keep = self._times(values, source)
        if keep is not None:
            values = {name: column[keep] for name, column in values.items()}
        channels = {name: Channel(name, self._unit(name), column, time) for name, column in values.items()}
        return Log(channels, self._metadata(), source, tuple(self.notes), counter)

    def _numeric(self) -> list[_Column]:
        """The columns that are channels; a note on each that is not, and on missing numbers."""
        numeric: list[_Column] = []
        texts: list[str] = []
        missing: list[str] = []
        for place, column in enumerate(self.columns, 1):
            if column is self.clock:
                continue
            if not column.header:
                if column.numbers or column.texts:
                    kind = "counts the rows" if _counts(column.values()) else "has no name"
                    self.notes.append(f"column {place} {kind}: left out")
                continue
            if column.texts and not column.numbers:
                texts.append(column.header)
            elif not column.numbers:
                self.notes.append(f"column {column.header} is empty: left out")
            elif self._is_kept(column):
                numeric.append(column)
                if column.gaps > column.texts:
                    missing.append(f"{column.header} ({column.gaps - column.texts} of {self.rows})")
        if texts:
            self.notes.append(f"columns of text, left out: {', '.join(texts)}")
        if missing:
            self.notes.append(f"samples without a number, kept as such: {', '.join(missing)}")
        return numeric

    def _is_kept(self, column: _Column) -> bool:
        """Whether a column that holds numbers is a channel: one with text in most of its cells is none."""
        if not column.texts:
            return True
        kept = column.texts <= FEW * self.rows
        cells = "cells is no number" if column.texts == 1 else "cells are no numbers"
        done = "kept as samples without a number" if kept else "the column is left out"
        mark = f" of the decimal mark {self.decimal.mark!r}" if any(map(NUMBER.fullmatch, column.examples)) else ""
        self.notes.append(f"column {column.header}: {column.texts} of {self.rows} {cells}{mark} ({column.example}): {done}")
        return kept

    def _counter(self, values: dict[str, Array], source: str) -> str:
        """The name of the column that counts the samples, with the counts in place of its values; empty without one."""
        for name in values:
            counts = counted(name, values[name], f"{source}, column {name}", self.notes)
            if counts is not None:
                values[name] = counts
                return name
        return ""

    def _times(self, values: Mapping[str, Array], source: str) -> tuple[Array | None, NDArray[np.intp] | None]:
        """The time of each sample [s], and the samples to take in the order of their clock; None for all as they stand."""
        if self.clock is None:
            return None, None
        name = self.clock.header
        if self.clock.stamps is not None:
            time = self.clock.stamps.seconds(f"{source}, column {name}")
        elif self.clock.texts:
            raise FormatError(f"{source}: the clock {name!r} holds {self.clock.example}; correct it")
        else:
            time = self.clock.values() / self.per_second
        if (np.diff(time) > 0).all() and np.isfinite(time).all():
            return time, None
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
        if self.clock is not None and self.clock.stamps is not None:
            metadata["start"] = self.clock.stamps.first
        return metadata


def _is_gap(cell: str, decimal: DecimalMark) -> bool:
    """Whether a cell that is no finite number says that there is none, or a number that is too large."""
    return cell.lower() in NO_NUMBER or (NUMBER.fullmatch(cell) is not None and decimal.allows(mark_of(cell)))


def _unit_of(header: str) -> tuple[str, str]:
    """The unit that a header says, in a known spelling, and the unit in its brackets if that is not known."""
    try:
        quantity, unit = split_unit(header)
        if unit:
            check_unit(quantity, unit, percent=True)
    except FormatError:
        bracketed = re.search(r"[\[(]([^\[\]()]{1,20})[\])]\s*$", header)
        return "", bracketed[1] if bracketed else ""
    return unit, ""


def _counts(values: Array) -> bool:
    return bool(len(values) > 1 and (np.diff(values) == 1).all())


def _sample() -> bytes:
    return (
        b"# a sample, of no machine\n"
        b"time_ms,position_x_mm,current_x_A,State\n"
        b"0,10.0,0.5,idle\n2,10.25,0.75,idle\n4,10.75,nan,cut\n6,11.5,-0.25,cut\n"
    )


register(LogFormat("delimited text", ".csv", can_read, read_csv_log, _sample))
