"""Simulated histories watched by the charts of elastogeo, many machines at once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar

import numpy as np

from elastogeo.changes import Prior, Rule, fleet_prior, reference_from, start, step
from studies.histories import Array, Ways, histories
from studies.rates import ALARM, SILENT

NEVER = 10**6
BEFORE, RIGHT, OTHER = "alarm before", "right one", "another"
BLOCK = 500
"""Machines that are drawn together."""

PLAIN, DEFAULT = Ways(), Rule()


@dataclass(frozen=True)
class Outcome:
    """What a history led to.

    Attributes
    ----------
    alarm : int
        Which test since the beginning of the fault alarms: 1 is the first, 0 or less before it, `NEVER` none.
    first : int
        The indicator that is named first.
    repeats : int
        That were asked for until then.
    """

    alarm: int
    first: int
    repeats: int


@dataclass(frozen=True)
class Watched:
    """A machine, watched until its first alarm: a suspect test is repeated the same day, and alarms if that confirms it.

    Attributes
    ----------
    ways : Ways
    prior : tuple of 2 float
        Degrees of freedom and deviation that the charts expect, in units of what is expected.
    fleet : int
        Machines whose baselines give the prior in place of that; 0: none.
    covariate : bool
        Whether the temperature is known.
    repeat : bool
        Whether suspect tests are repeated; if not they are alarms.
    relevance : float
        Least change that matters, in deviations that are expected.
    rule : Rule
    """

    ways: Ways = PLAIN
    prior: tuple[float, float] = (6.0, 1.0)
    fleet: int = 0
    covariate: bool = False
    repeat: bool = True
    relevance: float = 0.0
    rule: Rule = DEFAULT

    part: ClassVar[int] = BLOCK
    share: ClassVar[float] = 50.0

    def draw(self, seed: tuple[int, ...]) -> Outcome:
        """One of a block that is drawn at once."""
        return _block(self, seed[0], seed[1] // BLOCK)[seed[1] % BLOCK]


@lru_cache(maxsize=2)
def _block(sample: Watched, seed: int, number: int) -> list[Outcome]:
    return watched(sample, BLOCK, (seed, number))


def watched(sample: Watched, machines: int, seed: tuple[int, ...]) -> list[Outcome]:
    """Many of them."""
    ways = sample.ways
    seen = histories(ways, machines, seed)
    m, warm = ways.baseline, seen.temperature if sample.covariate else np.full_like(seen.temperature, np.nan)
    reference = reference_from(seen.value[:, :m], _prior(sample, seen.value[:, :m]), temperature=warm[:, :m])
    reference = replace(reference, relevance=np.full(reference.mean.shape, sample.relevance))
    charts = start(reference)
    alarm, first, repeats = np.full(machines, NEVER), np.zeros(machines, dtype=int), np.zeros(machines, dtype=int)
    for t in range(m, m + ways.tests):
        charts, judged = step(charts, reference, sample.rule, seen.value[:, t], warm[:, t])
        named = judged.over != 0
        asked = np.any(named, axis=1)
        ratio = judged.ratio
        if sample.repeat and asked.any():
            repeats += asked & (alarm == NEVER)
            again = np.where(asked[:, np.newaxis], seen.repeated[:, t], np.nan)
            charts, judged = step(charts, reference, sample.rule, again, warm[:, t], answers=asked)
            named, ratio = judged.confirmed, judged.ratio
        new = np.any(named, axis=1) & (alarm == NEVER)
        alarm[new] = t - m - ways.fault.after + 1
        first[new] = np.argmax(np.where(named, ratio, 0.0)[new], axis=1)
    return [Outcome(*map(int, row)) for row in zip(alarm, first, repeats, strict=True)]


def _prior(sample: Watched, baseline: Array) -> Prior:
    q = sample.ways.indicators
    if not sample.fleet:
        return Prior(np.full(q, sample.prior[0]), np.full(q, sample.prior[1]))
    s = np.std(baseline, axis=1, ddof=1)
    fleets = [fleet_prior(some, baseline.shape[1] - 1.0) for some in np.split(s, len(s) // sample.fleet)]
    nu, s0 = (np.repeat([getattr(one, name) for one in fleets], sample.fleet, axis=0) for name in FIELDS)
    return Prior(nu, s0)


FIELDS = ("degrees_of_freedom", "deviation")


@dataclass(frozen=True)
class Within:
    """Judge: an alarm within so many tests since the fault began."""

    tests: int

    def __call__(self, found: Outcome) -> str:
        """`alarm`, `silent`, or `alarm before`."""
        if found.alarm < 1:
            return BEFORE
        return ALARM if found.alarm <= self.tests else SILENT


@dataclass(frozen=True)
class Named:
    """Judge: which indicator the first alarm names first, the changed one or another."""

    def __call__(self, found: Outcome) -> str:
        """`right one`, `another`, `silent` or `alarm before`."""
        if found.alarm < 1:
            return BEFORE
        if found.alarm == NEVER:
            return SILENT
        return OTHER if found.first else RIGHT
