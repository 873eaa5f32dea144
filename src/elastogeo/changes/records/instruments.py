"""Instruments that a history keeps: their calibrations, until when these hold, and what was tested with them."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.changes.due_dates import DueDate
from elastogeo.changes.events import Event
from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Calibration(Part):
    """One calibration of an instrument.

    Attributes
    ----------
    at : float [d]
    due : float or None [d]
        Until when it holds; None where nobody said.
    certificate : str
    who : str
        Who entered it.
    """

    at: float
    due: float | None
    certificate: str
    who: str


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptInstrument(Part):
    """One instrument.

    Attributes
    ----------
    key : int
    serial, kind : str
    calibrations : tuple of Calibration
        The last first.
    due : DueDate
        Of the next calibration, as it stands now: without a date where the last one says none.
    tests : int
        Made with it.
    machines : tuple of str
        Tested with it.
    last_test : float or None [d]
    alarm : int or None
        Number of its open alarm.
    """

    key: int
    serial: str
    kind: str
    calibrations: tuple[Calibration, ...]
    due: DueDate
    tests: int
    machines: tuple[str, ...]
    last_test: float | None
    alarm: int | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptInstruments(Result):
    """All instruments.

    Attributes
    ----------
    store : str
    now : float [d]
    instruments : tuple of KeptInstrument
        Those whose calibration has run out first, then by the date on which it does, those without a date last.
    simulated : str
        From what the tests are simulated; empty if any was measured.
    """

    store: str
    now: float
    instruments: tuple[KeptInstrument, ...]
    simulated: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TestWith(Part):
    """A test that was made with an instrument.

    Attributes
    ----------
    key : int
    name, machine, series : str
    at : float [d]
    expired : bool
        Whether the calibration had run out then.
    """

    __test__ = False

    key: int
    name: str
    machine: str
    series: str
    at: float
    expired: bool


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class InstrumentRecord(Result):
    """One instrument, with what was done with it and to it.

    Attributes
    ----------
    now : float [d]
    instrument : KeptInstrument
    tests : tuple of TestWith
        The last ones, the last first.
    alarms : tuple of (int, str, float)
        Number, state, and since when it is in this state [d], the last first.
    events : tuple of Event
        The last first.
    simulated : str
        From what the tests are simulated; empty if any was measured.
    """

    now: float
    instrument: KeptInstrument
    tests: tuple[TestWith, ...]
    alarms: tuple[tuple[int, str, float], ...]
    events: tuple[Event, ...]
    simulated: str = ""
