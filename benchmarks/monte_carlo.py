"""10^6 Monte Carlo trials of the 13-parameter test, through the factor and by one least-squares solution a trial.

`python benchmarks/monte_carlo.py [TRIALS]`, or `main()` from `benchmarks/run.py`. A trial is the whole test with other
Gaussian noise: 2 520 readings at seven forces, 13 parameters. Through the factor its estimate is p numbers and a triangle,
exactly as distributed as if all readings had been drawn and solved; the spread of both is printed beside the exact one.
Nothing is asserted, so nothing fails on a slow machine. Times are the best of three.
"""

from __future__ import annotations

import argparse
import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: one core is what is compared

from collections.abc import Callable
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from elastogeo.estimate import draw_estimates, factor_blocks, solve
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, Run
from elastogeo.sources import design_rows, select_sources

Array = NDArray[np.float64]

TRIALS = 10**6
SOLVED = 1000
"""Trials of the ways that take a solution each; their time is per trial, so it scales."""

FORCES = (36.0, 112.0, 238.0, 364.0, 490.0, 616.0, 742.0)
READINGS = 360
SIGMA = 7e-5
REPEATS = 3
TARGET = 2.0
"""Seconds that 10^6 trials through the factor may take."""


def main(trials: int = TRIALS) -> int:
    """Time the ways and print them as ratios."""
    labels, A, y = observations()
    factor = factor_blocks(labels, [np.asfortranarray(np.column_stack([A, y]))])
    exact = np.sqrt(np.diag(solve(factor).covariance)) * SIGMA / solve(factor).residual_std
    values = solve(factor).values
    expected = A @ values

    def through_factor() -> Array:
        return draw_estimates(factor, SIGMA, trials, np.random.default_rng(1))

    def lstsq_each() -> Array:
        random = np.random.default_rng(1)
        noise = (SIGMA * random.standard_normal(len(y)) for _ in range(SOLVED))
        return np.array([np.linalg.lstsq(A, expected + e, rcond=None)[0] for e in noise])

    def lstsq_at_once() -> Array:
        noise = SIGMA * np.random.default_rng(1).standard_normal((len(y), SOLVED))
        return np.linalg.lstsq(A, expected[:, np.newaxis] + noise, rcond=None)[0].T

    print(f"Monte Carlo, {len(y)} readings, {len(labels)} parameters, Gaussian noise; one core, best of {REPEATS}\n")
    print(f"{'way':<44}{'trials':>10}{'seconds':>10}{'us/trial':>11}{'ratio':>9}{'spread':>9}")
    base = 0.0
    for name, way, count in (
        ("elastogeo, through the factor", through_factor, trials),
        ("numpy.linalg.lstsq, one a trial", lstsq_each, SOLVED),
        ("numpy.linalg.lstsq, all right-hand sides", lstsq_at_once, SOLVED),
    ):
        seconds, draws = timed(way)
        each = seconds / count
        base = base or each
        spread = float(np.max(np.abs(draws.std(axis=0, ddof=1) / exact - 1)))
        print(f"{name:<44}{count:>10}{seconds:>10.3f}{1e6 * each:>11.3f}{each / base:>9.0f}{spread:>8.1%}")
    scaled = base * 10**6
    print(f"\n10^6 trials through the factor: {scaled:.2f} s, the aim is {TARGET:g} s; spread: greatest difference of a")
    print("standard deviation from the exact one, which the number of trials alone makes 1 / sqrt(2 trials).")
    return 0


def observations() -> tuple[list[str], Array, Array]:
    """Labels, design, and readings of the thesis's test."""
    machine = Machine("wFYXt", parse_topology("wFYXt"))
    sources = select_sources(machine, ["elasto-geometric-xy"])
    setup = LoadedBallBar(Circle(150.0), 2000 / 60)
    angle = np.arange(READINGS) * 2 * np.pi / READINGS
    noise = np.random.default_rng(0).standard_normal((len(FORCES), READINGS)) * SIGMA
    runs = [Run(f"{force:g} N", {"angle": angle, "radial": e}, force=force) for force, e in zip(FORCES, noise, strict=True)]
    rows = np.vstack([design_rows(sources, machine, setup.observe(machine, run)) for run in runs])
    return [source.name for source in sources], rows[:, :-1], rows[:, -1]


def timed(way: Callable[[], Array]) -> tuple[float, Array]:
    """Seconds of the fastest of some repeats, and the result."""
    seconds = []
    for _ in range(REPEATS):
        start = perf_counter()
        result = way()
        seconds.append(perf_counter() - start)
    return min(seconds), result


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Time Monte Carlo trials through the factor beside a solution a trial.")
    parser.add_argument("trials", nargs="?", type=int, default=TRIALS, help=f"default: {TRIALS}")
    sys.exit(main(parser.parse_args().trials))
