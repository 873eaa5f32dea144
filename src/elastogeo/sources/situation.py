"""The situation of every reading: what the drivers of the error sources may look at."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array, Frame, LoopFrames, Machine, Site, carried_to, loop_frames, weight_loads
from elastogeo.observe import Observations

STANDING = 1e-9
"""A velocity this much smaller than the greatest of the run counts as none: it is rounding error at a reversal."""


@dataclass(frozen=True, slots=True)
class Situation:
    """The observations of one machine, with what follows from them at each site, computed once.

    Attributes
    ----------
    machine : Machine
    observations : Observations
    frames : LoopFrames
        At the poses of the observations.
    weights : dict of str to array, shape (m, 6) or (1, 6) [N, N mm]
        What known weights load each joint and place with that carries any.
    """

    machine: Machine
    observations: Observations
    frames: LoopFrames = field(init=False)
    weights: dict[str, Array] = field(init=False)
    _carried: dict[tuple[str, Site], Array] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        """Place the frames."""
        observations = self.observations
        frames = loop_frames(self.machine, observations.commands, observations.tool)
        object.__setattr__(self, "frames", frames)
        object.__setattr__(self, "weights", weight_loads(self.machine, frames, observations.weight))

    def sensitivity(self, site: Site) -> Array:
        """Change of each reading per unit of each twist component at a site, shape (m, 6): `b^T J`.

        What acts on the reading itself (the length of a bar) has one component, the first. Outside the span of the
        instrument it is zero.
        """
        if site[0] == "reading":
            return np.ones((len(self.observations), 1))
        if not self.sees(site):
            return np.zeros((len(self.observations), 6))
        return self._at("direction", site)

    def sees(self, site: Site) -> bool:
        """Whether a twist at a site moves what the instrument reads: a place moves what sits on it."""
        if site[0] != "place":
            return site[0] == "reading" or self.observations.sees(site[1])
        place = next(place for place in self.machine.places if place.name == site[1])
        return self.observations.sees(place.beyond(self.machine.topology))

    def load(self, name: str) -> Array:
        """Load along and about the axes of a joint's motion frame, or of a place, shape (m, 6) [N, N mm].

        `J^T W` of the wrench at the tool (Eq. 4.5), and the weights that the joint or place carries (8.2).
        """
        of_wrench = self._at("wrench", ("place" if name in self.frames.places else "motion", name))
        return of_wrench + self.weights[name] if name in self.weights else of_wrench

    def command(self, axis: str) -> Array:
        """Commands of an axis, shape (m,) [mm or rad]."""
        return np.asarray(self.observations.commands[:, self.machine.index(axis)])

    def from_centre(self, axis: str) -> Array:
        """Commands of an axis from the centre of the test, shape (m,) [mm or rad]."""
        return np.asarray(self.command(axis) - self.observations.centre[self.machine.index(axis)])

    def velocity(self, axis: str) -> Array:
        """Commanded velocity of an axis, shape (m,) [mm/s or rad/s]."""
        return np.asarray(self.observations.velocity[:, self.machine.index(axis)])

    def sense(self, axis: str) -> Array:
        """Sign of the velocity of an axis, shape (m,): 0 where it stands, or turns back at this very reading.

        Of readings at standstill, the way in which the axis moved last.
        """
        if self.observations.sense is not None:
            return np.asarray(self.observations.sense[:, self.machine.index(axis)])
        velocity = self.velocity(axis)
        return np.where(np.abs(velocity) > STANDING * np.abs(velocity).max(), np.sign(velocity), 0.0)

    def side(self, axis: str) -> float:
        """+1 for an axis that carries the tool, -1 for one that carries the workpiece and moves by minus its command."""
        return self.frames.joints[axis].side

    def acceleration(self, axis: str) -> Array:
        """Commanded acceleration of an axis, shape (m,) [mm/s^2].

        Raises
        ------
        UnsupportedError
            If it is not known: a rotary axis turns along the path.
        """
        if self.observations.acceleration is None:
            raise UnsupportedError(
                f"run {self.observations.run!r} has no accelerations, since a rotary axis turns along its path; "
                f"ask for no parameter that an acceleration drives"
            )
        return np.asarray(self.observations.acceleration[:, self.machine.index(axis)])

    def force(self) -> Array:
        """Size of the force on the tool, shape (m,) [N]."""
        return np.asarray(np.linalg.norm(self.observations.wrench[:, :3], axis=1))

    def _at(self, quantity: str, site: Site) -> Array:
        if (quantity, site) not in self._carried:
            frame, side = self._frame(site)
            v = getattr(self.observations, quantity)
            self._carried[quantity, site] = carried_to(frame, self.frames.point, v, side)
        return self._carried[quantity, site]

    def _frame(self, site: Site) -> tuple[Frame, float]:
        kind, name = site
        match kind:
            case "tool":
                return Frame(self.frames.tool.rotation, self.frames.point), 1.0
            case "workpiece":
                return Frame(self.frames.workpiece.rotation, self.frames.point), -1.0
            case "place":
                return self.frames.places[name]
            case _:
                joint = self.frames.joints[name]
                return getattr(joint, kind), joint.side
