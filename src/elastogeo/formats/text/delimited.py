"""Delimited text, line by line: encoding, comments, separators, quoted cells, numbers."""

from __future__ import annotations

import codecs
import csv
import re

from elastogeo.errors import FormatError

MAX_LINE = 100_000
SEPARATORS = ";|,\t"
#: A plain finite number, with either decimal mark.
NUMBER = re.compile(r"[-+]?(\d+([.,]\d*)?|[.,]\d+)([eE][-+]?\d+)?", re.ASCII)

_UTF8, _UTF16 = b"\xef\xbb\xbf", (b"\xff\xfe", b"\xfe\xff")
_CHUNK = 1 << 20
_UTF8_SIGNS = ("\u00b5".encode(), "\u03bc".encode(), "\u00b0".encode())
_WORD = re.compile(r"\"[^\"]*\"|\S+")


def utf8_text(data: bytes, *, cut: bool = False) -> bytes:
    r"""Bytes of a text as UTF-8 with lines that end in `\n`: from UTF-8, UTF-16 with a byte order mark, or else Latin-1.

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
    if data.startswith(_UTF16):
        try:
            data = data.decode("utf-16", "ignore" if cut else "strict").encode()
        except UnicodeDecodeError as error:
            raise FormatError(f"the text is cut off or damaged at byte {error.start}; copy or export it again") from None
    elif not data.isascii():
        data = _utf8(data, cut)
    if b"\0" in data:
        raise FormatError("the file has zero bytes, so it is not text; export it as UTF-8 text")
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data


def _utf8(data: bytes, cut: bool) -> bytes:
    """Bytes above ASCII as UTF-8, without a byte order mark."""
    marked = len(_UTF8) if data.startswith(_UTF8) else 0
    data = data[marked:]
    decoder = codecs.getincrementaldecoder("utf-8")()
    try:
        for at in range(0, len(data), _CHUNK):
            decoder.decode(data[at : at + _CHUNK])
        decoder.decode(b"", final=True)
    except UnicodeDecodeError:
        pass
    else:
        return data
    try:
        data.decode()
    except UnicodeDecodeError as error:
        if cut and error.start > len(data) - 4:
            return data[: error.start]
        if any(sign in data for sign in _UTF8_SIGNS):
            raise FormatError(f"byte {error.start + marked} is not UTF-8, but the rest is; correct it there") from None
    return data.decode("latin-1").encode()


def comment_text(line: str, separator: str | None) -> str | None:
    """Return the text of a comment line (`#`, `%`, `//`, and `;` where it separates nothing), or None for any other.

    A spreadsheet saves a comment that holds a separator in quotes; they are removed.
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


def unguarded(value: str) -> str:
    """Take that apostrophe away again."""
    return value[1:] if value.startswith("'") and _is_formula(value) else value


def _is_formula(value: str) -> bool:
    return value.lstrip("'").startswith(("=", "+", "-", "@")) and not _is_number(value)
