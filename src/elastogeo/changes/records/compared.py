"""Two tests of a history, held against each other: what changed, and by how much tests of this machine differ anyway."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from elastogeo.changes.kinds import Kind
from elastogeo.estimate import Estimate
from elastogeo.identification import Change, Check, Difference
from elastogeo.machine import Array
from elastogeo.result import Part, Result

OTHER_MACHINE = "other machine"
NOT_ANALYSED = "not analysed"
NOTHING_IN_COMMON = "nothing in common"
FEW_RUNS = "few runs"
"""Why two tests, or their parameters, are not held against each other."""

WITHIN_SCATTER = "within the scatter"

Interval = tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ComparedTest(Part):
    """One of the two tests.

    Attributes
    ----------
    key : int
    name, machine, recipe : str
        `recipe` is the name of its series.
    machine_key, series : int
    date : float [d]
    origin, from_what : str
        `measured`, `simulated` or `reconstructed`, and from what.
    software : str
        Version that analysed it; empty if none has.
    error : str
        Why it says nothing; empty if it does.
    """

    key: int
    name: str
    machine: str
    recipe: str
    machine_key: int
    series: int
    date: float
    origin: str
    from_what: str
    software: str
    error: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class IndicatorDifference(Part):
    """How one indicator differs between two tests of one series.

    Attributes
    ----------
    name : str
    kind : Kind
    before, after : float
        In the unit of the kind.
    change : Estimate
        After less before, with the scatter within both tests as its uncertainty; infinite where they do not show it.
    expected : tuple of 2 float, or None
        Within which the change lies, with 95 % for all indicators together, if nothing changed: by the scatter between tests
        of the baseline, at the temperatures of the two. None without a baseline.
    """

    name: str
    kind: Kind
    before: float
    after: float
    change: Estimate
    expected: tuple[float, float] | None

    @property
    def within(self) -> bool | None:
        """Whether tests of the unchanged machine differ by as much; None if no baseline says it."""
        return None if self.expected is None else self.expected[0] <= self.change.value <= self.expected[1]

    @property
    def surety(self) -> float:
        """How far the change is beyond the middle of what is expected, in halves of its width; above 1 it is beyond."""
        low, high = self.expected or (-self.change.expanded(), self.change.expanded())
        half = (high - low) / 2
        return abs(self.change.value - (low + high) / 2) / half if half > 0 else 0.0


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ParameterDifference(Part):
    """How one parameter differs between two tests.

    Attributes
    ----------
    difference : Difference
    intervals : tuple of 2 (tuple of 2 float, or None)
        95 % of the value before and after.
    stands_for : dict of str to float
    separated : bool
        Whether the name is right: what it stands for is all compliance or all geometry.
    distortion : float or None [mm]
        By which a unit of it distorts the trace of the later test at the highest force; None where the readings are angles.
    """

    difference: Difference
    intervals: tuple[Interval | None, Interval | None]
    stands_for: Mapping[str, float]
    separated: bool
    distortion: float | None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class SettingDifference(Part):
    """A setting that differs.

    Attributes
    ----------
    name : str
        As the recipe or the test file has it: `setup.circle.radius`, `temperature_degC`; of the analysis, `software`.
    before, after : plain value
        None where a test does not say it.
    in_recipe : bool
        Whether tests that differ by it stand in two series.
    """

    name: str
    before: Any
    after: Any
    in_recipe: bool


@dataclass(frozen=True, slots=True)
class CircleTrace:
    """What one run around a circle read.

    Attributes
    ----------
    later : bool
        Whether it is of the later test.
    run : str
    force : float [N]
    sense : int
        +1 counter-clockwise, -1 clockwise.
    angle : array, shape (m,) [rad]
    deviation : array, shape (m,) [mm]
        Measured.
    """

    later: bool
    run: str
    force: float
    sense: int
    angle: Array
    deviation: Array


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ComparedTests(Result):
    """Two tests of a history, the earlier one first.

    Attributes
    ----------
    before, after : ComparedTest
    refusal : str
        Why they do not compare: OTHER_MACHINE, NOT_ANALYSED, NOTHING_IN_COMMON; empty if they do.
    indicators : tuple of IndicatorDifference
        Of two tests of one series, the surest change first; else none.
    baseline : int
        Of how many tests; 0 if the series has none, or the tests are of two.
    parameters : tuple of ParameterDifference
        Those that both determine, the surest change first.
    joint : Change or None
        Of all these parameters together.
    unjudged : str
        Why there are no parameters: NOTHING_IN_COMMON, FEW_RUNS; empty if there are.
    settings : tuple of SettingDifference
    traces : tuple of CircleTrace
        Of each test the first run at each level in each direction; none of what is no circle.
    radius : float or None [mm]
        Of the nominal circle.
    axes : tuple of str
        Of the plane of the circle; empty of a tilted one.
    verdict : tuple of Check
    """

    before: ComparedTest
    after: ComparedTest
    refusal: str
    indicators: tuple[IndicatorDifference, ...]
    baseline: int
    parameters: tuple[ParameterDifference, ...]
    joint: Change | None
    unjudged: str
    settings: tuple[SettingDifference, ...]
    traces: tuple[CircleTrace, ...]
    radius: float | None
    axes: tuple[str, ...]
    verdict: tuple[Check, ...]

    @property
    def one_recipe(self) -> bool:
        """Whether both are of one series."""
        return self.before.series == self.after.series


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Comparable(Result):
    """The tests of a machine of which two may be compared.

    Attributes
    ----------
    machine : str
    tests : tuple of ComparedTest
        The newest first.
    """

    machine: str
    tests: tuple[ComparedTest, ...]
