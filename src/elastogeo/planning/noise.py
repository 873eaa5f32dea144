"""How well a planned test is read: the noise of a reading, what wanders from run to run."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from elastogeo.errors import InputError
from elastogeo.machine import Angle, Length


@dataclass(frozen=True, slots=True)
class ReadingNoise:
    """What a planned test is read with.

    Attributes
    ----------
    reading : float [mm]
        Standard deviation of a reading of a length.
    angle : float [rad]
        Of a reading of an angle.
    set_up : float [mm]
        Standard deviation, from run to run, of each coordinate of the centre, and of the length of a bar or a sensor's zero.
    force : float
        Relative standard deviation of the force from run to run. **Not its calibration:** what is wrong in all runs alike no
        plan removes; it comes on top, in proportion to the compliance.
    """

    reading: Length = 1e-4
    angle: Angle = 1e-6
    set_up: Length = 2e-4
    force: float = 0.01

    def __post_init__(self) -> None:
        """Refuse noise that is none."""
        if not (0 < self.reading < inf and 0 < self.angle < inf):
            raise InputError(f"the noise of a reading is {self.reading:g} mm, {self.angle:g} rad; both must be positive")
        if not (0 <= self.set_up < inf and 0 <= self.force < 1):
            raise InputError(
                f"the set-up wanders by {self.set_up:g} mm and the force by {self.force:g} of itself; neither is negative, "
                f"and the force's is a share below 1: 0.01 is 1 %"
            )
