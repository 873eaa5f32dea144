"""Location errors of ISO 230-1: constant twists at a joint's location frame, before its own motion.

The squareness of X to Y is `E_C(0Y)X`: the rotation about z of X relative to Y.
"""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.machine import COMPONENTS, Machine
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source, twist_unit


def constant(_: Situation) -> float:
    """Driver: 1, whatever the pose and the load."""
    return 1.0


@family
def location_errors(machine: Machine) -> Iterator[Source]:
    """Six constant errors of every joint relative to the joint before it, nearer the foundation (0 for the foundation)."""
    for branch in (machine.topology.workpiece[::-1], machine.topology.tool):
        for before, axis in zip(("", *branch), branch, strict=False):
            for d, letter in enumerate(COMPONENTS):
                yield Source(
                    name=f"E_{letter}(0{before}){axis}",
                    unit=twist_unit(d),
                    site=("location", axis),
                    component=d,
                    driver=constant,
                    meaning=f"{'orientation' if d >= 3 else 'position'} error ({letter}) of {axis} "
                    f"relative to {before or 'the foundation'}",
                )
