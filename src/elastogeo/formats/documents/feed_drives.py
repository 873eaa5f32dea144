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

A log whose headers say quantity and unit (`time_s,current_x_A,position_x_mm`) needs no such file, and neither does the
folder of a recording whose channels do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from elastogeo.drive import (
    EVERY_LOG,
    PLAIN,
    SEARCHABLE,
    DriveRecord,
    DriveTest,
    FeedDrive,
    TorqueModel,
    units_of,
)
from elastogeo.errors import FormatError, InputError
from elastogeo.formats.channel_uses import ChannelUse, Clock
from elastogeo.formats.channels import on_one_clock
from elastogeo.formats.documents.drive_logs import RunLog, is_recording, named_logs, runs_of
from elastogeo.formats.documents.drive_records import LoadDocument, loaded, records_of
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.machine import About, Feed, Frequency, Time

SCHEMA = "elastogeo.drive/1"
FILE_NAME = "drive.toml"


@dataclass(frozen=True, slots=True)
class ModelDocument:
    """The table `model`: the balance that is identified first.

    Attributes
    ----------
    terms : tuple of str
        Of Eq. 6.6: inertia, viscous, coulomb, constant; and coulomb asymmetric, viscous asymmetric, stribeck.
    least_speed : float or None [mm/s]
        Slower samples are left out; by default those that the record itself shows to be at rest.
    smooth_speed : float or None [mm/s]
        Over which friction sets in, `tanh(v / smooth_speed)`; by default its sign is sharp.
    stribeck_speed : float or None [mm/s]
        Of the term stribeck.
    delay : float [s]
        By which the effort is recorded later than the motion.
    neighbours : float
        Share, 0 to 0.5, of the mean of its two neighbours in the motion of a sample.
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
    """One entry of the table `known`: a parameter that is given.

    Attributes
    ----------
    axis : str
    parameter : str
        Its name in the results: inertia, viscous, ...
    value : float
    unit : str
        As the results write it; another is refused.
    """

    axis: str
    parameter: str
    value: float
    unit: str


@dataclass(frozen=True, slots=True)
class ShownDocument:
    """One entry of the table `models`: the model whose parameters come first.

    Attributes
    ----------
    name : str
        Of one of the models that are compared: plain, smooth sign, ...
    axis : str
        Empty: all axes.
    """

    name: str
    axis: str = ""


@dataclass(frozen=True, slots=True)
class DriveDocument:
    """What a drive file says.

    Attributes
    ----------
    schema : str
        `elastogeo.drive/1`.
    name : str
        Of the test, for people.
    logs : tuple of str
        Log files beside this one, patterns (`run_*.csv`), folders of recordings. Each is a run, named after its file.
    channels : tuple of ChannelUse
        What the channels of the logs are; not needed where their names say quantity and unit.
    clock : Clock
        The clock that the channels of a log are put on.
    axes : tuple of str
        The axes to identify; all by default.
    drives : tuple of FeedDrive
        What turns the current of each axis into a force.
    model : ModelDocument
        The balance that is identified first.
    known : tuple of KnownDocument
        Parameters that are given.
    loads : tuple of LoadDocument
        Radial loads of unknown size on a circle.
    held_out : tuple of str
        Runs that are predicted only.
    models : tuple of ShownDocument
        Models whose parameters come first.
    simulated : str
        From what the logs are simulated; empty if they were measured.
    about : About
        Who, when, where, with what.
    """

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
    models: tuple[ShownDocument, ...] = ()
    simulated: str = ""
    about: About = field(default_factory=About)


def read_drives(
    paths: str | Path | Sequence[str | Path], axes: Sequence[str] = (), held_out: Sequence[str] = ()
) -> DriveTest:
    """Read a drive file, a folder that holds a `drive.toml`, or logs and recordings that say quantity and unit.

    Parameters
    ----------
    paths : str, Path, or sequence of these
        One drive file or its folder; or one log or more, among them folders of recordings. Parts of one recording are
        one run.
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
    documents = [path for path in files if path.suffix.lower() == ".toml" or (path.is_dir() and not is_recording(path))]
    if documents and len(files) > 1:
        raise FormatError(f"{documents[0]}: is a drive file, which names its logs; give it alone, or logs alone")
    if documents:
        file = documents[0] / FILE_NAME if documents[0].is_dir() else documents[0]
        if documents[0].is_dir() and not file.exists():
            raise FormatError(f"{documents[0]}: holds no {FILE_NAME} and no parts of a recording; name the logs themselves")
        table = read_document(file)
        check_schema(table, SCHEMA, str(file))
        document = build(DriveDocument, table, str(file))
        return _test(document, runs_of(named_logs(document.logs, file)), str(file), axes, held_out)
    name = ", ".join(path.name for path in files[:3]) + (f" and {len(files) - 3} more" if len(files) > 3 else "")
    document = DriveDocument(SCHEMA, name, tuple(map(str, files)))
    return _test(document, runs_of(files), name, axes, held_out)


def _test(
    document: DriveDocument, logs: Sequence[RunLog], where: str, axes: Sequence[str], held_out: Sequence[str]
) -> DriveTest:
    drives = {drive.axis: drive for drive in document.drives}
    wanted = tuple(axes) or document.axes
    told = document.model
    runs = [log.name for log in logs]
    twice = sorted({run for run in runs if runs.count(run) > 1})
    if twice:
        raise FormatError(f"{where}: two logs are called {twice[0]}; a run is named after its file, rename one")
    records: list[DriveRecord] = []
    notes: dict[str, list[str]] = {}
    for log in logs:
        found = on_one_clock(log.read(), document.channels, document.clock)
        made, said = records_of(log.name, found, drives, wanted, told.cutoff)
        records += [loaded(record, made, document.loads) for record in made]
        for sentence in (*found.report, *said):
            notes.setdefault(sentence, []).append(log.name)
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
        models={shown.axis: shown.name for shown in document.models},
        notes=tuple(f"{', '.join(of) if len(of) < len(logs) else EVERY_LOG}: {said}" for said, of in notes.items()),
        simulated=document.simulated,
        about=document.about,
        files={log.name: (log.path.name, log.sha256()) for log in logs},
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
