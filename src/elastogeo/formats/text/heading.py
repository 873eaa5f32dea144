"""What stands above the numbers of a delimited text: metadata, a preamble, the column headers, perhaps a line of units."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from elastogeo.errors import FormatError
from elastogeo.formats.text.delimited import MAX_LINE, NUMBER, SEPARATORS, comment_text, split_cells, unguarded
from elastogeo.formats.text.units import PER_SECOND, UNITS

STAMP = re.compile(
    r"(?P<whole>\d{4}-\d{2}-\d{2}[T ]\d{2}:\d{2}:\d{2})(?:[.,](?P<part>\d{1,12}))?(?P<zone>Z|[+-]\d{2}:?\d{2})?", re.ASCII
)
"""An ISO 8601 time with its date."""
PREAMBLE = "preamble"
"""Key of the metadata under which lines stand that say nothing in a form that is known."""

_SEARCHED = 65_536
_MOST = 500
"""Bytes and lines among which a table begins."""
_PAIR = re.compile(r"([^\W\d][^:=,;|\t\"]{0,79})[:=](.*)", re.DOTALL)
_DIRECTION = re.compile(r"cc?w|(counter|anti)?[- ]?clockwise|g0?[23]", re.IGNORECASE)
_KEY = re.compile(r"[^\W\d][^:=,;|\t\"]{0,79}")
_NUMBERS = re.compile(r"[-+.,\d\"][-+\d.,;|\s\"eE]*")
_HEADER_WORD = re.compile(r"\"[^\"]*\"|[^\s\[(]+(?:\s*(?:\[[^\[\]]{0,20}\]|\([^()]{0,20}\)))?")


@dataclass(frozen=True, slots=True)
class Heading:
    """What stands above the numbers of a delimited text.

    Attributes
    ----------
    headers : tuple of str
        Column headers as written, without quotes; empty if the numbers begin without any.
    line : int
        Number of the header's line, from 1.
    separator : str or None
        What separates cells; None for runs of blanks.
    metadata : dict of str to str
        The `key: value` and `key = value` lines, and lines of cells that say one number or a direction (`Radius;150;mm`
        under the key `Radius [mm]`); several lines of one key are joined by line ends. Other lines above the headers stand
        under `PREAMBLE`.
    first : str
        The first line of numbers; empty if there is none.
    units : tuple of str
        What a line of units under the headers says, a text for each header; empty without such a line.
    body : int
        Number of the last line above the numbers: that of the headers, or of the lines that follow them.
    """

    headers: tuple[str, ...]
    line: int
    separator: str | None
    metadata: dict[str, str]
    first: str
    units: tuple[str, ...] = ()
    body: int = 0

    @property
    def cells(self) -> tuple[str, ...]:
        """The cells of the first line of numbers."""
        return tuple(cell.strip() for cell in split_cells(self.first[:MAX_LINE], self.separator)) if self.first else ()

    @property
    def has_numbers(self) -> bool:
        """Whether under each header stands a cell, and one of them is a number or a time."""
        return len(self.cells) == len(self.headers) and any(map(is_value, self.cells))


def read_heading(text: bytes) -> Heading | None:
    """Read to the first line of numbers; None if the text ends before any header.

    Parameters
    ----------
    text : bytes
        As `utf8_text` gives it.

    Raises
    ------
    FormatError
        If a line is longer than `MAX_LINE` characters.
    """
    found = _above(_significant(text))
    if found is None or found.has_numbers:
        return found
    below = _with_units(found, _following(text, found))
    if below.has_numbers:
        return below
    return _below_preamble(text) or found


def is_value(cell: str) -> bool:
    """Whether a cell is a number or a time, so that its line is no line of names."""
    return bool(NUMBER.fullmatch(cell) or STAMP.match(cell))


def _above(lines: Iterator[tuple[int, str]]) -> Heading | None:
    """The heading whose headers are the first line that is no comment and no pair of key and value."""
    pairs: dict[str, list[str]] = {}
    remark = (0, "")
    for number, text in lines:
        comment = comment_text(text, None)
        pair = _pair(text if comment is None else comment)
        if pair:
            pairs.setdefault(pair[0], []).append(pair[1])
        elif comment is None:
            break
        elif comment:
            remark = (number, comment)
    else:
        return None
    metadata = {key: "\n".join(values) for key, values in pairs.items()}
    if not _NUMBERS.fullmatch(text):
        first = next((t for _, t in lines if comment_text(t, ";" if ";" in text else None) is None), "")
        separator = _separator(text, first)
        return Heading(_headers(text, separator), number, separator, metadata, first, (), number)
    separator = _separator(remark[1], text)
    headers = _headers(remark[1], separator)
    if remark[0] == 0 or len(headers) != len(split_cells(text, separator)):
        return Heading((), number, None, metadata, text)
    return Heading(headers, remark[0], separator, metadata, text, (), remark[0])


def _following(text: bytes, heading: Heading) -> list[tuple[int, str]]:
    """The first lines under the headers that are no comments, with their numbers."""
    found = []
    for number, line in _significant(text):
        if number > heading.line and comment_text(line, heading.separator) is None:
            found.append((number, line))
        if len(found) == 2:
            break
    return found


def _with_units(heading: Heading, following: Sequence[tuple[int, str]]) -> Heading:
    """The heading with the line of units that stands under it, if one does."""
    if len(following) < 2:
        return heading
    (number, line), (_, first) = following[:2]
    cells = tuple(_bare([cell.strip() for cell in split_cells(line, heading.separator)]))
    if not _are_units(cells, len(heading.headers)):
        return heading
    return replace(heading, units=cells, body=number, first=first)


def _are_units(cells: Sequence[str], width: int) -> bool:
    """Whether a line names units: no number in it, and at least half of its cells are units that are known."""
    said = [cell for cell in cells if cell]
    known = [cell for cell in said if cell in UNITS or cell in PER_SECOND]
    return len(cells) == width and 2 * len(known) >= max(len(said), 1) and not any(map(is_value, said))


def _below_preamble(text: bytes) -> Heading | None:
    """The heading of the first table in a text: lines of as many cells that hold numbers, a line of names above them."""
    *lines, last = text[:_SEARCHED].decode("utf-8", "ignore").split("\n", _MOST)
    if len(text) <= _SEARCHED and len(lines) < _MOST:
        lines.append(last)
    shown = [(number, line.strip()) for number, line in enumerate(lines, 1) if line.strip()]
    for separator in (*SEPARATORS, None):
        rows = [_cells(line, separator) for _, line in shown]
        start = next((k for k in range(1, len(rows)) if _begins(rows, k)), 0)
        if start:
            at = start - 2 if start > 1 and _are_units(_bare(rows[start - 1]), len(rows[start - 2])) else start - 1
            if len(rows[at]) == len(rows[start]) and _are_names(rows[at]):
                units = tuple(_bare(rows[start - 1])) if at < start - 1 else ()
                (number, header), (body, _), (_, first) = shown[at], shown[start - 1], shown[start]
                said = _said([line for _, line in shown[:at]])
                return Heading(_headers(header, separator), number, separator, said, first, units, body)
    return None


def _cells(line: str, separator: str | None) -> list[str]:
    """The cells of a line; none of a line that the separator does not split."""
    cells = [cell.strip() for cell in split_cells(line[:MAX_LINE], separator)]
    return cells if len(cells) > 1 else []


def _are_names(cells: Sequence[str]) -> bool:
    named = [cell for cell in cells if cell]
    return len(named) > 1 and len(set(named)) == len(named) and not any(is_value(cell) or len(cell) > 200 for cell in named)


def _begins(rows: Sequence[Sequence[str]], k: int) -> bool:
    """Whether a table of numbers begins with row k: it, and the next if there is one, are as wide as the row above it."""
    width = len(rows[k - 1])
    return not _are_readings(rows[k - 1]) and all(len(row) == width and _are_readings(row) for row in rows[k : k + 2])


def _bare(cells: Sequence[str]) -> list[str]:
    return [cell.strip("[]()") for cell in cells]


def _are_readings(cells: Sequence[str]) -> bool:
    filled = [cell for cell in cells if cell]
    return 2 * sum(map(is_value, filled)) >= len(filled) > 0


def _said(lines: Sequence[str]) -> dict[str, str]:
    """The metadata of a preamble: its pairs by their key, the rest of it under `PREAMBLE`."""
    said: dict[str, list[str]] = {}
    for line in lines:
        comment = comment_text(line, None)
        key, value = _pair(line if comment is None else comment) or (PREAMBLE, line)
        said.setdefault(key, []).append(value)
    return {key: "\n".join(values) for key, values in said.items()}


def _pair(text: str) -> tuple[str, str] | None:
    """Key and value of a line that says something about the run; None for any other line."""
    pair = _PAIR.match(text)
    if pair:
        return pair[1].strip(), unguarded(pair[2].strip())
    for separator in SEPARATORS:
        cells = [cell.strip() for cell in split_cells(text.rstrip(SEPARATORS), separator)] if separator in text else []
        if len(cells) not in (2, 3) or not _KEY.fullmatch(cells[0]):
            continue
        if NUMBER.fullmatch(cells[1]) or ("direction" in cells[0].lower() and _DIRECTION.fullmatch(cells[1])):
            unit = f" [{cells[2]}]" if len(cells) == 3 else ""
            return f"{cells[0]}{unit}", cells[1]
    return None


def _significant(text: bytes) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(io.TextIOWrapper(io.BytesIO(text), encoding="utf-8", errors="ignore", newline="\n"), 1):
        if len(line) > MAX_LINE:
            raise FormatError(f"line {number} is longer than {MAX_LINE} characters; a run file has one reading a line")
        stripped = line.strip()
        if stripped:
            yield number, stripped


def _separator(header: str, first: str) -> str | None:
    present = [s for s in SEPARATORS if len(split_cells(header, s)) > 1]
    agree = (s for s in present if len(split_cells(header, s)) == len(split_cells(first, s)))
    return next(agree, present[0] if present else None)


def _headers(line: str, separator: str | None) -> tuple[str, ...]:
    if separator is None:
        return tuple(word.strip('"') for word in _HEADER_WORD.findall(line))
    return tuple(cell.strip() for cell in split_cells(line, separator))
