"""Runs of a ball-roller test made by hand: circles, forces and torques written out, none of it by the program's simulator.

A roller circles a ball at constant feed. The same force acts in every direction (or one that the test gives), so each drive
holds `-F cos` or `-F sin`; its motor needs that through the screw, with the losses that the direction of the power says, and
its own inertia and friction.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from elastogeo.drive import FeedDrive, SetupCompliance
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import BallRoller, Circle, MachineTest, Question, Run

RADIUS, FEED, PITCH, EFFICIENCY = 56.4, 1000 / 60, 10.0, 0.9
CONSTANT = {"X": 1650.0, "Y": 1520.0}
INERTIA, VISCOUS, COULOMB = {"X": 6.0, "Y": 4.0}, {"X": 90.0, "Y": 70.0}, {"X": 1550.0, "Y": 1600.0}
RATIO = PITCH / (2 * np.pi)

ENGAGEMENT = np.array([40.0, 80.0, 120.0, 160.0, 200.0]) / 1000
SETUP = np.array([10.0, 26.0, 46.0, 66.0, 89.0]) / 1000
FORCE = SETUP * 1000 * np.array([18.9, 17.3, 16.3, 15.8, 14.5])
MACHINE = ENGAGEMENT - SETUP
"""Tables 6.5 and 6.6 of the thesis: engagement, deflection of the set-up, force, deflection of the machine [mm, N]."""

Force = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class RollerNoise:
    """Standard deviations of encoders [mm], currents [A], and the relative one of the force from run to run."""

    encoder: float = 1e-4
    current: float = 0.03
    force: float = 2e-3


def run_of(
    engagement: float, force: Force, sense: int, repeat: int, back: float, noise: RollerNoise, random: np.random.Generator
) -> Run:
    """One run: 385 degrees, 31 samples a second."""
    radius = RADIUS - engagement
    rate = sense * FEED / radius
    turned = sense * np.linspace(0, np.deg2rad(385), 700)
    time, c, s = turned / rate, np.cos(turned), np.sin(turned)
    pressed = force(turned) * (1 + noise.force * random.standard_normal())
    columns = {"time": time}
    for axis, position, velocity, held in (
        ("X", radius * c, -radius * rate * s, -pressed * c),
        ("Y", radius * s, radius * rate * c, -pressed * s),
    ):
        drives = held * velocity > 0
        torque = held * RATIO * np.where(drives, 1 / EFFICIENCY, back)
        torque += INERTIA[axis] * -(rate**2) * position / RATIO + VISCOUS[axis] * velocity / RATIO
        torque += COULOMB[axis] * np.sign(velocity)
        columns[f"position_{axis.lower()}"] = position + noise.encoder * random.standard_normal(len(time))
        columns[f"current_{axis.lower()}"] = torque / CONSTANT[axis] + noise.current * random.standard_normal(len(time))
    name = f"{1000 * engagement:g}um-{sense}-{repeat}"
    return Run(name, columns, engagement=engagement, sense=sense, repeat=repeat)


def make_roller_test(
    engagements: np.ndarray,
    force: Callable[[int], Force],
    setup: SetupCompliance,
    back: float = 2 - 1 / EFFICIENCY,
    noise: RollerNoise | None = None,
    seed: int = 1,
    **drive: float,
) -> MachineTest:
    """A test of two repeats in either direction at no engagement and at each of some; `force(n)` of the n-th of these."""
    random = np.random.default_rng(seed)
    parsed = parse_topology("wCAYfXZt")
    machine = Machine(name="m", topology=parsed, joints=tuple(map(Joint, parsed.axes)), tool=(0.0, 0.0, -150.0))
    given = {"efficiency": EFFICIENCY, "relative_uncertainty": 0.01, **drive}
    drives = tuple(FeedDrive(axis, torque_constant=CONSTANT[axis], pitch=PITCH, **given) for axis in "XY")
    forces: list[Force] = [np.zeros_like, *(force(n) for n in range(len(engagements)))]
    runs = tuple(
        run_of(engagement, of, sense, repeat, back, noise or RollerNoise(), random)
        for engagement, of in zip((0.0, *engagements), forces, strict=True)
        for repeat in (1, 2)
        for sense in (1, -1)
    )
    roller = BallRoller(Circle(RADIUS), FEED, drives, setup)
    return MachineTest("by hand", machine, roller, runs, Question(("C_XXX", "C_YYY", "E_Xt0", "E_Yt0")))


def table_6_6(**options: Any) -> MachineTest:
    """A test of a machine whose deflection is that of Table 6.6, in every direction."""
    setup = SetupCompliance(compliance=tuple(SETUP / FORCE), engagement=tuple(ENGAGEMENT), standard_uncertainty=1e-6)
    return make_roller_test(ENGAGEMENT, lambda n: lambda angle: np.full(len(angle), FORCE[n]), setup, **options)
