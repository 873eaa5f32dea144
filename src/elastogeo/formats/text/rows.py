"""The lines under the heading of a delimited text, in blocks: columns of plain numbers as arrays, all others as cells.

Runs and logs share this; they differ in what they do with a cell that is no plain number. A block of a large text is read by
pyarrow, which takes plain numbers of one decimal mark only; what it refuses, and every small text, is split here. Both
read a number as the same double.
"""

from __future__ import annotations

import functools
import importlib
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from elastogeo.formats.text.decimal_mark import DecimalMark, mark_of
from elastogeo.formats.text.delimited import MAX_LINE, NUMBER, comment_text, split_cells
from elastogeo.formats.text.heading import Heading
from elastogeo.machine import Array

NO_NUMBER = (
    *("", "nan", "+nan", "-nan", "null", "none", "na", "n/a", "#n/a"),
    *("inf", "+inf", "-inf", "infinity", "+infinity", "-infinity"),
)
"""Cells, in lower case, that say that there is a sample but no number."""

_BLOCK, _SMALL_BLOCK = 1 << 15, 1 << 13
"""Bytes that are taken at once of a large text and of any other: what is split into cells takes a hundred times its size."""
_LARGE = 1 << 20
"""Bytes from which a text is worth the time that it takes to load pyarrow."""
_MAY_BE_EMPTY = np.isin(np.arange(256), list(b' \t\f\v\n"#%/;'))
_BLANKS = re.compile(rb"[ \t]+")
_EDGES = re.compile(rb"(?m)^ | $")
_PLUS = re.compile(rb"(?m)(^|[;,|\t ])\+(?=[\d.])")


@dataclass(frozen=True, slots=True)
class Uneven:
    """A line that has another number of cells than the header: its number, its text, its cells, whether it has an end."""

    number: int
    text: str
    cells: int
    ended: bool


@dataclass(frozen=True, slots=True)
class Block:
    """Some lines of a text.

    Attributes
    ----------
    lines : sequence of int
        The number of each line that has as many cells as the header, shape (m,).
    columns : sequence of array, or of list of str
        By header. An array, shape (m,), where every cell is a plain number of the text's decimal mark (or, where gaps are
        allowed, none: NaN); otherwise the cells, stripped.
    uneven : sequence of Uneven
    """

    lines: Sequence[int]
    columns: Sequence[Array | list[str]]
    uneven: Sequence[Uneven] = ()


class Rows:
    """The lines under a heading.

    Parameters
    ----------
    text : bytes
        As `utf8_text` gives it.
    heading : Heading
        Of that text.
    gaps : bool
        Whether a cell may hold no number (`NO_NUMBER`).
    """

    def __init__(self, text: bytes, heading: Heading, *, gaps: bool) -> None:
        self.text, self.heading, self.gaps = text, heading, gaps
        self.decimal = DecimalMark(heading.metadata.get("decimal", ""))
        self._texts: set[int] = set()

    def blocks(self) -> Iterator[Block]:
        """All lines under the heading that are no comments, in blocks."""
        at, number = 0, 1
        while number <= self.heading.body and at < len(self.text):
            at = self.text.find(b"\n", at) + 1 or len(self.text)
            number += 1
        size = _BLOCK if len(self.text) >= _LARGE else _SMALL_BLOCK
        while at < len(self.text):
            end = self.text.find(b"\n", at + size) + 1 or len(self.text)
            raw = self.text[at:end]
            yield self._block(raw, number)
            number += raw.count(b"\n")
            at = end

    def _block(self, raw: bytes, number: int) -> Block:
        ends = np.flatnonzero(np.frombuffer(raw, np.uint8) == ord("\n"))
        if not raw.endswith(b"\n"):
            ends = np.append(ends, len(raw))
        starts = np.append(0, ends[:-1] + 1)
        longest = int((ends - starts).max())
        lines: Sequence[int] = range(number, number + len(starts))
        suspects = np.flatnonzero(_MAY_BE_EMPTY[np.frombuffer(raw, np.uint8)[starts]])
        texts: list[str] | None = None
        if len(suspects):
            texts = self._lines(raw)
            empty = {k for k in suspects.tolist() if self._is_empty(texts[k])}
            if empty:
                lines = [n for k, n in enumerate(lines) if k not in empty]
                texts = [text for k, text in enumerate(texts) if k not in empty]
                raw = "\n".join(texts).encode() + (b"\n" if raw.endswith(b"\n") else b"")
        if not lines:
            return Block((), [np.empty(0) for _ in self.heading.headers])
        if len(self.text) >= _LARGE and longest <= MAX_LINE:
            columns = self._by_arrow(raw, len(lines))
            if columns is not None:
                return Block(lines, columns)
        return self._split(texts or self._lines(raw), lines, ended=raw.endswith(b"\n"))

    def _lines(self, raw: bytes) -> list[str]:
        lines = raw.decode("utf-8", "replace").split("\n")
        return lines[:-1] if raw.endswith(b"\n") else lines

    def _is_empty(self, line: str) -> bool:
        text = line.strip()
        return not text or comment_text(text, self.heading.separator) is not None

    def _by_arrow(self, raw: bytes, count: int) -> list[Array | list[str]] | None:
        """The columns as pyarrow reads them; None where it does not read every number of the block."""
        separator = self.heading.separator
        mark = "," if separator != "," and b"," in raw else ""
        if b'"' in raw or (mark and (b"." in raw or self._texts)):
            return None
        mark = mark or ("." if b"." in raw and not self._texts else "")
        if not self.decimal.allows(mark):
            return None
        plain = _EDGES.sub(b"", _BLANKS.sub(b" ", raw)) if separator is None else raw
        try:
            table = self._table(_PLUS.sub(rb"\1", plain) if b"+" in plain else plain, mark)
        except _arrow().ArrowInvalid:
            return None
        if table.num_rows != count:
            return None
        columns = [self._column(k, column) for k, column in enumerate(table.columns)]
        if any(column is None for column in columns):
            return None
        if mark:
            self.decimal.settle(mark, raw.decode() if mark == "," else "")
        return [column for column in columns if column is not None]

    def _table(self, raw: bytes, mark: str) -> Any:
        arrow, csv = _arrow(), _arrow_csv()
        names = [str(k) for k in range(len(self.heading.headers))]
        return csv.read_csv(
            arrow.BufferReader(raw),
            read_options=csv.ReadOptions(column_names=names, use_threads=False, block_size=len(raw) + 1),
            parse_options=csv.ParseOptions(
                delimiter=self.heading.separator or " ", quote_char=False, ignore_empty_lines=False
            ),
            convert_options=csv.ConvertOptions(
                column_types={name: arrow.string() if k in self._texts else arrow.float64() for k, name in enumerate(names)},
                decimal_point=mark or ".",
                null_values=_nulls() if self.gaps else [],
                strings_can_be_null=False,
            ),
        )

    def _column(self, place: int, column: Any) -> Array | list[str] | None:
        """One column of a block; None if it holds something that is no finite number, where that is not allowed."""
        if place in self._texts:
            cells = [cell.strip() for cell in column.to_pylist()]
            return self._numbers(cells, place)
        values = np.array(column.to_numpy(), dtype=np.float64)
        finite = np.isfinite(values)
        if not finite.all():
            if not self.gaps:
                return None
            values[~finite] = np.nan
        return values

    def _split(self, texts: Sequence[str], lines: Sequence[int], *, ended: bool) -> Block:
        """The columns of lines, cell by cell."""
        separator, width = self.heading.separator, len(self.heading.headers)
        rows: list[list[str]] = []
        kept: list[int] = []
        uneven = []
        for k, (text, number) in enumerate(zip(texts, lines, strict=True)):
            cells = split_cells(text, separator) if len(text) <= MAX_LINE else []
            if len(cells) == width:
                rows.append(cells)
                kept.append(number)
            else:
                uneven.append(Uneven(number, text, len(cells), ended or k < len(texts) - 1))
        if not rows:
            return Block((), [np.empty(0) for _ in range(width)], uneven)
        columns = [self._numbers(cells, place) for place, cells in enumerate(zip(*rows, strict=True))]
        return Block(kept if uneven else lines, columns, uneven)

    def _numbers(self, cells: Sequence[str], place: int) -> Array | list[str]:
        """The numbers of a column of a block, or its cells if there is anything else among them."""
        values = self._plain(cells)
        if values is not None:
            return values
        self._texts.add(place)
        return [cell.strip() for cell in cells]

    def _plain(self, cells: Sequence[str]) -> Array | None:
        text = "\n".join(cells)
        comma, point = "," in text, "." in text
        mark = "," if comma else "." if point else ""
        if not text.isascii() or "_" in text or (comma and point) or not self.decimal.allows(mark):
            return None
        try:
            values = np.array(list(map(float, (text.replace(",", ".") if comma else text).split("\n"))))
        except ValueError:
            return None
        finite = np.isfinite(values)
        if not finite.all():
            if not self.gaps:
                return None
            values[~finite] = np.nan
        self.decimal.settle(mark, text)
        return values


def number_of(cell: str, decimal: DecimalMark) -> float | None:
    """The value of a cell that is a plain finite number of the text's decimal mark; None of any other cell."""
    mark = mark_of(cell)
    if not NUMBER.fullmatch(cell) or not decimal.allows(mark):
        return None
    value = float(cell.replace(",", "."))
    if not math.isfinite(value):
        return None
    decimal.settle(mark, cell)
    return value


@functools.cache
def _nulls() -> list[str]:
    return sorted({spelled for cell in NO_NUMBER for spelled in (cell, cell.upper(), cell.capitalize(), _camel(cell))})


def _camel(cell: str) -> str:
    return cell.replace("nan", "NaN").replace("n/a", "N/A")


@functools.cache
def _arrow() -> Any:
    return importlib.import_module("pyarrow")


@functools.cache
def _arrow_csv() -> Any:
    return importlib.import_module("pyarrow.csv")
