"""A run as it was recorded: named columns in internal units, and what its file says about it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.text.units import check_unit, split_unit, to_internal
from elastogeo.machine import Array

MAX_COLUMNS = 1000
SHOWN = 5


@dataclass(frozen=True, slots=True)
class Table:
    """The readings of one run.

    Attributes
    ----------
    columns : mapping of str to array, shape (m,)
        The readings by name of quantity without unit (`angle`, `radial`, `force`), in internal units [mm, rad, N,
        N mm, s, mm/s; bar, A, V, degC]. All finite, all of the same length m >= 1, read-only.
    metadata : mapping of str to str
        What the file says besides its readings (machine, date, operator).
    source : str
        Where the readings came from, for error messages.
    units : mapping of str to str
        Units that the columns had in the file, if it is known; empty for a number.

    Raises
    ------
    FormatError
        If there is no reading, if lengths differ, or if a value is not finite.
    """

    columns: Mapping[str, Array]
    metadata: Mapping[str, str]
    source: str
    units: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        columns: dict[str, Array] = {}
        for name, values in self.columns.items():
            array = np.asarray(values, dtype=np.float64).view()
            array.flags.writeable = False
            if array.ndim != 1 or not len(array):
                raise FormatError(f"{self.source}: column {name} has the shape {array.shape}; expected rows of readings")
            if not np.isfinite(array).all():
                row = int(np.argmin(np.isfinite(array))) + 1
                raise FormatError(f"{self.source}: reading {row} of column {name} is not a finite number; correct it")
            columns[name] = array
        if len({len(array) for array in columns.values()}) != 1:
            lengths = {name: len(array) for name, array in columns.items()}
            raise FormatError(f"{self.source}: columns must exist and have the same length, these arrived: {lengths}")
        object.__setattr__(self, "columns", columns)
        object.__setattr__(self, "metadata", dict(self.metadata))

    @property
    def rows(self) -> int:
        """The number of readings m of every column."""
        return len(next(iter(self.columns.values())))

    def column(self, name: str) -> Array:
        """One column, shape (m,), in internal units.

        Raises
        ------
        FormatError
            If the run has no such column; the message lists what it has.
        """
        if name not in self.columns:
            raise FormatError(f"{self.source}: has no column {name!r}; it has {', '.join(self.columns)}")
        return self.columns[name]


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a file: its header as written, the quantity it names, its unit (`""`: none)."""

    header: str
    quantity: str
    unit: str

    def internal(self, values: Array) -> Array:
        """Convert values of this column, shape (m,), to internal units."""
        return to_internal(values, self.unit)


def parse_headers(headers: Sequence[str], where: str) -> list[Column]:
    """Read all column headers of a file, and report everything that is wrong with them at once.

    Parameters
    ----------
    headers : sequence of str
        Column headers, each with its unit (`angle_deg`, `radial [um]`).
    where : str
        The file, and the line if there is one, for the message.

    Raises
    ------
    FormatError
        If there is no column or more than `MAX_COLUMNS`, a column is named twice, a unit is unknown or is missing.
    """
    if not headers:
        raise FormatError(f"{where}: there is no column; write a header such as 'angle_deg,radial_um'")
    if len(headers) > MAX_COLUMNS:
        raise FormatError(f"{where}: {len(headers)} columns arrived, at most {MAX_COLUMNS} are read; split the file")
    columns: dict[str, Column] = {}
    problems = []
    for header in headers:
        try:
            quantity, unit = split_unit(header)
            check_unit(quantity, unit)
        except FormatError as error:
            problems.append(str(error))
            continue
        if quantity in columns:
            first = columns[quantity].header
            problems.append(f"column {header!r} and {first!r} name the same quantity: rename or remove one")
        columns[quantity] = Column(header, quantity, unit)
    if problems:
        raise problems_error(where, problems[:SHOWN], len(problems), "column headers cannot be read")
    return list(columns.values())


def named_columns(headers: Sequence[str], columns: Mapping[str, str], where: str) -> list[Column | None]:
    """What each header of a file means, as a test says it; None for a column that it does not name.

    Parameters
    ----------
    headers : sequence of str
        Of the file.
    columns : mapping of str to str
        Our name with its unit (`angle_deg`) -> header in the file.
    where : str
        The file, and the line if there is one, for the message.

    Raises
    ------
    FormatError
        If one of them is not in the file, or not a quantity with its unit.
    """
    parsed = dict(zip(columns, parse_headers(list(columns), f"{where}, columns of the test"), strict=True))
    for name, header in columns.items():
        if header not in headers:
            near = get_close_matches(header, headers, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"it has {', '.join(headers[:20])}"
            raise FormatError(f"{where}: has no column {header!r}, which the test takes as {name}; {hint}")
    meant = {header: replace(parsed[name], header=header) for name, header in columns.items()}
    return [meant.get(header) for header in headers]


def problems_error(where: str, shown: Sequence[str], count: int, what: str) -> FormatError:
    """The one error for everything of a kind that is wrong with a file: counted, and the first ones shown."""
    if count == 1:
        return FormatError(f"{where}: {shown[0]}")
    more = f"\n  ... and {count - len(shown)} more" if count > len(shown) else ""
    return FormatError(f"{where}: {count} {what}:\n  " + "\n  ".join(shown) + more)
