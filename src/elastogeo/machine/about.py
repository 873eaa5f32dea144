"""Who made a test, when, with what: for the head of its report."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class About:
    """What is known of a test besides its numbers; every entry may be empty.

    Attributes
    ----------
    date : str
        `2026-03-01`, or with the time of day.
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
    """

    date: str = ""
    operator: str = ""
    place: str = ""
    machine_serial: str = ""
    instrument: str = ""
    instrument_serial: str = ""
    instrument_calibrated: str = ""
    remarks: str = ""
