"""`elastogeo.machine/1`: what a machine is.

name, topology, topology_iso, tool_mm, assumed : `assumed` says in words what was not measured
axes : [{name, offset_mm, tilt_rad, travel, travel_unit, compliant}], from the workpiece to the tool
places : [{name, on, offset_mm, carries_workpiece}], what gives way beside the joints
"""

from __future__ import annotations

from typing import Any

from elastogeo.machine import Machine
from elastogeo.report.document import document

MACHINE_SCHEMA = "elastogeo.machine/1"


def machine_json(machine: Machine) -> dict[str, Any]:
    """A machine as one JSON object (`elastogeo.machine/1`)."""
    return document(
        MACHINE_SCHEMA,
        {
            "name": machine.name,
            "topology": machine.topology.compact,
            "topology_iso": machine.topology.iso,
            "tool_mm": machine.tool,
            "assumed": machine.assumed,
            "axes": [
                {
                    "name": joint.name,
                    "offset_mm": joint.offset,
                    "tilt_rad": joint.tilt,
                    "travel": joint.travel,
                    "travel_unit": "rad" if joint.is_rotary else "mm",
                    "compliant": joint.compliant,
                }
                for joint in machine.joints
            ],
            "places": [
                {
                    "name": place.name,
                    "on": place.on,
                    "offset_mm": place.offset,
                    "carries_workpiece": place.carries_workpiece,
                }
                for place in machine.places
            ],
        },
    )
