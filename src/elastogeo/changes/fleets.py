"""The state of a machine, and of a fleet: of the verdicts of their series, the worst first."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from math import isfinite, nan
from typing import Any

import numpy as np

from elastogeo.changes.due_dates import OVERDUE
from elastogeo.changes.instruments import InstrumentMove
from elastogeo.changes.result import ALARM, NO_BASELINE, STEADY, SUSPECT, WATCH, ChangeVerdict, IndicatorState
from elastogeo.estimate import coverage_factor
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
    rows : tuple of MachineRow
        Every series as it was judged last, the worst first, where only some are in `series`; else empty.
    """

    machine: str
    series: tuple[ChangeVerdict, ...]
    state: str
    overdue: dict[str, float]
    open_alarms: int
    held_by: str = ""
    rows: tuple[MachineRow, ...] = ()


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
        How long, the grace taken off; zero if it is not.
    held_by : str
        Instrument whose alarm holds its alarm back; empty if none does.
    simulated : str
        From what its tests are simulated; empty if they were measured.
    model : str
        Of the machine; empty if it is not known.
    key : int or None
        Of the machine in its history; None outside one.
    grace : float [d]
        How long after it is due a test still comes in time.
    open_alarms : int
    confirmed : bool
        Whether a second test shows the change as well.
    tests_since : int
        Judged tests that stand since the change; 0 where none is known.
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
    grace: float = 0.0
    open_alarms: int = 0
    series_key: int | None = None
    confirmed: bool = False
    tests_since: int = 0

    def document(self) -> dict[str, Any]:
        """As plain values, to be kept as JSON; NaN is None."""
        return {field.name: _kept(getattr(self, field.name)) for field in fields(self)}

    @staticmethod
    def of_document(document: dict[str, Any]) -> MachineRow:
        """What `document` gave."""
        known = {name: document[name] for name in _NAMES if name in document}
        known |= {name: nan if known[name] is None else known[name] for name in ("change", "mean")}
        low, high = (nan if end is None else end for end in known["change_interval"])
        strip = tuple((name, state, nan if ratio is None else ratio) for name, state, ratio in known["strip"])
        return MachineRow(
            **{**known, "change_interval": (low, high), "points_to": tuple(known["points_to"]), "strip": strip}
        )


_NAMES = tuple(field.name for field in fields(MachineRow))


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


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FleetPart(Result):
    """The machines of a fleet that fit what is asked for, in their order: the worst first.

    Attributes
    ----------
    fleet : FleetState
        All of it.
    place, model : str
        Where a machine stands, and of which model it is; empty: any.
    state : str
        One of `MACHINE_STATES`; empty: any. Overdue are all whose test is, in whatever state they are.
    first : int
        Of the machines that fit, the first that is shown.
    """

    fleet: FleetState
    place: str = ""
    model: str = ""
    state: str = ""
    first: int = 0

    @property
    def machines(self) -> tuple[MachineRow, ...]:
        """Those that fit."""
        return tuple(row for row in self.fleet.machines if self.fits(row))

    def fits(self, row: MachineRow, *, but: str = "") -> bool:
        """Whether a machine fits what is asked for, `but` for one of `place`, `model`, `state`."""
        return (
            (not self.place or but == "place" or row.place == self.place)
            and (not self.model or but == "model" or row.model == self.model)
            and (not self.state or but == "state" or self.state in states_of(row))
        )


def states_of(row: MachineRow) -> tuple[str, ...]:
    """The states under which a machine counts: its own, and overdue where its test is."""
    return (row.state, OVERDUE) if row.overdue > 0 and row.state != OVERDUE else (row.state,)


def machine_state(machine: str, verdicts: Iterable[ChangeVerdict]) -> MachineState:
    """A machine from the verdicts of its series; when a test is due, and what became of an alarm, they say themselves."""
    ordered = tuple(sorted(verdicts, key=lambda one: (_of_one(one.state), one.since or 0.0, one.series.name)))
    late = {one.series.name: one.due.overdue for one in ordered if one.due is not None and one.due.is_late}
    states = [*(one.state for one in ordered), *([OVERDUE] if late else [])]
    opened = [one.alarm for one in ordered if one.alarm is not None]
    return MachineState(
        machine=machine,
        series=ordered,
        state=min(states, key=_of_one, default=NO_BASELINE),
        overdue=late,
        open_alarms=len(opened),
        held_by=next((alarm.held_by for alarm in opened if alarm.held_by), ""),
    )


def machine_shown(machine: str, verdicts: Iterable[ChangeVerdict], rows: Iterable[MachineRow], now: float) -> MachineState:
    """A machine from what was kept of each of its series, of which only some are judged anew.

    Parameters
    ----------
    machine : str
    verdicts : iterable of ChangeVerdict
        Of the series that are shown in full, the one that is asked for first.
    rows : iterable of MachineRow
        Of all its series.
    now : float [d]
    """
    every = tuple(sorted((_at(row, now) for row in rows), key=_order_of_one))
    return MachineState(
        machine=machine,
        series=tuple(verdicts),
        state=every[0].state if every else NO_BASELINE,
        overdue={row.series: row.overdue for row in every if row.overdue > 0},
        open_alarms=sum(row.open_alarms for row in every),
        held_by=next((row.held_by for row in every if row.held_by), ""),
        rows=every,
    )


def as_suspected(verdict: ChangeVerdict) -> IndicatorState | None:
    """The indicator that the waiting test was furthest off in, its change that of this one test; None where none waits.

    The change is against what was expected at the temperature of the test, with 95 % of such a test.
    """
    if not verdict.waiting:
        return None
    until = [step.test for step in verdict.steps].index(verdict.waiting) + 1
    over = ((step, name) for step in reversed(verdict.steps[:until]) for name in step.over)
    step, name = next(((step, name) for step, name in over if verdict[name].state == SUSPECT), (None, ""))
    if step is None:
        return None
    one, k = verdict[name], verdict.series.tests.index(step.test)
    low, high = one.expected[k]
    change = float(verdict.series.value[k, verdict.series.indicators.index(name)] - (low + high) / 2)
    half = float(coverage_factor(np.array([one.degrees_of_freedom]))[0] * (high - low) / 2 / one.limit)
    return replace(one, change=change, change_interval=(change - half, change + half))


def machine_row(verdict: ChangeVerdict, machine: str = "", place: str = "") -> MachineRow:
    """One series of a machine in a row: what the page of a fleet shows of it, and no more."""
    shown = _shown(verdict)
    judged = [step.date for step in verdict.steps]
    measured = verdict.series.date[~verdict.series.aside]
    due = verdict.due
    return MachineRow(
        machine=machine or verdict.series.machine or verdict.series.name,
        place=place,
        series=verdict.series.name,
        state=verdict.state,
        since=verdict.since,
        indicator=shown.name if shown else "",
        kind=shown.kind.name if shown else "",
        unit=shown.kind.unit if shown else "",
        change=shown.change if shown else nan,
        mean=shown.mean if shown else nan,
        change_interval=shown.change_interval if shown else (nan, nan),
        changed_at=verdict.change_point.date if verdict.change_point else None,
        points_to=tuple(cause.component for cause in verdict.causes),
        strip=tuple((one.name, one.state, _ratio(one)) for one in verdict.indicators),
        last_test=max([*judged, *map(float, measured[-1:])], default=None),
        due=due.at if due else None,
        overdue=due.overdue if due else 0.0,
        held_by=verdict.alarm.held_by if verdict.alarm else "",
        simulated=verdict.series.simulated,
        grace=due.grace if due else 0.0,
        open_alarms=int(verdict.alarm is not None),
        confirmed=verdict.is_confirmed,
        tests_since=_tests_since(verdict),
    )


def fleet_state(rows: Iterable[MachineRow], now: float, instruments: Sequence[InstrumentMove] = ()) -> FleetState:
    """All machines, from a row of each of their series.

    Parameters
    ----------
    rows : iterable of MachineRow
        Made when each series was judged; what has become overdue since then is seen here.
    now : float [d]
    instruments : sequence of InstrumentMove
    """
    worst: dict[str, MachineRow] = {}
    late: set[str] = set()
    for row in rows:
        current = _at(row, now)
        late |= {row.machine} if current.overdue > 0 else set()
        known = worst.get(row.machine)
        if known is None:
            worst[row.machine] = current
        else:
            shown = min(known, current, key=_order_of_one)
            worst[row.machine] = replace(shown, open_alarms=known.open_alarms + current.open_alarms)
    machines = tuple(sorted(worst.values(), key=_order))
    counts = {state: sum(row.state == state for row in machines) for state in MACHINE_STATES}
    counts[OVERDUE] = len(late)
    return FleetState(now, machines, counts, tuple(instruments))


def _at(row: MachineRow, now: float) -> MachineRow:
    """The row as it stands now: overdue is a matter of the date."""
    overdue = 0.0 if row.due is None else max(0.0, now - row.due - row.grace)
    state = row.state if not overdue else min(row.state, OVERDUE, key=_rank)
    since = row.due if state == OVERDUE != row.state else row.since
    same = (overdue, state, since) == (row.overdue, row.state, row.since)  # of most rows: a fleet has hundreds
    return row if same else replace(row, overdue=overdue, state=state, since=since)


def _order(row: MachineRow) -> tuple[int, float, str]:
    """The worst first; of one state the longest in it first."""
    return _rank(row.state), row.since if row.since is not None else np.inf, row.machine


def _order_of_one(row: MachineRow) -> tuple[tuple[bool, int], tuple[int, float, str]]:
    """The same for the series of one machine."""
    return _of_one(row.state), _order(row)


def _of_one(state: str) -> tuple[bool, int]:
    """Among the series of one machine: one without a baseline is not watched, and says nothing of those that are."""
    return state == NO_BASELINE, _rank(state)


def _rank(state: str) -> int:
    return MACHINE_STATES.index(state)


def _shown(verdict: ChangeVerdict) -> IndicatorState | None:
    """The indicator that changed most: of an alarm, of a suspect test, or one that drifts."""
    seen = as_suspected(verdict)
    if seen is not None:
        return seen
    states = [state for state in (ALARM, SUSPECT) if any(one.state == state for one in verdict.indicators)]
    chosen = [one for one in verdict.indicators if (one.state in states[:1]) or (not states and one.drift is not None)]
    return max(chosen, key=_ratio, default=None)


def _tests_since(verdict: ChangeVerdict) -> int:
    point = verdict.change_point
    return 0 if point is None else sum(not step.replaced and step.date >= point.date for step in verdict.steps)


def _ratio(one: IndicatorState) -> float:
    """Greatest |T| over the limit, of the last test that determines it; NaN before the first."""
    shown = np.flatnonzero(np.isfinite(one.single))
    if not len(shown) or not one.limit > 0:
        return nan
    last = shown[-1]
    return float(max(abs(one.single[last]), abs(one.running[last])) / one.limit)


def _kept(value: Any) -> Any:
    if isinstance(value, float):
        return value if isfinite(value) else None
    return [_kept(one) for one in value] if isinstance(value, tuple | list) else value
