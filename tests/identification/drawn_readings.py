"""Readings drawn for systems whose truth is zero: least squares is linear, so that their noise is all there is to see."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.signal import lfilter

from elastogeo.estimate import factor_blocks
from elastogeo.identification import Systems
from elastogeo.machine import Array

NOISE = 1e-4
Shape = tuple[int, int]
"""Runs, readings of each."""


def with_readings(systems: Systems, readings: Array) -> Systems:
    """The same systems with other readings, shape (runs, m)."""
    runs = []
    for run, reading in zip(systems.runs, readings, strict=True):
        rows = run.rows.copy(order="F")
        rows[:, -1] = reading
        runs.append(
            replace(run, held=replace(run.held, rows=rows), factor=factor_blocks(run.factor.labels, [rows.copy(order="F")]))
        )
    return replace(systems, runs=tuple(runs))


def white(random: np.random.Generator, shape: Shape) -> Array:
    return NOISE * random.standard_normal(shape)


def autocorrelated(random: np.random.Generator, shape: Shape) -> Array:
    """AR(0.9) along the trace, settled: its low harmonics scatter up to 25 times as much as its high ones."""
    runs, readings = shape
    return np.asarray(lfilter([NOISE], [1.0, -0.9], random.standard_normal((runs, 100 + readings)))[:, 100:])


def of_the_run(random: np.random.Generator, shape: Shape) -> Array:
    """Random harmonics up to the fifth in each run: an eccentricity, an oval, a lobed form, another in every run."""
    runs, readings = shape
    angle = np.arange(readings) * 2 * np.pi / readings
    waves = np.vstack([wave(order * angle) for order in range(6) for wave in (np.cos, np.sin)])
    return white(random, shape) + 3 * NOISE * random.standard_normal((runs, len(waves))) @ waves
