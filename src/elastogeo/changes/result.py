"""What judging a series says: its state, the step of each test, the chart of each indicator, and what the change is."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.changes.causes import Cause
from elastogeo.changes.change_points import ChangePoint
from elastogeo.changes.drifts import DRIFT, STEP, Drift
from elastogeo.changes.due_dates import DueDate
from elastogeo.changes.events import Event, OpenAlarm
from elastogeo.changes.kinds import Kind
from elastogeo.changes.series import Baseline, Series
from elastogeo.identification import Check
from elastogeo.machine import Array
from elastogeo.result import Part, Result

CONFIRMED = "change confirmed"
"""Check of an alarm: whether a second test shows the change as well."""
NO_BASELINE = "no baseline"
STEADY = "steady"
WATCH = "watch"
SUSPECT = "suspect"
ALARM = "alarm"

STATES = (ALARM, SUSPECT, WATCH, NO_BASELINE, STEADY)
"""Of a series and of an indicator, the worst first."""

SHAPES = (STEP, DRIFT)
"""Of a change."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Step(Part):
    """What one judged test did to the state of its series.

    Attributes
    ----------
    test : str
    date : float [d]
    state : str
        Of the series after it: `WATCH`, `STEADY`, `SUSPECT` or `ALARM`.
    over : tuple of str
        Indicators over their limit, and relevant, the furthest first.
    ratio : float
        Greatest |T| over its limit; above 1 is a signal. Zero where no indicator was determined.
    first : str
        The indicator it is of; empty where none was determined.
    repeats : str
        The suspect test that it repeats; empty if none.
    replaced : str
        The repeat that took its place, as it did not confirm it; empty if it stands, or was confirmed.
    confirmed : bool or None
        Of a suspect: True if a repeat on the same side confirms it, False if it does not, None without one: `unconfirmed`
        once the waiting time is over.
    """

    test: str
    date: float
    state: str
    over: tuple[str, ...]
    ratio: float
    first: str
    repeats: str = ""
    replaced: str = ""
    confirmed: bool | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class IndicatorState(Part):
    """One indicator of a series, with its chart. Arrays are along all n tests of the series, NaN where one is not judged.

    Attributes
    ----------
    name : str
    kind : Kind
    now : float
        By the last test that stands, in the unit of the kind; NaN if none determines it.
    standard_uncertainty : float
        Of `now`, by that test itself; NaN where there is none.
    mean : float
        Of the baseline, at its mean temperature.
    deviation : float
        Standard deviation between tests: that of the baseline, shrunk to what is expected, never less than the stated u.
    degrees_of_freedom : float
        Of `deviation`.
    limit : float
        Of |T| of both charts.
    relevance : float
        Least change that is an alarm, in the unit of the kind.
    lower, upper : float
        Tolerance; infinite where there is none.
    single, running : array, shape (n,)
        T of each test by itself, and of the running mean: a signal beyond `limit` (reference/monitoring, section 5).
    running_mean : array, shape (n,)
        In the unit of the kind.
    expected : array, shape (n, 2)
        Within which one test is expected if nothing changed, at its temperature; also for tests of the baseline.
    change : float
        By how much it is now off its baseline: the mean since the change, or the running mean where there is no alarm.
    change_interval : tuple of 2 float
        95 %, with the uncertainty of the baseline.
    state : str
        `ALARM` if it is part of the alarm, `SUSPECT` if of the suspect test; else `WATCH`, `STEADY` or `NO_BASELINE`.
    change_point : ChangePoint or None
        Since when; only where the state is `ALARM`.
    drift : Drift or None
        How fast; None where the slope is not significant.
    shape : str
        `STEP` or `DRIFT`, whichever explains the change better; empty where the tests cannot say.
    """

    name: str
    kind: Kind
    now: float
    standard_uncertainty: float
    mean: float
    deviation: float
    degrees_of_freedom: float
    limit: float
    relevance: float
    lower: float
    upper: float
    single: Array
    running: Array
    running_mean: Array
    expected: Array
    change: float
    change_interval: tuple[float, float]
    state: str
    change_point: ChangePoint | None = None
    drift: Drift | None = None
    shape: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ChangeVerdict(Result):
    """Whether a machine has changed, by one series of its tests.

    Attributes
    ----------
    series : Series
    baseline : Baseline or None
        None if none was set.
    alpha : float
        Of the rule: what its limits are made from.
    now : float [d]
        When it was judged.
    state : str
        One of `STATES`.
    since : float or None [d]
        Date of the test, or of the event, that brought this state; None without a test.
    waiting : str
        The suspect test that a repeat is asked for; empty if none is.
    repeat_by : float or None [d]
        Until when a repeat counts for `waiting`; an alarm after it.
    steps : tuple of Step
        One for each judged test, in their order.
    not_judged : dict of str to str
        Tests that are neither in the baseline nor judged, and why: `set aside`, `before the baseline`, `nothing determined`.
    indicators : tuple of IndicatorState
        In the order of the series, which is that of importance.
    change_point : ChangePoint or None
        Of all indicators that changed, together; only in an alarm.
    causes : tuple of Cause
        What the changed set points to, the likeliest first; empty without an alarm or without signatures.
    cannot_tell : tuple of tuple of str
        Components among which this test cannot tell.
    verdict : tuple of Check
    events : tuple of Event
        What happened to the machine and its instruments, in the order of time; the history fills it.
    due : DueDate or None
        Of the next test; the history fills it.
    alarm : OpenAlarm or None
        The one that no person has closed; the history fills it.
    """

    series: Series
    baseline: Baseline | None
    alpha: float
    now: float
    state: str
    since: float | None
    waiting: str
    repeat_by: float | None
    steps: tuple[Step, ...]
    not_judged: dict[str, str]
    indicators: tuple[IndicatorState, ...]
    change_point: ChangePoint | None
    causes: tuple[Cause, ...]
    cannot_tell: tuple[tuple[str, ...], ...]
    verdict: tuple[Check, ...]
    events: tuple[Event, ...] = ()
    due: DueDate | None = None
    alarm: OpenAlarm | None = None

    def __getitem__(self, name: str) -> IndicatorState:
        """The indicator of this name.

        Raises
        ------
        KeyError
            If the series has none of this name.
        """
        return next(one for one in self.indicators if one.name == name) if name in self else self._absent(name)

    def __contains__(self, name: object) -> bool:
        return any(one.name == name for one in self.indicators)

    def _absent(self, name: str) -> IndicatorState:
        raise KeyError(f"{name!r} is no indicator of this series; it has {', '.join(self.series.indicators)}")

    @property
    def is_confirmed(self) -> bool:
        """Whether a second test shows the change as well."""
        told = [check.passed for check in self.verdict if check.name == CONFIRMED]
        return bool(told[0]) if told else any(step.confirmed for step in self.steps)

    @property
    def changed(self) -> tuple[IndicatorState, ...]:
        """The indicators in alarm, the furthest over its limit first."""
        return tuple(sorted((one for one in self.indicators if one.state == ALARM), key=_excess))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Trend(Result):
    """One indicator of a series over time.

    Attributes
    ----------
    verdict : ChangeVerdict
    indicator : str
        Its name; empty: the one to look at first.
    days : float or None [d]
        How long before the last test it is drawn; None: all of it.
    first : int
        Of the tests, the newest first, the first that is listed.
    """

    verdict: ChangeVerdict
    indicator: str = ""
    days: float | None = None
    first: int = 0


def _excess(one: IndicatorState) -> float:
    low, high = one.change_interval
    half = (high - low) / 2
    return -abs(one.change) / half if half > 0 else 0.0
