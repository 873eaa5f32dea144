"""Simulated machines under the charts: as uncertain as a baseline leaves them, or as any machine is expected to be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from math import inf, sqrt

import numpy as np

from elastogeo.changes.charts import start, step
from elastogeo.changes.kinds import Kind
from elastogeo.changes.priors import default_prior
from elastogeo.changes.references import Reference, reference_from
from elastogeo.changes.rules import Rule
from elastogeo.machine import Array

BLUNDER = 6.0
"""Of a badly seated ball, in standard deviations between tests."""


@dataclass(frozen=True, slots=True)
class Truth:
    """Machines as they are, of n machines and q indicators, and what they are held against."""

    reference: Reference
    mean: Array
    deviation: Array


@dataclass(frozen=True, slots=True)
class Scatter:
    """What befalls tests."""

    blunders: float
    correlation: float


def expected(kinds: Mapping[str, Kind], m: int, n: int, random: np.random.Generator) -> Truth:
    """Machines whose variance is drawn from what is expected, each with a baseline; relative kinds about one."""
    relative = np.array([kind.relative for kind in kinds.values()])
    mean = np.where(relative, 1.0, 0.0)
    prior = default_prior(tuple(kinds.values()), np.ones(len(kinds)))
    sigma = _drawn(prior.deviation, prior.degrees_of_freedom, (n, len(kinds)), random)
    baseline = mean + sigma[:, np.newaxis] * random.standard_normal((n, m, len(kinds)))
    least = np.array([kind.relevance for kind in kinds.values()])
    return Truth(replace(reference_from(baseline, prior), relevance=least), np.broadcast_to(mean, sigma.shape), sigma)


def as_recorded(reference: Reference, n: int, random: np.random.Generator) -> Truth:
    """Machines that may be behind the baseline that was recorded: their scatter and mean as uncertain as it leaves them."""
    shape = (n, len(reference.mean))
    sigma = _drawn(reference.deviation, reference.degrees_of_freedom, shape, random)
    mean = reference.mean + sigma * random.standard_normal(shape) / np.sqrt(reference.count)
    parts = {part.name: np.broadcast_to(getattr(reference, part.name), shape) for part in fields(reference)}
    return Truth(Reference(**parts), mean, sigma)


def _drawn(deviation: Array, worth: Array, shape: tuple[int, int], random: np.random.Generator) -> Array:
    return np.asarray(deviation * np.sqrt(worth / random.chisquare(worth, shape)))


def first_alarms(
    truth: Truth, rule: Rule, course: Array, scatter: Scatter, random: np.random.Generator
) -> tuple[Array, float]:
    """By which test (1, 2, ...) each indicator of each machine alarms first, (n, q), infinite if none; repeats a machine."""
    n, q = truth.mean.shape
    charts, at, asked = start(truth.reference), np.full((n, q), inf), 0
    between = random.standard_normal((n, q))
    for t, change in enumerate(course):
        if t:
            fresh = random.standard_normal((n, q))
            between = scatter.correlation * between + sqrt(1 - scatter.correlation**2) * fresh
        values = [truth.mean + change + truth.deviation * (between + _blunder(scatter, (n, q), random)) for _ in range(2)]
        charts, judged = step(charts, truth.reference, rule, values[0])
        signal = np.any(judged.over != 0, axis=1)
        asked += int(np.sum(signal))
        if signal.any():
            again = np.where(signal[:, np.newaxis], values[1], np.nan)
            charts, judged = step(charts, truth.reference, rule, again, answers=signal)
            at = np.where(judged.confirmed, np.minimum(at, t + 1), at)
    return at, asked / n


def _blunder(scatter: Scatter, shape: tuple[int, int], random: np.random.Generator) -> Array:
    """In one indicator of a share of the machines."""
    off = np.zeros(shape)
    hit = np.flatnonzero(random.random(shape[0]) < scatter.blunders)
    off[hit, random.integers(shape[1], size=len(hit))] = BLUNDER * random.choice((-1.0, 1.0), len(hit))
    return off
