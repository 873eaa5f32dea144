"""Delimited text (CSV): headers carry their units, `angle_deg,radial_um`; every spelling of numbers that is unambiguous.

Separated by comma, semicolon, tab, bar or blanks; decimal point or decimal comma; UTF-8, UTF-16 with a byte order mark
or Latin-1; any line ends; comments and `key: value` lines. Every reading is taken, or the file is refused.

Ball-bar exports: radial readings without angles where the lines above tell the arc (`start angle [deg]: 0`, then
`end angle [deg]`, or `direction`, `radius [mm]`, `feed rate [mm/min]` and `sample rate [Hz]`); `CCW [um]` and `CW [um]` side
by side are two runs, the CW one from the end angle to the start angle.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from elastogeo.errors import FormatError
from elastogeo.formats.run_files import RunFormat, only_run, register
from elastogeo.formats.runs.arc_angles import check_sides, runs_of
from elastogeo.formats.text.delimited import NUMBER, guarded, utf8_text
from elastogeo.formats.text.heading import Heading, read_heading
from elastogeo.formats.text.readings import Readings
from elastogeo.formats.text.table import Column, Table, named_columns, parse_headers
from elastogeo.formats.text.units import QUANTITIES, UNITS, split_unit

_WRITABLE = re.compile(r"[^\W\d][\w ./°-]*([\[(][\w ./°-]*[\])])?")


def can_read(head: bytes) -> bool:
    """Whether these first bytes are text with a line of column headers above (or instead of) lines of numbers."""
    if head.startswith((b"PAR1", b"<", b"{")):
        return False
    try:
        heading = read_heading(utf8_text(head, cut=True))
    except FormatError:
        return False
    if heading is None:
        return False
    numeric = bool(heading.cells) and all(map(NUMBER.fullmatch, heading.cells))
    if not heading.headers:
        return numeric
    return any(_has_unit(header) or (numeric and header.strip().lower() in QUANTITIES) for header in _with_units(heading))


def read_csv(data: bytes, source: str) -> Table:
    """Read delimited text that holds one run; otherwise as `read_csv_runs`."""
    return only_run(read_csv_runs(data, source), source)


def read_csv_runs(data: bytes, source: str) -> tuple[Table, ...]:
    """Read delimited text: one run, or one for each direction.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    tuple of Table
        The readings in internal units [mm, rad, N, N mm, s, mm/s; bar, A, V, degC].

    Raises
    ------
    FormatError
        If anything in the file is not understood without doubt. Bad lines are counted and the first five shown.
    """
    text, heading = _opened(data, source)
    columns = parse_headers(_with_units(heading), f"{source}, line {heading.line}")
    check_sides(columns, f"{source}, line {heading.line}")
    return runs_of(_table(text, heading, columns, source))


def read_csv_columns(data: bytes, source: str, columns: Mapping[str, str]) -> Table:
    """Read the columns that a test names (our name with its unit -> header); what stands in the others does not matter.

    Raises
    ------
    FormatError
        As `read_csv_runs`, and if a column is not there.
    """
    text, heading = _opened(data, source)
    named = named_columns(heading.headers, columns, f"{source}, line {heading.line}")
    return only_run(runs_of(_table(text, heading, named, source)), source)


def _opened(data: bytes, source: str) -> tuple[bytes, Heading]:
    """The text and its heading."""
    try:
        text = utf8_text(data)
        heading = read_heading(text)
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None
    if heading is None:
        raise FormatError(f"{source}: there is no column header; write one such as 'angle_deg,radial_um'")
    where = f"{source}, line {heading.line}"
    if not heading.headers:
        raise FormatError(f"{where}: numbers begin without a column header; write one above: 'angle_deg,radial_um'")
    return text, heading


def _table(text: bytes, heading: Heading, columns: Sequence[Column | None], source: str) -> Table:
    readings = Readings(text, heading, columns)
    readings.read()
    return readings.table(source, ended=text.endswith(b"\n"))


def write_csv(columns: Mapping[str, ArrayLike], metadata: Mapping[str, str]) -> bytes:
    """Write a run as comma-separated UTF-8 text; read back, every number is the same bit for bit.

    Parameters
    ----------
    columns : mapping of str to array, shape (m,)
        Values in the units that their headers name (`radial_um`); they are written as they are, with 17 digits if
        need be.
    metadata : mapping of str to str
        Written above as `# key: value`. Text that a spreadsheet could take for a formula gets an apostrophe.

    Raises
    ------
    FormatError
        If a header, a key or the columns could not be read back.
    """
    parsed = parse_headers(list(columns), "columns to write")
    arrays = {c.header: np.asarray(columns[c.header], dtype=np.float64) for c in parsed}
    table = Table(arrays, metadata, "columns to write")
    for header in columns:
        if not _WRITABLE.fullmatch(header):
            raise FormatError(f"the column header {header!r} cannot be written; use letters, digits and a unit")
    lines = [f"rows: {table.rows}"]
    for key, value in metadata.items():
        if not re.fullmatch(r"[^\W\d][\w .()/-]{0,78}", key) or key != key.strip() or key == "rows":
            raise FormatError(f"the metadata key {key!r} cannot be written; use a short word other than 'rows'")
        lines += [f"{key}: {guarded(part)}" for part in value.splitlines() or [""]]
    comments = [_quoted(f"# {line}") for line in lines]
    header = ",".join(f'"{header}"' if " " in header else header for header in columns)
    rows = zip(*(map(repr, array.tolist()) for array in table.columns.values()), strict=True)
    return "\n".join([*comments, header, *map(",".join, rows), ""]).encode()


def _with_units(heading: Heading) -> list[str]:
    """The headers, each with the unit that stands under it, if it says none itself."""
    units = heading.units or ("",) * len(heading.headers)
    return [
        f"{header} [{unit}]" if unit in UNITS and not _has_unit(header) else header
        for header, unit in zip(heading.headers, units, strict=True)
    ]


def _has_unit(header: str) -> bool:
    try:
        return split_unit(header)[1] != ""
    except FormatError:
        return False


def _quoted(line: str) -> str:
    """Put a line in quotes if a spreadsheet would split it."""
    return '"' + line.replace('"', '""') + '"' if re.search(r"[,;|\t\"]", line) else line


def _sample() -> bytes:
    return write_csv(
        {"angle_deg": [0.0, 90.0, 180.0], "radial_um": [0.1, -2.5, 1e-17], "force_N": [36.0, 36.25, 35.5]},
        {"machine": "a sample, of no machine"},
    )


register(RunFormat("delimited text", ".csv", can_read, read_csv, _sample, write_csv, read_csv_runs, read_csv_columns))
