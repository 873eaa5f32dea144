"""Simulated positioning tests, compensated: a screw with a curve, a reversal, white noise, a zero that wanders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.identification import evaluate_positioning
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import MachineTest, Positioning, Run
from elastogeo.prediction import compensate
from studies.positioning_samples import TARGETS, WANDER, WHITE
from studies.rates import Cell, Named

LAYOUT = "9 targets, 5 cycles"


@dataclass(frozen=True)
class Compensated:
    """Five cycles in both directions, nine targets of X, a screw that is 25 um/m long.

    Attributes
    ----------
    reversal : float [mm]
    wander : bool
        Whether the zero and the slope of each cycle wander, by 1 um and by 5 um/m.
    """

    reversal: float
    wander: bool = False

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `compensate`."""
        random = np.random.default_rng(seed)
        target = np.tile(np.concatenate([TARGETS, TARGETS[::-1]]), 5)
        direction = np.tile(np.repeat([1.0, -1.0], len(TARGETS)), 5)
        cycle = np.repeat(np.arange(5), 2 * len(TARGETS))
        off = 2.5e-5 * target - self.reversal / 2 * direction + WHITE * random.standard_normal(90)
        if self.wander:
            off = off + WANDER * random.standard_normal(5)[cycle] + 5e-6 * random.standard_normal(5)[cycle] * target
        run = Run("run", {"target": target, "direction": direction, "deviation": off})
        setup = Positioning("X")
        return compensate(evaluate_positioning(MachineTest("study", Machine("m", parse_topology("wFXYZt")), setup, (run,))))


def compensated(check: str, truth: str, reversal: float, short: int = 0, **wanted: float) -> tuple[Cell, ...]:
    """A cell without and with wandering cycles."""
    return tuple(
        Cell(truth, LAYOUT, noise, Compensated(reversal, wander), Named(check), short=short * (not wander), **wanted)
        for noise, wander in (("white", False), ("of the cycle", True))
    )
