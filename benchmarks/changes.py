"""Time to judge a series, a fleet, and to find what a test says of it: `python benchmarks/changes.py`.

Series of eight indicators, monthly tests, the first ten of them the baseline; one in alarm from its middle on. Times are of
the processor, the least of five, on simulated numbers. It is no test: nothing is asserted.
"""

from __future__ import annotations

from collections.abc import Callable
from time import process_time

import numpy as np

from elastogeo.changes import (
    KINDS,
    Baseline,
    MachineRow,
    Series,
    fleet_state,
    indicators_of,
    judge,
    machine_row,
    signatures_of,
)
from elastogeo.formats import example_test, read_test
from elastogeo.identification import identify

LENGTHS = (50, 200, 500)
MACHINES = (200, 1000)
KIND = KINDS["straightness"]


def series_of(tests: int, alarm: bool) -> Series:
    """Of normal numbers."""
    value = KIND.reproducibility * np.random.default_rng(1).standard_normal((tests, 8))
    value[tests // 2 :, 0] += 8 * KIND.reproducibility * alarm
    return Series(
        name="benchmark",
        indicators=tuple(f"straightness {k}" for k in range(8)),
        kinds=(KIND,) * 8,
        tests=tuple(map(str, range(tests))),
        date=30.0 * np.arange(tests),
        value=value,
        standard_uncertainty=np.full((tests, 8), np.nan),
        temperature=np.full(tests, 20.0),
        repeats=np.full(tests, -1),
        aside=np.zeros(tests, dtype=bool),
        instruments=("",) * tests,
        simulated="normal numbers",
    )


def least(work: Callable[[], object]) -> float:
    """Processor time of the fastest of five [ms]."""
    times = []
    for _ in range(5):
        begin = process_time()
        work()
        times.append(process_time() - begin)
    return 1e3 * min(times)


def main() -> None:
    """Print a line for each."""
    for tests in LENGTHS:
        for alarm in (False, True):
            series = series_of(tests, alarm)
            baseline = Baseline(series.tests[:10], float(series.date[9]) + 0.5)
            spent = least(lambda s=series, b=baseline: judge(s, b))  # type: ignore[misc]
            print(f"judge {tests:>5} tests, {'alarm ' if alarm else 'steady'} {spent:8.1f} ms")
    series = series_of(50, alarm=True)
    row = machine_row(judge(series, Baseline(series.tests[:10], float(series.date[9]) + 0.5)))
    for machines in MACHINES:
        kept = [{**row.document(), "machine": f"machine {k}"} for k in range(machines)]
        spent = least(lambda k=kept: fleet_state(map(MachineRow.of_document, k), 2000.0))  # type: ignore[misc]
        print(f"fleet {machines:>5} machines, from what is kept {spent:8.1f} ms")
    result = identify(read_test(example_test()))
    print(f"indicators of the example test {least(lambda: indicators_of(result)):8.1f} ms")
    print(f"signatures of the example test {least(lambda: signatures_of(result)):8.1f} ms")


if __name__ == "__main__":
    main()
