"""Test files: a test as a TOML document, beside the run files that it names."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.channel_uses import ChannelUse, Clock
from elastogeo.formats.channels import on_one_clock
from elastogeo.formats.documents.calibrations import with_calibration
from elastogeo.formats.documents.drive_logs import is_recording
from elastogeo.formats.documents.machines import find_machine
from elastogeo.formats.log_files import log_formats, read_log, read_log_bytes
from elastogeo.formats.run_files import opened_run, read_run_bytes, run_formats
from elastogeo.formats.text.by_content import claiming
from elastogeo.formats.text.fingerprint import sha256_of
from elastogeo.formats.text.table import Table
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.formats.text.units import UNITS
from elastogeo.machine import About, Feed, Force, Length, Pressure, Resolution, Temperature, Time, Workpiece
from elastogeo.observe import KnownInfluence, MachineTest, Question, Run, check_runs, instrument_named, turning

SCHEMA = "elastogeo.test/1"
FILE_NAME = "test.toml"
EXAMPLE = "hermle-c50-reconstructed"
_SENSES = {"ccw": 1, "cw": -1}
_DATE = re.compile(r"\d{4}-\d\d-\d\d(T[\d:.]+(Z|[+-]\d\d:\d\d)?)?", re.ASCII)

ReadRun = Callable[[Path], Table]


@dataclass(frozen=True, slots=True)
class RunDocument:
    """One entry of the table `runs` of a test file.

    Attributes
    ----------
    file : str
        The run file beside this one; `name#2` is the second run of a file; a log, or the folder of a recording.
    name : str
        By default that of the file.
    force : float or None [N]
    pressure : float or None [bar]
        Of a loaded bar, in place of the force; needs a calibration.
    engagement : float or None [mm]
        Of a ball-roller run.
    feed : float or None [mm/s]
        Speed along the path, if it is not that of the set-up.
    machine_temperature, instrument_temperature : float or None [degC]
        Of this run, if the set-up refers lengths to 20 °C and says another.
    sense : str
        ccw or cw; by default the one that the angles show.
    repeat : int
        Which repeat of its level it is, from 1.
    start, end : float or None [s]
        The part of a log to take, both ends included, on its own clock.
    """

    file: str
    name: str = ""
    force: Force | None = None
    pressure: Pressure | None = None
    engagement: Length | None = None
    feed: Feed | None = None
    machine_temperature: Temperature | None = None
    instrument_temperature: Temperature | None = None
    sense: str = ""
    repeat: int = 1
    start: Time | None = None
    end: Time | None = None

    def __post_init__(self) -> None:
        """Refuse a feed or a sense of rotation that is none, and a part of a log that is empty."""
        if self.feed is not None and not self.feed > 0:
            raise InputError(f"the feed of a run is {self.feed * 60:g} mm/min; it must be positive")
        if self.start is not None and self.end is not None and not self.start < self.end:
            raise InputError(f"the run begins at {self.start:.6g} s and ends at {self.end:.6g} s; let it end later")
        if self.sense and self.sense not in _SENSES:
            raise InputError(f"sense is {self.sense!r}; write ccw (counter-clockwise) or cw (clockwise)")


@dataclass(frozen=True, slots=True)
class TestDocument:
    """What a test file says; its table `setup` is the instrument's.

    `columns` say what the columns of its run files mean where their headers do not: our name with its unit -> header.
    With `channels`, `clock`, or a `start` or `end` of a run, the files of its runs are logs of a controller: see `channels`.
    """

    schema: str
    name: str
    machine: str
    instrument: str
    setup: Mapping[str, Any]
    runs: tuple[RunDocument, ...] = ()
    question: Question = field(default_factory=Question)
    influences: tuple[KnownInfluence, ...] = ()
    resolution: Resolution | None = None
    simulated: str = ""
    reconstructed: str = ""
    workpiece: Workpiece | None = None
    columns: Mapping[str, str] = field(default_factory=dict)
    channels: tuple[ChannelUse, ...] = ()
    clock: Clock = field(default_factory=Clock)
    about: About = field(default_factory=About)


def read_test(
    path: str | Path, read: ReadRun | None = None, setup: Mapping[str, Any] | None = None, planned: int = 0
) -> MachineTest:
    """Read a test: a folder that holds a `test.toml`, or such a file.

    Parameters
    ----------
    path : str or Path
    read : callable, optional
        From the path of a run file to its table; by default the file is read, as a log where the test says or the file shows
        that it is one. A simulation gives its poses here, for runs that no file holds yet.
    setup : mapping of str to any, optional
        What stands in the file's table `setup` is replaced by these entries: a simulation's truth.
    planned : int
        Readings of a full turn to assume for every run instead of reading its file: for a test that has not been run.

    Returns
    -------
    MachineTest

    Raises
    ------
    FormatError
        If the file, or a run file, is not what it must be.
    InputError
        If the machine or the test contradicts itself.
    """
    file, document = read_test_document(Path(path))
    read = full_turn(planned) if planned and read is None else read
    tables = [_table(document, entry, file.parent, read) for entry in document.runs]
    runs = tuple(_run(entry, table, file.parent) for entry, table in zip(document.runs, tables, strict=True))
    if read is None:
        _check(runs, file)
    entries = with_calibration({**document.setup, **(setup or {})}, file.parent)
    found = build(instrument_named(document.instrument), entries, f"{file}, setup")
    for table in tables:
        _check_units(table, found.file_units)
    _check_resolution(file, angles=found.reads_angles)
    return MachineTest(
        name=document.name,
        machine=find_machine(document.machine, file.parent),
        setup=found,
        runs=runs,
        question=document.question,
        resolution=document.resolution,
        influences=document.influences,
        simulated=document.simulated or ", ".join(dict.fromkeys(run.simulated for run in runs if run.simulated)),
        reconstructed=document.reconstructed,
        workpiece=document.workpiece,
        about=_dated(document.about, tables),
    )


def full_turn(readings: int) -> ReadRun:
    """Poses of one full turn with this many readings, for runs that no file holds yet."""
    angle = 2 * np.pi * np.arange(readings) / readings
    return lambda path: Table({"angle": angle, "radial": np.zeros(readings)}, {}, str(path))


def read_test_document(path: Path) -> tuple[Path, TestDocument]:
    """The test file of a folder, or the file itself, and what it says; no run file is opened.

    Raises
    ------
    FormatError
        If it is not what it must be, or names no run.
    """
    file = path / FILE_NAME if path.is_dir() else path
    if is_recording(path) and not file.exists():
        raise FormatError(
            f"{path}: is a recording; name it in the {FILE_NAME} of a folder beside it: [[runs]] with "
            f'file = "../{path.name}"'
        )
    table = read_document(file)
    check_schema(table, SCHEMA, str(file))
    document = build(TestDocument, table, str(file))
    if not document.runs:
        raise FormatError(f'{file}: names no run; add for each run [[runs]] with file = "runs/112N.csv" and force_N = 112')
    return file, document


def run_files_of(path: str | Path) -> tuple[Path, ...]:
    """The run files that a test names, whether they are there or not."""
    file, document = read_test_document(Path(path))
    return tuple(file.parent / run.file for run in document.runs)


def example_test() -> Path:
    """The folder of the example test that comes with elastogeo.

    Raises
    ------
    FormatError
        If this copy of elastogeo came without it.
    """
    package = Path(str(resources.files("elastogeo")))
    for folder in (package / "examples" / EXAMPLE, package.parent.parent / "examples" / EXAMPLE):
        if (folder / FILE_NAME).is_file():
            return folder
    raise FormatError(f"the example {EXAMPLE} did not come with this copy of elastogeo; install it again")


def _table(document: TestDocument, entry: RunDocument, folder: Path, read: ReadRun | None) -> Table:
    """What a run recorded; of a log, its channels on one clock."""
    path = folder / entry.file
    if read is not None:
        return read(path)
    asked = bool(document.channels) or document.clock != Clock() or entry.start is not None or entry.end is not None
    if asked and document.columns:
        raise FormatError(f"{path}: columns are those of runs, channels those of logs; say one of them in the test file")
    log = read_log(path) if path.is_dir() or asked else None
    if log is None:
        data, number = opened_run(path)
        runs = claiming(run_formats(), data)
        logs = [] if runs or document.columns else claiming(log_formats(), data)
        if not logs:
            return read_run_bytes(data, str(path), number, document.columns, runs)
        log = read_log_bytes(data, str(path), logs)
    found = on_one_clock(log, document.channels, document.clock, entry.start, entry.end)
    if found.percent:
        name, kind = found.percent[0], found.percent[0].partition("_")[0]
        raise FormatError(
            f"{path}: {name} is in % of a rated value; say it under [[channels]], as rated_{kind}, with its unit"
        )
    return found.table


def _dated(about: About, tables: Sequence[Table]) -> About:
    """With the date of the earliest run where the test says none and all run files do."""
    dates = [table.metadata.get("date", "") for table in tables]
    if about.date or not all(map(_DATE.fullmatch, dates)):
        return about
    return replace(about, date=min(dates))


def _check(runs: tuple[Run, ...], file: Path) -> None:
    try:
        check_runs(runs)
    except InputError as error:
        raise InputError(f"{file}: {error}") from None


def _check_resolution(file: Path, *, angles: bool) -> None:
    """Refuse the resolution of angles in a unit of length, and the other way round."""
    for key in read_document(file):
        name, _, unit = key.partition("_")
        if name == "resolution" and UNITS[unit].dimension != ("angle" if angles else "length"):
            said = "arcsec, since this test reads angles" if angles else "um, since this test reads lengths"
            raise FormatError(f"{file}: {key} is no resolution of its readings; write resolution_{said}")


def _check_units(table: Table, usual: Mapping[str, str]) -> None:
    """Refuse a column in a unit of another dimension than the instrument reads: degrees of a linear axis."""
    for quantity, unit in table.units.items():
        wanted = usual.get(quantity, unit)
        if unit != wanted and (unit not in UNITS or wanted not in UNITS or UNITS[unit].dimension != UNITS[wanted].dimension):
            raise FormatError(
                f"{table.source}: column {quantity!r} has {f'the unit {unit}' if unit else 'no unit'}; with the set-up of "
                f"this test write {quantity}{f'_{wanted}' if wanted else ' without a unit'}"
            )


def _run(document: RunDocument, table: Table, folder: Path) -> Run:
    said, _, number = document.file.partition("#")
    falling = "angle" in table.columns and turning(table.columns["angle"]) < 0
    sense = document.sense or table.metadata.get("direction", "cw" if falling else "ccw").lower()
    if sense != table.metadata.get("direction", sense).lower():
        raise FormatError(
            f"{table.source}: the file says that the run went {table.metadata['direction']}, the test says {sense}; "
            f"correct the test file, or leave its sense out"
        )
    return Run(
        name=document.name or "-".join(filter(None, [Path(said).stem, number])),
        columns=table.columns,
        force=document.force,
        pressure=document.pressure,
        engagement=document.engagement,
        feed=document.feed,
        machine_temperature=document.machine_temperature,
        instrument_temperature=document.instrument_temperature,
        sense=_SENSES[sense],
        repeat=document.repeat,
        notes=tuple(table.metadata.get("clock", "").splitlines()),
        file=document.file,
        sha256=_hash(folder, document.file),
        simulated=table.metadata.get("simulated", ""),
        truth=_truth(table) if table.metadata.get("simulated") else {},
    )


def _truth(table: Table) -> dict[str, float]:
    """What a simulated run says of the parameters that it was made from."""
    text = table.metadata.get("truth", "")
    pairs = [entry.rpartition("=") for entry in text.split()]
    try:
        truth = {name: float(value) for name, _, value in pairs if name}
    except ValueError:
        truth = {}
    if len(truth) != len(pairs) or not all(map(isfinite, truth.values())):
        raise FormatError(
            f"{table.source}: the truth of this simulated run is {text!r}, not a list of name=value; simulate it again, or "
            f"delete that line"
        )
    return truth


def _hash(folder: Path, name: str) -> str:
    """Of the file of a run, of which `name#2` is the second run; empty if there is none yet."""
    path = folder / name if (folder / name).exists() else folder / name.partition("#")[0]
    return sha256_of(path) if path.exists() else ""
