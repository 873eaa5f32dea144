"""Lengths at another temperature than 20 °C (ISO 1): how far a body is longer there, and what that is uncertain by."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import COLDEST, WARMEST, Array, PerLength, Temperature
from elastogeo.observe.observations import ObservedInfluence

REFERENCE = 20.0
"""Temperature [degC] at which lengths are stated."""

MOST_EXPANSION = 1e-4
"""Expansion per kelvin that a machine or a sensor may have: twice that of plastics."""


@dataclass(frozen=True, slots=True)
class Expansion:
    """How warm a body was, and how much it expands.

    Attributes
    ----------
    temperature : float [degC]
    expansion : float [mm/mm]
        For each kelvin: 11.5 um/m of steel, 8 of glass, 0 of a laser that knows its air.
    temperature_uncertainty : float [degC]
        Standard uncertainty of the temperature.
    expansion_uncertainty : float [mm/mm]
        Standard uncertainty of the expansion for each kelvin.
    """

    temperature: Temperature
    expansion: PerLength
    temperature_uncertainty: Temperature = 0.0
    expansion_uncertainty: PerLength = 0.0

    def __post_init__(self) -> None:
        """Refuse what no machine has: kelvin for degrees, an expansion in another unit, a negative uncertainty."""
        if not COLDEST <= self.temperature <= WARMEST:
            raise InputError(
                f"the temperature is {self.temperature:g} degC; machines are tested between {COLDEST:g} and {WARMEST:g}: is "
                f"it in kelvin?"
            )
        if not 0 <= self.expansion <= MOST_EXPANSION:
            raise InputError(
                f"the expansion is {self.expansion:g} for each kelvin; steel has 11.5e-6: write expansion_um_per_m = 11.5"
            )
        if self.temperature_uncertainty < 0 or self.expansion_uncertainty < 0:
            raise InputError("the uncertainties of temperature and expansion are standard deviations; give none below zero")

    def at(self, temperature: float | None) -> Expansion:
        """The same body at another temperature [degC]; at its own where None is given."""
        return self if temperature is None else replace(self, temperature=temperature)

    @property
    def stretch(self) -> float:
        """By how much the body is longer than at 20 °C, relative to its length."""
        return self.expansion * (self.temperature - REFERENCE)

    def influences(self, body: str, length: Array) -> Iterator[ObservedInfluence]:
        """What is uncertain in readings from which `stretch` times a length, shape (m,) [mm], was subtracted.

        Parameters
        ----------
        body : str
            What it is the temperature of, for the labels.
        length : array, shape (m,) [mm]
            With its sign in the reading.
        """
        none = np.zeros((len(length), 6))
        sizes = (
            (f"temperature of the {body}", self.temperature_uncertainty, self.expansion),
            (f"expansion of the {body}", self.expansion_uncertainty, self.temperature - REFERENCE),
        )
        for label, uncertainty, per_length in sizes:
            if uncertainty:
                yield ObservedInfluence(label, uncertainty, np.inf, none, -per_length * length)
