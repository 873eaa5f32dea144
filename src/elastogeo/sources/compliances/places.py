"""Compliance of places that are no axis, where the machine file declares any: `CL_XXholder` (thesis 2.1, 2.5).

Holder, spindle nose, table, the post of a bar: whatever gives way between two carriages, or beyond the last one. A place and
the joint of its own carriage are one spring with a fixed lever between: all 36 compliances of the one are sums of those of
the other, and no pose, force or tool distinguishes them. A probe that spans one of them does, and the own weight of the
carriage, which loads the joint only. Where few compliances are asked for, translations for forces are those of every joint
with no turning axis between; rotations for moments have levers of their own, which tools of several lengths show.
"""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.machine import Machine
from elastogeo.sources.compliance import spring
from elastogeo.sources.families import family
from elastogeo.sources.source import Source


@family
def place_compliance(machine: Machine) -> Iterator[Source]:
    """All 36 compliances of every declared place, along the axes of the carriage that it is fixed to."""
    for place in machine.places:
        yield from spring("CL", ("place", place.name), f"the place {place.name}")
