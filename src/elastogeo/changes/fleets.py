"""The state of a machine, and of a fleet: of the verdicts of their series, the worst first."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.changes.due_dates import OVERDUE
from elastogeo.changes.instruments import InstrumentMove
from elastogeo.changes.result import ALARM, NO_BASELINE, STEADY, SUSPECT, WATCH, ChangeVerdict
from elastogeo.result import Part, Result

MACHINE_STATES = (ALARM, SUSPECT, OVERDUE, WATCH, NO_BASELINE, STEADY)
"""Of a machine, the worst first."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class MachineState(Result):
    """A machine with all its series.

    Attributes
    ----------
    machine : str
    series : tuple of ChangeVerdict
        The worst first.
    state : str
        The worst of them, or `OVERDUE`.
    overdue : dict of str to float [d]
        By series how long its test is overdue, the grace subtracted; only those that are.
    open_alarms : int
    held_by : str
        The instrument whose alarm holds its alarms back; empty if none does.
    """

    machine: str
    series: tuple[ChangeVerdict, ...]
    state: str
    overdue: dict[str, float]
    open_alarms: int
    held_by: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class MachineRow(Part):
    """A machine in one row of its fleet: of its worst series.

    Attributes
    ----------
    machine, place, series : str
    state : str
        One of `MACHINE_STATES`.
    since : float or None [d]
    indicator, kind, unit : str
        The indicator that changed most; empty if none did.
    change, mean : float
        Of it, in `unit`; NaN if none.
    change_interval : tuple of 2 float
    changed_at : float or None [d]
        Of its change point.
    points_to : tuple of str
        Components, the likeliest first.
    strip : tuple of (str, str, float)
        Of each indicator its name, state, and greatest |T| over its limit now.
    last_test, due : float or None [d]
    overdue : float [d]
        How long; zero if it is not.
    held_by : str
        Instrument whose alarm holds its alarm back; empty if none does.
    simulated : str
        From what its tests are simulated; empty if they were measured.
    model : str
        Of the machine; empty if it is not known.
    key : int or None
        Of the machine in its history; None outside one.
    """

    machine: str
    place: str
    series: str
    state: str
    since: float | None
    indicator: str
    kind: str
    unit: str
    change: float
    mean: float
    change_interval: tuple[float, float]
    changed_at: float | None
    points_to: tuple[str, ...]
    strip: tuple[tuple[str, str, float], ...]
    last_test: float | None
    due: float | None
    overdue: float
    held_by: str = ""
    simulated: str = ""
    model: str = ""
    key: int | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FleetState(Result):
    """All machines.

    Attributes
    ----------
    now : float [d]
    machines : tuple of MachineRow
        The worst first; of one state the longest in it first.
    counts : dict of str to int
        Of every state of `MACHINE_STATES`; overdue machines count there too if they are in another state.
    instruments : tuple of InstrumentMove
    """

    now: float
    machines: tuple[MachineRow, ...]
    counts: dict[str, int]
    instruments: tuple[InstrumentMove, ...] = ()
