"""Time and memory of reading a program for a control: `python benchmarks/programs.py [BLOCKS ...]`.

The program is a spiral of short lines and arcs by their radius, in plain ISO words, as a computer-aided system writes it; it
is read, and its path is made in parts of 50 000 blocks with a point a millimetre. Times are of the processor. It is no
test: nothing is asserted.
"""

from __future__ import annotations

import subprocess
import sys
import tracemalloc
from time import process_time

import numpy as np

from elastogeo.formats import read_machine, read_program_bytes

BLOCKS = (10_000, 100_000, 1_000_000)
MEGABYTE = 2**20


def text(blocks: int) -> bytes:
    """A program of so many blocks."""
    turn = np.linspace(0.0, 2000.0, blocks)
    x, y, z = 50 * np.cos(turn), 50 * np.sin(turn), turn / 50
    lines = [
        f"G3X{x[k]:.4f}Y{y[k]:.4f}R100." if k % 10 == 9 else f"N{k}G1X{x[k]:.4f}Y{y[k]:.4f}Z{z[k]:.4f}F{1000 + k % 7}"
        for k in range(blocks)
    ]
    return "\n".join(["%", "O1", "G21 G90 G17 G94", "G0 X51. Y0. Z0.", *lines, "M30", "%", ""]).encode()


def main() -> int:
    """Measure each size in a process of its own."""
    if sys.argv[1:2] == ["one"]:
        measure(int(sys.argv[2]), traced=sys.argv[3] == "traced")
        return 0
    print(
        "| blocks | file MB | read, CPU s | path, CPU s | read, peak MB | path, peak MB |\n|---:|---:|---:|---:|---:|---:|"
    )
    for blocks in map(int, sys.argv[1:] or BLOCKS):
        rows = [
            subprocess.run(
                [sys.executable, __file__, "one", str(blocks), way], capture_output=True, text=True, check=True
            ).stdout.split()
            for way in ("timed", "traced")
        ]
        print(f"| {blocks} | {' | '.join(rows[0] + rows[1][1:])} |", flush=True)
    return 0


def measure(blocks: int, *, traced: bool) -> None:
    """Print the size of the file [MB], then times [s] or peaks [MB] of reading it and of making its path."""
    data, machine = text(blocks), read_machine("hermle_c50")
    if traced:
        tracemalloc.start()
    found, begin = [f"{len(data) / MEGABYTE:.1f}"], process_time()
    program = read_program_bytes(data, "x", "iso")
    found.append(_value(begin, traced))
    begin = process_time()
    for _ in program.paths(machine, 1.0):
        pass
    found.append(_value(begin, traced))
    print(*found)


def _value(begin: float, traced: bool) -> str:
    if not traced:
        return f"{process_time() - begin:.2f}"
    peak = tracemalloc.get_traced_memory()[1] / MEGABYTE
    tracemalloc.reset_peak()
    return f"{peak:.0f}"


if __name__ == "__main__":
    sys.exit(main())
