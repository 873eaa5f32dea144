"""The numbers of a delimited text of a run: every line is taken, or the whole file is refused with its bad lines counted."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.text.decimal_mark import mark_of
from elastogeo.formats.text.delimited import MAX_LINE, NUMBER
from elastogeo.formats.text.heading import Heading
from elastogeo.formats.text.rows import Block, Rows, Uneven, number_of
from elastogeo.formats.text.table import SHOWN, Column, Table, problems_error
from elastogeo.machine import Array

_NOT_FINITE = ("nan", "inf", "infinity", "-nan", "-inf", "-infinity", "+nan", "+inf", "+infinity")
_SIDES = {
    **dict.fromkeys(("+", "↑", "up", "pos", "positive", "forward", "fwd"), 1.0),
    **dict.fromkeys(("-", "−", "↓", "down", "neg", "negative", "backward", "reverse", "rev"), -1.0),
}
"""How a column `direction` says from which side an axis comes to a target (ISO 230-2)."""
_THOUSANDS = re.compile(r"[-+]?\d{1,3}([ .,'\u00a0\u202f_]\d{3})+([.,]\d*)?", re.ASCII)


class Readings:
    """The readings under a heading.

    Parameters
    ----------
    text : bytes
        As `utf8_text` gives it.
    heading : Heading
    columns : list of Column or None
        What each header means; None for a column that is not taken, whose cells may hold anything.
    """

    def __init__(self, text: bytes, heading: Heading, columns: Sequence[Column | None]) -> None:
        self.heading, self.columns = heading, columns
        self._rows = Rows(text, heading, gaps=False)
        self.decimal = self._rows.decimal
        self.separator = heading.separator
        self.blocks: list[list[Array]] = [[] for _ in columns]
        self.problems: list[str] = []
        self.bad = self.rows = 0

    def read(self) -> None:
        """Read all lines under the heading."""
        for block in self._rows.blocks():
            columns, refused = self._refused(block)
            wrong: list[tuple[int, int | Uneven]] = [(block.lines[row], row) for row in refused]
            wrong += [(one.number, one) for one in block.uneven]
            self.bad += len(wrong)
            for number, what in sorted(wrong, key=lambda pair: pair[0])[: SHOWN - len(self.problems)]:
                why = self._miscounted(what) if isinstance(what, Uneven) else self._why(block, what)
                self.problems.append(f"line {number}, {why}")
            self.rows += len(block.lines)
            if not self.bad:
                for column, values, stored in zip(self.columns, columns, self.blocks, strict=True):
                    if column is not None:
                        stored.append(column.internal(values))

    def _refused(self, block: Block) -> tuple[list[Array], list[int]]:
        """The numbers of a block, and its rows with a cell that is none."""
        columns: list[Array] = []
        refused: set[int] = set()
        for column, found in zip(self.columns, block.columns, strict=True):
            if isinstance(found, list) and column is not None:
                values = [self._value(cell, column) for cell in found]
                refused |= {row for row, value in enumerate(values) if value is None}
                columns.append(np.array([math.nan if value is None else value for value in values]))
            else:
                columns.append(np.empty(0) if isinstance(found, list) else found)
        return columns, sorted(refused)

    def _value(self, cell: str, column: Column) -> float | None:
        """The number of a cell; +1 or -1 of one that says a direction; None of any other."""
        if column.quantity == "direction" and cell.lower() in _SIDES:
            return _SIDES[cell.lower()]
        return number_of(cell, self.decimal)

    def _why(self, block: Block, row: int) -> str:
        """What is wrong with a row of a block."""
        for column, found in zip(self.columns, block.columns, strict=True):
            if column is None or not isinstance(found, list):
                continue
            reason = self._reason(found[row], column)
            if reason:
                return f"column {column.header}: {reason}"
        raise AssertionError(row)

    def _miscounted(self, line: Uneven) -> str:
        """What is wrong with a line of too many or too few cells."""
        if len(line.text) > MAX_LINE:
            return f"is longer than {MAX_LINE} characters; put one reading on a line"
        count, wanted = line.cells, ", ".join(self.heading.headers[:8])
        cells = f"{count} cell{'s' if count > 1 else ''}"
        text = f"{_clip(line.text.strip())} has {cells}, expected are {len(self.columns)} ({wanted})"
        if not line.ended and count < len(self.columns):
            return f"{text}: the file may be cut off here; copy or export it again"
        if self.separator == "," and count > len(self.columns):
            return f"{text}; if its commas are decimal marks, separate the columns by semicolons"
        return f"{text}; complete the line or take it out"

    def _reason(self, cell: str, column: Column) -> str:
        """Why a cell is not taken; empty if it is."""
        if column.quantity == "direction" and cell.lower() in _SIDES:
            return ""
        if not cell:
            return "the cell is empty; fill it in or take the whole line out"
        if cell.lower() in _NOT_FINITE:
            return f"{cell!r} is no reading; take the whole line out if the reading is missing"
        if NUMBER.fullmatch(cell):
            mark = mark_of(cell)
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
            raise problems_error(source, self.problems, self.bad, "lines cannot be read (nothing was read)")
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
        columns, units = {}, {}
        for column, blocks in zip(self.columns, self.blocks, strict=True):
            if column is not None:
                units[column.quantity] = column.unit
                columns[column.quantity] = np.concatenate(blocks)
                blocks.clear()
        return Table(columns, metadata, source, units)


def _clip(text: str) -> str:
    return repr(text if len(text) <= 40 else f"{text[:40]}…")
