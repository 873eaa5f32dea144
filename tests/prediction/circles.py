"""Simulated loaded circles of a machine of three axes, which the tests of this room share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.machine import About, Joint, Machine, parse_topology
from elastogeo.observe import Campaign, Circle, Imperfection, KnownInfluence, LoadedBallBar, MachineTest, Question, Run
from elastogeo.prediction import parameter_scales
from elastogeo.sources import select_sources, simulate

PLAN = (
    ("XY", (250.0, 250.0, 0.0)),
    ("YZ", (250.0, -250.0, 250.0)),
    ("ZX", (-250.0, 250.0, 0.0)),
    ("XY", (0.0, -250.0, 0.0)),
    ("YZ", (-250.0, 0.0, 250.0)),
    ("ZX", (-250.0, -250.0, 250.0)),
    ("XY", (-250.0, -250.0, -250.0)),
    ("YZ", (0.0, 0.0, 0.0)),
)
"""Eight circles that tell all that circles tell of three axes with one tool: rank 30 (planning.md)."""
MIDDLE = tuple((plane, (0.0, 0.0, 0.0)) for plane in ("XY", "YZ", "ZX"))
NOISE = Imperfection(noise=1e-4, eccentricity=1e-3, force_scatter=0.002)


def machine() -> Machine:
    """Three axes, one of them on the side of the workpiece."""
    topology = parse_topology("wYXFZt")
    joints = tuple(Joint(axis, offset=(30.0, -20.0, 50.0)) for axis in topology.axes)
    return Machine("three axes", topology, joints, tool=(0.0, 0.0, -150.0))


def springs(one: Machine, seed: int = 7) -> dict[str, float]:
    """True compliances, symmetric and positive definite, about those of machines."""
    random = np.random.default_rng(seed)
    found = {}
    for joint in one.compliant:
        sources = select_sources(one, [f"C_??{joint.name}"])
        root = random.normal(size=(6, 6)) / 2 + np.eye(6)
        spring = (root @ root.T).ravel()
        found |= {s.name: float(spring[6 * s.component + (s.load or 0)] * parameter_scales([s])[0]) for s in sources}
    return found


def circles(
    plan: Sequence[tuple[str, tuple[float, float, float]]] = PLAN,
    repeats: int = 2,
    reciprocal: bool = False,
    gauge: float = 0.0,
    seed: int = 11,
) -> Campaign:
    """Circles in planes at places, at two forces; one gauge, uncertain by so much, for all."""
    one, angle, tests = machine(), 2 * np.pi * np.arange(20) / 20, {}
    truth = springs(one)
    stated = (KnownInfluence("force-scale", "gauge", relative=gauge, degrees_of_freedom=20.0),) if gauge else ()
    for k, (plane, place) in enumerate(plan):
        runs = tuple(
            Run(f"{force:g} N, {n}", {"angle": angle, "radial": np.zeros(20)}, force=force, repeat=n)
            for force in (100.0, 700.0)
            for n in range(1, repeats + 1)
        )
        setup = LoadedBallBar(Circle(150.0, plane=plane, centre=dict(zip("XYZ", place, strict=True))), 30.0)
        question = Question(parameters=("C_???",), reciprocal=reciprocal)
        test = MachineTest(plane, one, setup, runs, influences=stated, question=question, about=About(instrument_serial="7"))
        tests[f"{plane.lower()}{k}"] = simulate(test, truth, NOISE, seed + k, exact=False)
    return Campaign("circles", tests)
