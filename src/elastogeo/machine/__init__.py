"""What a machine is: topology, axes, frames, poses to Jacobian columns, batched. Stands on `errors` alone."""

from elastogeo.machine.commands import Commands, Motion, follow, workpiece_ball
from elastogeo.machine.frames import (
    Array,
    Frame,
    JointFrames,
    LoopFrames,
    Site,
    check_commands,
    loop_frames,
    rotation_matrix,
    steady,
)
from elastogeo.machine.jacobian import COMPONENTS, carried_to, jacobian
from elastogeo.machine.machine import Joint, Machine, Vector
from elastogeo.machine.topology import AXIS_ORDER, LINEAR, ROTARY, SPINDLE, Topology, parse_topology

__all__ = [
    "AXIS_ORDER",
    "COMPONENTS",
    "LINEAR",
    "ROTARY",
    "SPINDLE",
    "Array",
    "Commands",
    "Frame",
    "Joint",
    "JointFrames",
    "LoopFrames",
    "Machine",
    "Motion",
    "Site",
    "Topology",
    "Vector",
    "carried_to",
    "check_commands",
    "follow",
    "jacobian",
    "loop_frames",
    "parse_topology",
    "rotation_matrix",
    "steady",
    "workpiece_ball",
]
