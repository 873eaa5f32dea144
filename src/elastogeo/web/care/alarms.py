"""Alarms: what waits for somebody, and what a person does about it."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form

from elastogeo.changes.alarms import ACKNOWLEDGED, FALSE, HELD, OPEN, REPAIRED
from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask, or_not_found
from elastogeo.web.fields import Why
from elastogeo.web.pages import Pages

pages = Pages()
CLOSED_FOR = 90.0
"""Days for which a closed alarm is shown."""
STATES = (OPEN, ACKNOWLEDGED, HELD, REPAIRED, FALSE)


@pages.shows("/alarms")
def alarms(asked: Ask, state: str = "", hall: str = "") -> Shown:
    """All alarms that nobody has closed, those that were closed lately, and what else waits."""
    every = asked.history.alarms(CLOSED_FOR)
    shown = every.only(state, hall)
    rows = {row.number: row for row in (*shown.alarms, *shown.closed)}
    context = {"rows": rows, "states": STATES, "halls": every.places, "state": state, "hall": hall}
    return Shown("care/alarms.html.j2", view_of(shown), context=context)


@pages.shows("/alarms/{key:int}")
def alarm(asked: Ask, key: int) -> Shown:
    """One alarm: how it stands, what happened to it, who was told."""
    with or_not_found("There is no such alarm."):
        found = asked.history.alarm(key)
    return Shown("care/alarm.html.j2", view_of(found), context={"row": found.row, "is_open": found.is_open})


@pages.acts("/alarms/{key:int}/acknowledge", role=ENGINEER)
def acknowledge(asked: Ask, key: int, why: Why) -> Done:
    """Say that somebody knows of an alarm, and what is done."""
    done = asked.history.acknowledge(key, why)
    return Done(f"/alarms/{key}", view_of(done).sentence, view_of(done).document)


@pages.acts("/alarms/{key:int}/close", role=ENGINEER)
def close(asked: Ask, key: int, as_what: Annotated[str, Form(max_length=20)], why: Why) -> Done:
    """End an alarm: as `repaired`, so that a new baseline follows, or as `false`, so that the old one stays."""
    if as_what not in ("repaired", "false"):
        raise InputError("say whether the alarm is closed as repaired or as false")
    done = asked.history.close_alarm(key, repaired=as_what == "repaired", why=why)
    return Done(f"/alarms/{key}", view_of(done).sentence, view_of(done).document)


@pages.acts("/machines/{key:int}/silence", role=ENGINEER)
def silence(asked: Ask, key: int, until: Annotated[str, Form(max_length=40)], why: Why) -> Done:
    """Send nothing of a machine until the end of a day, or send again: `now`."""
    name = asked.machine(key).name
    asked.history.silence_until(name, until, why)
    said = "Messages of this machine are sent again." if until == "now" else "Nothing is sent of this machine until then."
    return Done("/alarms", f"{name}: {said}")
