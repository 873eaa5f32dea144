"""The situation of every reading: what the drivers of the error sources may look at."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from elastogeo.machine import Array, Frame, LoopFrames, Machine, Site, carried_to, loop_frames
from elastogeo.observe import Observations


@dataclass(frozen=True, slots=True)
class Situation:
    """The observations of one machine, with what follows from them at each site, computed once.

    Attributes
    ----------
    machine : Machine
    observations : Observations
    frames : LoopFrames
        At the poses of the observations.
    """

    machine: Machine
    observations: Observations
    frames: LoopFrames = field(init=False)
    _carried: dict[tuple[str, Site], Array] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        """Place the frames."""
        observations = self.observations
        object.__setattr__(self, "frames", loop_frames(self.machine, observations.commands, observations.tool))

    def sensitivity(self, site: Site) -> Array:
        """Change of each reading per unit of each twist component at a site, shape (m, 6): `b^T J`."""
        return self._at("direction", site)

    def load(self, axis: str) -> Array:
        """Load along and about the axes of a joint's motion frame, shape (m, 6) [N, N mm]: `J^T W` (Eq. 4.5)."""
        return self._at("wrench", ("motion", axis))

    def command(self, axis: str) -> Array:
        """Commands of an axis, shape (m,) [mm or rad]."""
        return np.asarray(self.observations.commands[:, self.machine.index(axis)])

    def _at(self, quantity: str, site: Site) -> Array:
        if (quantity, site) not in self._carried:
            frame, side = self._frame(site)
            v = getattr(self.observations, quantity)
            self._carried[quantity, site] = carried_to(frame, self.frames.point, v, side)
        return self._carried[quantity, site]

    def _frame(self, site: Site) -> tuple[Frame, float]:
        place, axis = site
        match place:
            case "tool":
                return Frame(self.frames.tool.rotation, self.frames.point), 1.0
            case "workpiece":
                return Frame(self.frames.workpiece.rotation, self.frames.point), -1.0
            case _:
                joint = self.frames.joints[axis]
                return getattr(joint, place), joint.side
