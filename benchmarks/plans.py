"""Time and memory of a plan: `python benchmarks/plans.py [CANDIDATES ...]`, eight tests of a five-axis machine.

From the machine to the plan: drawing tests within the travel, working out what each tells, choosing, and what the chosen
ones will tell. Times are of the processor and of the clock, after a small plan; each size runs in a process of its own. It
is no test: nothing is asserted.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
from time import perf_counter, process_time

from elastogeo.formats import read_machine
from elastogeo.planning import Means, candidates, plan

CANDIDATES = (125, 250, 500, 1000)
GOALS = ("workspace", "parameters", "information")
TESTS = 8
KIBIBYTES_PER_MEGABYTE = 1024


def measured(count: int) -> str:
    """One line of the table."""
    means = Means(read_machine("hermle_c50"))
    plan(means, tests=2, count=10)
    begun, clock = process_time(), perf_counter()
    drawn = candidates(means, count=count)
    took = [process_time() - begun]
    for goal in GOALS:
        start = process_time()
        plan(means, tests=TESTS, goal=goal, chosen_from=drawn)
        took.append(process_time() - start)
        if goal == GOALS[0]:
            elapsed = perf_counter() - clock
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / KIBIBYTES_PER_MEGABYTE
    cells = "".join(f"{seconds:>13.2f}" for seconds in took)
    return f"{count:>11}{cells}{took[0] + took[1]:>13.2f}{elapsed:>13.2f}{memory:>9.0f}"


def main() -> None:
    """Print the table."""
    heads = ("draw", *GOALS, "draw + first", "its clock")
    print(f"{'candidates':>11}{''.join(f'{head:>13}' for head in heads)}{'MB':>9}   [s of the processor]")
    context = multiprocessing.get_context("spawn")
    for count in [int(word) for word in sys.argv[1:]] or CANDIDATES:
        with context.Pool(1) as pool:
            print(pool.apply(measured, (count,)), flush=True)


if __name__ == "__main__":
    main()
