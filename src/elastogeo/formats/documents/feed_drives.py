"""Drive files: logs of feed drives, what their channels are, and what is asked of them, as a TOML document.

    schema = "elastogeo.drive/1"
    name = "three-axis mill, unloaded"
    logs = ["run_*.csv"]

    [clock]
    sample_time_ms = 100            # if the logs keep no clock

    [[channels]]
    quantity = "current_x"          # current_, torque_ or force_, position_, velocity_, acceleration_ and the axis
    channel = "X1_CurrentFeedback"
    unit = "A"

A log whose headers say quantity and unit (`time_s,current_x_A,position_x_mm`) needs no such file: `read_drive_logs`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated

import numpy as np

from elastogeo.drive import (
    EVERY_LOG,
    PLAIN,
    SEARCHABLE,
    DriveRecord,
    DriveTest,
    FeedDrive,
    TorqueModel,
    differentiate,
    effort_from_current,
    gain,
    smoothed,
    standing,
    units_of,
    window_of,
)
from elastogeo.errors import FormatError, InputError
from elastogeo.formats.channels import ChannelUse, Clock, OnOneClock, on_one_clock
from elastogeo.formats.log_files import read_log
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.machine import Array, Feed, Frequency, Time

Centre = Annotated[tuple[float, float], "mm"]

SCHEMA = "elastogeo.drive/1"
FILE_NAME = "drive.toml"
SHARE_OF_SAMPLING, HIGHEST = 0.1, 30.0
"""The cut-off of the differentiator where none is given: this share of the sampling rate, at most so many Hz."""


@dataclass(frozen=True, slots=True)
class ModelDocument:
    """The table `model`: the balance that is identified first.

    Attributes
    ----------
    search : tuple of str
        Which of smooth_speed, stribeck_speed, delay and neighbours are searched instead of given.
    compare : bool
        Whether richer models are compared with the plain one.
    cutoff : float or None [Hz]
        Of the differentiator, where a log has no velocity or no acceleration.
    """

    terms: tuple[str, ...] = PLAIN
    least_speed: Feed | None = None
    smooth_speed: Feed | None = None
    stribeck_speed: Feed | None = None
    delay: Time = 0.0
    neighbours: float = 0.0
    search: tuple[str, ...] = ()
    compare: bool = True
    cutoff: Frequency | None = None


@dataclass(frozen=True, slots=True)
class KnownDocument:
    """One entry of the table `known`: a parameter that is given. Its unit is that of the results."""

    axis: str
    parameter: str
    value: float
    unit: str


@dataclass(frozen=True, slots=True)
class LoadDocument:
    """One entry of the table `loads`: a radial load of unknown size on a circular path (Eqs. 6.7, 6.8).

    Attributes
    ----------
    name : str
        Of the load; runs of one engagement share it.
    runs : tuple of str
        Runs that it acts in.
    centre : tuple of 2 float [mm]
        Of the circle, in positions of the axes.
    axes : tuple of 2 str
    """

    name: str
    runs: tuple[str, ...]
    centre: Centre = (0.0, 0.0)
    axes: tuple[str, ...] = ("X", "Y")

    def __post_init__(self) -> None:
        """Refuse a plane that is none."""
        if len(self.axes) != 2 or self.axes[0] == self.axes[1]:
            raise InputError(f"the load {self.name!r} acts in the plane of two axes; got {', '.join(self.axes)}")


@dataclass(frozen=True, slots=True)
class DriveDocument:
    """What a drive file says."""

    schema: str
    name: str
    logs: tuple[str, ...]
    channels: tuple[ChannelUse, ...] = ()
    clock: Clock = field(default_factory=Clock)
    axes: tuple[str, ...] = ()
    drives: tuple[FeedDrive, ...] = ()
    model: ModelDocument = field(default_factory=ModelDocument)
    known: tuple[KnownDocument, ...] = ()
    loads: tuple[LoadDocument, ...] = ()
    held_out: tuple[str, ...] = ()
    simulated: str = ""


def read_drives(
    paths: str | Path | Sequence[str | Path], axes: Sequence[str] = (), held_out: Sequence[str] = ()
) -> DriveTest:
    """Read a drive file, a folder that holds a `drive.toml`, or logs whose headers say quantity and unit.

    Parameters
    ----------
    paths : str, Path, or sequence of these
        One drive file or folder, or one log or more.
    axes : sequence of str
        Axes to read; default those of the file, else all.
    held_out : sequence of str
        Runs that are predicted only, besides those of the file.

    Raises
    ------
    FormatError
        If a file is not what it must be, or has no drive.
    InputError
        If the test contradicts itself.
    """
    given = [paths] if isinstance(paths, str | Path) else paths
    files = [Path(path) for path in given]
    documents = [path for path in files if path.is_dir() or path.suffix.lower() == ".toml"]
    if documents and len(files) > 1:
        raise FormatError(f"{documents[0]}: is a drive file, which names its logs; give it alone, or logs alone")
    if documents:
        file = documents[0] / FILE_NAME if documents[0].is_dir() else documents[0]
        table = read_document(file)
        check_schema(table, SCHEMA, str(file))
        document = build(DriveDocument, table, str(file))
        return _test(document, _logs(document, file), str(file), axes, held_out)
    name = ", ".join(path.name for path in files[:3]) + (f" and {len(files) - 3} more" if len(files) > 3 else "")
    document = DriveDocument(SCHEMA, name, tuple(map(str, files)))
    return _test(document, files, name, axes, held_out)


def _logs(document: DriveDocument, file: Path) -> list[Path]:
    """The log files that a document names, patterns resolved, in their order."""
    found: list[Path] = []
    for entry in document.logs:
        folder, _, name = entry.replace("\\", "/").rpartition("/")
        if not name or any(sign in folder for sign in "*?["):
            raise FormatError(f"{file}: logs has {entry!r}; write a file, or a pattern in its last part such as run_*.csv")
        place = file.parent / folder
        matches = sorted(place.glob(name)) if any(sign in name for sign in "*?[") else [place / name]
        if not matches:
            raise FormatError(f"{file}: no log matches {entry!r} in {place}; copy the logs there, or correct the path")
        found += matches
    if not found:
        raise FormatError(f'{file}: names no log; write for example logs = ["run_*.csv"]')
    return list(dict.fromkeys(found))


def _test(
    document: DriveDocument, logs: Sequence[Path], where: str, axes: Sequence[str], held_out: Sequence[str]
) -> DriveTest:
    drives = {drive.axis: drive for drive in document.drives}
    wanted = tuple(axes) or document.axes
    told = document.model
    runs = [path.stem for path in logs]
    twice = sorted({run for run in runs if runs.count(run) > 1})
    if twice:
        raise FormatError(f"{where}: two logs are called {twice[0]}; a run is named after its file, rename one")
    records: list[DriveRecord] = []
    notes: dict[str, list[str]] = {}
    for path in logs:
        found = on_one_clock(read_log(path), document.channels, document.clock)
        made, said = _records(path.stem, found, drives, wanted, told.cutoff)
        records += [_loaded(record, made, document.loads) for record in made]
        for sentence in (*found.report, *said):
            notes.setdefault(sentence, []).append(path.stem)
    missing = [axis for axis in wanted if axis not in {record.axis for record in records}]
    if missing:
        raise FormatError(f"{where}: the logs have no current, torque or force of axis {missing[0]}; map its channels")
    test = DriveTest(
        name=document.name,
        records=tuple(records),
        drives=drives,
        model=_model(told),
        searched=told.search,
        held_out=tuple(dict.fromkeys((*document.held_out, *held_out))),
        compare=told.compare,
        notes=tuple(f"{', '.join(of) if len(of) < len(logs) else EVERY_LOG}: {said}" for said, of in notes.items()),
        simulated=document.simulated,
    )
    strangers = [run for load in document.loads for run in load.runs if run not in runs]
    if strangers:
        raise FormatError(f"{where}: a load acts in the run {strangers[0]!r}, but the logs are {', '.join(runs)}")
    return _with_known(test, document.known, where)


def _model(told: ModelDocument) -> TorqueModel:
    strangers = [name for name in told.search if name not in SEARCHABLE]
    if strangers:
        raise InputError(f"model.search has {strangers[0]!r}; name some of {', '.join(SEARCHABLE)}")
    start = 1.0 if "stribeck_speed" in told.search and told.stribeck_speed is None else told.stribeck_speed
    return TorqueModel(told.terms, told.least_speed, told.smooth_speed, start, told.delay, told.neighbours)


def _with_known(test: DriveTest, entries: Sequence[KnownDocument], where: str) -> DriveTest:
    """The test with its known parameters, whose units are checked against those of the results."""
    known: dict[str, dict[str, float]] = {}
    for entry in entries:
        records = test.of(entry.axis)
        if not records:
            raise FormatError(f"{where}, known: there is no record of axis {entry.axis!r}, there are {', '.join(test.axes)}")
        units = units_of(records, test.model)
        if entry.parameter not in units:
            raise FormatError(f"{where}, known: {entry.parameter!r} is none of the parameters {', '.join(units)}")
        if entry.unit != units[entry.parameter]:
            raise FormatError(
                f"{where}, known: {entry.parameter} of axis {entry.axis} is given in {entry.unit!r}; write it in "
                f"{units[entry.parameter]!r}"
            )
        known.setdefault(entry.axis, {})[entry.parameter] = entry.value
    return replace(test, known=known)


def _records(
    run: str, found: OnOneClock, drives: Mapping[str, FeedDrive], wanted: Sequence[str], cutoff: float | None
) -> tuple[list[DriveRecord], list[str]]:
    """The record of every axis whose effort is in a log, and what was done."""
    columns, source = found.table.columns, found.table.source
    records, notes = [], []
    for axis in _axes(columns):
        if wanted and axis not in wanted:
            continue
        effort, unit = _effort(axis, columns, drives)
        record, said = _record(run, axis, found, effort, unit, cutoff, source)
        records.append(record)
        notes += said
    if not records and not wanted:
        raise FormatError(
            f"{source}: no channel is the current, torque or force of a drive; name them current_x, torque_x or force_x "
            f"with their unit, or map them in a drive file"
        )
    return records, notes


def _axes(columns: Mapping[str, Array]) -> list[str]:
    """Axes that an effort is recorded of."""
    split = [name.rpartition("_") for name in columns]
    return list(dict.fromkeys(axis.upper() for kind, _, axis in split if kind in ("current", "torque", "force")))


def _effort(axis: str, columns: Mapping[str, Array], drives: Mapping[str, FeedDrive]) -> tuple[Array, str]:
    """Effort of a drive and its unit: what is recorded nearest to a torque."""
    named = axis.lower()
    for kind, unit in (("torque", "N mm"), ("force", "N")):
        if f"{kind}_{named}" in columns:
            return columns[f"{kind}_{named}"], unit
    current, drive = columns[f"current_{named}"], drives.get(axis)
    if drive is None:
        return current, "A"
    if drive.motor_constant is None:
        return drive.sense * current, "A"
    return effort_from_current(drive, current), "N" if drive.force_constant is not None else "N mm"


def _record(
    run: str, axis: str, found: OnOneClock, effort: Array, unit: str, cutoff: float | None, source: str
) -> tuple[DriveRecord, list[str]]:
    """One record: the motion from its own channels, or from the highest derivative that is there."""
    columns, named = found.table.columns, axis.lower()
    time = columns["time"]
    position, velocity, acceleration = (columns.get(f"{kind}_{named}") for kind in ("position", "velocity", "acceleration"))
    if velocity is not None and acceleration is not None:
        if position is None:
            position = _integrated(time, velocity)
        return DriveRecord(run, axis, time, position, velocity, acceleration, effort, effort_unit=unit), []
    from_velocity = velocity is not None
    known = velocity if velocity is not None else position
    if known is None:
        raise FormatError(
            f"{source}: has the effort of axis {axis}, but neither its position nor its velocity; map position_{named}, or "
            f"leave the axis out with axes"
        )
    chosen = cutoff or min(SHARE_OF_SAMPLING / found.step, HIGHEST)
    try:
        made = differentiate(time, known, chosen)
        smooth = smoothed(time, effort, chosen)
    except InputError as error:
        raise FormatError(f"{source}, axis {axis}: {error}") from None
    keep = ~made.edge
    if keep.sum() < 2:
        raise FormatError(
            f"{source}, axis {axis}: no sample is far enough from an end for a cut-off of {chosen:.3g} Hz; record longer"
        )
    if from_velocity:
        # Segments too short for the filter have no number; their samples are left out below.
        where = _integrated(time, np.nan_to_num(made.position)) if position is None else position
        position, velocity, acceleration = where, made.position, made.velocity
    else:
        position, velocity, acceleration = made.position, made.velocity, made.acceleration
    path = _integrated(time, known) if from_velocity else known
    at_rest = standing(time, path, made.position if from_velocity else made.velocity, window_of(found.step, chosen))
    derivative = 1 if from_velocity else 2
    left = gain(chosen, found.step, chosen, derivative) / gain(chosen, found.step, chosen, 0)
    note = (
        f"axis {axis}: {'acceleration' if from_velocity else 'velocity and acceleration'} by differences after a zero-phase "
        f"low-pass of {chosen:.3g} Hz, through which the effort goes as well; at that frequency the acceleration keeps "
        f"{100 * left:.2f} % of what the effort does, so the inertia is too large by {100 * (1 / left - 1):.2f} % there and "
        f"by less below; {int((~keep).sum())} samples near the ends are left out"
    )
    record = DriveRecord(
        run,
        axis,
        time[keep],
        position[keep],
        velocity[keep],
        acceleration[keep],
        smooth[keep],
        effort_unit=unit,
        cutoff=chosen,
        standing=at_rest[keep],
    )
    return record, [note]


def _integrated(time: Array, velocity: Array) -> Array:
    """Position relative to the first sample, by trapezoids."""
    return np.concatenate([[0.0], np.cumsum(np.diff(time) * (velocity[1:] + velocity[:-1]) / 2)])


def _loaded(record: DriveRecord, others: Sequence[DriveRecord], loads: Sequence[LoadDocument]) -> DriveRecord:
    """The record with the direction patterns of the loads that act in its run on its axis."""
    acting = [load for load in loads if record.run in load.runs and record.axis in load.axes]
    if not acting:
        return record
    patterns = {}
    for load in acting:
        pair = [next((other for other in others if other.axis == axis), None) for axis in load.axes]
        if any(other is None or not np.array_equal(other.time, record.time) for other in pair):
            raise FormatError(
                f"run {record.run}: the load {load.name!r} needs the positions of {' and '.join(load.axes)} at the same "
                f"times"
            )
        x, y = (other.position - c for other, c in zip(pair, load.centre, strict=True) if other is not None)
        radius = np.hypot(x, y)
        if not radius.all():
            raise FormatError(
                f"run {record.run}: the path goes through the centre of the load {load.name!r}; correct centre_mm"
            )
        patterns[load.name] = (x, y)[load.axes.index(record.axis)] / radius
    return replace(record, disturbance=patterns)
