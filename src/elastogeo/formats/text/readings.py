"""The numbers of a delimited text: every line is taken, or the whole file is refused with its bad lines counted."""

from __future__ import annotations

import math
import re
from itertools import chain
from typing import TextIO

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.text.delimited import MAX_LINE, NUMBER, Heading, comment_text, split_cells
from elastogeo.formats.text.table import SHOWN, Column, Table, problems_error
from elastogeo.machine import Array

_BLOCK = 32_768
_SURELY_DECIMAL = re.compile(r",(?!\d\d\d)|,\d{3}[\deE]|(?<!\d),|\d{4},|(?<!\d)0\d*,", re.ASCII)
_MARKS = {",": ",", "comma": ",", ".": ".", "point": "."}
_NOT_FINITE = ("nan", "inf", "infinity", "-nan", "-inf", "-infinity", "+nan", "+inf", "+infinity")
_THOUSANDS = re.compile(r"[-+]?\d{1,3}([ .,'\u00a0\u202f_]\d{3})+([.,]\d*)?", re.ASCII)


class DecimalMark:
    """The decimal mark of a text, learnt from its numbers, and whether a comma has shown that it is not one for thousands.

    Attributes
    ----------
    mark : str
        `,` or `.`; empty until a number has shown one.
    """

    def __init__(self, said: str = "") -> None:
        """Take what the text says of itself: `comma`, `point`, or nothing."""
        self.mark = _MARKS.get(said.lower(), "")
        self.sure = self.mark != ""
        self.doubtful = ""

    def allows(self, mark: str) -> bool:
        """Whether a number with this mark (empty: with none) fits those before it."""
        return not mark or self.mark in ("", mark)

    def settle(self, mark: str, text: str) -> None:
        """Learn from a text whose numbers have this mark."""
        self.mark = self.mark or mark
        if mark == "," and not self.sure:
            self.sure = _SURELY_DECIMAL.search(text) is not None
            if not self.doubtful and (found := re.search(r"\d{1,3},\d{3}", text)):
                self.doubtful = found[0]

    def check(self, source: str) -> None:
        """Raise a `FormatError` if the commas may as well be marks for thousands."""
        if self.mark == "," and not self.sure:
            raise FormatError(
                f"{source}: the commas, as in {_clip(self.doubtful)}, may be decimal marks or marks for "
                "thousands; say which by a line '# decimal: comma' above the header, or write the numbers without commas"
            )


class Readings:
    """The numbers under a heading: parsed in blocks of lines, line by line only where something is not plain."""

    def __init__(self, heading: Heading, columns: list[Column]) -> None:
        self.heading, self.columns = heading, columns
        self.separator = heading.separator
        self.decimal = DecimalMark(heading.metadata.get("decimal", ""))
        self.blocks: list[list[Array]] = [[] for _ in columns]
        self.problems: list[str] = []
        self.bad = self.rows = self.line = 0

    def read(self, stream: TextIO) -> None:
        """Read all lines under the heading of a text that is open at its beginning."""
        for _ in range(self.heading.line):
            stream.readline()
        self.line = self.heading.line
        while lines := stream.readlines(_BLOCK):
            self._block(lines)
            self.line += len(lines)

    def _block(self, lines: list[str]) -> None:
        values = self._plain(lines)
        if values is None:
            kept = [n for n, line in enumerate(lines) if not self._is_empty(line)]
            if 0 < len(kept) < len(lines):
                values = self._plain([lines[n] for n in kept])
            if values is None:
                rows = [row for n in kept if (row := self._row(lines[n], self.line + n + 1))]
                values = np.array(rows, dtype=np.float64).reshape(-1, len(self.columns))
        self.rows += len(values)
        for column, block, stored in zip(self.columns, values.T, self.blocks, strict=True):
            if not self.bad:
                stored.append(column.internal(block))

    def _is_empty(self, line: str) -> bool:
        text = line.strip()
        return not text or comment_text(text, self.separator) is not None

    def _plain(self, lines: list[str]) -> Array | None:
        """Parse lines that hold nothing but finite numbers of one decimal mark; None if there is anything else."""
        text = "".join(lines)
        if not text.isascii() or "_" in text or '"' in text or len(max(lines, key=len)) > MAX_LINE:
            return None
        comma, point = self.separator != "," and "," in text, "." in text
        mark = "," if comma else "." if point else ""
        if (comma and point) or not self.decimal.allows(mark):
            return None
        if comma:
            lines = text.replace(",", ".").removesuffix("\n").split("\n")
        rows = [line.split(self.separator) for line in lines]
        width = len(self.columns)
        if any(len(row) != width for row in rows):
            return None
        try:
            values = np.array(list(map(float, chain.from_iterable(rows))))
        except ValueError:
            return None
        if not np.isfinite(values).all():
            return None
        self.decimal.settle(mark, text)
        return values.reshape(-1, width)

    def _row(self, line: str, number: int) -> list[float] | None:
        """Parse one line cell by cell; None, counted and for the first five explained, if it will not do."""
        row = self._values(line)
        if row is None:
            self.bad += 1
            if len(self.problems) < SHOWN:
                self.problems.append(f"line {number}, {self._why(line)}")
        return row

    def _values(self, line: str) -> list[float] | None:
        if len(line) > MAX_LINE:
            return None
        cells = split_cells(line.rstrip("\n"), self.separator)
        if len(cells) != len(self.columns):
            return None
        row = []
        for cell in map(str.strip, cells):
            mark = "," if "," in cell else "." if "." in cell else ""
            if not NUMBER.fullmatch(cell) or not self.decimal.allows(mark):
                return None
            row.append(float(cell.replace(",", ".")))
            self.decimal.settle(mark, cell)
        return row if all(map(math.isfinite, row)) else None

    def _why(self, line: str) -> str:
        """What is wrong with a line that `_values` refused."""
        if len(line) > MAX_LINE:
            return f"is longer than {MAX_LINE} characters; put one reading on a line"
        cells = split_cells(line.rstrip("\n"), self.separator)
        if len(cells) != len(self.columns):
            return self._miscounted(len(cells), line)
        reasons = ((c.header, self._reason(cell.strip())) for c, cell in zip(self.columns, cells, strict=True))
        return next(f"column {header}: {reason}" for header, reason in reasons if reason)

    def _miscounted(self, count: int, line: str) -> str:
        wanted = ", ".join(column.header for column in self.columns[:8])
        cells = f"{count} cell{'s' if count > 1 else ''}"
        text = f"{_clip(line.strip())} has {cells}, expected are {len(self.columns)} ({wanted})"
        if not line.endswith("\n") and count < len(self.columns):
            return f"{text}: the file may be cut off here; copy or export it again"
        if self.separator == "," and count > len(self.columns):
            return f"{text}; if its commas are decimal marks, separate the columns by semicolons"
        return f"{text}; complete the line or take it out"

    def _reason(self, cell: str) -> str:
        """Why a cell is not taken; empty if it is."""
        if not cell:
            return "the cell is empty; fill it in or take the whole line out"
        if cell.lower() in _NOT_FINITE:
            return f"{cell!r} is no reading; take the whole line out if the reading is missing"
        if NUMBER.fullmatch(cell):
            mark = "," if "," in cell else "." if "." in cell else ""
            if not self.decimal.allows(mark):
                return f"{_clip(cell)} has the decimal mark {mark!r}, but the file uses {self.decimal.mark!r}; use one"
            finite = math.isfinite(float(cell.replace(",", ".")))
            return "" if finite else f"{_clip(cell)} is too large for a number; correct it"
        if _THOUSANDS.fullmatch(cell):
            return f"{_clip(cell)} seems to have marks for thousands; write the number without them"
        return f"{_clip(cell)} is not a number; correct it or take the whole line out"

    def table(self, source: str, *, ended: bool) -> Table:
        """Return what was read, in internal units.

        Parameters
        ----------
        source : str
            The file, for messages.
        ended : bool
            Whether its last line has a line end.

        Raises
        ------
        FormatError
            If a line was bad, there was none, the decimal mark is in doubt, or fewer arrived than the file promises.
        """
        if self.bad:
            raise problems_error(source, self.problems, self.bad, "lines will not do (nothing was read)")
        if not self.rows:
            raise FormatError(f"{source}: no reading follows the column header on line {self.heading.line}")
        self.decimal.check(source)
        metadata = dict(self.heading.metadata)
        promised = metadata.get("rows", "")
        if re.fullmatch(r"\d{1,15}", promised, re.ASCII):
            del metadata["rows"]
            if int(promised) != self.rows or not ended:
                raise FormatError(
                    f"{source}: its line 'rows' promises {promised} complete lines of readings, {self.rows} arrived"
                    f"{'' if ended else ' and the last has no end'}; copy it again, or correct the line if it was edited"
                )
        columns = {}
        for column, blocks in zip(self.columns, self.blocks, strict=True):
            columns[column.quantity] = np.concatenate(blocks)
            blocks.clear()
        return Table(columns, metadata, source)


def _clip(text: str) -> str:
    return repr(text if len(text) <= 40 else f"{text[:40]}…")
