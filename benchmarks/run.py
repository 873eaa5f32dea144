"""Time, memory and accuracy of elastogeo's streamed least squares, beside the usual ways: `make bench`.

What is measured, and how to read the table: `benchmarks/README.md`. Nothing is asserted, so nothing fails on a slow machine.
This file imports nothing heavy, because on Linux a process begins with the peak memory of the one that started it.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import subprocess
import sys
from pathlib import Path
from typing import Any

CASES = Path(__file__).with_name("cases.py")

LOOPED = 2000
"""Readings of the plain Python loop; its time is per reading, so it scales."""

FULL_MATRIX_BYTES = 400
"""Memory that the full matrix takes per reading: itself, the copy of the solver, angle, force and reading."""

WAYS = {
    "streamed-2-axes": "elastogeo, streamed, wFYXt",
    "streamed-5-axes": "elastogeo, streamed, wCAFYXZSt",
    "full-matrix": "full matrix, numpy.linalg.lstsq",
    "derivatives": f"derivatives in a loop (4.24), {LOOPED}",
}
HEADER = (
    f"{'readings':>10}  {'way':<36}{'ns/reading':>11}{'ratio':>8}{'CPU ns':>8}{'process MB':>12}{'work MB':>9}"
    f"{'arrays MB':>11}{'digits':>8}{'truth':>7}"
)

Result = dict[str, Any]


def main() -> int:
    """Run every case in a process of its own and print the tables."""
    parser = argparse.ArgumentParser(description="Time elastogeo's streamed least squares beside the usual ways.")
    parser.add_argument("readings", nargs="*", type=int, default=[10**6, 10**7], help="default: 1000000 10000000")
    counts: list[int] = parser.parse_args().readings

    busy = f"load {os.getloadavg()[0]:.1f} before the start; " if hasattr(os, "getloadavg") else ""
    first = case("stages-2-axes", counts[0])
    five = case("stages-5-axes", counts[0])
    versions = ", ".join(f"{name} {version}" for name, version in first["versions"].items())
    print(f"{processor()}, {os.cpu_count()} cores; {versions}; {busy}13 parameters, best of 3\n")
    print(HEADER, flush=True)
    base = math.nan
    for count in counts:
        exact = case("reference", count)["solution"]
        base = math.nan
        for name in ("streamed-2-axes", "streamed-5-axes", "full-matrix"):
            if name == "full-matrix" and free_bytes() < FULL_MATRIX_BYTES * count:
                print(f"{count:>10}  {WAYS[name]:<36}not run: needs {FULL_MATRIX_BYTES * count / 1e9:.0f} GB of free memory")
                continue
            result = case(name, count)
            base = nanoseconds(result, count) if math.isnan(base) else base
            print(line(count, name, result, exact, base), flush=True)
    looped = case("derivatives", LOOPED)
    print(line(LOOPED, "derivatives", looped, case("reference", LOOPED)["solution"], base), flush=True)

    print(f"\nwhere elastogeo's time goes, CPU ns a reading ({counts[0]} readings):")
    for topology, result in (("wFYXt", first), ("wCAFYXZSt", five)):
        parts = "  ".join(f"{stage} {1e9 * seconds / counts[0]:.0f}" for stage, seconds in result["processor"].items())
        print(f"  {topology:<10} {parts}")
    return 0


def case(name: str, readings: int) -> Result:
    """What `cases.py` says of a case."""
    print(f"  measuring {name}, {readings} readings ...", file=sys.stderr, flush=True)
    command = [sys.executable, str(CASES), name, str(readings)]
    result: Result = json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout)
    return result


def line(readings: int, name: str, result: Result, exact: list[float], base: float) -> str:
    """One line of the table."""
    took, processor_took = nanoseconds(result, readings), 1e9 * result["processor"]["all"] / readings
    work = result["process_mb"] - result["imports_mb"]
    arrays = "-" if math.isnan(result["arrays_mb"]) else f"{result['arrays_mb']:.1f}"
    return (
        f"{readings:>10}  {WAYS[name]:<36}{took:>11.0f}{took / base:>8.1f}{processor_took:>8.0f}"
        f"{result['process_mb']:>12.0f}{work:>9.0f}{arrays:>11}{digits(result['solution'], exact):>8.1f}"
        f"{digits(result['solution'], result['truth']):>7.1f}"
    )


def nanoseconds(result: Result, readings: int) -> float:
    """Time per reading on the clock [ns]."""
    return 1e9 * float(result["clock"]["all"]) / readings


def digits(values: list[float], right: list[float]) -> float:
    """Decimal digits that are right in the worst of the values, 16 at most."""
    worst = max(abs(value - true) / abs(true) for value, true in zip(values, right, strict=True))
    return min(16.0, -math.log10(max(worst, 1e-16)))


def free_bytes() -> float:
    """Free memory [bytes], infinite where the system does not say."""
    try:
        return float(os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return math.inf


def processor() -> str:
    """The kind of processor, as far as the system says."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.processor() or platform.machine()


if __name__ == "__main__":
    sys.exit(main())
