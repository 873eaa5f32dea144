"""Records of a feed drive that moves along sines, made by hand, with the faults that its verdict is to find."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.drive import DriveRecord, DriveTest

INERTIA, VISCOUS, COULOMB, CONSTANT = 0.01, 0.15, 4.0, 0.5
"""In A and mm, s."""


@dataclass(frozen=True)
class Sines:
    """Which records a test has: four sines of 0.2 to 3 Hz a run, velocity and acceleration as a control gives them.

    Attributes
    ----------
    runs, samples : int
    step : float [s]
    noise : float [A]
        White, of the current.
    correlated : float [A]
        Of an AR(1) with 0.95 besides.
    smooth : float or None [mm/s]
        Over which the friction sets in; None for at once.
    delay : float [s]
        Of the current's channel.
    averaged : float
        Share of the mean of its neighbours that each sample of the recorded motion has lost: what averaging puts back.
    reversed_effort : bool
        Whether the current has the wrong sign.
    digits : int or None
        With which the current is written.
    trembling : float [mm/s]
        White noise of the recorded velocity.
    heavier : float
        By which factor the friction of the last run is greater.
    """

    runs: int = 5
    samples: int = 600
    step: float = 0.005
    noise: float = 0.2
    correlated: float = 0.0
    smooth: float | None = None
    delay: float = 0.0
    averaged: float = 0.0
    reversed_effort: bool = False
    digits: int | None = None
    trembling: float = 0.0
    heavier: float = 1.0

    def test(self, seed: tuple[int, ...], **settings: object) -> DriveTest:
        """A test of these records; `settings` are those of `DriveTest`."""
        random = np.random.default_rng(seed)
        factors = [1.0] * (self.runs - 1) + [self.heavier]
        records = tuple(self._record(f"run {k}", factor, random) for k, factor in enumerate(factors))
        return DriveTest("sines", records, **settings)

    def _record(self, run: str, factor: float, random: np.random.Generator) -> DriveRecord:
        time = self.step * np.arange(self.samples)
        waves = [(random.uniform(0.2, 3.0), random.uniform(0, 2 * np.pi), random.uniform(3, 10)) for _ in range(4)]

        def motion(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            v = sum(size * np.sin(2 * np.pi * f * at + phase) for f, phase, size in waves)
            a = sum(size * 2 * np.pi * f * np.cos(2 * np.pi * f * at + phase) for f, phase, size in waves)
            return np.asarray(v), np.asarray(a)

        v, a = motion(time)
        felt, rate = motion(time - self.delay)
        if self.averaged:
            felt, rate = (_mixed(values, self.averaged) for values in (felt, rate))
        sense = np.sign(felt) if self.smooth is None else np.tanh(felt / self.smooth)
        effort = INERTIA * rate + VISCOUS * felt + factor * COULOMB * sense + CONSTANT
        effort += self.noise * random.standard_normal(self.samples) + self.correlated * _held_on(random, self.samples)
        if self.digits is not None:
            size = 10.0 ** (np.floor(np.log10(np.abs(effort))) + 1 - self.digits)
            effort = np.round(effort / size) * size
        effort = -effort if self.reversed_effort else effort
        seen = v + self.trembling * random.standard_normal(self.samples)
        return DriveRecord(run, "X", time, np.cumsum(v) * self.step, seen, a, effort)


def _mixed(values: np.ndarray, share: float) -> np.ndarray:
    """Values with this share of the mean of their two neighbours."""
    mean = values.copy()
    mean[1:-1] = (values[2:] + values[:-2]) / 2
    return values + share * (mean - values)


def _held_on(random: np.random.Generator, count: int) -> np.ndarray:
    """AR(1) with 0.95, of standard deviation 1."""
    values = random.standard_normal(count)
    for k in range(1, count):
        values[k] = 0.95 * values[k - 1] + np.sqrt(1 - 0.95**2) * values[k]
    return values
