"""A test that could be made: planned runs without readings, what it takes, how long."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.equality import ByValue
from elastogeo.observe import MachineTest, Setup


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Candidate(ByValue):
    """A test that could be made.

    Attributes
    ----------
    name : str
        Short, without blanks; unique among candidates that are chosen from together.
    test : MachineTest
        Planned: its runs say poses and forces, their readings are zero. What they tell comes from the instrument's own
        `observe`.
    minutes : float
        To set it up and to run it.
    """

    name: str
    test: MachineTest
    minutes: float

    def __repr__(self) -> str:
        return f"<Candidate {self.name!r}: {self.test.instrument}, {self.minutes:.0f} min>"

    @property
    def setup(self) -> Setup:
        """Of its instrument."""
        return self.test.setup
