"""Simulated series of tests, judged: by numbers drawn alone, and by loaded circles of a machine with a fault."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf
from typing import Any, ClassVar

import numpy as np

from elastogeo.changes import (
    ALARM as IN_ALARM,
)
from elastogeo.changes import (
    Baseline,
    ChangeVerdict,
    Indicator,
    InstrumentMove,
    Kind,
    Series,
    Signatures,
    Tolerance,
    indicators_of,
    instrument_moves,
    judge,
    signatures_of,
)
from elastogeo.identification import Identification, identify
from studies.bar_tests import Layout, make_test
from studies.histories import Ways, histories
from studies.truth import Truth

MISSED, HELD, UNSAID = "missed", "held", "not said"
DRAWN = Kind("drawn", "1", 1.0, 0.0)
PLAIN = Ways()
MONTH = 30.0
MOST_REPEATS = 30


@dataclass(frozen=True)
class Judged:
    """A machine whose indicators are drawn, judged after its last test; suspect tests are repeated the same day.

    Attributes
    ----------
    ways : Ways
    covariate, repeat : bool
        Whether the temperature is known, and suspect tests are repeated.
    tolerance : float or None
        Of the first indicator, in standard deviations of what is expected.
    trend : float
        Of the first indicator while the baseline is made, in standard deviations from test to test.
    unread : float
        Share of the tests whose temperature nobody wrote down.
    short : int
        Tests of the baseline that are taken; 0: all.
    """

    ways: Ways = PLAIN
    covariate: bool = False
    repeat: bool = True
    tolerance: float | None = None
    trend: float = 0.0
    unread: float = 0.0
    short: int = 0

    def draw(self, seed: tuple[int, ...]) -> ChangeVerdict:
        """Repeats are put in one after the other, as the charts ask for them."""
        seen = histories(self.ways, 1, seed)
        m = self.ways.baseline
        value = seen.value[0].copy()
        value[:m, 0] += self.trend * np.arange(m)
        unread = np.random.default_rng((*seed, 7)).random(len(value)) < self.unread
        warm = np.where(unread | (not self.covariate), np.nan, seen.temperature[0])
        series = _series(value, warm, (DRAWN,) * self.ways.indicators)
        baseline = Baseline(series.tests[: self.short or m], float(series.date[m - 1]) + 0.5)
        wanted = {} if self.tolerance is None else {"indicator 0": Tolerance(lower=-self.tolerance, upper=self.tolerance)}
        asked: set[str] = set()
        for _ in range(MOST_REPEATS):
            verdict = judge(series, baseline, tolerances=wanted)
            suspect = next((s for s in verdict.steps if s.over and s.test not in asked), None)
            if suspect is None or not self.repeat or (verdict.state == IN_ALARM and suspect.date > (verdict.since or inf)):
                return verdict
            asked.add(suspect.test)
            k = series.tests.index(suspect.test)
            i = int(suspect.test.split()[1])
            once, again = value[i], seen.repeated[0, i]
            without_blunder = np.where(np.abs(once) < np.abs(again), once, again)
            series = _repeated(series, k, without_blunder if suspect.repeats else again)
        return verdict


def _series(value: Any, warm: Any, kinds: tuple[Kind, ...], interval: float = MONTH) -> Series:
    n, q = value.shape
    return Series(
        name="drawn",
        indicators=tuple(f"indicator {k}" for k in range(q)),
        kinds=kinds,
        tests=tuple(f"test {i}" for i in range(n)),
        date=interval * np.arange(n),
        value=value,
        standard_uncertainty=np.full((n, q), np.nan),
        temperature=warm,
        repeats=np.full(n, -1),
        aside=np.zeros(n, dtype=bool),
        instruments=("",) * n,
        simulated="drawn numbers",
    )


def _repeated(series: Series, k: int, value: Any) -> Series:
    """The series with a repeat of its k-th test, an hour later."""
    repeats = np.where(series.repeats > k, series.repeats + 1, series.repeats)
    return replace(
        series,
        tests=(*series.tests[: k + 1], f"{series.tests[k]} again", *series.tests[k + 1 :]),
        date=np.insert(series.date, k + 1, series.date[k] + 0.04),
        value=np.insert(series.value, k + 1, value, axis=0),
        standard_uncertainty=np.insert(series.standard_uncertainty, k + 1, np.nan, axis=0),
        temperature=np.insert(series.temperature, k + 1, series.temperature[k]),
        repeats=np.insert(repeats, k + 1, k),
        aside=np.insert(series.aside, k + 1, False),
        instruments=(*series.instruments, ""),
    )


@dataclass(frozen=True)
class Since:
    """Judge: whether what is said of the first indicator in alarm holds its truth.

    Attributes
    ----------
    what : str
        `change point`, `change`, `slope` or `date of the limit`.
    sample : Judged
        Its ways say the truth.
    """

    what: str
    sample: Judged

    def __call__(self, verdict: ChangeVerdict) -> str:
        """`held`, `missed`, or `not said`."""
        one, ways = verdict.indicators[0], self.sample.ways
        first = ways.baseline + ways.fault.after
        slope = ways.fault.size / MONTH
        if one.state != IN_ALARM or one.change_point is None:
            return UNSAID
        if self.what == "change point":
            low, high = one.change_point.interval
            return HELD if low <= MONTH * (first - 0.5) <= high else MISSED
        if self.what == "change":
            n = ways.tests - ways.fault.after
            truth = ways.fault.size * (1 if ways.fault.kind == "step" else n)
            return HELD if one.change_interval[0] <= truth <= one.change_interval[1] else MISSED
        if one.drift is None:
            return UNSAID
        if self.what == "slope":
            truth = 365.2425 * slope
            return HELD if one.drift.interval[0] <= truth <= one.drift.interval[1] else MISSED
        if one.drift.limit_at is None or self.sample.tolerance is None:
            return UNSAID
        truth = MONTH * (first - 1) + self.sample.tolerance / abs(slope)
        return HELD if one.drift.limit_at_interval[0] <= truth <= one.drift.limit_at_interval[1] else MISSED


CIRCLES = Layout((36.0, 238.0, 490.0, 742.0) * 2, (1,) * 4 + (-1,) * 4)
HEALTHY = (("C_XXX", 5e-5), ("C_XXY", 1e-5), ("C_YYY", 4.5e-5), ("E_XX1", -2e-5), ("E_YY1", 3e-5), ("E_C(0Y)X", 1e-5))


@dataclass(frozen=True)
class Faulty:
    """A machine `wFYXt` by loaded circles in XY, both ways round: ten tests of it healthy, five with a fault.

    Attributes
    ----------
    faults : tuple of (name, value)
        Added to the truth.
    gauge : float
        By which share its force is off after the tenth test.
    """

    faults: tuple[tuple[str, float], ...] = ()
    gauge: float = 0.0

    share: ClassVar[float] = 0.25

    def draw(self, seed: tuple[int, ...]) -> ChangeVerdict:
        """Both states identified from noise of their own; between tests the indicators scatter as their kinds say."""
        before, signatures = _healthy()
        truth = dict(HEALTHY)
        for name, value in self.faults:
            truth[name] = truth.get(name, 0.0) + value
        after = indicators_of(_identified(Truth(tuple(truth.items()), force_scale=self.gauge), seed))
        rows = [[one.value for one in before]] * 10 + [[one.value for one in after]] * 5
        scatter = [one.kind.reproducibility * (abs(one.value) if one.kind.relative else 1) for one in before]
        value = np.array(rows) + np.array(scatter) * np.random.default_rng((*seed, 1)).standard_normal((15, len(before)))
        series = _series(value, np.full(15, np.nan), tuple(one.kind for one in before))
        series = replace(series, indicators=tuple(one.name for one in before), signatures=signatures)
        return judge(series, Baseline(series.tests[:10], float(series.date[9]) + 0.5))


def _identified(truth: Truth, seed: tuple[int, ...]) -> Identification:
    return identify(make_test(CIRCLES, truth, "white", seed, question=("loaded-xy",)))


@lru_cache(maxsize=1)
def _healthy() -> tuple[tuple[Indicator, ...], Signatures]:
    found = _identified(Truth(HEALTHY), (1,))
    signatures = signatures_of(found)
    assert signatures is not None
    return indicators_of(found), signatures


@dataclass(frozen=True)
class Pointed:
    """Judge: whether a component is the first that is named, or named as one that cannot be told from the first."""

    component: str

    def __call__(self, verdict: ChangeVerdict) -> str:
        """`first`, `among those that cannot be told`, `another`, or `none`."""
        if not verdict.causes:
            return "none"
        first = verdict.causes[0]
        if first.component == self.component:
            return "first"
        return "not told apart" if self.component in first.alike else "another"


@dataclass(frozen=True)
class Fleet:
    """Six machines that one instrument measures, ten tests before its calibration and six after.

    Attributes
    ----------
    off : tuple of float
        Of each machine, by how many standard deviations its first indicator is off since; a fault of its own where it is
        drawn between these and four times as much.
    drawn : bool
        Whether it is.
    """

    off: tuple[float, ...]
    drawn: bool = False

    def draw(self, seed: tuple[int, ...]) -> tuple[InstrumentMove, ...]:
        """What is said of the instrument."""
        random = np.random.default_rng(seed)
        verdicts = []
        for number, size in enumerate(self.off):
            value = random.standard_normal((16, 4))
            value[10:, 0] += size * (random.uniform(1, 4) if self.drawn else 1)
            series = _series(value, np.full(16, np.nan), (DRAWN,) * 4)
            series = replace(series, machine=f"machine {number}", instruments=("bar",) * 16)
            verdicts.append(judge(series, Baseline(series.tests[:10], float(series.date[9]) + 0.5)))
        return instrument_moves(verdicts, {"bar": MONTH * 9 + 1})


def moved(found: tuple[InstrumentMove, ...]) -> str:
    """Judge: whether there is an alarm on the instrument."""
    return "alarm" if found else "silent"
