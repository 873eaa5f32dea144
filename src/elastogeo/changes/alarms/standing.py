"""What became of alarms: one as it stands, what a person is told of it, and all that wait for somebody."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from elastogeo.changes.fleets import MachineRow
from elastogeo.changes.result import ChangeVerdict
from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AlarmRow(Part):
    """An alarm as it stands. Dates in days since 1970-01-01 UTC.

    Attributes
    ----------
    number : int
    machine, series : str
        Empty if it is the alarm of an instrument.
    instrument : str
        Serial number; empty if it is the alarm of a series.
    state : str
        `OPEN`, `HELD`, `ACKNOWLEDGED` or one of `CLOSED`.
    opened : float [d]
    over : mapping of str to float
        By indicator, how many limits it was away from the baseline at most, as far as its steps say.
    confirmed : bool
        Whether a second test shows the change as well.
    who, why : str
        Of the person's last step; empty without one.
    at : float [d]
        Of its last step.
    holds : tuple of str
        Of the alarm of an instrument, the machines whose alarms it holds back.
    silent_until : float or None [d]
        Until when nothing is sent of its machine.
    simulated : str
        From what the tests of its series are simulated; empty if any was measured.
    place : str
        Hall or plant of its machine.
    shown : MachineRow or None
        What its series shows now, in one row; None of an instrument, and of an alarm that is closed.
    held_by : int or None
        Number of the alarm of the instrument that holds it back.
    machine_key, series_key, instrument_key : int or None
        In its history.
    """

    number: int
    machine: str
    series: str
    instrument: str
    state: str
    opened: float
    over: Mapping[str, float]
    confirmed: bool
    who: str
    why: str
    at: float
    holds: tuple[str, ...] = ()
    silent_until: float | None = None
    simulated: str = ""
    place: str = ""
    shown: MachineRow | None = None
    held_by: int | None = None
    machine_key: int | None = None
    series_key: int | None = None
    instrument_key: int | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AlarmNews(Result):
    """One change of state of an alarm, as a person is told of it.

    Attributes
    ----------
    step : str
        `OPEN`, `WORSE`, `RELEASED` or one of `CLOSED`.
    alarm : AlarmRow
    verdict : ChangeVerdict or None
        Of the series when it happened; None for an instrument, and where a person took the step.
    simulated : str
        From what the tests are simulated; empty if they were measured.
    """

    step: str
    alarm: AlarmRow
    verdict: ChangeVerdict | None = None
    simulated: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class OverdueRow(Part):
    """A test that is overdue.

    Attributes
    ----------
    machine, series : str
    due : float [d]
    overdue : float [d]
        How long, the grace taken off.
    """

    machine: str
    series: str
    due: float
    overdue: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FailedRow(Part):
    """A message that was given up.

    Attributes
    ----------
    channel, address, subject, error : str
    at : float [d]
        When it was made.
    """

    channel: str
    address: str
    subject: str
    error: str
    at: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class SilenceRow(Part):
    """A machine of which nothing is sent.

    Attributes
    ----------
    machine : str
    machine_key : int
        In its history.
    until, at : float [d]
        Until when, and when that was said.
    who, why : str
    """

    machine: str
    machine_key: int
    until: float
    at: float
    who: str
    why: str


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AlarmList(Result):
    """Alarms, and what else a person should see once a week: the digest.

    Attributes
    ----------
    now : float [d]
    alarms : tuple of AlarmRow
        Those that nobody knows of first, then by age.
    overdue : tuple of OverdueRow
        The longest first.
    failed : tuple of FailedRow
        Of the last week.
    simulated : str
        From what the tests are simulated; empty if any was measured.
    acted : bool
        Whether it is what a person just did to one alarm, not all there is.
    closed : tuple of AlarmRow
        Those that were closed lately, the last first; the digest has none of them.
    silences : tuple of SilenceRow
        Those that hold now, by machine; the digest has none of them.
    """

    now: float
    alarms: tuple[AlarmRow, ...]
    overdue: tuple[OverdueRow, ...] = ()
    failed: tuple[FailedRow, ...] = ()
    simulated: str = ""
    acted: bool = False
    closed: tuple[AlarmRow, ...] = ()
    silences: tuple[SilenceRow, ...] = ()

    @property
    def places(self) -> tuple[str, ...]:
        """Halls or plants of the machines."""
        return tuple(sorted({row.place for row in (*self.alarms, *self.closed)} - {""}))

    def only(self, state: str = "", place: str = "") -> AlarmList:
        """The alarms in a state, at a place; empty: all. An instrument has no place."""

        def chosen(rows: tuple[AlarmRow, ...]) -> tuple[AlarmRow, ...]:
            return tuple(row for row in rows if state in ("", row.state) and place in ("", row.place))

        return replace(self, alarms=chosen(self.alarms), closed=chosen(self.closed))
