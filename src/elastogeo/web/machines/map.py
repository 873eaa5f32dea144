"""The map of a machine's workspace: how stiff it is in a direction, section by section."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Form, Query

from elastogeo.changes import KeptJob
from elastogeo.errors import InputError
from elastogeo.report import view_of
from elastogeo.web.answering import Done, Shown
from elastogeo.web.asking import ENGINEER, Ask
from elastogeo.web.pages import Pages

pages = Pages()
PAGE, PART = "machines/map.html.j2", "machines/map_part.html.j2"
Basis = Annotated[str, Query(max_length=40)]
"""`campaign:3` or `test:17`: what the map rests on; empty: the last map, or the first basis."""


@pages.shows("/machines/{key:int}/map", fresh=True)
def workspace_map(
    asked: Ask,
    key: int,
    basis: Basis = "",
    plane: Annotated[str, Query(max_length=2)] = "",
    height: Annotated[int | None, Query(ge=0, le=9999)] = None,
    azimuth: Annotated[float, Query(ge=-360, le=360)] = 0.0,
    elevation: Annotated[float, Query(ge=-90, le=90)] = 0.0,
    assumed: bool = False,
) -> Shown:
    """A section through the workspace: stiffness in a direction in colour, softest and stiffest place in words.

    `basis` names the campaign or test it rests on, `plane` two axes, `height` the place of the third one, `azimuth` and
    `elevation` the direction in degrees, `assumed` adds what rests on joints that were never tested and count as rigid.
    """
    found = asked.machine(key)
    kind, number = _basis(basis)
    job = asked.history.map_job(key, kind, number)
    chosen = {"basis": basis, "azimuth": azimuth, "elevation": elevation, "assumed": assumed}
    context: dict[str, Any] = {
        "key": key,
        "machine": found,
        "bases": asked.history.map_bases(key),
        "job": job,
        "basis": basis or _said(job),
        "chosen": chosen,
        "section": None,
        "planes": (),
        "made": None,
    }
    if job is None or job.state != "done":
        return Shown(PAGE, document={"map": None, "job": None if job is None else job.key}, rows=(), context=context)
    section = asked.history.map_section(job, plane, height, azimuth, elevation, assumed)
    wide = [axis for axis, one in zip(section.map.axes, section.map.along, strict=True) if len(one) > 1]
    planes = [f"{a}{b}" for n, a in enumerate(wide) for b in wide[n + 1 :]]
    context |= {"section": section, "planes": planes, "made": job.result["basis"] if job.result else None}
    return Shown(PAGE, view_of(section), part=PART, context=context)


@pages.acts("/machines/{key:int}/map", role=ENGINEER)
def make_map(asked: Ask, key: int, basis: Annotated[str, Form(max_length=40)] = "") -> Done:
    """Ask for the map of a machine, from the tests that are chosen."""
    asked.machine(key)
    number = asked.history.put_map(key, *_basis(basis))
    return Done(f"/machines/{key}/map{f'?basis={basis}' if basis else ''}", "The map is being made.", {"job": number})


def _basis(said: str) -> tuple[str, int]:
    """What a map is to rest on, by kind and key."""
    kind, _, number = said.partition(":")
    if not said:
        return "", 0
    if kind not in ("campaign", "test") or not (number.isdecimal() and number.isascii() and len(number) < 16):
        raise InputError("a map rests on a campaign or a test of the machine; choose one that is listed")
    return kind, int(number)


def _said(job: KeptJob | None) -> str:
    made = None if job is None else (job.result or {}).get("basis")
    return "" if made is None else f"{made['kind']}:{made['key']}"
