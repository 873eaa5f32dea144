"""Delimited text up to its column header: encoding, comments, metadata lines, separator, quoted cells."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TextIO

from elastogeo.errors import FormatError

MAX_LINE = 100_000
SEPARATORS = ";|,\t"
#: A plain finite number, with either decimal mark.
NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?", re.ASCII)

_BOMS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
_UTF8_SIGNS = ("\u00b5".encode(), "\u03bc".encode(), "\u00b0".encode())
_PAIR = re.compile(r"([^\W\d][^:=,;|\t\"]{0,79})[:=](.*)", re.DOTALL)
_DIRECTION = re.compile(r"cc?w|(counter|anti)?[- ]?clockwise|g0?[23]", re.IGNORECASE)
_KEY = re.compile(r"[^\W\d][^:=,;|\t\"]{0,79}")
_NUMBERS = re.compile(r"[-+.,\d\"][-+\d.,;|\s\"eE]*")
_HEADER_WORD = re.compile(r"\"[^\"]*\"|[^\s\[(]+(?:\s*(?:\[[^\[\]]{0,20}\]|\([^()]{0,20}\)))?")
_WORD = re.compile(r"\"[^\"]*\"|\S+")


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
        under the key `Radius [mm]`); several lines of one key are joined by line ends.
    first : str
        The first line of numbers; empty if there is none.
    """

    headers: tuple[str, ...]
    line: int
    separator: str | None
    metadata: dict[str, str]
    first: str


def open_text(data: bytes, *, cut: bool = False) -> TextIO:
    r"""Open bytes as lines that end in `\n`: UTF-8, UTF-16 with a byte order mark, or else Latin-1.

    Parameters
    ----------
    data : bytes
        The file, or its beginning.
    cut : bool
        Whether `data` is the beginning of a file only, which may end inside a character.

    Raises
    ------
    FormatError
        If the bytes are not text.
    """
    encoding = next((name for bom, name in _BOMS if data.startswith(bom)), "utf-8")
    try:
        text = data.decode(encoding, "ignore" if cut and encoding == "utf-16" else "strict")
    except UnicodeDecodeError as error:
        if encoding == "utf-16":
            raise FormatError(f"the text is cut off or damaged at byte {error.start}; copy or export it again") from None
        if not (cut and error.start > len(data) - 4):
            encoding = "latin-1"
            if any(sign in data for sign in _UTF8_SIGNS):
                raise FormatError(f"byte {error.start} is not UTF-8, but the rest is; correct it there") from None
        text = ""
    if "\0" in text or (encoding == "latin-1" and b"\0" in data):
        raise FormatError("the file has zero bytes, so it is not text; export it as UTF-8 text")
    errors = "ignore" if cut else "strict"
    return io.TextIOWrapper(io.BytesIO(data), encoding=encoding, errors=errors, newline=None)


def comment_text(line: str, separator: str | None) -> str | None:
    """Return the text of a comment line (`#`, `%`, `//`, and `;` where it separates nothing), or None for any other.

    A spreadsheet saves a comment that holds a separator in quotes; they are taken off.
    """
    if line.startswith(('"#', '"%', '"//')):
        cells = line.rstrip(SEPARATORS)
        line = cells[1:-1].replace('""', '"') if cells.endswith('"') else line
    if line.startswith(("#", "%")):
        return line.lstrip("#%").strip()
    if line.startswith("//"):
        return line.lstrip("/").strip()
    if line.startswith(";") and separator != ";" and ";" not in line[1:]:
        return line[1:].strip()
    return None


def read_heading(stream: TextIO) -> Heading | None:
    """Read to the first line of numbers; None if the text ends before any header.

    Raises
    ------
    FormatError
        If a line is longer than `MAX_LINE` characters.
    """
    pairs: dict[str, list[str]] = {}
    remark = (0, "")
    lines = _significant(stream)
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
        return Heading(_headers(text, separator), number, separator, metadata, first)
    separator = _separator(remark[1], text)
    headers = _headers(remark[1], separator)
    if remark[0] == 0 or len(headers) != len(split_cells(text, separator)):
        return Heading((), number, None, metadata, text)
    return Heading(headers, remark[0], separator, metadata, text)


def split_cells(line: str, separator: str | None) -> list[str]:
    """Split a line into its cells (runs of blanks separate if `separator` is None), and take quotes off."""
    if '"' not in line:
        return line.split(separator)
    if separator is None:
        return [word.strip('"') for word in _WORD.findall(line)]
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    except csv.Error:
        return line.split(separator)


def guarded(value: str) -> str:
    """Put an apostrophe before text that a spreadsheet would take for a formula; numbers stay as they are."""
    return f"'{value}" if _is_formula(value) else value


def _is_number(text: str) -> bool:
    """Whether a text is a plain number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _unguarded(value: str) -> str:
    return value[1:] if value.startswith("'") and _is_formula(value) else value


def _is_formula(value: str) -> bool:
    return value.lstrip("'").startswith(("=", "+", "-", "@")) and not _is_number(value)


def _pair(text: str) -> tuple[str, str] | None:
    """Key and value of a line that says something about the run; None for any other line."""
    pair = _PAIR.match(text)
    if pair:
        return pair[1].strip(), _unguarded(pair[2].strip())
    for separator in SEPARATORS:
        cells = [cell.strip() for cell in split_cells(text.rstrip(SEPARATORS), separator)] if separator in text else []
        if len(cells) not in (2, 3) or not _KEY.fullmatch(cells[0]):
            continue
        if NUMBER.fullmatch(cells[1]) or ("direction" in cells[0].lower() and _DIRECTION.fullmatch(cells[1])):
            unit = f" [{cells[2]}]" if len(cells) == 3 else ""
            return f"{cells[0]}{unit}", cells[1]
    return None


def _significant(stream: TextIO) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(stream, 1):
        if len(line) > MAX_LINE:
            raise FormatError(f"line {number} is longer than {MAX_LINE} characters; a run file has one reading a line")
        text = line.strip()
        if text:
            yield number, text


def _separator(header: str, first: str) -> str | None:
    present = [s for s in SEPARATORS if len(split_cells(header, s)) > 1]
    agree = (s for s in present if len(split_cells(header, s)) == len(split_cells(first, s)))
    return next(agree, present[0] if present else None)


def _headers(line: str, separator: str | None) -> tuple[str, ...]:
    if separator is None:
        return tuple(word.strip('"') for word in _HEADER_WORD.findall(line))
    return tuple(cell.strip() for cell in split_cells(line, separator))
