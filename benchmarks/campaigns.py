"""Time and memory of a campaign: `python benchmarks/campaigns.py [TESTS ...]`, tests of ten runs of 1000 readings each.

Loaded circles in XY, YZ and ZX at places and table angles of their own, with the default questions of their planes (64
columns) and two stated influences, of one gauge and of each test; then again with one test that contradicts the others,
which is looked for. Times are of the processor, after a small campaign was identified; making the readings is not timed. It
is no test: nothing is asserted.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
import tracemalloc
from time import process_time

import numpy as np

from elastogeo.formats import read_machine
from elastogeo.identification import identify
from elastogeo.machine import About
from elastogeo.observe import Circle, KnownInfluence, LoadedBallBar, MachineTest, Run

RUNS, READINGS = 10, 1000
TESTS = (1, 5, 10, 20)
MEGABYTE = 2**20


KNOWN = (KnownInfluence("force-scale", relative=0.01), KnownInfluence("tool-offset", length=1e-3))


def campaign(tests: int, readings: int = READINGS, wrong: bool = False) -> dict[str, MachineTest]:
    """So many tests of the example machine, with readings of noise; in the first an oval grows with the force."""
    machine, random = read_machine("hermle_c50"), np.random.default_rng(1)
    angle = 2 * np.pi * np.arange(readings) / readings
    found = {}
    for k in range(tests):
        place, plane = k // 3, ("XY", "YZ", "ZX")[k % 3]
        circle = Circle(150.0, plane=plane, centre={"X": 50.0 * place, "A": 0.05 * place, "C": 0.1 * place})
        oval = 1e-5 * np.cos(2 * angle) * (wrong and not k)
        runs = tuple(
            Run(f"{force} N", {"angle": angle, "radial": random.normal(force * oval, 1e-4)}, force=float(force))
            for force in range(100, 100 * RUNS + 1, 100)
        )
        found[f"{plane.lower()}-{place}"] = MachineTest(
            f"{plane} {place}",
            machine,
            LoadedBallBar(circle, 2000 / 60),
            runs,
            influences=KNOWN,
            about=About(instrument_serial="1"),
        )
    return found


def measured(tests: int) -> tuple[float, float, float, float, float]:
    """Seconds of the processor, and where one test is wrong; most memory [MB] of the process, and that Python's accounting
    saw during and after.
    """
    identify(campaign(2, 60))
    asked, wrong = campaign(tests), campaign(tests, wrong=True)
    before = process_time()
    identify(asked)
    between, most = process_time(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    identify(wrong)
    after = process_time()
    tracemalloc.start()
    result = identify(asked)
    kept, peak = tracemalloc.get_traced_memory()
    assert len(result.tests) == tests
    return between - before, after - between, most, peak / MEGABYTE, kept / MEGABYTE


def main() -> None:
    """One line for each size, each in a process of its own."""
    print("| tests | readings | CPU s | one wrong, CPU s | process MB | arrays MB, most | arrays MB, kept |")
    print("|---:|---:|---:|---:|---:|---:|---:|")
    for tests in map(int, sys.argv[1:] or map(str, TESTS)):
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            seconds, wrong, most, peak, kept = pool.apply(measured, (tests,))
        print(
            f"| {tests} | {tests * RUNS * READINGS} | {seconds:.2f} | {wrong:.2f} | {most:.0f} | {peak:.0f} | {kept:.0f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
