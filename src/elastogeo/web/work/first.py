"""The first run: three ways to a result, and the first machine."""

from __future__ import annotations

from typing import Annotated

from fastapi import Form

from elastogeo.errors import InputError
from elastogeo.formats import shipped_machines
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask
from elastogeo.web.pages import Pages

pages = Pages()


@pages.shows("/first")
def first(asked: Ask) -> Shown:
    """Where one begins: a simulated fleet to look at, a test of one's own, a machine."""
    count = len(asked.history.machines())
    context = {"count": count, "kinds": tuple(shipped_machines())}
    return Shown("work/first.html.j2", document={"schema": "elastogeo.first/1", "machines": count}, context=context)


@pages.acts("/first/demo", role=ENGINEER)
def demo(asked: Ask) -> Done:
    """Fill a history that has no machines with the simulated fleet."""
    job = asked.history.put_demo()
    return Done(f"/jobs/{job}", document={"job": job})


@pages.acts("/machines", role=ENGINEER)
def add_machine(
    asked: Ask,
    name: Annotated[str, Form(max_length=100)],
    kind: Annotated[str, Form(max_length=100)] = "",
    serial: Annotated[str, Form(max_length=100)] = "",
    place: Annotated[str, Form(max_length=100)] = "",
) -> Done:
    """Add a machine: this very one, by the name that people call it."""
    if any(one.name == name.strip() for one in asked.history.machines()):
        raise InputError(f"there is a machine {name.strip()!r} already; give this one another name")
    found = asked.history.add_machine(name, kind=kind, serial=serial, place=place)
    return Done(f"/machines/{found.key}", f"{found.name} was added.", {"machine": found.key})
