"""What an instrument adds to a true reading: noise, a harmonic residue, resolution. For simulation only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array


@dataclass(frozen=True, slots=True)
class Imperfection:
    """Imperfections of simulated readings.

    Attributes
    ----------
    noise : float [mm]
        Standard deviation of white Gaussian noise.
    resolution : float [mm]
        Step to which readings are quantised; zero for none.
    residue : tuple of (int, float, float)
        Harmonics that no parameter explains: order, amplitude [mm], phase [rad].
    """

    noise: float = 0.0
    resolution: float = 0.0
    residue: tuple[tuple[int, float, float], ...] = ()

    def added_to(self, reading: Array, angle: Array, random: np.random.Generator) -> Array:
        """The reading, shape (m,), as such an instrument would give it at these angles, shape (m,) [rad]."""
        seen = reading + self.noise * random.standard_normal(len(reading))
        for order, amplitude, phase in self.residue:
            seen += amplitude * np.cos(order * angle + phase)
        return np.round(seen / self.resolution) * self.resolution if self.resolution else seen
