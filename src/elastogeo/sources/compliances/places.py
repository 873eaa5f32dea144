"""Compliance of places that are no axis, where the machine file declares any: `CL_XXholder` (thesis 2.1, 2.5).

Holder, spindle nose, table, the post of a bar: whatever gives way between two carriages, or beyond the last one. A place and
the joint of its own carriage are one spring with a fixed lever between: all 36 compliances of the one are sums of those of
the other, and no pose, force or tool distinguishes them. A probe that spans one of them does, and the own weight of the
carriage, which loads the joint only. Where few compliances are asked for, translations for forces are those of every joint
with no turning axis between; rotations for moments have levers of their own, which tools of several lengths show.
"""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.machine import COMPONENTS, Machine, Place
from elastogeo.sources.compliance import JointLoad, load_words, twist_words
from elastogeo.sources.families import family
from elastogeo.sources.source import Source, twist_unit


@family
def place_compliance(machine: Machine) -> Iterator[Source]:
    """All 36 compliances of every declared place, along the axes of the carriage that it is fixed to."""
    for place in machine.places:
        yield from (_compliance(place, d, f) for d in range(6) for f in range(6))


def _compliance(place: Place, d: int, f: int) -> Source:
    return Source(
        name=f"CL_{COMPONENTS[d]}{COMPONENTS[f]}{place.name}",
        unit=f"{twist_unit(d)}/{'N' if f < 3 else '(N mm)'}",
        site=("place", place.name),
        component=d,
        driver=JointLoad(place.name, f),
        meaning=f"{twist_words(d)} for a {load_words(f)}, at the place {place.name}",
        load=f,
        force_degree=1.0,
    )
