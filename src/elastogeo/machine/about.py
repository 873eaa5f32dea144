"""Who made a test, when, with what: for the head of its report, and for the history of the machine."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from elastogeo.errors import InputError
from elastogeo.machine.quantity import Temperature

COLDEST, WARMEST = 0.0, 60.0
"""Temperatures [degC] between which machines are tested."""


@dataclass(frozen=True, slots=True)
class About:
    """What is known of a test besides its numbers; every entry may be empty.

    Attributes
    ----------
    date : str
        `2026-03-01`, or with the time of day and its zone: `2026-03-01T14:30:00+01:00`.
    operator : str
        Who ran the test.
    place : str
        Hall, or position of the machine.
    machine_serial : str
        Serial number of the machine.
    instrument : str
        Make and model of the instrument.
    instrument_serial : str
        Serial number of the instrument.
    instrument_calibrated : str
        Date of its last calibration, or the certificate.
    remarks : str
        What else a reader should know.
    temperature : float or None [degC]
        Of the machine. It corrects nothing: a trend of many tests takes it into account.
    """

    date: str = ""
    operator: str = ""
    place: str = ""
    machine_serial: str = ""
    instrument: str = ""
    instrument_serial: str = ""
    instrument_calibrated: str = ""
    remarks: str = ""
    temperature: Temperature | None = None

    def __post_init__(self) -> None:
        """Refuse kelvin given as degrees Celsius."""
        if self.temperature is not None and not COLDEST <= self.temperature <= WARMEST:
            raise InputError(
                f"the temperature of the machine is {self.temperature:g} degC; machines are tested between {COLDEST:g} and "
                f"{WARMEST:g}: is it in kelvin?"
            )

    def said(self) -> dict[str, Any]:
        """What is known, by name with its unit, as a document has it."""
        known = {name: value for name, value in asdict(self).items() if value not in ("", None)}
        return {"temperature_degC" if name == "temperature" else name: value for name, value in known.items()}
