"""What an instrument and a set-up add to true readings; each kind by itself, or together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from studies.chain import Array


@dataclass(frozen=True)
class Noise:
    """Sizes of what is added; zero for none.

    Attributes
    ----------
    white : float [mm]
        Standard deviation of independent readings.
    correlated : float [mm]
        Standard deviation of a stationary AR(1) along each trace.
    correlation : float
        Of its neighbouring readings.
    of_run : float [mm]
        Standard deviation of each coefficient of an offset and of the orders `orders`, drawn once a run.
    orders : tuple of int
    harmonic : float [mm]
        Scale of orders 1 to 5, drawn once a run: amplitude half-normal, phase uniform.
    eccentricity : float [mm]
        Standard deviation of the centre in each direction, drawn once a run.
    step : float [mm]
        To which readings are rounded.
    """

    white: float = 1e-4
    correlated: float = 0.0
    correlation: float = 0.9
    of_run: float = 0.0
    orders: tuple[int, ...] = (2, 3)
    harmonic: float = 0.0
    eccentricity: float = 0.0
    step: float = 0.0

    def on(self, reading: Array, angle: Array, random: np.random.Generator) -> Array:
        """The readings, shape (runs, m) [mm], with one draw of the noise at these angles, shape (runs, m) [rad]."""
        runs, m = reading.shape
        seen = reading + self.white * random.standard_normal((runs, m))
        if self.correlated:
            seen += self.correlated * autocorrelated(random, runs, m, self.correlation)
        if self.of_run:
            seen += self.of_run * random.standard_normal((runs, 1))
            for order in self.orders:
                seen += self.of_run * wave(order * angle, random.standard_normal((2, runs, 1)))
        if self.harmonic:
            for order in range(1, 6):
                amplitude, phase = np.abs(random.standard_normal((runs, 1))), random.uniform(0, 2 * np.pi, (runs, 1))
                seen += self.harmonic * amplitude * np.cos(order * angle + phase)
        if self.eccentricity:
            seen += self.eccentricity * wave(angle, random.standard_normal((2, runs, 1)))
        return np.asarray(np.round(seen / self.step) * self.step if self.step else seen)


def wave(angle: Array, coefficients: Array) -> Array:
    """Cosine and sine with these coefficients."""
    return np.asarray(coefficients[0] * np.cos(angle) + coefficients[1] * np.sin(angle))


def autocorrelated(random: np.random.Generator, runs: int, m: int, correlation: float) -> Array:
    """Stationary AR(1) of unit variance, shape (runs, m)."""
    steps = random.standard_normal((m, runs))
    steps[1:] *= np.sqrt(1.0 - correlation**2)
    for k in range(1, m):
        steps[k] += correlation * steps[k - 1]
    return np.asarray(steps.T)


NOISES: dict[str, Noise] = {
    "white": Noise(),
    "autocorrelated": Noise(correlated=3e-4),
    "of the run": Noise(of_run=5e-4),
    "harmonic": Noise(harmonic=5e-4),
    "quantised": Noise(step=5e-4),
    "eccentricity": Noise(eccentricity=1e-3),
}
"""White 0.1 um alone, and with: AR(1) 0.9 of 0.3 um; an offset and orders 2 and 3 of 0.5 um, drawn per run; orders 1 to 5 of
0.5 um whose amplitude and phase are drawn per run; a step of 0.5 um; a centre that wanders by 1 um from run to run."""
