"""How fast: the slope of an indicator over time with its interval, and when it reaches a limit if it goes on."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite, nan, sqrt

import numpy as np
from scipy.special import stdtrit

from elastogeo.changes.change_points import COVERAGE, Since, squares_of_step
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
        Standard deviations; they are independent.
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
    factor: float
    first: float
    last: float
    tests: int

    @property
    def t(self) -> float:
        """Slope over its standard deviation."""
        return self.slope / self.slope_deviation

    def at(self, date: float) -> tuple[float, float]:
        """Height at a date, and its standard deviation."""
        off = date - self.date
        return self.height + self.slope * off, sqrt(self.height_deviation**2 + (off * self.slope_deviation) ** 2)


def line_of(date: Array, departure: Array, deviation: float, freedom: float) -> Line | None:
    """The line through departures, shape (n,); None with fewer than four, or all of one date."""
    shown = np.isfinite(departure)
    if np.sum(shown) < FEWEST or not np.ptp(date[shown]) > 0 or not deviation > 0:
        return None
    t, d = date[shown], departure[shown]
    middle = float(t.mean())
    spread = float(np.sum((t - middle) ** 2))
    return Line(
        date=middle,
        height=float(d.mean()),
        slope=float((t - middle) @ d) / spread,
        height_deviation=deviation / sqrt(len(t)),
        slope_deviation=deviation / sqrt(spread),
        factor=float(stdtrit(freedom, (1 + COVERAGE) / 2)),
        first=float(t[0]),
        last=float(t[-1]),
        tests=len(t),
    )


def shape_of(since: Since, c: int, latest: int) -> tuple[str, int]:
    """Whether a step or a drift explains a change better, and the first test of it.

    Parameters
    ----------
    since : Since
    c : int
        Of the indicator.
    latest : int
        The latest test that may be the first changed one.

    Returns
    -------
    shape : str
        `STEP` or `DRIFT`; empty if the tests cannot say.
    first : int
        The first changed test by the better one.
    """
    departure, known = since.departure[:, c], since.reference
    count, deviation, freedom = (float(one[c]) for one in (known.count, known.deviation, known.degrees_of_freedom))
    stepped = squares_of_step(departure, count)[0][: latest + 1]
    drifted = _squares_of_ramp(since, departure, count)[: latest + 1]
    number = float(np.sum(np.isfinite(departure)))

    def likelihood(left: float) -> float:
        return float(-(freedom + number) / 2 * np.log1p(left / (freedom * deviation**2)))

    better = likelihood(float(drifted.min())) - likelihood(float(stepped.min()))
    shape = DRIFT if better > SURE else STEP if better < -SURE else ""
    return shape, int(drifted.argmin() if shape == DRIFT else stepped.argmin())


def _squares_of_ramp(since: Since, departure: Array, count: float) -> Array:
    """Of a slope that begins after the test before each of n tests: the sum of squares that it leaves."""
    shown = np.isfinite(departure)
    d = np.where(shown, departure, 0.0)
    left = np.empty(len(d))
    for k in range(len(d)):
        run = np.where(shown, np.maximum(since.date - since.last_before(k), 0.0), 0.0)
        n, s1, s2 = count + float(np.sum(shown)), float(run.sum()), float(run @ run)
        y1, y2 = float(d.sum()), float(run @ d)
        left[k] = d @ d - y1**2 / n
        spread = s2 - s1**2 / n
        if spread > 0:
            left[k] -= (y2 - s1 * y1 / n) ** 2 / spread
    return left


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
    half = line.factor * line.slope_deviation
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
    a = line.slope**2 - (k * line.slope_deviation) ** 2
    b = to_go * line.slope
    c = to_go**2 - k**2 * (line.height_deviation**2 + deviation**2)
    root = b**2 - a * c
    if root < 0:
        return -inf, inf
    if a <= 0:  # the slope could be zero: what is left is open at one side
        early = sorted((b + sign * sqrt(root)) / a for sign in (-1, 1)) if a < 0 else [c / (2 * b)]
        return line.date + early[-1], inf
    return line.date + (b - sqrt(root)) / a, line.date + (b + sqrt(root)) / a
