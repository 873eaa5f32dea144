"""Location errors of ISO 230-1: constant twists at a joint's location frame, before its own motion.

The squareness of X to Y is `E_C(0Y)X`: the rotation about z of X relative to Y.
"""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.machine import COMPONENTS, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Sign, Source, twist_unit


def constant(_: Situation) -> float:
    """Driver: 1, whatever the pose and the load."""
    return 1.0


@family
def location_errors(machine: Machine) -> Iterator[Source]:
    """Six constant errors of every joint relative to the joint before it, nearer the foundation (0 for the foundation)."""
    workpiece, tool = machine.topology.workpiece[::-1], machine.topology.tool
    for branch, opposite in ((workpiece, tool), (tool, workpiece)):
        for before, axis in zip(("", *branch), branch, strict=False):
            beside = before or "".join(opposite[:1])
            for d, letter in enumerate(COMPONENTS):
                yield Source(
                    name=f"E_{letter}(0{before}){axis}",
                    unit=twist_unit(d),
                    site=("location", axis),
                    component=d,
                    driver=constant,
                    meaning=f"{'orientation' if d >= 3 else 'position'} error ({letter}) of {axis} "
                    f"relative to {before or 'the foundation'}",
                    sign=_squareness(machine, axis, beside, d),
                )


def _squareness(machine: Machine, axis: str, beside: str, d: int) -> Sign | None:
    """The squareness that a rotation of `axis` is, to the linear axis before it, or across the foundation from it.

    A rotation of the guide turns its direction; where it carries the workpiece, it turns the workpiece with the guide, which
    then sees the other axis turned the other way: the angle between the two changes by the same.
    """
    if d < 3 or not beside:
        return None
    one, other = (machine.joints[machine.index(name)] for name in (axis, beside))
    if one.is_rotary or other.is_rotary or {one.direction, other.direction, d - 3} != {0, 1, 2}:
        return None
    return Sign("squareness", axis, beside, 1.0 if (d - 3 + 1) % 3 == one.direction else -1.0)
