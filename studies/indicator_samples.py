"""Indicator tests drawn by hand: springs in series, read by dials of 1 um."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.identification.calibrations import indicator_test

ENGAGEMENT = np.array([40.0, 80.0, 120.0, 160.0, 200.0]) / 1000
MACHINE, BALL, ROLLER = 1 / 14.6e3, 1 / 430e3, 1 / 16e3
RESOLUTION = 1e-3


@dataclass(frozen=True)
class Dials:
    """One indicator test.

    Attributes
    ----------
    offset : float [mm]
        That the machine gives way by before the contact carries.
    softens : float
        Relative growth of the roller's compliance up to the greatest engagement.
    scatter : float [mm]
        Standard deviation of a dial beside its resolution.
    repeats : int
        Readings at each engagement.
    ball : float [mm/N]
        Compliance of the ball; it decides how a dial rounds its few micrometres.
    """

    offset: float = 0.0
    softens: float = 0.0
    scatter: float = 0.0
    repeats: int = 1
    ball: float = BALL

    def draw(self, seed: tuple[int, ...]) -> object:
        """The test, its engagements a few micrometres off the round ones so that the dials round each time anew."""
        random = np.random.default_rng(seed)
        engagement = np.repeat(ENGAGEMENT + 5e-3 * random.random(len(ENGAGEMENT)), self.repeats)
        roller = ROLLER * (1 + self.softens * engagement / ENGAGEMENT[-1])
        force = (engagement - self.offset) / (MACHINE + self.ball + roller)

        def read(deflection: np.ndarray) -> np.ndarray:
            noisy = deflection + self.scatter * random.standard_normal(len(deflection))
            return RESOLUTION * np.round(noisy / RESOLUTION)

        readings = {
            "engagement": engagement,
            "force": force,
            "ball": read(self.ball * force),
            "roller": read(roller * force),
        }
        return indicator_test(readings, RESOLUTION)
