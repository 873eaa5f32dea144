"""Time and memory of a prediction along a path: `python benchmarks/paths.py [POINTS ...]`.

What is known of the machine comes from 18 loaded circles in XY, YZ and ZX at places of their own, with all joint compliances
of the example machine (180, each joint symmetric) and the gains of its linear axes asked for. The path is a spiral that
climbs, under a force along it; in five axes the table turns with it, which these tests do not support. `stream` takes the
pieces as they come and keeps none: its memory is that of the path itself. `whole` keeps every point and its interval, and
splits 2000 of them. Times are of the processor. It is no test: nothing is asserted.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tracemalloc
from time import process_time

import numpy as np

from elastogeo.formats import read_machine
from elastogeo.identification import Identification, identify
from elastogeo.machine import ConstantForce, Cut, Machine, ToolPath, path_of_commands
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Question, Run
from elastogeo.prediction import deviations, knowledge_of, path_deviation

POINTS = (10_000, 100_000, 1_000_000)
WAYS = ("stream", "whole")
READINGS = 60
MEGABYTE = 2**20
ASKED = ("C_*", "E_XX1", "E_YY1", "E_ZZ1")


def known() -> Identification:
    """What 18 circles say of the example machine; their readings are noise."""
    machine, random = read_machine("hermle_c50"), np.random.default_rng(1)
    angle = 2 * np.pi * np.arange(READINGS) / READINGS
    tests = {}
    for place in range(6):
        centre = {axis: float(value) for axis, value in zip("XYZ", random.uniform(-120.0, 120.0, 3), strict=True)}
        for plane in ("XY", "YZ", "ZX"):
            circle = Circle(150.0, plane=plane, centre=centre)
            runs = tuple(
                Run(f"{force} N {k}", {"angle": angle, "radial": random.normal(0.0, 1e-4, READINGS)}, force=force, repeat=k)
                for force in (100.0, 700.0)
                for k in (1, 2)
            )
            setup = LoadedBallBar(circle, 2000 / 60)
            test = MachineTest(
                f"{plane} {place}", machine, setup, runs, question=Question(parameters=ASKED, reciprocal=True)
            )
            tests[f"{plane.lower()}-{place}"] = test
    return identify(tests)


def spiral(machine: Machine, points: int, five_axes: bool) -> ToolPath:
    """A path of so many points."""
    turn = np.linspace(0.0, 40 * np.pi, points)
    commands = np.zeros((points, len(machine.axes)))
    commands[:, machine.index("X")] = (20 + turn) * np.cos(turn)
    commands[:, machine.index("Y")] = (20 + turn) * np.sin(turn)
    commands[:, machine.index("Z")] = -turn
    if five_axes:
        commands[:, machine.index("C")] = 0.1 * turn
        commands[:, machine.index("A")] = 0.3 * np.sin(0.05 * turn)
    return path_of_commands(machine, commands, feed=50.0)


def measured(points: int, way: str, five_axes: bool) -> dict[str, float]:
    """Seconds of the processor, and memory [MB]: of the process, and the arrays that it takes most and keeps."""
    result = known()
    cut = Cut(ConstantForce((-50.0, 200.0, -30.0), "path"))
    path = spiral(result.campaign.machine, points, five_axes)
    path_deviation(result, spiral(result.campaign.machine, 1000, five_axes), cut)
    tracemalloc.start()
    began = process_time()
    if way == "whole":
        found = path_deviation(result, path, cut)
        supported = float(found.supported[:, :3].mean())
    else:
        pieces = deviations(knowledge_of(result), path, cut)
        supported = float(np.mean([piece.machine.supported.mean() for piece in pieces]))
    seconds = process_time() - began
    kept, most = tracemalloc.get_traced_memory()
    columns = len(result.confounding.labels)
    return {
        "seconds": seconds,
        "most": most / MEGABYTE,
        "kept": kept / MEGABYTE,
        "supported": supported,
        "columns": columns,
        "rank": result.confounding.rank,
    }


def main() -> None:
    """One line for each size and way, each in a process of its own."""
    if sys.argv[1:2] == ["--one"]:
        points, way, axes = sys.argv[2:]
        print(json.dumps(measured(int(points), way, axes == "5")))
        return
    print("| points | axes | way | CPU s | µs a point | arrays MB, most | arrays MB, kept | supported | columns, rank |")
    print("|---:|---:|---|---:|---:|---:|---:|---:|---|")
    for points in map(int, sys.argv[1:] or map(str, POINTS)):
        for axes in ("3", "5"):
            for way in WAYS:
                call = [sys.executable, __file__, "--one", str(points), way, axes]
                line = subprocess.run(call, capture_output=True, text=True, check=True).stdout.splitlines()[-1]
                one = json.loads(line)
                print(
                    f"| {points} | {axes} | {way} | {one['seconds']:.1f} | {one['seconds'] / points * 1e6:.1f} | "
                    f"{one['most']:.0f} | {one['kept']:.0f} | {100 * one['supported']:.0f} % | "
                    f"{one['columns']:.0f}, {one['rank']:.0f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
