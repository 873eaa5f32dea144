"""How fast: the slope of an indicator over time with its interval, and when it reaches a limit if it goes on."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, inf, isfinite, nan, sqrt

import numpy as np
from scipy.special import stdtrit

from elastogeo.changes.change_points import COVERAGE, Since, likelihood, squares_of_step
from elastogeo.machine import Array
from elastogeo.result import Part

YEAR = 365.2425
"""Days."""

FEWEST = 4
"""Tests, at least, that tell a slope; with fewer one odd test is a drift."""

SURE = 2.0
"""Difference of the log-likelihoods of a step and of a drift from which one explains the change better: e^2 to 1."""

STEP = "step"
DRIFT = "drift"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Drift(Part):
    """A significant slope of an indicator.

    Attributes
    ----------
    per_year : float
        In the unit of the kind.
    interval : tuple of 2 float
        Of it, 95 %.
    since : float [d]
        Date of the first test of the regression.
    tests : int
        In the regression.
    at_end : float
        The line at the last test, in the unit of the kind.
    end : float [d]
        Date of the last test.
    limit : float
        What it runs into, in the unit of the kind.
    limit_is : str
        `tolerance`, or `relevance` where no tolerance is set.
    limit_at : float or None [d]
        When the line reaches it, if it goes on; None where it is beyond it already.
    limit_at_interval : tuple of 2 float [d]
        95 % (Fieller); the later end is infinite where the slope could be too small to reach it.
    """

    per_year: float
    interval: tuple[float, float]
    since: float
    tests: int
    at_end: float
    end: float
    limit: float
    limit_is: str
    limit_at: float | None
    limit_at_interval: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Line:
    """A straight line through departures from a baseline, whose scatter is known with some degrees of freedom.

    Attributes
    ----------
    date, height : float [d], [unit]
        Of its middle.
    slope : float [unit/d]
    height_deviation, slope_deviation : float
        Standard deviations by the scatter of the tests; they are independent.
    height_leverage, slope_leverage : float
        Standard deviations by what a kelvin changes, which is one error of both, with their signs.
    factor : float
        Student's t of 95 %.
    first, last : float [d]
    tests : int
    """

    date: float
    height: float
    slope: float
    height_deviation: float
    slope_deviation: float
    height_leverage: float
    slope_leverage: float
    factor: float
    first: float
    last: float
    tests: int

    @property
    def t(self) -> float:
        """Slope over its standard deviation."""
        return self.slope / self.deviation

    @property
    def deviation(self) -> float:
        """Standard deviation of the slope."""
        return hypot(self.slope_deviation, self.slope_leverage)

    def at(self, date: float) -> tuple[float, float]:
        """Height at a date, and its standard deviation."""
        off = date - self.date
        warm = self.height_leverage + off * self.slope_leverage
        return self.height + self.slope * off, hypot(self.height_deviation, off * self.slope_deviation, warm)


def line_of(date: Array, departure: Array, deviation: float, freedom: float, leverage: Array | float = 0.0) -> Line | None:
    """The line through departures, shape (n,), with `Since.leverage`; None with fewer than four, or all of one date."""
    shown = np.isfinite(departure)
    if np.sum(shown) < FEWEST or not np.ptp(date[shown]) > 0 or not deviation > 0:
        return None
    t, d, warm = date[shown], departure[shown], np.broadcast_to(leverage, shown.shape)[shown]
    middle = float(t.mean())
    spread = float(np.sum((t - middle) ** 2))
    return Line(
        date=middle,
        height=float(d.mean()),
        slope=float((t - middle) @ d) / spread,
        height_deviation=deviation / sqrt(len(t)),
        slope_deviation=deviation / sqrt(spread),
        height_leverage=deviation * float(warm.mean()),
        slope_leverage=deviation * float((t - middle) @ warm) / spread,
        factor=float(stdtrit(freedom, (1 + COVERAGE) / 2)),
        first=float(t[0]),
        last=float(t[-1]),
        tests=len(t),
    )


def shape_of(since: Since, c: int, latest: int) -> str:
    """Whether a step or a drift explains the change of an indicator better; empty if the tests cannot say.

    Parameters
    ----------
    since : Since
    c : int
        Of the indicator.
    latest : int
        The latest test that may be the first changed one.
    """
    stepped = squares_of_step(since.departure[:, c], float(since.reference.count[c]))[0]
    drifted = _squares_of_ramp(since, c)[0]
    better = float(np.ptp(likelihood(since, c, np.array([one[: latest + 1].min() for one in (stepped, drifted)]))))
    if better <= SURE:
        return ""
    return DRIFT if drifted[: latest + 1].min() < stepped[: latest + 1].min() else STEP


def weights_of_ramp(since: Since, c: int) -> Array:
    """Log of the probability that a drift began after the test before each of n tests, up to a constant, shape (n,)."""
    left, spread = _squares_of_ramp(since, c)
    return np.where(spread > 0, likelihood(since, c, left) - np.log(np.maximum(spread, 1e-300)) / 2, -np.inf)


def _squares_of_ramp(since: Since, c: int) -> tuple[Array, Array]:
    """Of a slope that begins after the test before each of n tests: the squares that it leaves, and those of its dates."""
    departure, count = since.departure[:, c], float(since.reference.count[c])
    shown = np.isfinite(departure)
    d = np.where(shown, departure, 0.0)
    begins = np.array([since.last_before(k) for k in range(len(d))])
    run = np.where(shown, np.maximum(since.date - begins[:, np.newaxis], 0.0), 0.0)
    n, total = count + float(np.sum(shown)), float(d.sum())
    spread = np.sum(run**2, axis=1) - np.sum(run, axis=1) ** 2 / n
    along = run @ d - np.sum(run, axis=1) * total / n
    gain = np.divide(along**2, spread, out=np.zeros_like(spread), where=spread > 0)
    return float(d @ d) - total**2 / n - gain, spread


def drift_of(line: Line, mean: float, mean_deviation: float, relevance: float, lower: float, upper: float) -> Drift:
    """What a slope means for the machine.

    Parameters
    ----------
    line : Line
        Of departures from `mean`.
    mean, mean_deviation : float
        Of the baseline, and the standard deviation of that mean: what a limit that counts from it has besides.
    relevance : float
        Least change that matters.
    lower, upper : float
        Tolerance; infinite where there is none.
    """
    side = 1.0 if line.slope > 0 else -1.0
    tolerance = upper if side > 0 else lower
    toleranced = isfinite(tolerance)
    limit = tolerance - mean if toleranced else side * relevance
    at_end = line.at(line.last)[0]
    reached = None if side * (limit - at_end) <= 0 else line.date + (limit - line.height) / line.slope
    interval = (nan, nan) if reached is None else _fieller(line, limit, 0.0 if toleranced else mean_deviation)
    half = line.factor * line.deviation
    return Drift(
        per_year=line.slope * YEAR,
        interval=((line.slope - half) * YEAR, (line.slope + half) * YEAR),
        since=line.first,
        tests=line.tests,
        at_end=mean + at_end,
        end=line.last,
        limit=mean + limit,
        limit_is="tolerance" if toleranced else "relevance",
        limit_at=reached,
        limit_at_interval=interval,
    )


def _fieller(line: Line, limit: float, deviation: float) -> tuple[float, float]:
    """Dates between which the line reaches a limit: those at which it may lie there (Fieller, 1954)."""
    to_go, k = limit - line.height, line.factor
    a = line.slope**2 - (k * line.deviation) ** 2
    b = to_go * line.slope + k**2 * line.height_leverage * line.slope_leverage
    c = to_go**2 - k**2 * (line.height_deviation**2 + line.height_leverage**2 + deviation**2)
    root = b**2 - a * c
    if root < 0:
        return -inf, inf
    if a <= 0:  # the slope could be zero: what is left is open at one side
        early = sorted((b + sign * sqrt(root)) / a for sign in (-1, 1)) if a < 0 else [c / (2 * b)]
        return line.date + early[-1], inf
    return line.date + (b - sqrt(root)) / a, line.date + (b + sqrt(root)) / a
