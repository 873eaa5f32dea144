"""Simulated series for the tests: independent normal values about a mean, with changes put in by hand."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from elastogeo.changes import KINDS, Baseline, ChangeVerdict, Kind, Rule, Series, judge

FIRST = 20000.0
"""Date of the first test [d]."""

NAMES = ("stiffness X", "stiffness Y", "squareness XY", "backlash X")
MEANS = np.array([16000.0, 20000.0, 1e-5, 2e-3])


def kinds() -> tuple[Kind, ...]:
    return tuple(KINDS[name.rpartition(" ")[0]] for name in NAMES)


def deviations() -> np.ndarray[Any, Any]:
    """Between tests, as the kinds state them."""
    return np.array([k.reproducibility * (m if k.relative else 1) for k, m in zip(kinds(), MEANS, strict=True)])


def series_of(off: np.ndarray[Any, Any], seed: int | None = None, interval: float = 30.0, **other: Any) -> Series:
    """A series that is off its means by so many standard deviations, shape (n, 4), plus normal noise with a seed."""
    n = len(off)
    noise = 0.0 if seed is None else np.random.default_rng(seed).standard_normal(off.shape)
    made = Series(
        name="simulated machine, circle XY",
        indicators=NAMES,
        kinds=kinds(),
        tests=tuple(f"test {i}" for i in range(n)),
        date=FIRST + interval * np.arange(n),
        value=MEANS + deviations() * (off + noise),
        standard_uncertainty=np.full((n, 4), np.nan),
        temperature=np.full(n, np.nan),
        repeats=np.full(n, -1),
        aside=np.zeros(n, dtype=bool),
        instruments=("",) * n,
        simulated="normal numbers",
    )
    return replace(made, **other)


def baseline_of(series: Series, tests: int = 10, **other: Any) -> Baseline:
    """The first tests."""
    return Baseline(series.tests[:tests], float(series.date[tests - 1]) + 0.5, **other)


def judged(
    off: np.ndarray[Any, Any], seed: int | None = None, tests: int = 10, rule: Rule | None = None, **other: Any
) -> ChangeVerdict:
    """The verdict of a series, its first tests as the baseline."""
    series = series_of(off, seed, **other)
    return judge(series, baseline_of(series, tests), rule=rule, now=float(series.date[-1]) if len(series) else 0.0)


def stepped(before: int, after: int, size: float, indicator: int = 0) -> np.ndarray[Any, Any]:
    """No change, then a step of one indicator by so many standard deviations."""
    off = np.zeros((before + after, 4))
    off[before:, indicator] = size
    return off
