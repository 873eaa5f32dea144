"""Compliance that changes with the force: `CF1_XXX` is what C_XXX gains per newton (5.39), `CF2_XXX` per N^2."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from elastogeo.machine import Array, Machine
from elastogeo.sources.compliance import JointLoad, joint_compliance, load_of
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source

LISTED_POWERS = (1, 2)


@dataclass(frozen=True, slots=True)
class LoadTimesForce:
    """Driver: a joint load times the n-th power of the force on the tool."""

    load: JointLoad
    power: int

    def __call__(self, situation: Situation) -> Array:
        """Values [N^(n+1) or N^(n+1) mm] at every reading, shape (m,)."""
        return self.load(situation) * situation.force() ** self.power


@family
def force_dependent_compliance(machine: Machine) -> Iterator[Source]:
    """What each joint compliance gains per newton, and per newton squared, of the force on the tool."""
    for source in joint_compliance(machine):
        for power in LISTED_POWERS:
            yield replace(
                source,
                name=f"CF{power}_{source.name.removeprefix('C_')}",
                unit=f"{source.unit}/N" if power == 1 else f"{source.unit}/N^{power}",
                driver=LoadTimesForce(load_of(source), power),
                meaning=f"what {source.name} gains per {'N' if power == 1 else f'N^{power}'}",
                force_degree=1.0 + power,
            )
