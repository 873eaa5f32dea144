"""Positioning tests of axes with known errors, made here and not by the program's own simulator."""

import numpy as np

from elastogeo.machine import parse_topology
from elastogeo.machine.machine import Joint, Machine
from elastogeo.observe import KnownInfluence, MachineTest, Positioning, Run

TARGETS = np.array([-201.3, -148.2, -102.7, -49.1, 0.6, 51.4, 97.9, 152.2, 199.5])


def axis_test(
    error,
    axis="X",
    noise=2e-4,
    wander=0.0,
    cycles=5,
    seed=1,
    targets=TARGETS,
    sides=(1.0, -1.0),
    scale=None,
    direction=None,
    topology="wFYXZt",
):
    """A test of an axis whose error is `error(position, sense)` [mm]; each cycle has a zero of its own, and a slope that
    wanders."""
    random = np.random.default_rng(seed)
    columns = {name: [] for name in ("cycle", "direction", "target", "deviation")}
    for cycle in range(1, cycles + 1):
        zero, slope = random.normal(0, 0.01), random.normal(0, wander)
        for sense in sides:
            read = error(targets, np.full(len(targets), sense)) + zero + slope * targets
            columns["cycle"].append(np.full(len(targets), float(cycle)))
            columns["direction"].append(np.full(len(targets), sense))
            columns["target"].append(targets)
            columns["deviation"].append(read + random.normal(0, noise, len(targets)))
    run = Run("1", {name: np.concatenate(parts) for name, parts in columns.items()})
    influences = () if scale is None else (KnownInfluence("sensor-scale", "laser", relative=scale),)
    parsed = parse_topology(topology)
    machine = Machine("machine", parsed, tuple(Joint(one, pitch=10.0 if one == "X" else None) for one in parsed.axes))
    setup = Positioning(axis, direction=direction)
    return MachineTest(f"{axis} {direction or ''}", machine, setup, (run,), influences=influences)
