"""Push and pull apart: `CP_XXX` gives way to a positive load at its joint, `CN_XXX` to a negative one (thesis 2.3).

A preloaded pair of contacts, a screw held by an axial bearing on one side, a joint that opens: each may be stiffer one way.
With both asked for, `C_XXX` itself is their common part and is not distinguished from them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.machine import Array, Machine
from elastogeo.sources.compliance import JointLoad, joint_compliance, load_of
from elastogeo.sources.families import family
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source


@dataclass(frozen=True, slots=True)
class OneWay:
    """Driver: a joint load where it has one sign, else zero."""

    load: JointLoad
    positive: bool

    def __call__(self, situation: Situation) -> Array:
        """Load [N or N mm] at every reading, shape (m,)."""
        load = self.load(situation)
        return np.maximum(load, 0.0) if self.positive else np.minimum(load, 0.0)


@family
def one_way_compliance(machine: Machine) -> Iterator[Source]:
    """What each joint gives way to a positive, and to a negative load."""
    for source in joint_compliance(machine):
        for letter, positive, word in (("P", True, "positive"), ("N", False, "negative")):
            yield replace(
                source,
                name=f"C{letter}_{source.name.removeprefix('C_')}",
                driver=OneWay(load_of(source), positive),
                meaning=f"{source.name} for a {word} load",
            )
