"""What a new test with a sphere nest begins with: motions of the machine's own rotary axes, and errors to simulate."""

from __future__ import annotations

from dataclasses import replace
from math import degrees, pi

from elastogeo.errors import InputError
from elastogeo.machine import SPINDLE, Joint, Machine
from elastogeo.observe.template import Template

_SETUP = """\
[setup]
sensors = [[1, 0, 1], [-0.5, 0.866, 1], [-0.5, -0.866, 1]]   # in which the ball moves where each reads positive
nest = "@NEST@"              # the end that carries the nest (the other carries the ball): workpiece or tool
known = ["@KNOWN@"]         # ends whose point is known: the ball's centre, or the place of the nest and its zeros
centre = { X_mm = 150, Y_mm = 80 }   # where the tool point meets the workpiece point, rotary axes at zero

# Motions of runs that do not record the rotary axes; the linear axes follow.
@MOTIONS@"""

_SIMULATION = """\
readings = @READINGS@                   # 36 of each motion

[imperfection]
noise_um = 0.3
resolution_um = 0.1

[values]                         # true parameters, in mm, N, rad
@LOCATIONS@E_X@FREE@0 = 0.02
E_Y@FREE@0 = -0.03
E_Z@FREE@0 = 0.01
"""

_INFLUENCES = """\
[[influences]]
kind = "sensor-scale"
label = "calibration of the sensors"
relative = 0.002

[[influences]]
kind = "@KNOWN@-offset"          # of the end that is known, in each direction
label = "point of the end that is known"
length_um = 1

"""

TEMPLATE = Template(
    title="Sphere nest about rotary axes",
    setup=_SETUP,
    columns="a_deg, c_deg (commands of the rotary axes), displacement_1_um, displacement_2_um, displacement_3_um",
    simulation=_SIMULATION,
    level="",
    repeats=4,
    influences=_INFLUENCES,
)

SWING = pi / 3
"""How far an axis that does not turn all the way is to swing to either side [rad], if its travel lets it."""

_ACROSS = {"A": "YZBC", "B": "XZAC", "C": "XYAB"}
_POSITIONS = (0.012, -0.008, 0.015, -0.01)
_ORIENTATIONS = (3e-5, -2e-5, 2e-5, 4e-5)
"""Errors to simulate [mm, rad], one after the other."""


def template_for(machine: Machine) -> Template:
    """The template with the motions and the location errors of a machine's own rotary axes.

    Raises
    ------
    InputError
        If it has none.
    """
    rotary = [joint for joint in machine.joints if joint.is_rotary and joint.name != SPINDLE]
    if not rotary:
        raise InputError(
            f"machine {machine.name!r} ({machine.topology.compact}) has no rotary axis that a sphere nest could look at"
        )
    # an end that no rotary axis carries is the one that must be known
    on_tool = all(machine.in_tool_branch(joint.name) for joint in rotary)
    known, free = ("workpiece", "t") if on_tool else ("tool", "w")
    moves = [[joint] for joint in rotary] + ([rotary] if len(rotary) > 1 else [])
    said = {
        "@NEST@": "tool" if on_tool else "workpiece",
        "@KNOWN@": known,
        "@FREE@": free,
        "@MOTIONS@": "".join(_motion(joints) for joints in moves),
        "@READINGS@": str(36 * len(moves)),
        "@LOCATIONS@": _locations(machine),
    }
    texts = {field: getattr(TEMPLATE, field) for field in ("setup", "simulation", "influences")}
    for mark, text in said.items():
        texts = {field: before.replace(mark, text) for field, before in texts.items()}
    return replace(TEMPLATE, **texts)


def _motion(joints: list[Joint]) -> str:
    ends = {joint.name: _ends(joint) for joint in joints}
    start, end = (", ".join(f"{axis}_deg = {degrees(at[k]):g}" for axis, at in ends.items()) for k in (0, 1))
    name = " and ".join(ends)
    return f'\n[[setup.motions]]\nname = "{name}"\nstart = {{ {start} }}\nend = {{ {end} }}\n'


def _ends(joint: Joint) -> tuple[float, float]:
    low, high = joint.travel
    return (0.0, 2 * pi) if low <= 0 and high >= 2 * pi else (max(low, -SWING), min(high, SWING))


def _locations(machine: Machine) -> str:
    """The location errors of the rotary axes across themselves, by name, one a line."""
    positions, orientations = iter(_POSITIONS * 2), iter(_ORIENTATIONS * 2)
    lines = []
    for branch in (machine.topology.workpiece[::-1], machine.topology.tool):
        for before, axis in zip(("", *branch), branch, strict=False):
            for letter in _ACROSS.get(axis, ""):
                value = next(positions if letter in "XYZ" else orientations)
                lines.append(f'"E_{letter}(0{before}){axis}" = {value:g}\n')
    return "".join(lines)
