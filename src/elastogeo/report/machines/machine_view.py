"""The view of a machine: its axes from workpiece to tool, and what is assumed of it."""

from __future__ import annotations

from math import degrees

from elastogeo.machine import Machine
from elastogeo.report.machines.document import machine_json
from elastogeo.report.numbers import pretty
from elastogeo.report.view import KeyValue, Section, Table, View, views


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
    document = machine_json(machine)
    return View(
        kind="Machine",
        title=machine.name,
        subtitle=machine.topology.compact,
        origin="",
        head=(("Topology", machine.topology.compact), ("ISO 10791-6", machine.topology.iso)),
        sentence=f"{len(machine.joints)} joints from the workpiece to the tool: {machine.topology.iso}.",
        values=(KeyValue("axes", " ".join(machine.axes)),),
        picture=None,
        checks=(),
        document=document,
        rows=document["axes"],
        tables=(table,),
        notes=assumed,
        sections=(Section("Axes", tables=(table,), points=assumed),),
    )


def _row(machine: Machine, k: int) -> tuple[str, ...]:
    joint = machine.joints[k]
    low, high = (degrees(end) if joint.is_rotary else end for end in joint.travel)
    return (
        joint.name,
        "tool" if machine.in_tool_branch(joint.name) else "workpiece",
        "rotary" if joint.is_rotary else "linear",
        pretty(", ".join(f"{value:g}" for value in joint.offset)),
        pretty(f"{low:.4g} to {high:.4g}") + ("°" if joint.is_rotary else " mm"),
    )
