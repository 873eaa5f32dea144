"""Compliance that changes as its axis travels: a polynomial, or a screw held at one end or at both (thesis 2.6).

`CQ1_XXX` is what C_XXX gains per mm (of a rotary axis per rad) of its own axis from the centre of the test, `CQ2_XXX` per
square. A drive screw of one cross-section gives way along its axis in proportion to its free length: held at one end,
`CE1_XXX` is its compliance with the nut at the far end of the travel (it grows from the least command); held at both,
`CE2_XXX` is that in the middle, and it is none at either end.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import isfinite

import numpy as np

from elastogeo.machine import Array, Joint, Machine
from elastogeo.sources.compliance import JointLoad, joint_compliance, load_of
from elastogeo.sources.families import family, named
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source

LISTED_POWERS = (1, 2)
_NAME = re.compile(r"CQ(\d)_([XYZABC]{2}[XYZUVWABCS])")


@dataclass(frozen=True, slots=True)
class LoadTimesTravel:
    """Driver: a joint load times the n-th power of the travel of its axis from the centre of the test."""

    load: JointLoad
    power: int

    def __call__(self, situation: Situation) -> Array:
        """Values [N mm^n, ...] at every reading, shape (m,)."""
        return np.asarray(self.load(situation) * situation.from_centre(self.load.axis) ** self.power)


@dataclass(frozen=True, slots=True)
class LoadOnScrew:
    """Driver: the load along a screw, times its free length as a share of the travel (ends 1), or `4 s (1 - s)` (ends 2)."""

    load: JointLoad
    travel: tuple[float, float]
    ends: int

    def __call__(self, situation: Situation) -> Array:
        """Values [N] at every reading, shape (m,)."""
        low, high = self.travel
        share = (situation.command(self.load.axis) - low) / (high - low)
        return np.asarray(self.load(situation) * (share if self.ends == 1 else 4.0 * share * (1.0 - share)))


@family
def travel_dependent_compliance(machine: Machine) -> Iterator[Source]:
    """What each joint compliance gains along the travel of its own axis, and its square."""
    return (_travelling(source, power, machine) for source in joint_compliance(machine) for power in LISTED_POWERS)


@named
def travel_dependent_named(machine: Machine, name: str) -> Source | None:
    """A gain of any power that its name gives: `CQ3_XXX`."""
    match = _NAME.fullmatch(name)
    if not match or not int(match[1]):
        return None
    compliances = {source.name: source for source in joint_compliance(machine)}
    source = compliances.get(f"C_{match[2]}")
    return None if source is None else _travelling(source, int(match[1]), machine)


@family
def screw_compliance(machine: Machine) -> Iterator[Source]:
    """The drive screw of every linear axis whose travel is known, held at one end and at both."""
    on_axis = {source.name: source for source in joint_compliance(machine)}
    for joint in machine.compliant:
        source = on_axis[f"C_{2 * 'XYZABC'[joint.direction]}{joint.name}"]
        if joint.is_rotary or not all(map(isfinite, joint.travel)):
            continue
        for ends, where in ((1, "one end, the nut at the far end"), (2, "both ends, the nut in the middle")):
            yield replace(
                source,
                name=f"CE{ends}_{source.name.removeprefix('C_')}",
                driver=LoadOnScrew(JointLoad(joint.name, joint.direction), joint.travel, ends),
                meaning=f"compliance of the screw of {joint.name}, held at {where}",
            )


def _travelling(source: Source, power: int, machine: Machine) -> Source:
    joint: Joint = machine.joints[machine.index(source.site[1])]
    unit = "rad" if joint.is_rotary else "mm"
    per = unit if power == 1 else f"{unit}^{power}"
    return replace(
        source,
        name=f"CQ{power}_{source.name.removeprefix('C_')}",
        unit=f"{source.unit}/{per}",
        driver=LoadTimesTravel(load_of(source), power),
        meaning=f"what {source.name} gains per {per} of travel of {joint.name}",
    )
