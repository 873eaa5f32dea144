"""A test of feed drives: the records of its runs, and what is asked of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from elastogeo.drive.feed_drive import FeedDrive
from elastogeo.drive.model import TorqueModel
from elastogeo.drive.records import DriveRecord
from elastogeo.errors import InputError
from elastogeo.machine import About

EVERY_LOG = "all logs"
"""How a note begins that holds for all logs of a test."""


@dataclass(frozen=True, slots=True, eq=False)
class DriveTest:
    """Records of feed drives, and what is asked of them.

    Attributes
    ----------
    name : str
    records : tuple of DriveRecord
        Of every run and axis.
    drives : mapping of str to FeedDrive
        By axis, as far as they are known.
    model : TorqueModel
    searched : tuple of str
        Parameters of the model to search.
    known : mapping of str to mapping of str to float
        Parameters that are given, by axis and name.
    held_out : tuple of str
        Runs that are predicted only.
    compare : bool
        Whether richer models are compared.
    models : mapping of str to str
        Name of the model that is to be shown, by axis; by an empty name for all axes. Without one, it is that which the runs
        support.
    notes : tuple of str
        What was done to the logs.
    simulated : str
        From what the records are simulated; empty if they were measured.
    about : About
    files : mapping of str to tuple of (str, str)
        Name and SHA-256 of the log of each run.
    """

    name: str
    records: tuple[DriveRecord, ...]
    drives: Mapping[str, FeedDrive] = field(default_factory=dict)
    model: TorqueModel = field(default_factory=TorqueModel)
    searched: tuple[str, ...] = ()
    known: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    held_out: tuple[str, ...] = ()
    compare: bool = True
    models: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    simulated: str = ""
    about: About = field(default_factory=About)
    files: Mapping[str, tuple[str, str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse a test that asks of runs or axes that are not there."""
        runs = self.runs
        if not runs:
            raise InputError(f"{self.name}: there is no record of a drive; give the log of one run or more")
        strangers = [run for run in self.held_out if run not in runs]
        if strangers:
            raise InputError(f"the run {strangers[0]!r} is to be held out, but there are {', '.join(runs)}")
        if set(self.held_out) >= set(runs):
            raise InputError("all runs are to be held out; leave some to identify the drives from")
        modelled = [axis for axis in self.models if axis and axis not in self.axes]
        if modelled:
            raise InputError(f"a model of axis {modelled[0]} is asked for, but there are records of {', '.join(self.axes)}")
        unknown = [axis for axis in self.known if axis not in self.axes]
        if unknown:
            raise InputError(f"a parameter of axis {unknown[0]} is known, but there are records of {', '.join(self.axes)}")

    @property
    def runs(self) -> tuple[str, ...]:
        """Names of the runs, in the order of the records."""
        return tuple(dict.fromkeys(record.run for record in self.records))

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes, in the order of the records."""
        return tuple(dict.fromkeys(record.axis for record in self.records))

    def of(self, axis: str) -> list[DriveRecord]:
        """The records of one axis."""
        return [record for record in self.records if record.axis == axis]
