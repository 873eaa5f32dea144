"""The readings of one test, run by run, beside what its kept parameters predict: to look into it."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.machine import Array
from elastogeo.result import Part, Result

NO_READINGS = "no readings"
NOT_EXPLAINED = "not explained"
"""Why there is nothing to look into, or no model beside the readings."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ExploredRun(Part):
    """One run.

    Attributes
    ----------
    run : str
    force : float [N]
    sense : int
        +1 and -1 of a circle, counter-clockwise and clockwise; 0 of what is none.
    pose : array, shape (m,) [rad, mm or as the instrument counts]
    measured : array, shape (m,) [mm or rad]
        Less the reference if one is subtracted, and less the run's own set-up.
    predicted : array, shape (m,) [mm or rad], or None
        By the kept parameters; None where there are none.
    angular : bool
        Whether its readings are angles.
    readings : int
        Of the run, of which m are here.
    """

    run: str
    force: float
    sense: int
    pose: Array
    measured: Array
    predicted: Array | None
    angular: bool
    readings: int


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Explored(Result):
    """One test of a history, with its readings.

    Attributes
    ----------
    key : int
    name, machine, recipe : str
    date : float [d]
    origin, from_what : str
    quantity, unit : str
        What the readings count along, and its unit in the run files: `angle`, `deg`.
    runs : tuple of ExploredRun
    refusal : str
        NO_READINGS, or NOT_EXPLAINED if nothing is predicted; empty if all is there.
    """

    key: int
    name: str
    machine: str
    recipe: str
    date: float
    origin: str
    from_what: str
    quantity: str
    unit: str
    runs: tuple[ExploredRun, ...]
    refusal: str = ""

    @property
    def readings(self) -> int:
        """Of all runs."""
        return sum(run.readings for run in self.runs)

    @property
    def shown(self) -> int:
        """How many of them are here."""
        return sum(len(run.measured) for run in self.runs)
