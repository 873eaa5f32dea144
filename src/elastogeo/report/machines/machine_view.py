"""The view of a machine: its axes from workpiece to tool, and what is assumed of it."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

from elastogeo.machine import Machine
from elastogeo.report.machines.document import machine_json
from elastogeo.report.numbers import pretty
from elastogeo.report.view import KeyValue, Picture, Section, Table, View, views

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@views(Machine)
def machine_view(machine: Machine) -> View:
    """All that is shown of a machine."""
    table = Table(
        ("axis", "branch", "kind", "offset [mm]", "travel"),
        tuple(_row(machine, k) for k in range(len(machine.joints))),
        words=(0, 1, 2, 3, 4),
        title="Axes, from the workpiece to the tool",
    )
    assumed = tuple(f"Assumed: {sentence}" for sentence in machine.assumed)
    places = _places(machine)
    document = machine_json(machine)
    return View(
        kind="Machine",
        title=machine.name,
        subtitle=machine.topology.compact,
        origin="",
        head=(("Topology", machine.topology.compact), ("ISO 10791-6", machine.topology.iso)),
        sentence=f"{len(machine.joints)} joints from the workpiece to the tool: {machine.topology.iso}.",
        values=(KeyValue("axes", " ".join(machine.axes)),),
        picture=Picture(
            "chain",
            "Both branches from the foundation up. Square: a linear axis, round: a rotary one; the arrow is its "
            "direction, beside "
            "it the offset of its carriage from the one before.",
            "The kinematic chain of the machine",
            lambda: _drawn(machine),
        ),
        document=document,
        rows=document["axes"],
        tables=(table, *places),
        notes=assumed,
        sections=(Section("Axes", tables=(table, *places), points=assumed),),
    )


def _places(machine: Machine) -> tuple[Table, ...]:
    """What gives way beside the joints; nothing if the machine declares no place."""
    rows = tuple((p.name, p.on, pretty(", ".join(f"{value:g}" for value in p.offset))) for p in machine.places)
    title = "Places that give way beside the joints"
    return (Table(("place", "on the carriage", "offset [mm]"), rows, words=(0, 1, 2), title=title),) if rows else ()


def _row(machine: Machine, k: int) -> tuple[str, ...]:
    joint = machine.joints[k]
    low, high = (degrees(end) if joint.is_rotary else end for end in joint.travel)
    return (
        joint.name,
        "tool" if machine.in_tool_branch(joint.name) else "workpiece",
        "rotary" if joint.is_rotary else "linear",
        pretty(", ".join(f"{value:g}" for value in joint.offset)),
        pretty(f"{low:.6g} to {high:.6g}") + ("°" if joint.is_rotary else " mm"),
    )


def _drawn(machine: Machine) -> Figure:
    from elastogeo.report.machines.chain import chain_figure

    return chain_figure(machine)
