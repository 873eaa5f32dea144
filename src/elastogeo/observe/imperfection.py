"""What an instrument adds to a true reading: noise, run-to-run scatter, a residue, resolution. For simulation only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Angle, Array, Current, Length, LengthPerForce


@dataclass(frozen=True, slots=True)
class Residue:
    """A harmonic that no parameter explains.

    Attributes
    ----------
    order : int
        Per turn.
    amplitude : float [mm]
    amplitude_per_force : float [mm/N]
        What is added to the amplitude per force of the run.
    phase : float [rad]
    """

    order: int
    amplitude: Length = 0.0
    amplitude_per_force: LengthPerForce = 0.0
    phase: Angle = 0.0


@dataclass(frozen=True, slots=True)
class Imperfection:
    """Imperfections of simulated readings.

    Attributes
    ----------
    noise : float [mm]
        Standard deviation of white Gaussian noise.
    resolution : float [mm]
        Step to which readings are quantised; zero for none.
    eccentricity : float [mm]
        Standard deviation, from run to run, of the centre in each direction of the plane.
    force_scatter : float
        Relative standard deviation, from run to run, of the force about its level.
    residue : tuple of Residue
    current_noise : float [A]
        Standard deviation of white Gaussian noise of a motor's current.
    angle_noise : float [rad]
        Standard deviation of white Gaussian noise of an angular sensor.
    """

    noise: Length = 0.0
    resolution: Length = 0.0
    eccentricity: Length = 0.0
    force_scatter: float = 0.0
    residue: tuple[Residue, ...] = ()
    current_noise: Current = 0.0
    angle_noise: Angle = 0.0

    def force_factor(self, random: np.random.Generator) -> float:
        """By what factor the force of a run is off its level."""
        return 1.0 + self.force_scatter * float(random.standard_normal())

    def added_to(self, reading: Array, angle: Array, force: float, random: np.random.Generator) -> Array:
        """The reading, shape (m,), as such an instrument gives it at these angles, shape (m,) [rad], and this force [N]."""
        x, y = self.eccentricity * random.standard_normal(2)
        seen = reading + self.noise * random.standard_normal(len(reading)) + x * np.cos(angle) + y * np.sin(angle)
        for harmonic in self.residue:
            amplitude = harmonic.amplitude + harmonic.amplitude_per_force * force
            seen += amplitude * np.cos(harmonic.order * angle + harmonic.phase)
        return self._resolved(seen)

    def noisy(self, position: Array, random: np.random.Generator) -> Array:
        """A position, shape (m,) [mm], as an encoder with this noise and resolution gives it."""
        return self._resolved(position + self.noise * random.standard_normal(len(position)))

    def angular(self, angle: Array, random: np.random.Generator) -> Array:
        """An angle, shape (m,) [rad], as an angular sensor with this noise gives it."""
        return np.asarray(angle + self.angle_noise * random.standard_normal(len(angle)))

    def _resolved(self, seen: Array) -> Array:
        return np.asarray(np.round(seen / self.resolution) * self.resolution if self.resolution else seen)
