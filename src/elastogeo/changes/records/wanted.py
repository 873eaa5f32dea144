"""What people want of each series: its baseline, its limits, how often it is tested."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.changes.kinds import Kind
from elastogeo.changes.result import ChangeVerdict
from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class SetBaseline(Part):
    """A baseline that somebody set.

    Attributes
    ----------
    tests : int
        It is made of.
    set_at : float [d]
    who, why : str
    holds : bool
        False once an alarm was closed as repaired after it.
    """

    tests: int
    set_at: float
    who: str
    why: str
    holds: bool


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class WantedOfSeries(Part):
    """What is wanted of one series.

    Attributes
    ----------
    key : int
    machine : str
    machine_key : int
    place, series, state : str
    tests : int
    baseline : SetBaseline or None
        The last one that was set.
    limits : int
        Indicators with a tolerance.
    interval : float or None [d]
        Between tests; None: no date.
    grace : float [d]
    """

    key: int
    machine: str
    machine_key: int
    place: str
    series: str
    state: str
    tests: int
    baseline: SetBaseline | None
    limits: int
    interval: float | None
    grace: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptSettings(Result):
    """What people have set.

    Attributes
    ----------
    store : str
    now : float [d]
    series : tuple of WantedOfSeries
        Those without a baseline that holds first, then by machine.
    simulated : str
        From what the tests are simulated; empty if any was measured.
    """

    store: str
    now: float
    series: tuple[WantedOfSeries, ...]
    simulated: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class WantedOfIndicator(Part):
    """What somebody wants of one indicator.

    Attributes
    ----------
    name : str
    kind : Kind
    lower, upper : float or None
        In the unit of its kind.
    relevance : float or None
        Least change that is an alarm, in place of the kind's: a share where the kind is relative, else in its unit.
    set_at : float or None [d]
        None where nobody has said anything.
    who, why : str
    """

    name: str
    kind: Kind
    lower: float | None = None
    upper: float | None = None
    relevance: float | None = None
    set_at: float | None = None
    who: str = ""
    why: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TestOfSeries(Part):
    """A test that a baseline may be made of.

    Attributes
    ----------
    key : int
    name : str
    at : float [d]
    temperature : float
        NaN where it is not known.
    aside, in_baseline : bool
    state : str
        Of the series after it; empty where it was not judged.
    """

    __test__ = False

    key: int
    name: str
    at: float
    temperature: float
    aside: bool
    in_baseline: bool
    state: str


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class SeriesRecord(Result):
    """One series: what is wanted of it, and what that is decided from.

    Attributes
    ----------
    now : float [d]
    wanted : WantedOfSeries
    verdict : ChangeVerdict
        As it is judged now.
    indicators : tuple of WantedOfIndicator
        In the order of the series.
    tests : tuple of TestOfSeries
        The last first.
    baselines : tuple of SetBaseline
        All that were set, the last first.
    """

    now: float
    wanted: WantedOfSeries
    verdict: ChangeVerdict
    indicators: tuple[WantedOfIndicator, ...]
    tests: tuple[TestOfSeries, ...]
    baselines: tuple[SetBaseline, ...]
