"""Error motions E_djn of ISO 230-1 as polynomials: component d at joint j, growing with its command to the power n (5.16).

`E_XX1` is the linear positioning gain of X, `E_YX2` its quadratic straightness in y.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from elastogeo.machine import COMPONENTS, Array, Joint, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source, twist_unit

LISTED_DEGREES = (1, 2, 3)


@dataclass(frozen=True, slots=True)
class CommandPower:
    """Driver: the joint's command to the power n."""

    axis: str
    degree: int

    def __call__(self, situation: Situation) -> Array:
        """Values [mm^n or rad^n] at every reading, shape (m,)."""
        return situation.command(self.axis) ** self.degree


@family
def error_motions(machine: Machine) -> Iterator[Source]:
    """Six error motions of each moving axis (not the spindle), of degrees 1 to 3."""
    for joint in machine.joints:
        if joint.name != "S":
            yield from (_error_motion(joint, d, n) for d in range(6) for n in LISTED_DEGREES)


def _error_motion(joint: Joint, d: int, degree: int) -> Source:
    of = "rad" if joint.is_rotary else "mm"
    over = of if degree == 1 else f"{of}^{degree}"
    component = COMPONENTS[d]
    kind = _kind(joint, d)
    return Source(
        name=f"E_{component}{joint.name}{degree}",
        unit=f"{twist_unit(d)}/{over}",
        site=("motion", joint.name),
        component=d,
        driver=CommandPower(joint.name, degree),
        meaning=f"{kind} of {joint.name}, degree {degree}",
    )


def _kind(joint: Joint, d: int) -> str:
    along = joint.direction + (3 if joint.is_rotary else 0)
    letter = COMPONENTS[d]
    if d == along:
        return "positioning error"
    if joint.is_rotary:
        return f"{'tilt' if d >= 3 else 'radial or axial'} error motion ({letter})"
    return f"angular error motion ({letter})" if d >= 3 else f"straightness in {letter.lower()}"
