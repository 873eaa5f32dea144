"""Compliance that depends on the feed: `CV_XXX` is what C_XXX gains per velocity of its axis, `CS_XXX` per speed (8.2).

Moving guides and screws give way otherwise than those at rest. What grows with the velocity changes its sign where the axis
turns back, as damping does; what grows with the speed does not. Runs at one feed do not distinguish them from the compliance
itself or from the lag of the servo; runs at several feeds and forces do.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.machine import Array, Joint, Machine
from elastogeo.sources.compliance import JointLoad, joint_compliance, load_of
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source


@dataclass(frozen=True, slots=True)
class LoadTimesVelocity:
    """Driver: a joint load times the commanded velocity of its axis, or its magnitude."""

    load: JointLoad
    magnitude: bool

    def __call__(self, situation: Situation) -> Array:
        """Values [N mm/s, ...] at every reading, shape (m,)."""
        velocity = situation.velocity(self.load.axis)
        return self.load(situation) * (np.abs(velocity) if self.magnitude else velocity)


@family
def feed_dependent_compliance(machine: Machine) -> Iterator[Source]:
    """What each joint compliance gains per velocity and per speed of its own axis, but for the spindle."""
    for source in joint_compliance(machine):
        joint: Joint = machine.joints[machine.index(source.site[1])]
        if joint.name == "S":
            continue
        per = "rad" if joint.is_rotary else "mm"
        for letter, magnitude, word in (("V", False, "velocity"), ("S", True, "speed")):
            yield replace(
                source,
                name=f"C{letter}_{source.name.removeprefix('C_')}",
                unit=f"{source.unit} s/{per}",
                driver=LoadTimesVelocity(load_of(source), magnitude),
                meaning=f"what {source.name} gains per {word} of {joint.name}",
            )
