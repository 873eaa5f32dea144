"""Planned tests whose programs are judged: every instrument's template, and circles in every position."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import cos, pi, radians, sin
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import elastogeo as eg
from elastogeo.observe import BallBar, Circle, LoadedBallBar, MachineTest, Run, instruments
from tests.conftest import build_machine

MOVING = {
    "ball-bar", "loaded-ball-bar", "ball-roller", "positioning", "sphere-nest", "displacement-probes", "static-force",
    "sensor-frame", "joint-probe",
}  # fmt: skip


@cache
def of_template(name: str) -> MachineTest:
    """The test that `elastogeo new` makes for an instrument, planned."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / name
        eg.new_test(path, instrument=name)
        return eg.read_test(path, planned=72)


def circle_test(
    circle: Circle, topology: str = "wCAFYXZSt", *, angle: np.ndarray | None = None, loaded: bool = False
) -> MachineTest:
    """Both directions of a bar on a circle."""
    angle = np.arange(60) * 2 * pi / 60 if angle is None else angle
    columns = {"angle": angle, "radial": np.zeros(len(angle))}
    machine = build_machine(topology, tool=(0.0, 0.0, -160.0))
    if loaded:
        runs = tuple(Run(f"{f} N {s}", columns, force=float(f), sense=s) for f in (100, 400) for s in (1, -1))
        return MachineTest("loaded", machine, LoadedBallBar(circle, 2000 / 60), runs)
    runs = (Run("ccw", columns, sense=1), Run("cw", columns, sense=-1))
    return MachineTest("bar", machine, BallBar(circle, 1000 / 60), runs)


TILTED = ((1.0, 0.0, 0.0), (0.0, cos(0.5), sin(0.5)))
PART = np.linspace(radians(-20), radians(200), 50)

CIRCLES: dict[str, Callable[[], MachineTest]] = {
    "XY": lambda: circle_test(Circle(150.0)),
    "YZ": lambda: circle_test(Circle(100.0, "YZ", {"X": 30.0, "Z": 40.0})),
    "ZX": lambda: circle_test(Circle(100.0, "ZX", {"Y": -20.0})),
    "ZX in part": lambda: circle_test(Circle(100.0, "ZX"), angle=PART),
    "tilted": lambda: circle_test(Circle(100.0, TILTED, {"Z": 50.0})),
    "tilted in part": lambda: circle_test(Circle(100.0, TILTED), angle=PART),
    "table held": lambda: circle_test(Circle(150.0, "XY", {"A": radians(20), "C": radians(35), "X": 40.0}), loaded=True),
    "head held": lambda: circle_test(Circle(150.0, "XY", {"B": radians(15), "C": radians(35)}), "wFXYZCBSt"),
    "across a turned axis": lambda: circle_test(Circle(80.0, "XY", {"C": radians(25)}), "wXCFYZt"),
    "plane of the table": lambda: circle_test(Circle(80.0, "XY", {"A": radians(25)}, in_workpiece=True)),
    "table turns": lambda: circle_test(Circle(150.0, "XY", {"X": 50.0, "Y": 20.0}, True, 0.0, 0.4, {"C": 1.0})),
    "bar and table turn": lambda: circle_test(Circle(120.0, "XY", {"X": 30.0}, False, 1.0, 0.0, {"C": -0.5})),
    "table tilts": lambda: circle_test(
        Circle(100.0, "YZ", {"Y": 60.0}, True, 0.0, 0.0, {"A": 0.3}), angle=np.linspace(-1.5, 1.5, 40)
    ),
    "thesis": lambda: circle_test(Circle(150.0, "XY", {"X": 100.0, "Y": 50.0, "Z": -80.0}), loaded=True),
    "three axes": lambda: circle_test(Circle(150.0), "wFYXZt"),
    "two axes": lambda: circle_test(Circle(150.0), "wFYXt"),
    "clockwise first": lambda: replace(one := circle_test(Circle(150.0)), runs=one.runs[::-1]),
}


def planned_tests() -> dict[str, Callable[[], MachineTest]]:
    """Every test whose program is judged, by name."""
    names = [name for name in instruments() if name in MOVING]
    return {f"template of {name}": (lambda name=name: of_template(name)) for name in names} | CIRCLES
