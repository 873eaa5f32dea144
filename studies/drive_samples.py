"""What the studies of feed drives draw, and how they judge it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from elastogeo.drive import TorqueModel
from elastogeo.identification.feed_drives import identify_drives
from studies.dwells import Dwells
from studies.sines import Sines

MISSED, HELD, FOUND, OTHER, NOT_FOUND = "missed", "held", "found", "other", "not found"


@dataclass(frozen=True)
class Identified:
    """A simulated test of one axis, identified.

    Attributes
    ----------
    records : Dwells or Sines
    compare : bool
        Whether models are compared.
    least_speed : float or None [mm/s]
    held_out : tuple of str
    """

    records: Dwells | Sines
    compare: bool = False
    least_speed: float | None = None
    held_out: tuple[str, ...] = ()

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of the axis."""
        model = TorqueModel(least_speed=self.least_speed)
        test = self.records.test(seed, model=model, compare=self.compare, held_out=self.held_out)
        return identify_drives(test).axes[0]


@dataclass(frozen=True)
class Misses:
    """Judge: whether the 95 % interval of a parameter misses its truth."""

    parameter: str
    truth: float

    def __call__(self, found: Any) -> str:
        for parameter in found.parameters:
            if parameter.name == self.parameter and len(parameter.stands_for) == 1:
                low, high = parameter.estimate.interval()
                return HELD if low <= self.truth <= high else MISSED
        return NOT_FOUND


@dataclass(frozen=True)
class Supports:
    """Judge: which model the runs support."""

    wanted: tuple[str, ...]

    def __call__(self, found: Any) -> str:
        return NOT_FOUND if not found.supported else FOUND if found.supported in self.wanted else OTHER
