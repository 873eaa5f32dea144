"""Time and memory of a map of the compliance at the tool with U: `python benchmarks/maps.py [--quick]`.

Three axes: the eight loaded circles of `examples/three-axis-campaign`. Five axes: sixteen loaded circles of the example
machine at places and table angles of their own; their readings are noise. Grids of 4 000 to half a million places, along one
direction and in the softest of each place. Times are of the processor. It is no test: nothing is asserted.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from pathlib import Path
from time import process_time

import numpy as np

from elastogeo.formats import read_campaign, read_machine
from elastogeo.identification import Identification, identify
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Question, Run
from elastogeo.prediction import map_compliance

SHAPES = ((20, 20, 10), (50, 50, 25), (100, 100, 50))
READINGS = 60
MEGABYTE = 2**10
EXAMPLE = Path(__file__).parents[1] / "examples" / "three-axis-campaign"


def five_axes() -> Identification:
    """What sixteen circles say of the example machine."""
    machine, random = read_machine("hermle_c50"), np.random.default_rng(1)
    angle = 2 * np.pi * np.arange(READINGS) / READINGS
    tests = {}
    for k in range(16):
        place = {axis: float(random.uniform(-150.0, 150.0)) for axis in "XYZ"}
        turned = {axis: float(random.uniform(-0.5, 0.5)) for axis in "AC"}
        circle = Circle(150.0, plane=("XY", "YZ", "ZX")[k % 3], centre={**place, **turned})
        runs = tuple(
            Run(f"{force} N {n}", {"angle": angle, "radial": random.normal(0.0, 1e-4, READINGS)}, force=force, repeat=n)
            for force in (100.0, 700.0)
            for n in (1, 2)
        )
        question = Question(parameters=("C_*",), reciprocal=True)
        tests[f"t{k}"] = MachineTest(f"t{k}", machine, LoadedBallBar(circle, 2000 / 60), runs, question=question)
    return identify(tests)


def measured(axes: str, shape: tuple[int, ...], direction: str) -> dict[str, float]:
    """Seconds of the processor, and the most memory [MB] of the process, before the map and with it."""
    result = identify(read_campaign([EXAMPLE])) if axes == "3" else five_axes()
    along = {axis: (-150.0, 150.0, count) for axis, count in zip("XYZ", shape, strict=True)}
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MEGABYTE
    began = process_time()
    found = map_compliance(result, along, direction=direction)
    return {
        "seconds": process_time() - began,
        "before": before,
        "most": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MEGABYTE,
        "supported": found.share_supported,
        "rank": result.confounding.rank,
        "columns": len(result.confounding.labels),
        "runs": result.campaign.runs,
    }


def main() -> None:
    """One line for each size and direction, each in a process of its own."""
    if sys.argv[1:2] == ["--one"]:
        axes, shape, direction = sys.argv[2:]
        print(json.dumps(measured(axes, tuple(map(int, shape.split("x"))), direction)))
        return
    shapes = SHAPES[:1] if "--quick" in sys.argv else SHAPES
    print("| axes | columns, rank, runs | places | direction | CPU s | us a place | MB before | MB most | supported |")
    print("|---:|---|---:|---|---:|---:|---:|---:|---:|")
    for axes in ("3", "5"):
        for shape in shapes:
            for direction in ("X", "softest"):
                call = [sys.executable, __file__, "--one", axes, "x".join(map(str, shape)), direction]
                one = json.loads(subprocess.run(call, capture_output=True, text=True, check=True).stdout.splitlines()[-1])
                places = int(np.prod(shape))
                print(
                    f"| {axes} | {one['columns']:.0f}, {one['rank']:.0f}, {one['runs']:.0f} | {places} | {direction} | "
                    f"{one['seconds']:.1f} | {one['seconds'] / places * 1e6:.0f} | "
                    f"{one['before']:.0f} | {one['most']:.0f} | {100 * one['supported']:.0f} % |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
