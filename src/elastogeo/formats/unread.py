"""Why no reader takes a file, where that can be told: spreadsheets, archives, delimited text that is not quite a table."""

from __future__ import annotations

from collections.abc import Sequence

from elastogeo.errors import FormatError
from elastogeo.formats.guessed_names import guessed_quantity
from elastogeo.formats.text.by_content import HEAD
from elastogeo.formats.text.delimited import NUMBER, utf8_text
from elastogeo.formats.text.heading import Heading, is_value, read_heading
from elastogeo.formats.text.units import UNITS, dimensions_of, split_unit

_SHOWN = 12
_EXPORT = "export the sheet as CSV (in a spreadsheet: Save as, CSV UTF-8), and read that"
_OLD_OFFICE, _ZIP, _GZIP, _PDF = b"\xd0\xcf\x11\xe0", b"PK\x03\x04", b"\x1f\x8b", b"%PDF"
_DEFAULT_UNITS = {"angle": "deg", "radial": "um", "displacement": "um", "force": "N", "pressure": "bar", "time": "s"}


def unread(data: bytes, run: bool) -> str:
    """What a file is that no reader takes, and what to do; empty if that cannot be told.

    Parameters
    ----------
    data : bytes
        The whole file.
    run : bool
        Whether a run of an instrument was expected, rather than a log.
    """
    head = data[:HEAD]
    if head.startswith(_ZIP):
        if b"xl/" in head or b"[Content_Types].xml" in head:
            return f"is an Excel workbook (xlsx), which is not read; {_EXPORT}"
        if b"opendocument.spreadsheet" in head:
            return f"is an OpenDocument spreadsheet (ods), which is not read; {_EXPORT}"
    if head.startswith(_OLD_OFFICE):
        return f"is an old Excel workbook (xls) or another Office document, which is not read; {_EXPORT}"
    if head.startswith((_ZIP, _GZIP)):
        return "is an archive; unpack it, and read the files in it"
    if head.startswith(_PDF):
        return "is a PDF, a page for people; export the readings as text or CSV"
    try:
        heading = read_heading(utf8_text(head, cut=True))
    except FormatError:
        return ""
    return _of_text(heading, run) if heading is not None else ""


def _of_text(heading: Heading, run: bool) -> str:
    headers = heading.headers
    where = f"line {heading.line} has the column headers {_listed(headers)}"
    if not all(headers) or not headers or (len(headers) == 1 and not _unit(headers[0])) or any(map(is_value, headers)):
        return ""
    if not heading.first:
        return f"{where}, but no line of numbers follows; export the file again, with its data" if _is_table(headers) else ""
    cells = heading.cells
    if not cells or not all(NUMBER.fullmatch(cell) or not cell for cell in cells):
        return ""
    if len(cells) != len(headers):
        return _of_width(heading, where)
    return f"{where}, and {_named(headers)}" if run else ""


def _of_width(heading: Heading, where: str) -> str:
    """What to do about lines of numbers with another number of cells than the headers."""
    number, count, width = heading.body + 1, len(heading.cells), len(heading.headers)
    said = f"{where}: {width} of them, but the next line of numbers has {count} cells"
    if heading.separator == "," and count > width:
        return (
            f"{said} ({heading.first[:60]!r}); if its commas are decimal marks, export the file with semicolons between the "
            "columns, or with decimal points"
        )
    return f"{said} ({heading.first[:60]!r}, about line {number}); give each column a header, and each header a column"


def _named(headers: Sequence[str]) -> str:
    """How to say what columns are whose headers do not."""
    guesses = [(header, guessed_quantity(header, _unit(header))) for header in headers]
    known = [f'{_key(quantity, header)} = "{header}"' for header, quantity in guesses if quantity]
    example = ", ".join(dict.fromkeys(known)) or f'angle_deg = "{headers[0]}", radial_um = "{headers[-1]}"'
    return (
        "none of them says a quantity and its unit as angle_deg and radial_um do; rename them, or say what they are in "
        f"test.toml, above its first table: columns = {{ {example} }}"
    )


def _key(quantity: str, header: str) -> str:
    unit = _unit(header)
    if not unit and dimensions_of(quantity):
        unit = _DEFAULT_UNITS.get(quantity.partition("_")[0], "mm")
    return f"{quantity}_{unit}" if unit else quantity


def _unit(header: str) -> str:
    try:
        unit = split_unit(header)[1]
    except FormatError:
        return ""
    plain = next((one for one in UNITS if one.isascii() and one.isidentifier() and UNITS[one] == UNITS.get(unit)), unit)
    return plain if unit else ""


def _is_table(headers: Sequence[str]) -> bool:
    """Whether a line without numbers under it is one of column headers, rather than prose."""
    return any(map(_unit, headers)) or any(guessed_quantity(header) for header in headers)


def _listed(headers: Sequence[str]) -> str:
    more = f", ... ({len(headers)} in all)" if len(headers) > _SHOWN else ""
    return ", ".join(headers[:_SHOWN]) + more
