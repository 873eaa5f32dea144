"""Records of a feed drive with dwells, made by hand: trapezoidal moves, rests between them, an imperfect encoder."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.drive import DriveRecord, DriveTest, differentiate, smoothed, standing, window_of

TRUTH = {"inertia": 0.002, "viscous": 0.02, "coulomb": 3.0, "constant": 0.4}
"""In A and mm, s."""

LONGEST = 30.0
"""Cut-off of the differentiator [Hz], as where none is stated at 500 Hz."""


@dataclass(frozen=True)
class Dwells:
    """Which records a test has.

    Attributes
    ----------
    runs : int
    noise : float [mm]
        White, of the encoder.
    step : float [mm]
        Of the encoder; 1e-6 for a log of six digits.
    held : bool
        Whether the drive holds any part of its friction at rest, or nothing.
    one_way : bool
    rest : float [s]
        Between two moves; 0 for a record without dwells.
    current : float [A]
        White noise of the current.
    scatter : float
        Relative standard deviation of the friction from run to run.
    """

    runs: int = 4
    noise: float = 0.0
    step: float = 1e-6
    held: bool = True
    one_way: bool = False
    rest: float = 0.5
    current: float = 0.1
    scatter: float = 0.0

    def test(self, seed: tuple[int, ...], **settings: object) -> DriveTest:
        """A test of these records; `settings` are those of `DriveTest`."""
        random = np.random.default_rng(seed)
        records = tuple(self._record(f"run {k}", random) for k in range(self.runs))
        return DriveTest("dwells", records, **settings)

    def _record(self, run: str, random: np.random.Generator, sample: float = 0.002) -> DriveRecord:
        """Eight moves of 40 mm at 5 to 100 mm/s, 500 mm/s^2."""
        rest = np.zeros(max(int(self.rest / sample), 2))
        parts = [rest]
        for k, speed in enumerate(random.uniform(5, 100, 8)):
            steps = int(speed / 500 / sample)
            ramp = speed * np.arange(1, steps + 1) / steps
            even = np.full(int((40 / speed - speed / 500) / sample), speed)
            sign = 1.0 if self.one_way or k % 2 == 0 else -1.0
            parts += [sign * np.concatenate([ramp, even, ramp[::-1]]), rest]
        v = np.concatenate(parts)
        time = sample * np.arange(len(v))
        x = np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * sample)])
        rests = np.cumsum(np.diff(np.concatenate([[0], (v == 0).astype(int)])) == 1)
        hold = random.uniform(-1, 1, rests.max() + 1)[rests] if self.held else np.zeros(len(v))
        friction = TRUTH["coulomb"] * (1 + self.scatter * random.standard_normal()) * np.where(v == 0, hold, np.sign(v))
        effort = TRUTH["inertia"] * np.gradient(v, sample) + TRUTH["viscous"] * v + friction + TRUTH["constant"]
        effort += self.current * random.standard_normal(len(v))
        seen = np.round((x + self.noise * random.standard_normal(len(v))) / self.step) * self.step
        made, smooth = differentiate(time, seen, LONGEST), smoothed(time, effort, LONGEST)
        still = standing(time, seen, made.velocity, window_of(sample, LONGEST))
        keep = ~made.edge
        columns = (time, made.position, made.velocity, made.acceleration, smooth)
        return DriveRecord(run, "X", *(column[keep] for column in columns), cutoff=LONGEST, standing=still[keep])
