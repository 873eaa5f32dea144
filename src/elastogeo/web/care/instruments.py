"""Instruments: their calibrations, those that run out first, and what was tested with them."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form

from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask, or_not_found
from elastogeo.web.pages import Pages

pages = Pages()

Name = Annotated[str, Form(max_length=80)]
Day = Annotated[str, Form(max_length=20)]


@pages.shows("/instruments")
def instruments(asked: Ask) -> Shown:
    """All instruments, those whose calibration has run out first."""
    return Shown("care/instruments.html.j2", view_of(asked.history.instruments()))


@pages.shows("/instruments/{key:int}")
def instrument(asked: Ask, key: int) -> Shown:
    """One instrument: its calibrations, its alarms, what was tested with it."""
    with or_not_found("There is no such instrument."):
        found = asked.history.instrument(key)
    return Shown("care/instrument.html.j2", view_of(found), context={"key": key, "alarm": found.instrument.alarm})


@pages.acts("/instruments", role=ENGINEER)
def add_instrument(
    asked: Ask, serial: Name, kind: Name = "", calibrated: Day = "", due: Day = "", certificate: Name = ""
) -> Done:
    """Add an instrument, with a calibration of it if a day is given."""
    known = asked.history.add_instrument(serial, kind=kind, calibrated=calibrated, due=due, certificate=certificate)
    return Done(f"/instruments/{known.key}", f"Instrument {known.serial} is kept.")


@pages.acts("/instruments/{key:int}/calibrations", role=ENGINEER)
def calibrate(asked: Ask, key: int, calibrated: Day, due: Day = "", certificate: Name = "") -> Done:
    """Note a calibration."""
    if not calibrated:
        raise InputError("a calibration has a day; give it")
    with or_not_found("There is no such instrument."):
        serial = asked.history.instrument(key).instrument.serial
    asked.history.add_instrument(serial, calibrated=calibrated, due=due, certificate=certificate)
    return Done(f"/instruments/{key}", f"The calibration of {serial} is kept.")
