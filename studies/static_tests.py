"""Tests of static instruments as their templates begin them, their readings written out by hand.

Truth is a compliance of translations at X, Y and Z of a machine that stands straight: the tool gives way by the sum of the
matrices, wherever a sensor touches. Probes and bar turn with the table, the other way round than its command. Noise is that
of `studies.noise`, by sensor, along the angle of a loading cycle or of the table.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import (
    DisplacementProbes,
    KnownInfluence,
    MachineTest,
    Question,
    Run,
    Sensor,
    SensorFrame,
    StaticForce,
)
from studies.chain import Array
from studies.noise import NOISES

FORCE_SCALE = 0.01
"""Relative standard uncertainty of the force, as the templates state it."""

TRUE = {"C_XXX": 6e-5, "C_YYX": 1e-5, "C_XYX": 4e-6, "C_YYY": 4e-5, "C_ZZZ": 3e-5, "C_XXZ": 1e-5}
"""Compliance of the joints [mm/N]."""

FRAME = (
    ((60, -40, 30), (1, 0, 0)),
    ((60, 40, 30), (1, 0, 0)),
    ((60, 0, -50), (1, 0, 0)),
    ((-40, 60, 20), (0, 1, 0)),
    ((40, 60, 30), (0, 1, 0)),
    ((-45, -30, 90), (0, 0, 1)),
    ((40, -35, 90), (0, 0, 1)),
    ((0, 50, 90), (0, 0, 1)),
)
PUSH = np.array([1.0, 2.0, -2.0]) / 3
"""Sensors of the frame: where and which way [mm]; the direction of its force."""

PROBES = np.array([[1, 0.2, 0], [0, 1, 0.3], [0.4, 0, 1]])
BAR = np.array([1.0, 0.0, 1.0]) / np.sqrt(2)


def cartesian() -> Array:
    """What the joints add up to, shape (3, 3) [mm/N]."""
    summed = np.zeros((3, 3))
    for name, value in TRUE.items():
        summed["XYZ".index(name[2]), "XYZ".index(name[3])] += value
    return summed


@dataclass(frozen=True)
class Made:
    """A test, and what is true of it.

    Attributes
    ----------
    test : MachineTest
    shown : mapping of str to float
        What the instrument shows by itself: `line`, `zero`, `C_XY`, `twist X`.
    """

    test: MachineTest
    shown: dict[str, float]

    @property
    def parameters(self) -> dict[str, float]:
        """Of the joints; what is not named is zero."""
        return TRUE | ({"E_R0": self.shown["zero"]} if "zero" in self.shown else {})


def static_force(noise: str, seed: tuple[int, ...], levels: tuple[float, ...]) -> Made:
    """A sensor along a force in x that rises and falls three times in each run."""
    random, zero = np.random.default_rng(seed), 0.002
    angle, off = np.linspace(0, 6 * np.pi, 120, endpoint=False), 1.0 + FORCE_SCALE * random.standard_normal()
    compliance = float(cartesian()[0, 0])
    forces = np.array([level * (1 - np.cos(angle)) / 2 for level in levels])
    seen = NOISES[noise].on(zero + compliance * off * forces, np.tile(angle, (len(levels), 1)), random)
    runs = tuple(
        Run(f"run {k}", {"force": force, "displacement": moved}, force=level)
        for k, (level, force, moved) in enumerate(zip(levels, forces, seen, strict=True))
    )
    return Made(_test(StaticForce((1.0, 0.0, 0.0)), runs), {"line": compliance, "zero": zero})


def sensor_frame(noise: str, seed: tuple[int, ...], levels: tuple[float, ...]) -> Made:
    """Eight sensors about the tool, a skew force that rises and falls once in each run."""
    random, off = np.random.default_rng(seed), 1.0
    off += FORCE_SCALE * random.standard_normal()
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    moved = cartesian() @ PUSH
    ways = np.array([way for _, way in FRAME], dtype=float)
    runs = []
    for k, level in enumerate(levels):
        force = level * (1 - np.cos(angle)) / 2
        seen = NOISES[noise].on(np.outer(ways @ moved, off * force), np.tile(angle, (len(ways), 1)), random)
        columns = {f"displacement_{n + 1}": reading for n, reading in enumerate(seen)}
        runs.append(Run(f"run {k}", {"force": force, **columns}, force=level))
    sensors = tuple(Sensor(tuple(map(float, point)), tuple(map(float, way))) for point, way in FRAME)
    setup = SensorFrame(sensors, direction=(1.0, 2.0, -2.0), lever=(15.0, -10.0, -40.0))
    twist = dict(zip((f"twist {axis}" for axis in "XYZABC"), (*moved, 0.0, 0.0, 0.0), strict=True))
    return Made(_test(setup, tuple(runs)), twist)


def displacement_probes(noise: str, seed: tuple[int, ...], levels: tuple[float, ...]) -> Made:
    """Three skew probes and a bar that turn with the table, in one turn of each run."""
    random = np.random.default_rng(seed)
    off = 1.0 + FORCE_SCALE * random.standard_normal()
    angle = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    c, s, zero, one = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    turned = np.array([[c, s, zero], [-s, c, zero], [zero, zero, one]]).transpose(2, 0, 1)
    ways = np.einsum("mij,kj->kmi", turned, PROBES / np.linalg.norm(PROBES, axis=1, keepdims=True))
    push = turned @ BAR
    runs = []
    for k, level in enumerate(levels):
        true = np.einsum("kmi,ij,mj->km", ways, cartesian(), off * level * push)
        seen = NOISES[noise].on(true, np.tile(angle, (3, 1)), random)
        columns = {f"displacement_{n + 1}": reading for n, reading in enumerate(seen)}
        runs.append(Run(f"run {k}", {"angle": angle, **columns}, force=level))
    probes = tuple(tuple(map(float, way)) for way in PROBES)
    setup = DisplacementProbes(probes, bar=(1.0, 0.0, 1.0), rotary_turn={"C": 1.0})
    matrix = {f"C_{i}{j}": float(cartesian()[m, n]) for m, i in enumerate("XYZ") for n, j in enumerate("XYZ")}
    return Made(_test(setup, tuple(runs)), matrix)


def _test(setup: StaticForce | SensorFrame | DisplacementProbes, runs: tuple[Run, ...]) -> MachineTest:
    topology = parse_topology("wCAYfXZt")
    machine = Machine("study", topology, tuple(Joint(axis) for axis in topology.axes))
    stated = (KnownInfluence("force-scale", "calibration of the force", relative=FORCE_SCALE),)
    return MachineTest("study", machine, setup, runs, Question(), influences=stated)


MAKERS: dict[str, Callable[[str, tuple[int, ...], tuple[float, ...]], Made]] = {
    "static force": static_force,
    "sensor frame": sensor_frame,
    "displacement probes": displacement_probes,
}
