"""What a file is and what it holds: format, columns or channels, and how a test file says what they mean."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.guessed_names import guessed_quantity
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.log_files import log_formats, read_log
from elastogeo.formats.recording_files import part_files
from elastogeo.formats.run_files import RunFormat, run_formats
from elastogeo.formats.text.by_content import HEAD, opened
from elastogeo.formats.text.table import Table
from elastogeo.formats.text.toml_documents import read_document
from elastogeo.formats.text.units import QUANTITIES, UNITS, check_unit, dimensions_of, split_unit
from elastogeo.result import Result

SHOWN = 5

_READ = ("angle", "radial", "radius", "displacement", "ccw", "cw", "length", "deviation", "target")
"""What an instrument reads, rather than what a control records."""
_COUNTED = ("cycle", "direction")
"""Columns without a unit that say how a target was approached."""
_INSIDE = {"length": "mm", "angle": "rad", "force": "N", "moment": "N mm", "feed": "mm/s", "angular rate": "rad/s"}
_INSIDE |= {"acceleration": "mm/s2", "pressure": "bar", "time": "s", "current": "A", "voltage": "V", "temperature": "degC"}


_CALIBRATED: tuple[set[str], ...] = (
    {"pressure", "force"},
    {"pressure", "displacement"},
    {"engagement", "force", "ball", "roller"},
)
"""The columns of readings that `elastogeo calibrate` takes."""


@dataclass(frozen=True, slots=True)
class InspectedColumn:
    """One column of readings, or one channel of a log.

    Attributes
    ----------
    name : str
        As the file spells it.
    unit : str
        That the file says, in a spelling of `UNITS`; empty if it says none.
    quantity : str
        That name and unit say without doubt (`current_x`); empty if they do not.
    guess : str
        The quantity that the name may mean, for a person to confirm; empty where nothing is to be guessed.
    count, numbers : int
        Samples, and those of them that are numbers.
    first : tuple of float [`unit`]
        Values of the first samples, at most `SHOWN`; NaN where a sample is no number.
    low, high : float or None [`unit`]
        Least and greatest number; None without any.
    rate : float or None [Hz]
        From the median step of its clock; None without one.
    """

    name: str
    unit: str
    quantity: str
    guess: str
    count: int
    numbers: int
    first: tuple[float, ...]
    low: float | None
    high: float | None
    rate: float | None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Inspected(Result):
    """What a file is.

    Attributes
    ----------
    path : str
    kind : str
        `run` (readings of an instrument), `readings` (for `elastogeo calibrate`), `log` (channels of a control or data
        logger), `recording` (a folder of `elastogeo record`), or what the schema of a document says: `test`, `drive`,
        `machine`, `simulation`.
    format : str
        Its name: `delimited text`, `TDMS`, ...
    runs : int
        That the file holds; 1 but for some ball-bar exports.
    columns : tuple of InspectedColumn
        In the order of the file; without its clock.
    duration : float or None [s]
        From the first to the last sample; None without a clock.
    metadata : mapping of str to str
        What the file says besides.
    notes : tuple of str
        What was found while it was read.
    problem : str
        Why a test cannot take the file as it stands, and what to do; empty if it can.
    """

    path: str
    kind: str
    format: str
    runs: int = 1
    columns: tuple[InspectedColumn, ...] = ()
    duration: float | None = None
    metadata: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problem: str = ""

    @property
    def channels(self) -> tuple[Mapping[str, str], ...]:
        """Entries `[[channels]]` of a test or drive file for this log: `quantity`, `channel`, `unit`.

        One for each channel whose quantity is known or guessed. A `unit` that is empty is to be filled in by the user.
        """
        entries: list[Mapping[str, str]] = []
        for column in self.columns if self.kind in ("log", "recording") else ():
            quantity = column.quantity or column.guess
            if quantity and quantity not in {entry["quantity"] for entry in entries}:
                unit = {} if column.unit else {"unit": ""}
                entries.append({"quantity": quantity, "channel": column.name, **unit})
        return tuple(entries)

    @property
    def renamed(self) -> Mapping[str, str]:
        """The table `columns` of a test file for this run: our name with its unit -> header in the file.

        Only where the file's own headers do not say it. A unit that is not known is written as `_?`.
        """
        if self.kind != "run" or all(column.quantity for column in self.columns):
            return {}
        named = {}
        for column in self.columns:
            quantity = column.quantity or column.guess
            if quantity:
                needs = dimensions_of(quantity)
                unit = column.unit.replace(" ", "_").replace("/", "_") or ("?" if needs else "")
                named["_".join(filter(None, (quantity, unit)))] = column.name
        return named


def inspect_file(path: str | Path) -> Inspected:
    """Say what a file or folder is, without a test.

    Parameters
    ----------
    path : str or Path
        A run file, a log, the folder of a recording, a TOML document or a folder that holds one.

    Raises
    ------
    FormatError
        If it cannot be opened, or is of no format that is known; the message says what to do.
    """
    path = Path(path)
    if path.is_dir():
        return _folder(path)
    if path.suffix.lower() == ".toml":
        return _document(path)
    data = opened(path, str(path))
    head = data[:HEAD]
    runs = [one for one in run_formats().values() if one.can_read(head)]
    logs = [one for one in log_formats().values() if one.can_read(head)]
    if runs and not logs:
        return _of_run(path, data, runs[0])
    log = read_log(path)
    if not runs:
        return _of_log(path, log, "log", logs[0].name)
    try:
        tables = _tables(runs[0], data, str(path))
    except FormatError as error:
        problem = str(error) if _are_readings(log) else ""
        return _of_log(path, log, "run" if problem else "log", logs[0].name, problem)
    if set(tables[0].columns) in _CALIBRATED:
        return _of_log(path, log, "readings", runs[0].name)
    if not any(_is_reading(name) for name in tables[0].columns):
        return _of_log(path, log, "log", logs[0].name)
    return _of_log(path, log, "run", runs[0].name, runs=len(tables))


def _folder(folder: Path) -> Inspected:
    for name in ("test.toml", "campaign.toml", "drive.toml"):
        if (folder / name).is_file():
            return _document(folder / name)
    if not part_files(folder):
        raise FormatError(
            f"{folder}: is a folder without test.toml, campaign.toml, drive.toml or parts of a recording; "
            f"name one of its files"
        )
    return _of_log(folder, read_log(folder), "recording", "Parquet")


def _document(path: Path) -> Inspected:
    table = read_document(path)
    said = str(table.get("schema", ""))
    kind, _, version = said.removeprefix("elastogeo.").partition("/")
    if not said.startswith("elastogeo.") or not version:
        raise FormatError(
            f'{path}: is TOML, but says no schema of elastogeo; begin it with a line such as schema = "elastogeo.test/1"'
        )
    return Inspected(str(path), kind, "TOML", metadata={k: v for k, v in table.items() if isinstance(v, str)})


def _of_run(path: Path, data: bytes, run_format: RunFormat) -> Inspected:
    """A run that no reader of logs understands: its columns in internal units."""
    tables = _tables(run_format, data, str(path))
    columns = []
    for name, values in tables[0].columns.items():
        unit = next((_INSIDE[one] for one in dimensions_of(name) if one in _INSIDE), "")
        columns.append(_column(Channel(name, unit, values), name))
    return Inspected(str(path), "run", run_format.name, len(tables), tuple(columns), None, tables[0].metadata)


def _tables(run_format: RunFormat, data: bytes, source: str) -> tuple[Table, ...]:
    return run_format.read_runs(data, source) if run_format.read_runs else (run_format.read(data, source),)


def _of_log(path: Path, log: Log, kind: str, name: str, problem: str = "", runs: int = 1) -> Inspected:
    columns = tuple(_column(channel, _quantity(channel)) for channel in log.channels.values())
    spans = [c.time[-1] - c.time[0] for c in log.channels.values() if c.time is not None]
    duration = float(max(spans)) if spans else None
    return Inspected(str(path), kind, name, runs, columns, duration, log.metadata, log.notes, problem)


def _column(channel: Channel, quantity: str) -> InspectedColumn:
    finite = channel.values[np.isfinite(channel.values)]
    steps = np.diff(channel.time) if channel.time is not None else np.empty(0)
    return InspectedColumn(
        name=channel.name,
        unit=channel.unit,
        quantity=quantity,
        guess="" if quantity else guessed_quantity(channel.name, channel.unit),
        count=len(channel.values),
        numbers=len(finite),
        first=tuple(channel.values[:SHOWN].tolist()),
        low=float(finite.min()) if len(finite) else None,
        high=float(finite.max()) if len(finite) else None,
        rate=1 / float(np.median(steps)) if len(steps) else None,
    )


def _quantity(channel: Channel) -> str:
    """The quantity that a channel's name and unit say without doubt."""
    try:
        quantity, unit = split_unit(channel.name)
        check_unit(quantity, unit or channel.unit, percent=True)
    except (FormatError, InputError):
        return ""
    known = quantity in (*QUANTITIES, *_COUNTED) or dimensions_of(quantity)
    return quantity if known and (not dimensions_of(quantity) or (unit or channel.unit) in UNITS) else ""


def _is_reading(quantity: str) -> bool:
    """Whether a quantity is what an instrument reads, rather than what a control records."""
    return quantity.partition("_")[0] in (
        "angle",
        "radial",
        "radius",
        "displacement",
        "ccw",
        "cw",
        "length",
        "deviation",
        "target",
    )


def _are_readings(log: Log) -> bool:
    names = [_quantity(one) or guessed_quantity(one.name, one.unit) for one in log.channels.values()]
    return any(map(_is_reading, names))
