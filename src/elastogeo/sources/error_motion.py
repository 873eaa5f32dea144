"""Error motions E_djn of ISO 230-1 as polynomials: component d at joint j, growing with its command to the power n.

`E_XX1` is the linear positioning gain of X, `E_YX2` its quadratic straightness in y (5.16). Commands count from the centre
of the test, which keeps the powers apart. Of rotary axes there are harmonics too: `E_XCc1` and `E_XCs1` go with the cosine
and the sine of one turn of C.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import COMPONENTS, SPINDLE, Array, Joint, Machine
from elastogeo.sources.families import family, named
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Sign, Source, twist_unit

LISTED_DEGREES = (1, 2, 3)
LISTED_ORDERS = (1, 2)
_NAME = re.compile(r"E_([XYZABC])([XYZUVWABC])(c|s|)([1-9]\d?)")


@dataclass(frozen=True, slots=True)
class CommandPower:
    """Driver: the joint's command, from the centre of the test, to the power n."""

    axis: str
    degree: int

    def __call__(self, situation: Situation) -> Array:
        """Values [mm^n or rad^n] at every reading, shape (m,)."""
        return situation.from_centre(self.axis) ** self.degree


@dataclass(frozen=True, slots=True)
class CommandHarmonic:
    """Driver: cosine or sine of a multiple of a rotary joint's command."""

    axis: str
    order: int
    part: str

    def __call__(self, situation: Situation) -> Array:
        """Values at every reading, shape (m,)."""
        phase = self.order * situation.command(self.axis)
        return np.asarray(np.cos(phase) if self.part == "c" else np.sin(phase))


@family
def error_motions(machine: Machine) -> Iterator[Source]:
    """Six error motions of each axis but the spindle: degrees 1 to 3, and for rotary axes orders 1 and 2."""
    for joint in machine.joints:
        if joint.name == SPINDLE:
            continue
        for d in range(6):
            yield from (_polynomial(machine, joint, d, n) for n in LISTED_DEGREES)
            if joint.is_rotary:
                yield from (_harmonic(joint, d, n, part) for n in LISTED_ORDERS for part in "cs")


@named
def error_motion(machine: Machine, name: str) -> Source | None:
    """An error motion of any degree or order, by its name."""
    match = _NAME.fullmatch(name)
    if not match or match[2] not in machine.axes:
        return None
    joint, d, n = machine.joints[machine.index(match[2])], COMPONENTS.index(match[1]), int(match[4])
    if not match[3]:
        return _polynomial(machine, joint, d, n)
    return _harmonic(joint, d, n, match[3]) if joint.is_rotary else None


def _polynomial(machine: Machine, joint: Joint, d: int, degree: int) -> Source:
    of = "rad" if joint.is_rotary else "mm"
    return Source(
        name=f"E_{COMPONENTS[d]}{joint.name}{degree}",
        unit=f"{twist_unit(d)}/{of if degree == 1 else f'{of}^{degree}'}",
        site=("motion", joint.name),
        component=d,
        driver=CommandPower(joint.name, degree),
        meaning=f"{kind_of_motion(joint, d)} of {joint.name}, degree {degree}",
        sign=_sign(machine, joint, d, degree),
    )


def _sign(machine: Machine, joint: Joint, d: int, degree: int) -> Sign | None:
    """An error motion is that of the carriage: where it carries the workpiece, the tool is off the other way."""
    factor = 1.0 if machine.in_tool_branch(joint.name) else -1.0
    if degree == 1 and d == joint.direction + 3 * joint.is_rotary:
        return Sign("gain", joint.name, factor=factor)
    if degree == 2 and d < 3 and not joint.is_rotary and d != joint.direction:
        return Sign("bow", joint.name, COMPONENTS[d], factor)
    return None


def _harmonic(joint: Joint, d: int, order: int, part: str) -> Source:
    return Source(
        name=f"E_{COMPONENTS[d]}{joint.name}{part}{order}",
        unit=twist_unit(d),
        site=("motion", joint.name),
        component=d,
        driver=CommandHarmonic(joint.name, order, part),
        meaning=f"{kind_of_motion(joint, d)} of {joint.name}, {'cosine' if part == 'c' else 'sine'} of order {order}",
    )


def kind_of_motion(joint: Joint, d: int) -> str:
    """What component d of an error motion of a joint is called (ISO 230-1)."""
    along = joint.direction + (3 if joint.is_rotary else 0)
    letter = COMPONENTS[d]
    if d == along:
        return "positioning error"
    if joint.is_rotary:
        return f"tilt error motion ({letter})" if d >= 3 else f"radial or axial error motion ({letter})"
    return f"angular error motion ({letter})" if d >= 3 else f"straightness in {letter.lower()}"
