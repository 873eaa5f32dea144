"""What a machine is called, its model, its serial number, where it stands."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form

from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask
from elastogeo.web.fields import Why
from elastogeo.web.pages import Pages

pages = Pages()

Text = Annotated[str, Form(max_length=80)]


@pages.shows("/machines/{key:int}/edit", role=ENGINEER)
def edit_machine(asked: Ask, key: int) -> Shown:
    """The form of a machine that is there."""
    found = asked.machine(key)
    view = view_of(asked.history.machine(found.name))
    return Shown("care/machine.html.j2", view, context={"machine": found})


@pages.acts("/machines/{key:int}/edit", role=ENGINEER)
def change_machine(
    asked: Ask,
    key: int,
    name: Text,
    kind: Text = "",
    serial: Text = "",
    place: Text = "",
    why: Why = "",
) -> Done:
    """Say anew what a machine is called, its model, serial number and place."""
    asked.machine(key)
    known = asked.history.change_machine(key, name=name, kind=kind, serial=serial, place=place, why=why)
    return Done(f"/machines/{key}", f"{known.name} is kept so.")
