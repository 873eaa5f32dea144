"""Simulated positioning tests: a curve, a reversal, a zero that wanders from cycle to cycle, by formulas of their own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.identification import evaluate_positioning
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import MachineTest, Positioning, Run
from studies.rates import Cell, Named

TARGETS = np.array([-201.3, -148.2, -102.7, -49.1, 0.6, 51.4, 97.9, 152.2, 199.5])
LAYOUT = "9 targets, 5 cycles"
WHITE, WANDER, STEP = 4e-4, 1e-3, 1e-3


@dataclass(frozen=True)
class Positioned:
    """Five cycles in both directions, nine targets of X.

    Attributes
    ----------
    noise : str
        White of 0.4 um; with a zero of each cycle of 1 um; rounded to 1 um.
    drift : float [mm]
        By which each cycle is off the one before.
    wave : float [mm]
        Amplitude of a periodic error of 37 mm.
    """

    noise: str
    drift: float = 0.0
    wave: float = 0.0

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `evaluate_positioning`."""
        random = np.random.default_rng(seed)
        target = np.tile(np.concatenate([TARGETS, TARGETS[::-1]]), 5)
        direction = np.tile(np.repeat([1.0, -1.0], len(TARGETS)), 5)
        cycle = np.repeat(np.arange(5), 2 * len(TARGETS))
        off = 2.5e-5 * target - 8e-8 * target**2 + 3e-10 * target**3 - 0.0015 * direction
        off = off + self.drift * cycle + self.wave * np.sin(2 * np.pi * target / 37) + WHITE * random.standard_normal(90)
        if self.noise == "of the cycle":
            off = off + WANDER * random.standard_normal(5)[cycle]
        if self.noise == "quantised":
            off = np.round(off / STEP) * STEP
        run = Run("run", {"target": target, "direction": direction, "deviation": off})
        return evaluate_positioning(MachineTest("study", Machine("m", parse_topology("wFXYZt")), Positioning("X"), (run,)))


def positioned(
    check: str, truth: str, noises: tuple[str, ...], drift: float = 0.0, wave: float = 0.0, short: int = 0, **wanted: float
) -> tuple[Cell, ...]:
    """A cell for each noise."""
    return tuple(
        Cell(truth, LAYOUT, noise, Positioned(noise, drift, wave), Named(check), short=short * (noise == "white"), **wanted)
        for noise in noises
    )
