"""One case of the benchmark, in a process of its own: `python benchmarks/cases.py CASE READINGS` prints one JSON object.

Every case solves the same simulated test: seven force levels, circles of R = 150 mm in XY, the readings that the 13
published parameters cause to first order, plus noise. Making the readings is never timed.
"""

from __future__ import annotations

import json
import math
import sys
import tracemalloc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter, process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elastogeo.estimate import empty_factor, factor_blocks, merge, solve
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, Run
from elastogeo.sources import design_rows, select_sources
from elastogeo.sources.response import BLOCK_READINGS, design_blocks

Array = NDArray[np.floating[Any]]

TRUTH = {
    "C_XXX": 6.19e-5,
    "C_XYX": 7.98e-7,
    "C_YYY": 4.61e-5,
    "C_CXY": -2.69e-8,
    "C_CYY": -1.66e-8,
    "C_CCY": -1.10e-9,
    "E_XX1": -1.30e-4,
    "E_YX2": 4.34e-7,
    "E_XY2": -7.26e-7,
    "E_YY1": -9.86e-5,
    "E_C(0Y)X": 1.15e-6,
    "E_Xt0": 3.891e-3,
    "E_Yt0": -6.2e-4,
}
"""Tables 5.5 and 5.6 of the thesis, in mm, N, rad."""

FORCES = (36.0, 112.0, 238.0, 364.0, 490.0, 616.0, 742.0)
RADIUS = 150.0
FEED = 2000 / 60
NOISE = 7e-5
REVOLUTION = 1000
PIECE = 65536
"""Readings that are made together and then held in memory, as a reader of a long file would hand them out."""

REPEATS = 3
MOVED = 2e-6
"""By how much [mm] the step of a numerical derivative moves a reading: the best balance of curvature and rounding."""


@dataclass
class Stopwatch:
    """Seconds by name, counted only where it runs: on the clock, and of the processor (all threads)."""

    clock: dict[str, float] = field(default_factory=dict)
    processor: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def on(self, what: str) -> Iterator[None]:
        clock, processor = perf_counter(), process_time()
        yield
        self.clock[what] = self.clock.get(what, 0.0) + perf_counter() - clock
        self.processor[what] = self.processor.get(what, 0.0) + process_time() - processor


Case = Callable[[int, Stopwatch], Array]


def recorded(readings: int) -> Iterator[Run]:
    """The runs of the test, one force after the other, in the pieces in which a long file would be read."""
    truth = np.array(list(TRUTH.values()))
    for level, force in enumerate(FORCES):
        length = (level + 1) * readings // len(FORCES) - level * readings // len(FORCES)
        revolution = min(REVOLUTION, length)
        for first in range(0, length, PIECE):
            counted = np.arange(first, min(first + PIECE, length)) % revolution
            angle = np.asarray(counted * (2 * np.pi / revolution), dtype=float)
            noise = np.random.default_rng([level, first]).normal(scale=NOISE, size=len(angle))
            # einsum and not @, which would leave the threads of BLAS spinning while the case is timed
            radial = np.asarray(np.einsum("ij,j->i", closed_form(angle, force), truth) + noise, dtype=float)
            yield Run(f"{force:g} N", {"angle": angle, "radial": radial}, force=force)


def closed_form(angle: Array, force: Array | float) -> Array:
    """The 13 columns written out by hand for this one test, in the precision of the angle, shape (m, 13)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = RADIUS * c, RADIUS * s
    fx, fy = force * c, force * s
    A = np.empty((len(angle), len(TRUTH)), dtype=angle.dtype, order="F")
    A[:, 0], A[:, 1], A[:, 2] = c * fx, c * fy, s * fy
    A[:, 3], A[:, 4], A[:, 5] = x * s * fx, x * s * fy, x * s * x * fy
    A[:, 6], A[:, 7], A[:, 8], A[:, 9] = c * x, s * x * x, c * y * y, s * y
    A[:, 10], A[:, 11], A[:, 12] = x * s, c, s
    return A


def streamed(topology: str) -> Case:
    """elastogeo: from angles to parameters, the readings passing by in blocks."""
    machine = Machine(topology, parse_topology(topology))
    setup = LoadedBallBar(Circle(RADIUS), FEED)
    sources = select_sources(machine, ["elasto-geometric-xy"])

    def case(readings: int, watch: Stopwatch) -> Array:
        factor = empty_factor([source.name for source in sources])
        for run in recorded(readings):
            with watch.on("all"):
                factor = merge(factor, factor_blocks(factor.labels, design_blocks(sources, machine, setup, [run])))
        with watch.on("all"):
            return solve(factor, tuple(TRUTH)).values

    return case


def stages(topology: str) -> Case:
    """The same, block by block with a stopwatch on each stage."""
    machine = Machine(topology, parse_topology(topology))
    setup = LoadedBallBar(Circle(RADIUS), FEED)
    sources = select_sources(machine, ["elasto-geometric-xy"])

    def case(readings: int, watch: Stopwatch) -> Array:
        factor = empty_factor([source.name for source in sources])
        for run in recorded(readings):
            for first in range(0, len(run.columns["angle"]), BLOCK_READINGS):
                part = {name: values[first : first + BLOCK_READINGS] for name, values in run.columns.items()}
                with watch.on("observe"):
                    observations = setup.observe(machine, Run(run.name, part, run.force))
                with watch.on("rows"):
                    rows = design_rows(sources, machine, observations)
                with watch.on("factor"):
                    factor = merge(factor, factor_blocks(factor.labels, [rows]))
        with watch.on("factor"):
            return solve(factor, tuple(TRUTH)).values

    return case


def full_matrix(readings: int, watch: Stopwatch) -> Array:
    """The whole matrix in memory, built vectorised, then `numpy.linalg.lstsq`."""
    runs = list(recorded(readings))
    angle, reading = (np.concatenate([run.columns[name] for run in runs]) for name in ("angle", "radial"))
    force = np.repeat([run.force for run in runs], [len(run.columns["angle"]) for run in runs])
    del runs
    with watch.on("all"):
        return np.asarray(np.linalg.lstsq(closed_form(angle, force), reading, rcond=None)[0])


def numerical_derivatives(readings: int, watch: Stopwatch) -> Array:
    """A loop over readings and parameters that differentiates the exact model (Eq. 4.24), then `numpy.linalg.lstsq`."""
    runs = list(recorded(readings))
    steps = MOVED / np.abs(closed_form(np.linspace(0, 2 * np.pi, REVOLUTION), FORCES[-1])).max(axis=0)
    with watch.on("all"):
        A, y = [], []
        for run in runs:
            assert run.force is not None
            for angle, reading in zip(run.columns["angle"].tolist(), run.columns["radial"].tolist(), strict=True):
                undisturbed = exact_reading(np.zeros(len(steps)), angle, run.force)
                row = []
                for j, step in enumerate(steps):
                    parameters = np.zeros(len(steps))
                    parameters[j] = step
                    row.append((exact_reading(parameters, angle, run.force) - undisturbed) / step)
                A.append(row)
                y.append(reading)
        return np.asarray(np.linalg.lstsq(np.array(A), np.array(y), rcond=None)[0])


def exact_reading(p: Array, angle: float, force: float) -> float:
    """One reading of this test by products of planar transforms, as chapters 4 and 5 of the thesis write it."""
    x, y = RADIUS * math.cos(angle), RADIUS * math.sin(angle)
    fx, fy = force * math.cos(angle), force * math.sin(angle)
    tool = (
        planar(0.0, y, 0.0)
        @ planar(p[8] * y**2, p[2] * fy + p[9] * y, p[3] * fx + p[4] * fy + p[5] * x * fy)
        @ planar(0.0, 0.0, p[10])
        @ planar(x, 0.0, 0.0)
        @ planar(p[0] * fx + p[1] * fy + p[6] * x, p[7] * x**2, 0.0)
        @ np.array([p[11], p[12], 1.0])
    )
    return math.hypot(tool[0], tool[1]) - RADIUS


def planar(x: float, y: float, turn: float) -> Array:
    """Transform of the plane: a turn about z, then a shift."""
    c, s = math.cos(turn), math.sin(turn)
    return np.array([[c, -s, x], [s, c, y], [0.0, 0.0, 1.0]])


def reference(readings: int, watch: Stopwatch) -> Array:
    """The same solution in extended precision (64 bits of mantissa on x86), columns scaled; independent of elastogeo."""
    scale = np.linalg.norm(closed_form(np.linspace(0, 2 * np.pi, REVOLUTION), FORCES[-1]), axis=0)
    N, g = np.zeros((len(scale), len(scale)), np.longdouble), np.zeros(len(scale), np.longdouble)
    with watch.on("all"):
        for run in recorded(readings):
            A = closed_form(run.columns["angle"].astype(np.longdouble), run.force or 0.0) / scale
            N += A.T @ A
            g += A.T @ run.columns["radial"]
        solution = np.zeros_like(g)
        for _ in range(8):
            solution += np.linalg.solve(N.astype(float), (g - N @ solution).astype(float))
    return np.asarray(solution / scale)


CASES: dict[str, Callable[[], Case]] = {
    "streamed-2-axes": lambda: streamed("wFYXt"),
    "streamed-5-axes": lambda: streamed("wCAFYXZSt"),
    "stages-2-axes": lambda: stages("wFYXt"),
    "stages-5-axes": lambda: stages("wCAFYXZSt"),
    "full-matrix": lambda: full_matrix,
    "derivatives": lambda: numerical_derivatives,
    "reference": lambda: reference,
}


def peak_process_mb() -> float:
    """Most memory [MB] that this process had resident so far; not a number on Windows."""
    try:
        import resource
    except ImportError:
        return math.nan
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1e6 if sys.platform == "darwin" else 1e6 / 1024)


def measured(name: str, readings: int) -> dict[str, object]:
    """Best time of the repeats, peak memory, and the solution of a case."""
    case = CASES[name]()
    imports = peak_process_mb()
    clock: dict[str, float] = {}
    processor: dict[str, float] = {}
    for _ in range(1 if name == "reference" else REPEATS):
        watch = Stopwatch()
        solution = case(readings, watch)
        clock = {what: min(seconds, clock.get(what, math.inf)) for what, seconds in watch.clock.items()}
        processor = {what: min(seconds, processor.get(what, math.inf)) for what, seconds in watch.processor.items()}
    process = peak_process_mb()
    arrays = math.nan
    if name.startswith("streamed"):
        tracemalloc.start()
        case(readings, Stopwatch())
        arrays = tracemalloc.get_traced_memory()[1] / 1e6
    return {
        "clock": clock,
        "processor": processor,
        "imports_mb": imports,
        "process_mb": process,
        "arrays_mb": arrays,
        "solution": [float(value) for value in solution],
        "truth": list(TRUTH.values()),
        "versions": {"Python": sys.version.split()[0], "NumPy": np.__version__},
    }


if __name__ == "__main__":
    print(json.dumps(measured(sys.argv[1], int(sys.argv[2]))))
